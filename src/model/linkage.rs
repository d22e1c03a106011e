//! From the controller's numbers to the angles of the rows: signs, zero offsets, coupled displays, and the closed
//! parallelogram solved exactly.
//!
//! Two words are kept apart. The *joint number* `q` is what the controller shows. The *actuator angle* is how far the
//! drive has turned its own axis, in the controller's sense: `q` plus the share of another joint where the display is
//! coupled. Drive errors (deflection, play, encoder errors) act on actuator angles.

use nalgebra::Vector2;

use crate::geometry::orientation::angle_near;
use crate::geometry::real::Real;

use super::robot::{DOF, LOOP_AROUND, LOOP_DRIVEN, Parallelogram, Robot};

/// Errors of the loop's rods, metres. The rocker is kept as the scale of the loop; the arm follows link 2's length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopErrors<T> {
    /// Crank P-Q.
    pub crank_m: T,
    /// Coupler Q-R.
    pub coupler_m: T,
    /// Arm P-S: the error of link 2's length, which the open chain has too.
    pub arm_m: T,
}

/// Row angles and how they follow the actuators.
#[derive(Clone, Copy, Debug)]
pub struct RowAngles<T> {
    /// Angle of each row, rad.
    pub theta_rad: [T; DOF],
    /// How the driven row turns with the actuator of the joint it goes around: zero without a loop.
    pub driven_by_around: T,
    /// How the driven row turns with its own actuator: its sign without a loop.
    pub driven_by_own: T,
    /// Second derivatives of the driven row's angle, 1/rad: by the actuator it goes around twice, by both actuators,
    /// by its own twice. Zero without a loop and for equal opposite sides.
    pub driven_curvature: [T; 3],
}

impl<T: Real> RowAngles<T> {
    /// All rows at zero.
    pub fn none() -> Self {
        let zero = T::zero();
        Self { theta_rad: [zero; DOF], driven_by_around: zero, driven_by_own: zero, driven_curvature: [zero; 3] }
    }
}

/// Speeds and accelerations of the rows.
#[derive(Clone, Copy, Debug)]
pub struct RowRates<T> {
    /// Speed of each row, rad/s.
    pub speed_rad_s: [T; DOF],
    /// Acceleration of each row, rad/s^2.
    pub acceleration_rad_s2: [T; DOF],
}

/// Row rates of actuator rates, through the loop: `theta3' = J a'`, `theta3'' = J a'' + a'^T H a'` with the slopes J
/// and the curvature H of the closed loop.
pub fn row_rates<T: Real>(
    robot: &Robot,
    angles: &RowAngles<T>,
    actuator_speed_rad_s: &[f64; DOF],
    actuator_acceleration_rad_s2: &[f64; DOF],
) -> RowRates<T> {
    let speed = actuator_speed_rad_s.map(T::constant);
    let acceleration = actuator_acceleration_rad_s2.map(T::constant);
    let signed = |of: &[T; DOF]| std::array::from_fn(|joint| of[joint] * T::constant(robot.joints[joint].sign));
    let mut rates = RowRates { speed_rad_s: signed(&speed), acceleration_rad_s2: signed(&acceleration) };
    let follows = |of: &[T; DOF]| angles.driven_by_around * of[LOOP_AROUND] + angles.driven_by_own * of[LOOP_DRIVEN];
    let (around, own) = (speed[LOOP_AROUND], speed[LOOP_DRIVEN]);
    let [around_twice, both, own_twice] = angles.driven_curvature;
    let bend = around_twice * around * around + both * around * own * T::constant(2.0) + own_twice * own * own;
    rates.speed_rad_s[LOOP_DRIVEN] = follows(&speed);
    rates.acceleration_rad_s2[LOOP_DRIVEN] = follows(&acceleration) + bend;
    rates
}

/// The loop cannot close: the rods are too short for this pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the parallelogram cannot close in this pose")]
pub struct LoopOpen;

/// Actuator angles of controller numbers, rad.
pub fn actuators_from_numbers<T: Real>(robot: &Robot, numbers_rad: &[T; DOF]) -> [T; DOF] {
    let mut actuators = *numbers_rad;
    for coupling in &robot.couplings {
        let share = coupling.factor * robot.joints[coupling.joint].sign;
        actuators[coupling.joint] += numbers_rad[coupling.by] * T::constant(share);
    }
    actuators
}

/// Controller numbers of actuator angles, rad: the inverse of [`actuators_from_numbers`].
pub fn numbers_from_actuators(robot: &Robot, actuators_rad: &[f64; DOF]) -> [f64; DOF] {
    // Couplings enter through other joints' numbers, which are themselves coupled at most in a chain of DOF links.
    let mut numbers = *actuators_rad;
    for _ in 0..DOF {
        let before = numbers;
        numbers = *actuators_rad;
        for coupling in &robot.couplings {
            let share = coupling.factor * robot.joints[coupling.joint].sign;
            numbers[coupling.joint] -= before[coupling.by] * share;
        }
        if numbers == before {
            break;
        }
    }
    numbers
}

/// Row angles of actuator angles.
///
/// # Errors
/// [`LoopOpen`] when the rods of the parallelogram cannot meet.
pub fn row_angles<T: Real>(
    robot: &Robot,
    actuators_rad: &[T; DOF],
    loop_errors: &LoopErrors<T>,
) -> Result<RowAngles<T>, LoopOpen> {
    let theta_rad: [T; DOF] = std::array::from_fn(|joint| {
        let row = &robot.joints[joint];
        actuators_rad[joint] * T::constant(row.sign) + T::constant(row.theta_rad)
    });
    let own_sign = T::constant(robot.joints[LOOP_DRIVEN].sign);
    let driven_curvature = [T::zero(); 3];
    let open = RowAngles { theta_rad, driven_by_around: T::zero(), driven_by_own: own_sign, driven_curvature };
    let Some(parallelogram) = &robot.parallelogram else {
        return Ok(open);
    };
    let offset = T::constant(parallelogram.crank_offset_rad);
    let arm_angle = theta_rad[LOOP_AROUND];
    // The crank keeps its own angle when joint 2 moves: the constant part of theta_2 belongs to it, its turn does not.
    let crank_angle = theta_rad[LOOP_DRIVEN] + T::constant(robot.joints[LOOP_AROUND].theta_rad) + offset;
    let rocker = close_loop(parallelogram, loop_errors, arm_angle, crank_angle)?;
    let mut angles = open;
    angles.theta_rad[LOOP_DRIVEN] = rocker.angle_rad - arm_angle - offset;
    angles.driven_by_around = (rocker.by_arm - T::one()) * T::constant(robot.joints[LOOP_AROUND].sign);
    angles.driven_by_own = rocker.by_crank * own_sign;
    let [arm_twice, both, crank_twice] = rocker.curvature;
    let both_signs = T::constant(robot.joints[LOOP_AROUND].sign * robot.joints[LOOP_DRIVEN].sign);
    // The arm's own turn is subtracted from the rocker's at constant rate: it has no part in the curvature.
    angles.driven_curvature = [arm_twice, both * both_signs, crank_twice];
    Ok(angles)
}

/// The rocker's angle and how it follows the arm and the crank.
#[derive(Clone, Copy, Debug)]
struct Rocker<T> {
    angle_rad: T,
    by_arm: T,
    by_crank: T,
    /// Second derivatives: by the arm twice, by arm and crank, by the crank twice.
    curvature: [T; 3],
}

fn direction<T: Real>(angle_rad: T) -> Vector2<T> {
    let (sin, cos) = num_dual::DualNum::sin_cos(&angle_rad);
    Vector2::new(cos, sin)
}

fn across<T: Real>(unit: &Vector2<T>) -> Vector2<T> {
    Vector2::new(-unit.y, unit.x)
}

/// Solves P-Q-R-S for the rocker: `|S + rocker u(phi) - Q| = coupler`, on the branch next to the parallel one
/// (Nguyen, Le and Kang 2019, equations 5 to 7, in closed form).
fn close_loop<T: Real>(
    parallelogram: &Parallelogram,
    errors: &LoopErrors<T>,
    arm_angle: T,
    crank_angle: T,
) -> Result<Rocker<T>, LoopOpen> {
    let crank_m = T::constant(parallelogram.crank_m) + errors.crank_m;
    let coupler_m = T::constant(parallelogram.coupler_m) + errors.coupler_m;
    let arm_m = T::constant(parallelogram.arm_m) + errors.arm_m;
    let rocker_m = T::constant(parallelogram.rocker_m);

    let crank_unit = direction(crank_angle);
    let arm_unit = direction(arm_angle);
    // From S to Q; the rocker's tip R lies `coupler` away from Q.
    let s_to_q = crank_unit * crank_m - arm_unit * arm_m;
    let distance_squared = s_to_q.dot(&s_to_q);
    let distance = num_dual::DualNum::sqrt(&distance_squared);
    let cosine =
        (distance_squared + rocker_m * rocker_m - coupler_m * coupler_m) / (T::constant(2.0) * rocker_m * distance);
    if cosine.value().is_nan() || cosine.value().abs() >= 1.0 {
        return Err(LoopOpen);
    }
    // The rocker leans off the line to Q by the angle of that cosine, to the side on which the crank is nearer.
    let sine = num_dual::DualNum::sqrt(&((T::one() - cosine) * (T::one() + cosine)));
    let beside = s_to_q.x * crank_unit.y - s_to_q.y * crank_unit.x;
    let side = if beside.value() >= 0.0 { sine } else { -sine };
    let toward_q = s_to_q / distance;
    let rocker_unit = toward_q * cosine + across(&toward_q) * side;
    // Same turn as the crank, so that t3 is continuous.
    let angle = num_dual::DualNum::atan2(&rocker_unit.y, rocker_unit.x);
    let angle_rad = angle + T::constant(angle_near(angle.value(), crank_angle.value()) - angle.value());

    let coupler = rocker_unit * rocker_m - s_to_q;
    // How R, Q and S turn: d/dt of the three pins per radian of rocker, crank and arm.
    let (rocker_swing, crank_swing, arm_swing) =
        (across(&rocker_unit) * rocker_m, across(&crank_unit) * crank_m, across(&arm_unit) * arm_m);
    let lever = coupler.dot(&rocker_swing);
    let by_arm = -coupler.dot(&arm_swing) / lever;
    let by_crank = coupler.dot(&crank_swing) / lever;
    // `e.e = coupler^2` differentiated twice, `e` the coupler: e'.e' + e.e'' = 0, with the turning pins' centripetal
    // parts in e''.
    let (by_arm_only, by_crank_only) = (rocker_swing * by_arm + arm_swing, rocker_swing * by_crank - crank_swing);
    let inward =
        [coupler.dot(&rocker_unit) * rocker_m, coupler.dot(&crank_unit) * crank_m, coupler.dot(&arm_unit) * arm_m];
    let curvature = [
        (inward[0] * by_arm * by_arm + inward[2] - by_arm_only.dot(&by_arm_only)) / lever,
        (inward[0] * by_arm * by_crank - by_arm_only.dot(&by_crank_only)) / lever,
        (inward[0] * by_crank * by_crank - inward[1] - by_crank_only.dot(&by_crank_only)) / lever,
    ];
    Ok(Rocker { angle_rad, by_arm, by_crank, curvature })
}

/// The actuator angle of the driven joint that gives row angle `driven_theta_rad`, when the joint it goes around
/// stands at `around_theta_rad` (both angles of rows): the loop solved the other way round.
///
/// # Errors
/// [`LoopOpen`] when the rods cannot meet.
pub fn driven_actuator(robot: &Robot, around_theta_rad: f64, driven_theta_rad: f64) -> Result<f64, LoopOpen> {
    let row = &robot.joints[LOOP_DRIVEN];
    let Some(parallelogram) = &robot.parallelogram else {
        return Ok((driven_theta_rad - row.theta_rad) * row.sign);
    };
    // Seen from P instead of S the crank takes the rocker's part: swap the two and turn the arm round.
    let mirrored = Parallelogram { crank_m: parallelogram.rocker_m, rocker_m: parallelogram.crank_m, ..*parallelogram };
    let none = LoopErrors { crank_m: 0.0, coupler_m: 0.0, arm_m: 0.0 };
    let rocker_angle = around_theta_rad + driven_theta_rad + parallelogram.crank_offset_rad;
    let crank = close_loop(&mirrored, &none, around_theta_rad + std::f64::consts::PI, rocker_angle)?;
    let own = crank.angle_rad - parallelogram.crank_offset_rad - robot.joints[LOOP_AROUND].theta_rad;
    Ok((own - row.theta_rad) * row.sign)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::fixture;

    const ERRORS: LoopErrors<f64> = LoopErrors { crank_m: 4e-3, coupler_m: -3e-3, arm_m: 2e-3 };

    fn driven_theta(robot: &Robot, around: f64, own: f64) -> f64 {
        let actuators = [0.0, around, own, 0.0, 0.0, 0.0];
        row_angles(robot, &actuators, &ERRORS).expect("a closed loop").theta_rad[LOOP_DRIVEN]
    }

    #[test]
    fn slopes_and_curvature_of_the_loop_are_its_differences() {
        let mut robot = fixture::looped_with_masses();
        robot.joints[LOOP_AROUND].sign = -1.0;
        for (around, own) in [(0.3, 0.2), (-0.4, 0.1), (0.5, -0.6)] {
            let theta = |i: f64, j: f64| driven_theta(&robot, around + i * 1e-3, own + j * 1e-3);
            let angles = row_angles(&robot, &[0.0, around, own, 0.0, 0.0, 0.0], &ERRORS).expect("a closed loop");
            let slopes = [(theta(1.0, 0.0) - theta(-1.0, 0.0)) / 2e-3, (theta(0.0, 1.0) - theta(0.0, -1.0)) / 2e-3];
            assert!((angles.driven_by_around - slopes[0]).abs() < 1e-7);
            assert!((angles.driven_by_own - slopes[1]).abs() < 1e-7);
            let curvature = [
                (theta(1.0, 0.0) - 2.0 * theta(0.0, 0.0) + theta(-1.0, 0.0)) / 1e-6,
                (theta(1.0, 1.0) - theta(1.0, -1.0) - theta(-1.0, 1.0) + theta(-1.0, -1.0)) / 4e-6,
                (theta(0.0, 1.0) - 2.0 * theta(0.0, 0.0) + theta(0.0, -1.0)) / 1e-6,
            ];
            for (exact, difference) in angles.driven_curvature.iter().zip(curvature) {
                assert!((exact - difference).abs() < 1e-7, "{exact} against {difference}");
                assert!(exact.abs() > 1e-4, "the rods differ: {exact}");
            }
        }
    }

    #[test]
    fn row_rates_are_the_row_angles_in_motion() {
        let robot = fixture::looped_with_masses();
        let start = [0.1, 0.3, -0.2, 0.4, 0.5, 0.6];
        let speed = [0.5, 1.2, -0.9, 1.0, -2.0, 0.3];
        let acceleration = [1.0, -2.0, 3.0, 0.4, 0.1, -5.0];
        let at = |t: f64| {
            let actuators = std::array::from_fn(|j| start[j] + speed[j] * t + 0.5 * acceleration[j] * t * t);
            row_angles(&robot, &actuators, &ERRORS).expect("a closed loop")
        };
        let rates = row_rates(&robot, &at(0.0), &speed, &acceleration);
        let step = 1e-3;
        for joint in 0..DOF {
            let [before, now, after] = [-step, 0.0, step].map(|t| at(t).theta_rad[joint]);
            assert!((rates.speed_rad_s[joint] - (after - before) / (2.0 * step)).abs() < 1e-5);
            let second = (after - 2.0 * now + before) / (step * step);
            assert!((rates.acceleration_rad_s2[joint] - second).abs() < 1e-5);
        }
    }
}

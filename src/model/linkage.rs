//! From the controller's numbers to the angles of the rows: signs, zero offsets, coupled displays, and the closed
//! parallelogram solved exactly.
//!
//! Two words are kept apart. The *joint number* `q` is what the controller shows. The *actuator angle* is how far the
//! drive has turned its own axis, in the controller's sense: `q` plus the share of another joint where the display is
//! coupled. Drive errors (deflection, play, encoder errors) act on actuator angles.

use nalgebra::Vector2;

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
    let open = RowAngles { theta_rad, driven_by_around: T::zero(), driven_by_own: own_sign };
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
    Ok(angles)
}

/// The rocker's angle and how it follows the arm and the crank.
#[derive(Clone, Copy, Debug)]
struct Rocker<T> {
    angle_rad: T,
    by_arm: T,
    by_crank: T,
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
    let toward_q = num_dual::DualNum::atan2(&s_to_q.y, s_to_q.x);
    let opening = num_dual::DualNum::acos(&cosine);
    let branches = [toward_q + opening, toward_q - opening];
    let away = |angle: &T| ((angle.value() - crank_angle.value()) * 0.5).sin().abs();
    let chosen = if away(&branches[0]) <= away(&branches[1]) { branches[0] } else { branches[1] };
    // Same turn as the crank, so that t3 is continuous.
    let turns = ((crank_angle.value() - chosen.value()) / std::f64::consts::TAU).round();
    let angle_rad = chosen + T::constant(turns * std::f64::consts::TAU);

    let rocker_unit = direction(angle_rad);
    let coupler = rocker_unit * rocker_m - s_to_q;
    let lever = coupler.dot(&across(&rocker_unit)) * rocker_m;
    Ok(Rocker {
        angle_rad,
        by_arm: -(coupler.dot(&across(&arm_unit)) * arm_m) / lever,
        by_crank: coupler.dot(&across(&crank_unit)) * crank_m / lever,
    })
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

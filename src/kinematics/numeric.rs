//! Inverse kinematics by iteration, for arms without a closed form.

use nalgebra::{Matrix6, Vector6};

use crate::geometry::pose::{Pose, pose_difference};
use crate::model::chain::{Chain, Rows};
use crate::model::effect::Response;
use crate::model::robot::DOF;

/// Pose error, m and rad, that counts as none.
const REACHED: f64 = 1e-11;
/// Rounds after which a start is given up.
const ROUNDS: usize = 60;

/// Where an iteration ended.
#[derive(Clone, Copy, Debug)]
pub struct Ended {
    /// Row angles, rad.
    pub theta_rad: [f64; DOF],
    /// Distance from the wanted position, m.
    pub position_m: f64,
    /// Angle from the wanted orientation, rad.
    pub orientation_rad: f64,
}

impl Ended {
    /// True when the pose is met.
    pub fn reached(&self) -> bool {
        self.position_m < 10.0 * REACHED && self.orientation_rad < 10.0 * REACHED
    }
}

/// Follows the row angles from `start_rad` to the pose: damped least squares with the damping of Levenberg and
/// Marquardt (Nakamura and Hanafusa 1986; Sugihara 2011 for damping by the residual).
///
/// Lengths are weighed by `size_m`, so that a metre at full reach counts as a radian.
pub fn follow(
    rows: &Rows<f64>,
    still: &Response<f64>,
    base_t_flange: &Pose,
    start_rad: &[f64; DOF],
    size_m: f64,
) -> Ended {
    let mut theta_rad = *start_rad;
    let mut chain = rows.at(&theta_rad, still);
    let mut error = scaled_error(base_t_flange, &chain, size_m);
    let mut damping = 1e-3;
    for _ in 0..ROUNDS {
        if error.norm() < 0.1 * REACHED || damping > 1e8 {
            break;
        }
        let jacobian = scaled_jacobian(&chain, size_m);
        let square = jacobian.transpose() * jacobian;
        let Some(factor) = (square + Matrix6::identity() * (damping * error.norm_squared() + 1e-18)).cholesky() else {
            damping *= 10.0;
            continue;
        };
        let mut step = factor.solve(&(jacobian.transpose() * error));
        // More than half a radian at once leaves the range in which the Jacobian says anything.
        let longest = step.amax();
        if longest > 0.5 {
            step *= 0.5 / longest;
        }
        let tried = std::array::from_fn(|row| theta_rad[row] + step[row]);
        let tried_chain = rows.at(&tried, still);
        let tried_error = scaled_error(base_t_flange, &tried_chain, size_m);
        if tried_error.norm() < error.norm() {
            (theta_rad, chain, error) = (tried, tried_chain, tried_error);
            damping = (damping * 0.2).max(1e-6);
        } else if error.norm() < REACHED {
            break;
        } else {
            damping *= 8.0;
        }
    }
    let (shift, turn) = pose_difference(base_t_flange, &chain.flange());
    Ended { theta_rad, position_m: shift.norm(), orientation_rad: turn.norm() }
}

fn scaled_error(base_t_flange: &Pose, chain: &Chain<f64>, size_m: f64) -> Vector6<f64> {
    let (shift, turn) = pose_difference(base_t_flange, &chain.flange());
    let shift = shift / size_m;
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

fn scaled_jacobian(chain: &Chain<f64>, size_m: f64) -> Matrix6<f64> {
    let flange = chain.flange().translation;
    let columns = chain.axes.map(|axis| {
        let shift = axis.direction.cross(&(flange - axis.origin)) / size_m;
        let turn = axis.direction;
        Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
    });
    Matrix6::from_columns(&columns)
}

/// Starts that cover the cube of row angles evenly: the additive recurrence of the generalised golden ratio
/// (Roberts 2018, sequence R6).
pub fn spread_starts(count: u32) -> impl Iterator<Item = [f64; DOF]> {
    // The root of x^7 = x + 1.
    const RATIO: f64 = 1.112_775_684_278_705_5;
    (1..=count).map(|index| {
        std::array::from_fn(|row| {
            let step = RATIO.powi(-(row as i32 + 1));
            ((0.5 + f64::from(index) * step).fract() * 2.0 - 1.0) * std::f64::consts::PI
        })
    })
}

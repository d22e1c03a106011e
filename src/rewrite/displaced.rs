//! Targets that are another target plus a constant displacement (RAPID `Offs`, `RelTool`).
//!
//! Only the displacement's numbers are its own; its orientation is that of the base target. So the position is made to
//! land exactly, with the orientation that the corrected base target has; what that leaves in orientation is told.

use crate::geometry::pose::{Pose, pose_difference};
use crate::kinematics::choose::Wish;
use crate::kinematics::controller::Controller;
use crate::model::conditions::Conditions;
use crate::model::robot::DOF;
use crate::program::target::{Displacement, DisplacementKind, position_m, values};

use crate::invert::RealArm;

use super::setting::{Obstacle, Setting};

/// Position error at which the displaced point counts as reached, m.
const REACHED_M: f64 = 5e-8;
/// Rounds; each leaves less than a hundredth of the error.
const MOST_ROUNDS: usize = 20;

/// The pose at a displacement from `base`, both in the frame of the base target.
pub fn displaced(base: &Pose, displacement: &Displacement) -> Pose {
    let shift = position_m(values(&displacement.position), displacement.units);
    let translation = match displacement.kind {
        DisplacementKind::Frame => base.translation + shift,
        DisplacementKind::Tool => base.translation + base.rotation * shift,
    };
    Pose { rotation: base.rotation * displacement.rotation, translation }
}

/// The displacement that carries `base` to a point, m, in the frame of the displacement.
pub fn displacement_to(base: &Pose, point: &nalgebra::Vector3<f64>, kind: DisplacementKind) -> nalgebra::Vector3<f64> {
    let shift = point - base.translation;
    match kind {
        DisplacementKind::Frame => shift,
        DisplacementKind::Tool => base.rotation.transpose() * shift,
    }
}

/// A command with a given orientation whose position lands.
pub struct Landing {
    /// The target to write, in its frame.
    pub target: Pose,
    /// Joint numbers that the controller then commands, rad.
    pub numbers_rad: [f64; DOF],
    /// Orientation error that stays, rad.
    pub orientation_left_rad: f64,
    /// Rounds taken.
    pub rounds: usize,
}

/// Finds the target with the orientation of `start` that lands at the position of `meant`, both in the target's frame.
///
/// # Errors
/// [`Obstacle`] when the arm cannot go there.
pub fn land_position(
    arm: &RealArm<'_>,
    controller: &Controller,
    setting: &Setting,
    conditions: &Conditions,
    meant: &Pose,
    start: &Pose,
    near_rad: &[f64; DOF],
) -> Result<Landing, Obstacle> {
    let mut target = *start;
    let mut near = *near_rad;
    for rounds in 0..MOST_ROUNDS {
        let flange = setting.nominal_flange(&target);
        let choice = controller
            .solve(&flange, &Wish::default(), Some(&near))
            .map_err(|error| Obstacle::refused(error.to_string()))?;
        near = choice.numbers_rad;
        let real = arm.flange(&near, conditions).map_err(|error| Obstacle::refused(error.to_string()))?;
        let (miss, turned) = pose_difference(meant, &setting.landed(&real));
        if miss.norm() <= REACHED_M {
            let orientation_left_rad = turned.norm();
            return Ok(Landing { target, numbers_rad: near, orientation_left_rad, rounds });
        }
        target.translation += miss;
    }
    Err(Obstacle::refused("the displaced position does not converge"))
}

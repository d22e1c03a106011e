//! Targets that write a tool's axis and leave its turn about that axis to a rule (APT).
//!
//! The rule has to hold for the corrected target, not for the real arm: the controller, or the post processor before it,
//! completes the axis that is written. So the real tool arrives a little turned about its own axis, which nothing asks
//! for, and at the right point with the right axis, which is what the target says.

use crate::geometry::orientation::OrientationConvention;
use crate::geometry::pose::{Pose, rotation_z};
use crate::invert::Correction;

use super::setting::Obstacle;

/// Turn about the tool's axis, rad, at which the rule counts as kept.
const KEPT_RAD: f64 = 1e-10;
/// Rounds; each leaves the turn times the arm's error in radians.
const MOST_ROUNDS: usize = 12;

/// The correction whose target keeps the rule of `convention`, and that target.
///
/// `command` corrects a pose: the correction, and the target that brings the real tool there. It is asked for `written`
/// turned about the tool's axis by ever better amounts.
///
/// # Errors
/// [`Obstacle`] of `command`, or where the rule says nothing: the tool stands along its direction.
pub fn along_axis(
    convention: OrientationConvention,
    written: &Pose,
    command: impl Fn(&Pose) -> Result<(Correction, Pose), Obstacle>,
) -> Result<(Correction, Pose), Obstacle> {
    let mut spin_rad = 0.0;
    for _ in 0..MOST_ROUNDS {
        let meant = Pose { rotation: written.rotation * rotation_z(spin_rad), ..*written };
        let (correction, after) = command(&meant)?;
        let numbers = convention.numbers(&after.rotation, &[]);
        let Some(ruled) = convention.rotation(&numbers) else {
            return Err(Obstacle::refused("the tool's axis lies along the direction that is to turn the tool"));
        };
        let turn = ruled.transpose() * after.rotation;
        let off_rad = turn[(1, 0)].atan2(turn[(0, 0)]);
        if off_rad.abs() <= KEPT_RAD {
            let after = if correction.iterations == 0 { *written } else { Pose { rotation: ruled, ..after } };
            return Ok((correction, after));
        }
        spin_rad -= off_rad;
    }
    Err(Obstacle::refused("no turn about the tool's axis keeps the rule that turns the tool"))
}

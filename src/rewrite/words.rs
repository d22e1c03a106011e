//! The reasons of refusals, in words that a programmer can act on.

use crate::invert::InversionError;
use crate::kinematics::controller::Controller;
use crate::kinematics::posture::Singularity;
use crate::model::robot::DOF;

/// Sine below which a straight wrist or a stretched elbow is named as the cause.
const NEAR_SIN: f64 = 0.1;
/// Distance of the wrist centre from axis 1, as a part of the arm's size, below which that is named as the cause.
const NEAR_AXIS: f64 = 0.05;

/// Why the real arm cannot be brought there: which singularity it is, and what helps.
pub fn no_command(error: &InversionError, controller: &Controller, nominal_rad: &[f64; DOF]) -> String {
    let InversionError::Singular { .. } = error else {
        return error.to_string();
    };
    let Some(near) = singularity_at(controller, nominal_rad) else {
        return error.to_string();
    };
    let axis_5_deg = nominal_rad[4].to_degrees();
    let shoulder = near.shoulder_m / controller.size_m() / NEAR_AXIS;
    let [wrist, elbow] = [near.wrist_sin / NEAR_SIN, near.elbow_sin / NEAR_SIN];
    let least = shoulder.min(wrist).min(elbow);
    let (cause, help) = if least > 1.0 {
        return error.to_string();
    } else if least == wrist {
        (format!("wrist singularity: joint 5 at {axis_5_deg:.2} deg puts axes 4 and 6 in line"), "bend the wrist")
    } else if least == elbow {
        ("the arm is stretched (or folded) as far as it goes".to_string(), "move the target off that bound")
    } else {
        ("the wrist centre stands over axis 1".to_string(), "move the target away from axis 1")
    };
    format!("{cause}; no small turn of the joints makes up for the arm's errors there; {help}")
}

/// How near the arm stands to each singularity at these numbers.
fn singularity_at(controller: &Controller, numbers_rad: &[f64; DOF]) -> Option<Singularity> {
    let flange = controller.forward(numbers_rad).ok()?;
    let branches = controller.inverse(&flange).ok()?;
    let away = |other: &[f64; DOF]| -> f64 {
        // Turns of axes 4 and 6 are arbitrary where the wrist is straight.
        [0, 1, 2, 4].iter().map(|&joint: &usize| (other[joint] - numbers_rad[joint]).abs()).sum()
    };
    branches
        .iter()
        .min_by(|a, b| away(&a.numbers_rad).total_cmp(&away(&b.numbers_rad)))
        .map(|solution| solution.singularity)
}

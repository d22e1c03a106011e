//! What is known about the moment at which the arm stands somewhere: everything but the joint numbers themselves.

use super::robot::{DOF, Mass};

/// The circumstances of one pose. Effects that need what is absent here contribute nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Conditions {
    /// The sense in which each joint last moved before it stood: -1, 0 (unknown), +1, in the controller's sense.
    pub approach: [f64; DOF],
    /// Joint speeds, rad/s, in a continuous recording.
    pub speed_rad_s: Option<[f64; DOF]>,
    /// Joint accelerations, rad/s^2, in a continuous recording.
    pub acceleration_rad_s2: Option<[f64; DOF]>,
    /// Time since the start of the recording, s.
    pub time_s: Option<f64>,
    /// Arm temperature, deg C.
    pub temperature_c: Option<f64>,
    /// What the flange carries, where it is not the robot file's payload.
    pub payload: Option<Mass>,
}

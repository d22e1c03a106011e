//! Status and turn: which of the inverse kinematic solutions a position means.
//!
//! What is certain (KUKA, expert programming manual, "Status and Turn"; agrees with taught points of a KR 210):
//! * S bit 0: set where the wrist centre lies behind axis 1, in the system that turns with axis 1 (overhead area).
//! * S bit 1: the bend of the elbow. It follows the sign of A3, shifted by the angle that the offset between axis 3 and
//!   the wrist makes: set in the usual bend, so that the meeting point of both is the stretched arm.
//! * S bit 2: set where A5 is negative (of its turn next to zero).
//! * T bit n: set where axis n + 1 stands at a negative angle.
//!
//! S bit 4 (the point was taught by an absolutely accurate robot) says nothing about the posture. Higher bits neither.
//! A continuous motion keeps the status of its start and ignores both numbers: see `targets`.

use crate::program::target::Configuration;

/// No axis turns farther than ten turns from zero.
const FARTHEST_DEG: f64 = 3600.0;

/// What status and turn ask for; numbers that are absent, negative or too large ask for nothing.
pub(super) fn configuration(status: Option<i64>, turn: Option<i64>) -> Configuration {
    let mut wanted = Configuration::default();
    if let Some(status) = status.filter(|status| (0..128).contains(status)) {
        let bit = |number: u32| status & (1 << number) != 0;
        wanted.rear = Some(bit(0));
        wanted.elbow_down = Some(!bit(1));
        wanted.wrist_negative = Some(bit(2));
    }
    if let Some(turn) = turn.filter(|turn| (0..64).contains(turn)) {
        wanted.joint_intervals_deg = (0..6)
            .map(|joint| match turn & (1 << joint) {
                0 => (joint, 0.0, FARTHEST_DEG),
                _ => (joint, -FARTHEST_DEG, 0.0),
            })
            .collect();
    }
    wanted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_sides_and_signs() {
        let wanted = configuration(Some(0b10110), Some(0b110010));
        assert_eq!((wanted.rear, wanted.elbow_down, wanted.wrist_negative), (Some(false), Some(false), Some(true)));
        let negative: Vec<usize> =
            wanted.joint_intervals_deg.iter().filter(|(_, _, max)| *max == 0.0).map(|(joint, _, _)| *joint).collect();
        assert_eq!(negative, [1, 4, 5]);
        assert_eq!(configuration(None, None), Configuration::default());
        assert_eq!(configuration(Some(-1), Some(400)), Configuration::default());
    }
}

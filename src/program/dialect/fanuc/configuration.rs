//! `CONFIG : 'N U T, 0, 1, 0'`: posture letters and turn numbers. The text is never rewritten.
//!
//! N and F: axis 5 negative and positive (onerobotics.com, "The perils of six-axis robots", with numbers; the RoboDK
//! post). U and D: elbow up and down. T and B: in front of and behind axis 1.
//!
//! The turn numbers count full turns of J1, J4 and J6: floor((q + 180) / 360), as the RoboDK post has it. Programs of
//! R-2000iC arms, whose J5 cannot turn that far, hold `0, 1, 0`, which agrees.

use crate::program::target::Configuration;

/// The joints, from 0, that the three turn numbers belong to.
const TURNING_JOINTS: [usize; 3] = [0, 3, 5];

/// Reads the text between the quotes. Letters and numbers that are not understood ask for nothing.
pub(super) fn configuration(text: &[u8]) -> Configuration {
    let text = String::from_utf8_lossy(text);
    let mut parts = text.split(',');
    let mut configuration = Configuration::default();
    for letter in parts.next().unwrap_or_default().split_whitespace() {
        match letter {
            "N" => configuration.wrist_negative = Some(true),
            "F" => configuration.wrist_negative = Some(false),
            "U" => configuration.elbow_down = Some(false),
            "D" => configuration.elbow_down = Some(true),
            "T" => configuration.rear = Some(false),
            "B" => configuration.rear = Some(true),
            _ => {}
        }
    }
    let turns: Vec<Option<i8>> = parts.map(|turn| turn.trim().parse().ok()).collect();
    if turns.len() == TURNING_JOINTS.len() {
        for (joint, turn) in TURNING_JOINTS.into_iter().zip(turns) {
            let Some(turn) = turn.map(f64::from) else { continue };
            configuration.joint_intervals_deg.push((joint, 360.0 * turn - 180.0, 360.0 * turn + 180.0));
        }
    }
    configuration
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_and_turns() {
        let read = configuration(b"N U T, 0, 1, -1");
        assert_eq!((read.wrist_negative, read.elbow_down, read.rear), (Some(true), Some(false), Some(false)));
        assert_eq!(read.joint_intervals_deg, [(0, -180.0, 180.0), (3, 180.0, 540.0), (5, -540.0, -180.0)]);
        let read = configuration(b"F D B, 0, 0, 0");
        assert_eq!((read.wrist_negative, read.elbow_down, read.rear), (Some(false), Some(true), Some(true)));
    }

    #[test]
    fn what_is_not_understood_asks_for_nothing() {
        assert_eq!(configuration(b""), Configuration::default());
        assert_eq!(configuration(b"? ? ?, x, 999999, \xff"), Configuration::default());
        assert_eq!(configuration(b"N, 0, 0").joint_intervals_deg, []);
    }
}

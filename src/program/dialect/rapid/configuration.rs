//! Configuration data and additional axes of a target.

use crate::program::number::is_nine_e_nine;
use crate::program::target::{Configuration, ExternalAxis};

/// Reads `confdata` `[cf1, cf4, cf6, cfx]`.
///
/// cf1, cf4 and cf6 number the quarter turn in which axes 1, 4 and 6 stand: k means 90 k to 90 (k + 1) degrees. cfx
/// numbers the eight solutions of a serial arm: 4 for the wrist centre behind axis 1, 2 for the wrist centre behind
/// the lower arm, 1 for axis 5 below zero (ABB, RAPID Instructions, Functions and Data Types 3HAC050917, `confdata`:
/// table of cfx against the three singularities). A cfx outside 0..7 says nothing.
pub fn configuration([cf1, cf4, cf6, cfx]: [f64; 4]) -> Configuration {
    let quarters = [(0, cf1), (3, cf4), (5, cf6)];
    // A quadrant beyond the turns of any axis is a mark such as 9E9, not a place.
    let intervals = quarters.into_iter().filter(|(_, quarter)| quarter.fract() == 0.0 && quarter.abs() < 100.0);
    let bits = (cfx.fract() == 0.0 && (0.0..8.0).contains(&cfx)).then_some(cfx as u8);
    Configuration {
        joint_intervals_deg: intervals.map(|(axis, k)| (axis, 90.0 * k, 90.0 * (k + 1.0))).collect(),
        rear: bits.map(|bits| bits & 4 != 0),
        elbow_down: bits.map(|bits| bits & 2 != 0),
        wrist_negative: bits.map(|bits| bits & 1 != 0),
        near_joints_deg: None,
    }
}

/// Reads `extjoint`: 9E9 stands for an axis that is not there.
pub fn external_axes(values: [f64; 6]) -> Vec<ExternalAxis> {
    let present = "abcdef".chars().zip(values).filter(|(_, value)| !is_nine_e_nine(*value));
    present.map(|(letter, value)| ExternalAxis { name: format!("eax_{letter}"), value }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrants_and_solution_numbers_become_intervals_and_branches() {
        let read = configuration([0.0, -1.0, 2.0, 5.0]);
        assert_eq!(read.joint_intervals_deg, [(0, 0.0, 90.0), (3, -90.0, 0.0), (5, 180.0, 270.0)]);
        assert_eq!((read.rear, read.elbow_down, read.wrist_negative), (Some(true), Some(false), Some(true)));
        let unused = configuration([0.0, 0.0, 0.0, 9e9]);
        assert_eq!((unused.rear, unused.elbow_down, unused.wrist_negative), (None, None, None));
    }

    #[test]
    fn absent_axes_are_left_out() {
        let axes = external_axes([1500.0, 9e9, 9e9, -3.5, 9e9, 9e9]);
        assert_eq!(
            axes.iter().map(|axis| (axis.name.as_str(), axis.value)).collect::<Vec<_>>(),
            [("eax_a", 1500.0), ("eax_d", -3.5)]
        );
    }
}

//! `///RCONF l,m,n,o,p,q,..`: how the arm stands. The line is never rewritten.
//!
//! m: 0 upper, 1 lower arm. n: 0 front, 1 rear. o, p, q: R, T, S below (0) or beyond (1) 180 degrees (NX100 and DX100
//! manuals, 4.1). Beyond may be on either side, so only "below" asks for something.
//!
//! l: 0 flip, 1 no-flip. The NX100 manual (3.9) tells flip by the R axis: -90 to 90 degrees. Jobs of a YRC1000 have
//! `1` at positions that are taught beside pulse positions with R near zero and B negative: there no-flip is a negative
//! B (inferred). Lines of 24 values (DX100 and later) are read so, shorter ones as the NX100 manual says.

use crate::program::target::Configuration;

const NEW_LENGTH: usize = 24;
const AXIS_S: usize = 0;
const AXIS_R: usize = 3;
const AXIS_T: usize = 5;

/// Reads what stands behind `///RCONF`. Values that are neither 0 nor 1 ask for nothing.
pub(super) fn configuration(text: &[u8]) -> Configuration {
    let text = String::from_utf8_lossy(text);
    let flags: Vec<Option<bool>> = text
        .split(',')
        .map(|flag| match flag.trim() {
            "0" => Some(false),
            "1" => Some(true),
            _ => None,
        })
        .collect();
    let flag = |index: usize| flags.get(index).copied().flatten();
    let by_wrist = flags.len() >= NEW_LENGTH;
    let mut joint_intervals_deg = Vec::new();
    for (index, joint) in [(5, AXIS_S), (3, AXIS_R), (4, AXIS_T)] {
        if flag(index) == Some(false) {
            let flipped_wrist = joint == AXIS_R && !by_wrist && flag(0) == Some(false);
            let limit = if flipped_wrist { 90.0 } else { 180.0 };
            joint_intervals_deg.push((joint, -limit, limit));
        }
    }
    Configuration {
        joint_intervals_deg,
        rear: flag(2),
        elbow_down: flag(1),
        wrist_negative: if by_wrist { flag(0) } else { None },
        near_joints_deg: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twenty_four_values_tell_flip_by_the_wrist() {
        let read = configuration(b"1,0,1,0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0");
        assert_eq!((read.wrist_negative, read.elbow_down, read.rear), (Some(true), Some(false), Some(true)));
        assert_eq!(read.joint_intervals_deg, [(0, -180.0, 180.0), (3, -180.0, 180.0)]);
    }

    #[test]
    fn six_values_tell_flip_by_the_r_axis() {
        let read = configuration(b" 0,1,0,0,0,1");
        assert_eq!((read.wrist_negative, read.elbow_down, read.rear), (None, Some(true), Some(false)));
        assert_eq!(read.joint_intervals_deg, [(3, -90.0, 90.0), (5, -180.0, 180.0)]);
        assert_eq!(configuration(b"1,0,0,0,0,0").joint_intervals_deg[1], (3, -180.0, 180.0));
    }

    #[test]
    fn what_is_not_understood_asks_for_nothing() {
        assert_eq!(configuration(b""), Configuration::default());
        assert_eq!(configuration(b"x,,2,\xff"), Configuration::default());
    }
}

//! Which of the arm's solutions a pose asks for. The value itself is never rewritten.
//!
//! Hi4/Hi5 write a number, of which a vendor-made post processor sets: 0x02 rear, 0x04 elbow down, 0x08 non-flip. Bit 0
//! stands for "automatic" (inferred from the order of the Hi6 dialog), and then nothing is asked for. The bits for turns
//! over 180 degrees are contradictory in the sources (0x10..0x40 against the high byte) and are not used.
//!
//! Hi6 writes flags (HRScript manual 5.1): `re`, `dn`, `nf`, `auto`, and `s`, `r1`, `r2`, `b` for axes beyond 180 degrees.
//! A flag that is not there is off; the older `fl` meant non-flip before V60.06-07 and says nothing here.
//!
//! Rear: the manual speaks of the tool tip behind the S axis, simulation of the wrist centre; the latter is taken.
//! Flip: "the B-axis coordinate being a + value", non-flip a negative one (Hi6 operation manual 2.3.2.2). B is axis 5.

use crate::program::target::Configuration;

const AUTOMATIC: u64 = 0x01;
const REAR: u64 = 0x02;
const ELBOW_DOWN: u64 = 0x04;
const NON_FLIP: u64 = 0x08;

/// Flags of the axes that may stand beyond 180 degrees: name and joint from 0.
const TURN_FLAGS: [(&str, usize); 4] = [("s", 0), ("r2", 3), ("b", 4), ("r1", 5)];

/// The configuration number of Hi4/Hi5.
pub(super) fn from_number(value: u64) -> Configuration {
    if value & AUTOMATIC != 0 {
        return Configuration::default();
    }
    Configuration {
        rear: Some(value & REAR != 0),
        elbow_down: Some(value & ELBOW_DOWN != 0),
        wrist_negative: Some(value & NON_FLIP != 0),
        ..Configuration::default()
    }
}

/// The configuration string of Hi6, flags divided by semicolons.
pub(super) fn from_flags(text: &str) -> Configuration {
    let flags: Vec<String> = text.split(';').map(|flag| flag.trim().to_lowercase()).collect();
    let has = |name: &str| flags.iter().any(|flag| flag == name);
    if has("auto") {
        return Configuration::default();
    }
    Configuration {
        rear: Some(has("re")),
        elbow_down: Some(has("dn")),
        wrist_negative: (!has("fl")).then(|| has("nf")),
        joint_intervals_deg: TURN_FLAGS
            .iter()
            .filter(|(name, _)| !has(name))
            .map(|&(_, joint)| (joint, -180.0, 180.0))
            .collect(),
        near_joints_deg: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_asks_for_what_its_low_bits_say() {
        let hints = from_number(0x0c);
        assert_eq!((hints.rear, hints.elbow_down, hints.wrist_negative), (Some(false), Some(true), Some(true)));
        assert_eq!(from_number(0x02).rear, Some(true));
        assert_eq!(from_number(0x0601), Configuration::default());
    }

    #[test]
    fn flags_that_are_not_there_are_off() {
        let hints = from_flags("re;R2");
        assert_eq!((hints.rear, hints.elbow_down, hints.wrist_negative), (Some(true), Some(false), Some(false)));
        assert_eq!(hints.joint_intervals_deg, [(0, -180.0, 180.0), (4, -180.0, 180.0), (5, -180.0, 180.0)]);
        assert_eq!(from_flags("fl;r2").wrist_negative, None);
        assert_eq!(from_flags("auto"), Configuration::default());
        assert_eq!(from_flags("nf").wrist_negative, Some(true));
    }
}

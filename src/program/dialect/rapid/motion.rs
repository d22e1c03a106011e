//! Which statements move the arm: by name where the name is ABB's, else by shape.
//!
//! Process packages give every customer other instructions (`ArcL1`, `SpotML`, `MyGlueC`), but all of them carry their
//! positions first, and a tool (with `\WObj` behind it) near the end.

use crate::program::target::PathKind;

/// What the name of a motion instruction says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotionName {
    /// How the TCP travels.
    pub path: PathKind,
    /// True for `SearchL`, `SearchC`: a signal and a variable for the found position come first.
    pub search: bool,
    /// True for moves along an arc: via and end point.
    pub circular: bool,
    /// Positional arguments behind the tool (`MoveLDO`: signal and value; `MoveLSync`: procedure).
    pub after_tool: usize,
}

const FAMILIES: &[&str] = &[
    "move", "arc", "spot", "search", "trigg", "paint", "disp", "clad", "cap", "laser", "mill", "calib", "glue", "nut",
    "weld", "cut", "fc", "seam",
];
/// Between family and path letter: `SpotML`, `FCPressL`, `MoveAbsJ`, `ArcRefL`.
const MIDDLES: &[&str] = &["", "m", "press", "abs", "ref", "adapt"];
/// Behind the path letter, with the number of positional arguments behind the tool.
const TAILS: &[(&str, usize)] = &[
    ("", 0),
    ("do", 2),
    ("ao", 2),
    ("go", 2),
    ("sync", 1),
    ("ios", 0),
    ("start", 0),
    ("end", 0),
    ("1", 0),
    ("2", 0),
    ("1start", 0),
    ("2start", 0),
    ("1end", 0),
    ("2end", 0),
    ("sig", 0),
];

/// Instructions that take a position and a tool without moving.
const STANDING: &[&str] = &["pdispon", "eoffson", "mtooltcpcalib", "stoolrotcalib", "stooltcpcalib", "spottoolchange"];

/// Reads the lower-case name of an instruction; `None` when it is none of ABB's motion instructions.
pub fn motion_name(name: &str) -> Option<MotionName> {
    for family in FAMILIES {
        let Some(rest) = name.strip_prefix(family) else { continue };
        for middle in MIDDLES {
            let Some(letter_and_tail) = rest.strip_prefix(middle) else { continue };
            let mut letters = letter_and_tail.chars();
            let path = match letters.next() {
                Some('l') => PathKind::Linear,
                Some('j') => PathKind::Joint,
                Some('c') => PathKind::ArcEnd,
                _ => continue,
            };
            if let Some((_, after_tool)) = TAILS.iter().find(|(tail, _)| *tail == letters.as_str()) {
                let circular = path == PathKind::ArcEnd;
                return Some(MotionName { path, search: *family == "search", circular, after_tool: *after_tool });
            }
        }
    }
    None
}

/// True for instructions that name a position and a tool, yet leave the arm where it is.
pub fn stands_still(name: &str) -> bool {
    STANDING.contains(&name)
}

/// How a move with an unknown name travels, from its last letter (`MyGlueL`, `ViaJ2`).
pub fn path_of_unknown(name: &str) -> PathKind {
    match name.trim_end_matches(|letter: char| letter.is_ascii_digit()).chars().last() {
        Some('l') => PathKind::Linear,
        Some('j') => PathKind::Joint,
        Some('c') => PathKind::ArcEnd,
        _ => PathKind::Other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_motions_are_read() {
        for (name, path, after_tool) in [
            ("movel", PathKind::Linear, 0),
            ("moveabsj", PathKind::Joint, 0),
            ("movejdo", PathKind::Joint, 2),
            ("movelsync", PathKind::Linear, 1),
            ("arcl1start", PathKind::Linear, 0),
            ("arccend", PathKind::ArcEnd, 0),
            ("spotml", PathKind::Linear, 0),
            ("fcpressc", PathKind::ArcEnd, 0),
            ("trigglios", PathKind::Linear, 0),
            ("nutj", PathKind::Joint, 0),
        ] {
            let read = motion_name(name).map(|motion| (motion.path, motion.after_tool));
            assert_eq!(read, Some((path, after_tool)), "{name}");
        }
        for name in ["moveextj", "arckill", "triggio", "triggequip", "movelist", "spotspecial", "movetolocal", "mover"]
        {
            assert_eq!(motion_name(name), None, "{name}");
        }
        assert!(motion_name("searchc").is_some_and(|motion| motion.search && motion.circular));
    }
}

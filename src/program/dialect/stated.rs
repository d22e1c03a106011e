//! What a program in a neutral format says about itself in a comment, because the format has no words for it:
//!
//! ```text
//! falsetarget: units=mm,deg orientation=fixed-xyz frame=part tool=spindle
//! ```
//!
//! Keys in any order and any case, each at most once a line; a later line holds from there on. `orientation` is one of
//! `fixed-xyz`, `euler-zyx`, `euler-xyz`, `euler-zyz`, `rotation-vector`, `quaternion-wxyz`, `quaternion-xyzw`, and
//! `tool-axis,+x` (tool X as far as it goes along work X; also `-x`, `+y`, ..). `frame=base` is the robot's base,
//! `tool=own` the robot's own tool; without a word the frame is `work` and the tool `tool`, to be found in the cell file.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::orientation::{OrientationConvention, SpinRule};
use crate::program::target::{LengthUnit, Reference};

/// The word that opens a statement, in any case.
const MARK: &str = "falsetarget:";
/// The frame of a program that names none.
const DEFAULT_FRAME: &str = "work";
/// The tool of a program that names none.
const DEFAULT_TOOL: &str = "tool";

/// What is stated up to a place.
#[derive(Clone, Debug)]
pub(super) struct Stated {
    /// What three or four orientation numbers mean.
    pub orientation: Option<OrientationConvention>,
    /// Unit of lengths.
    pub length: Option<LengthUnit>,
    /// Angles are radians.
    pub radians: Option<bool>,
    /// The frame of the targets.
    pub frame: Reference,
    /// The tool that goes there.
    pub tool: Reference,
}

impl Default for Stated {
    fn default() -> Self {
        let named = |word: &str| Reference::Named(word.into());
        Self { orientation: None, length: None, radians: None, frame: named(DEFAULT_FRAME), tool: named(DEFAULT_TOOL) }
    }
}

impl Stated {
    /// Reads a comment's text; what is wrong in a statement is said. True when the comment is a statement.
    pub fn read(&mut self, source: &Source, file: usize, comment: Span, findings: &mut Vec<Diagnostic>) -> bool {
        let text = source.text(comment).into_owned();
        let text = text.trim();
        let Some(rest) =
            text.get(..MARK.len()).filter(|start| start.eq_ignore_ascii_case(MARK)).map(|_| &text[MARK.len()..])
        else {
            return false;
        };
        for word in rest.split_whitespace() {
            if let Err(expected) = self.word(word) {
                let message = format!("`{word}` states nothing that is known: {expected}");
                findings.push(Diagnostic::error("unknown-statement", message).at(file, comment, ""));
            }
        }
        true
    }

    fn word(&mut self, word: &str) -> Result<(), &'static str> {
        let (key, value) = word.split_once('=').ok_or("expected `key=value`")?;
        match key.to_ascii_lowercase().as_str() {
            "orientation" => self.orientation = Some(orientation(value).ok_or(ORIENTATIONS)?),
            "units" => self.units(value)?,
            "frame" => self.frame = reference(value, "base"),
            "tool" => self.tool = reference(value, "own"),
            _ => return Err("the keys are units, orientation, frame and tool"),
        }
        Ok(())
    }

    fn units(&mut self, value: &str) -> Result<(), &'static str> {
        for unit in value.split(',') {
            match (length_unit(unit), angle_unit(unit)) {
                (Some(length), _) => self.length = Some(length),
                (_, Some(radians)) => self.radians = Some(radians),
                _ => return Err("units are mm, m, inch, deg and rad"),
            }
        }
        Ok(())
    }
}

const ORIENTATIONS: &str = "orientations are fixed-xyz, euler-zyx, euler-xyz, euler-zyz, rotation-vector, \
                            quaternion-wxyz, quaternion-xyzw, and tool-axis,+x (-x, +y, -y, +z, -z)";

fn orientation(value: &str) -> Option<OrientationConvention> {
    Some(match value.to_ascii_lowercase().as_str() {
        "fixed-xyz" => OrientationConvention::FixedXyz,
        "euler-zyx" => OrientationConvention::EulerZyx,
        "euler-xyz" => OrientationConvention::EulerXyz,
        "euler-zyz" => OrientationConvention::EulerZyz,
        "rotation-vector" => OrientationConvention::RotationVector,
        "quaternion-wxyz" => OrientationConvention::QuaternionWxyz,
        "quaternion-xyzw" => OrientationConvention::QuaternionXyzw,
        other => {
            let direction = other.strip_prefix("tool-axis,")?.as_bytes();
            let [sign @ (b'+' | b'-'), axis @ b'x'..=b'z'] = direction else { return None };
            OrientationConvention::ToolAxis(SpinRule { axis: axis - b'x', against: *sign == b'-' })
        }
    })
}

fn reference(value: &str, unnamed: &str) -> Reference {
    if value.eq_ignore_ascii_case(unnamed) { Reference::Unnamed } else { Reference::Named(value.into()) }
}

/// The unit of length that a word names.
pub(super) fn length_unit(word: &str) -> Option<LengthUnit> {
    match word.to_ascii_lowercase().as_str() {
        "mm" => Some(LengthUnit::Millimetre),
        "m" => Some(LengthUnit::Metre),
        "inch" | "in" => Some(LengthUnit::Inch),
        _ => None,
    }
}

/// Whether a word names radians; `None` for one that names no unit of angles.
pub(super) fn angle_unit(word: &str) -> Option<bool> {
    match word.to_ascii_lowercase().as_str() {
        "deg" => Some(false),
        "rad" => Some(true),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stated(lines: &[&str]) -> (Stated, usize) {
        let (mut stated, mut findings) = (Stated::default(), Vec::new());
        for line in lines {
            let source = Source::new("t", *line);
            stated.read(&source, 0, Span::new(0, line.len()), &mut findings);
        }
        (stated, findings.len())
    }

    #[test]
    fn a_later_statement_holds_and_names_have_defaults() {
        let (read, wrong) =
            stated(&["FALSETARGET: UNITS=inch,DEG Orientation=Tool-Axis,-Y", "falsetarget: tool=own frame=jig"]);
        assert_eq!(wrong, 0);
        assert_eq!((read.length, read.radians), (Some(LengthUnit::Inch), Some(false)));
        let rule = read.orientation.and_then(OrientationConvention::spin_rule);
        assert_eq!(rule, Some(SpinRule { axis: 1, against: true }));
        assert_eq!((read.tool, read.frame), (Reference::Unnamed, Reference::Named("jig".into())));
        let (nothing, wrong) = stated(&["TOOL=6 MM", "orientation: fixed-xyz", "falsetarge"]);
        assert_eq!((nothing.orientation, wrong), (None, 0));
        assert_eq!((nothing.frame, nothing.tool), (Reference::Named("work".into()), Reference::Named("tool".into())));
    }

    #[test]
    fn what_is_not_known_is_said() {
        for line in ["falsetarget: orientation=xyz", "falsetarget: units=cm", "falsetarget: speed=5", "falsetarget: mm"]
        {
            assert_eq!(stated(&[line]).1, 1, "{line}");
        }
    }
}

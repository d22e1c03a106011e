//! Reading YAML with a place for every complaint.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::base::units::{deg_from_rad, m_from_mm, mm_from_m, rad_from_deg};
use crate::geometry::orientation::OrientationConvention;
use crate::geometry::pose::Pose;

use super::error::FileError;

/// Largest file that is taken for YAML: a whole model with its covariance stays far below.
const LARGEST_BYTES: usize = 64 << 20;

/// Parses a file into a type that denies unknown keys.
///
/// # Errors
/// [`FileError`] with line and column: not UTF-8, not YAML, an unknown or missing key, a wrong type.
pub fn parse<T: DeserializeOwned>(source: &Source, what: &str) -> Result<T, FileError> {
    if source.bytes().iter().all(u8::is_ascii_whitespace) {
        let empty = Diagnostic::error("empty-file", format!("the file is empty; expected {what}"));
        return Err(FileError::new(source, empty.at(0, Span::new(0, 0), "")));
    }
    if source.bytes().len() > LARGEST_BYTES {
        let large = Diagnostic::error("file-size", format!("the file is too large to be {what}"));
        return Err(FileError::new(source, large.at(0, Span::new(0, 0), "")));
    }
    let text = std::str::from_utf8(source.bytes()).map_err(|error| {
        let at = error.valid_up_to();
        let diagnostic = Diagnostic::error("not-utf-8", format!("the file is not UTF-8 text; expected {what}"));
        FileError::new(source, diagnostic.at(0, Span::new(at, at + 1), "first byte that is not text"))
    })?;
    serde_yaml::from_str(text).map_err(|error| {
        let at = error.location().map_or(0, |location| location.index().min(text.len()));
        let end =
            source.bytes()[at..].iter().position(|byte| matches!(byte, b'\n' | b'\r')).map_or(text.len(), |n| at + n);
        let diagnostic = Diagnostic::error("yaml", plain_message(&error.to_string()))
            .at(0, Span::new(at, end), "")
            .help(format!("expected {what}; the keys are listed in docs/files.md"));
        FileError::new(source, diagnostic)
    })
}

/// The library's message without the names of the types here, without whole files quoted, and without its "at line L
/// column C" at the end, which the drawn place says already.
fn plain_message(message: &str) -> String {
    const QUOTED: usize = 40;
    let mut plain = message.rfind(" at line ").map_or(message, |end| &message[..end]).to_string();
    if let (Some(open), Some(close)) = (plain.find('"'), plain.rfind('"'))
        && let Some((cut, _)) = plain[open + 1..close].char_indices().nth(QUOTED)
    {
        plain.replace_range(open + 1 + cut..close, "...");
    }
    if let Some(at) = plain.find("expected struct ") {
        plain.replace_range(at.., "expected keys with values");
    }
    plain
}

/// Where a key stands, for complaints about a value that is well-formed but wrong: at the top level, else (the robot
/// inside a model file) wherever it comes first.
///
/// `item` counts the `- ` entries below the key.
pub fn place_of(source: &Source, key: &str, item: Option<usize>) -> Span {
    let is_key = |text: &[u8]| text.strip_prefix(key.as_bytes()).is_some_and(|rest| rest.first() == Some(&b':'));
    let lines: Vec<Span> = source.lines().collect();
    let top = lines.iter().position(|line| is_key(source.slice(*line)));
    let anywhere = || lines.iter().position(|line| is_key(source.slice(*line).trim_ascii_start()));
    let Some(at) = top.or_else(anywhere) else {
        return Span::new(0, 0);
    };
    let starts_at = |line: Span| line.start + indent(source.slice(line));
    let whole = Span::new(starts_at(lines[at]), lines[at].end);
    let Some(item) = item else {
        return whole;
    };
    let is_entry = |line: &&Span| source.slice(**line).trim_ascii_start().starts_with(b"-");
    let entries: Vec<Span> = lines[at + 1..].iter().filter(is_entry).copied().collect();
    let depth = entries.first().map(|line| indent(source.slice(*line)));
    let mut own = entries.iter().filter(|line| Some(indent(source.slice(**line))) == depth);
    own.nth(item).map_or(whole, |line| Span::new(starts_at(*line), line.end))
}

fn indent(text: &[u8]) -> usize {
    text.len() - text.trim_ascii_start().len()
}

/// A complaint about a value.
pub fn complain(source: &Source, key: &str, item: Option<usize>, code: &'static str, message: String) -> FileError {
    FileError::new(source, Diagnostic::error(code, message).at(0, place_of(source, key, item), ""))
}

/// A pose as files write it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseEntry {
    /// Position, mm.
    pub xyz_mm: [f64; 3],
    /// Fixed X-Y-Z angles, deg: R = Rz(yaw) Ry(pitch) Rx(roll).
    #[serde(default)]
    pub rpy_deg: [f64; 3],
}

impl PoseEntry {
    /// In metres and radians; `None` when a number is not finite.
    pub fn pose(&self) -> Option<Pose> {
        let rotation = OrientationConvention::FixedXyz.rotation(&self.rpy_deg.map(rad_from_deg))?;
        let translation = nalgebra::Vector3::from(self.xyz_mm.map(m_from_mm));
        translation.iter().all(|x| x.is_finite()).then_some(Pose { rotation, translation })
    }

    /// As files write it.
    pub fn from_pose(pose: &Pose) -> Self {
        let angles = OrientationConvention::FixedXyz.numbers(&pose.rotation, &[0.0; 3]);
        Self {
            xyz_mm: std::array::from_fn(|axis| tidy(mm_from_m(pose.translation[axis]))),
            rpy_deg: std::array::from_fn(|axis| tidy(deg_from_rad(angles[axis]))),
        }
    }
}

/// The number to 15 significant digits: what a unit conversion leaves in the sixteenth is not worth writing.
pub fn tidy(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number) + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_below_their_key() {
        let text = "robot:\n  joints:\n    - {name: A}\neffects:\n  - effect: a\n    parameters:\n      - {name: x}\n  - effect: b\n";
        let source = Source::new("t", text);
        let found = |key: &str, item| source.text(place_of(&source, key, item)).into_owned();
        assert_eq!(found("effects", Some(1)), "- effect: b");
        assert_eq!(found("joints", Some(0)), "- {name: A}");
        assert_eq!(found("joints", None), "joints:");
        assert_eq!(found("nothing", None), "");
    }

    #[test]
    fn messages_name_no_types_and_quote_no_files() {
        let long =
            format!("invalid type: string \"{}\", expected struct SchemaOnly at line 1 column 1", "x".repeat(500));
        let plain = plain_message(&long);
        assert!(
            plain.len() < 110 && plain.ends_with("..., expected keys with values") || plain.contains("...\""),
            "{plain}"
        );
        assert!(!plain.contains("SchemaOnly"), "{plain}");
        assert_eq!(
            plain_message("unknown field `a`, expected `b` at line 2 column 3"),
            "unknown field `a`, expected `b`"
        );
    }
}

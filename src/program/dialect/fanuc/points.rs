//! From the entries of a point to a target's value, and the frame and tool it is stored for.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Span;
use crate::geometry::orientation::OrientationConvention;
use crate::program::number::NumberField;
use crate::program::target::{CartesianNumbers, Configuration, ExternalAxis, JointNumbers, TargetValue, Units};

use super::block::{Block, EntryValue};
use super::configuration::configuration;

const CARTESIAN_KEYS: [&str; 6] = ["X", "Y", "Z", "W", "P", "R"];
const JOINT_KEYS: [&str; 6] = ["J1", "J2", "J3", "J4", "J5", "J6"];

/// A point of the `/POS` section.
#[derive(Clone, Debug)]
pub(super) struct Point {
    /// Its number.
    pub number: u32,
    /// The whole point.
    pub span: Span,
    /// Its numbers.
    pub value: TargetValue,
    /// Why they cannot be used, if so.
    pub computed: Option<String>,
    /// The letters and turns.
    pub configuration: Configuration,
    /// `E1`, `E2`, `E3`.
    pub external_axes: Vec<ExternalAxis>,
    /// `UF`.
    pub frame: Stored,
    /// `UT`.
    pub tool: Stored,
}

/// The number of a frame or tool as a point stores it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stored {
    /// This one.
    Number(u32),
    /// `F`, or nothing: whichever is selected when the program runs.
    Any,
}

/// Reads a point; broken numbers go to `diagnostics`.
pub(super) fn point(bytes: &[u8], file: usize, block: &Block, diagnostics: &mut Vec<Diagnostic>) -> Point {
    let entry = |key: &str| block.entries.iter().find(|entry| entry.key == key);
    let stored = |key: &str| match entry(key).map(|entry| &entry.value) {
        Some(EntryValue::Word(word)) => {
            let number = std::str::from_utf8(&bytes[word.start..word.end]).ok().and_then(|text| text.parse().ok());
            number.map_or(Stored::Any, Stored::Number)
        }
        _ => Stored::Any,
    };
    let number = |key: &str| match entry(key).map(|entry| &entry.value) {
        Some(EntryValue::Number(field)) => Some(field.clone()),
        _ => None,
    };
    let quoted = block.entries.iter().find_map(|entry| match entry.value {
        EntryValue::Quoted(span) => Some(span),
        _ => None,
    });
    let (value, computed) = value(block, number);
    for broken in block.entries.iter().filter(|entry| matches!(entry.value, EntryValue::Broken)) {
        let message = format!("`{}` of P[{}] has no readable value", broken.key, block.number);
        diagnostics.push(Diagnostic::error("broken-point", message).at(file, broken.span, ""));
    }
    if !block.closed {
        let message = format!("P[{}] is not closed: the file may have been cut off", block.number);
        diagnostics.push(Diagnostic::error("truncated", message).at(file, block.span, ""));
    }
    let additional = block.entries.iter().filter_map(|entry| match &entry.value {
        EntryValue::Number(field) if is_additional(&entry.key) => {
            Some(ExternalAxis { name: entry.key.clone(), value: field.value })
        }
        _ => None,
    });
    Point {
        number: block.number,
        span: block.span,
        value,
        computed,
        configuration: quoted.map(|span| configuration(&bytes[span.start..span.end])).unwrap_or_default(),
        external_axes: additional.collect(),
        frame: stored("UF"),
        tool: stored("UT"),
    }
}

/// `E1`, or a seventh joint of group 1.
fn is_additional(key: &str) -> bool {
    let numbered = |letter: &str| key.strip_prefix(letter).and_then(|number| number.parse::<u32>().ok());
    numbered("E").is_some() || numbered("J").is_some_and(|number| number > 6)
}

fn value(block: &Block, number: impl Fn(&str) -> Option<NumberField>) -> (TargetValue, Option<String>) {
    let unwritten = |reason: &str| (TargetValue::Unwritten, Some(reason.to_owned()));
    if block.entries.is_empty() {
        return unwritten("the point has no group 1: it moves other axes only");
    }
    let untaught = block.entries.iter().find(|entry| matches!(entry.value, EntryValue::Stars));
    let reason = untaught.map(|entry| format!("`{}` is not taught (asterisks)", entry.key));
    let six = |keys: [&str; 6]| -> Option<[NumberField; 6]> {
        let fields: Vec<NumberField> = keys.into_iter().filter_map(&number).collect();
        fields.try_into().ok()
    };
    if let Some([x, y, z, w, p, r]) = six(CARTESIAN_KEYS) {
        let numbers = CartesianNumbers {
            position: [x, y, z],
            orientation: [w, p, r].into(),
            convention: OrientationConvention::FixedXyz,
            units: Units::MM_DEG,
        };
        return (TargetValue::Cartesian(Box::new(numbers)), reason);
    }
    if let Some(joints) = six(JOINT_KEYS) {
        return (TargetValue::Joint(Box::new(JointNumbers { joints, units: Units::MM_DEG })), reason);
    }
    match reason {
        Some(reason) => unwritten(&reason),
        None if block.entries.iter().any(|entry| entry.key == "RX") => {
            unwritten("the point is stored for a remote TCP (RX, RY, ..)")
        }
        None => unwritten("the point has neither X to R nor J1 to J6"),
    }
}

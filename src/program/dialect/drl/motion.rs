//! Motion commands and their arguments.

use std::ops::Range;

use crate::program::dialect::script::{Kind, Text};
use crate::program::target::{Configuration, PathKind, Reference};

/// What a bare list means in a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bare {
    /// Joint values.
    Joints,
    /// A pose.
    Pose,
}

/// A motion command.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// The command as it is written.
    pub word: String,
    /// Where to, and how.
    pub goals: Vec<(Range<usize>, PathKind)>,
    /// What bare lists mean.
    pub bare: Bare,
    /// The goals are lists of positions.
    pub lists: bool,
    /// From `ref=`.
    pub frame: Option<Reference>,
    /// From `sol=`.
    pub configuration: Configuration,
    /// Why it does not go where the position says.
    pub computed: Option<String>,
}

/// True for the name of a motion command.
pub(super) fn is_motion(word: &str) -> bool {
    shape(word).is_some()
}

fn shape(word: &str) -> Option<(&'static [PathKind], Bare, bool)> {
    Some(match word.strip_prefix('A').unwrap_or(word) {
        "MOVEJ" => (&[PathKind::Joint][..], Bare::Joints, false),
        "MOVEJX" => (&[PathKind::Joint], Bare::Pose, false),
        "MOVEL" => (&[PathKind::Linear], Bare::Pose, false),
        "MOVEC" => (&[PathKind::ArcVia, PathKind::ArcEnd], Bare::Pose, false),
        "MOVESJ" => (&[PathKind::Other], Bare::Joints, true),
        "MOVESX" => (&[PathKind::Other], Bare::Pose, true),
        "MOVEB" => (&[PathKind::Other], Bare::Pose, false),
        _ => return None,
    })
}

/// Reads the command whose name is the token `at`.
pub(super) fn motion(text: Text<'_>, at: usize, end: usize) -> Option<Motion> {
    let word = text.word(at);
    let (paths, bare, lists) = shape(&word)?;
    let (arguments, _) = text.is(at + 1, b'(').then(|| text.parts(at + 1, end))??;
    let mut goals = Vec::new();
    for (index, &path) in paths.iter().enumerate() {
        let names: &[&str] = match (paths.len(), lists) {
            (2, _) if index == 0 => &["POS1"],
            (2, _) => &["POS2"],
            (_, true) => &["POS_LIST"],
            _ => &["POS", "POSX", "POSJ"],
        };
        goals.extend(argument(text, &arguments, Some(index), names).map(|range| (range, path)));
    }
    let relative =
        argument(text, &arguments, None, &["MOD"]).filter(|range| is_value(text, range, "DR_MV_MOD_REL", 1.0));
    let frame = argument(text, &arguments, None, &["REF"]).map(|range| reference(text, &range));
    let solution = argument(text, &arguments, None, &["SOL"]).and_then(|range| text.number(&range));
    let computed = match (&relative, word.ends_with('B')) {
        (Some(_), _) => Some("relative to the position before".to_owned()),
        (None, true) => Some("segments with blends".to_owned()),
        _ => None,
    };
    Some(Motion {
        word: word.to_lowercase(),
        goals,
        bare,
        lists,
        frame,
        configuration: solution.map(|number| configuration(number.value)).unwrap_or_default(),
        computed,
    })
}

/// The argument with one of these names, or the one at this place without a name.
fn argument(text: Text<'_>, all: &[Range<usize>], index: Option<usize>, names: &[&str]) -> Option<Range<usize>> {
    let named = |range: &Range<usize>| text.kind(range.start) == Some(Kind::Name) && text.is(range.start + 1, b'=');
    let by_name =
        all.iter().filter(|range| named(range)).find(|range| names.contains(&text.word(range.start).as_str()));
    if let Some(range) = by_name {
        return Some(range.start + 2..range.end);
    }
    all.get(index?).filter(|range| !named(range)).cloned()
}

fn is_value(text: Text<'_>, range: &Range<usize>, word: &str, number: f64) -> bool {
    text.word(range.start) == word || text.number(range).is_some_and(|field| field.value == number)
}

/// The frame that `ref=` or `set_ref_coord` names.
pub(super) fn reference(text: Text<'_>, range: &Range<usize>) -> Reference {
    if is_value(text, range, "DR_BASE", 0.0) {
        Reference::Unnamed
    } else if is_value(text, range, "DR_WORLD", 2.0) {
        Reference::Named("world".into())
    } else if is_value(text, range, "DR_TOOL", 1.0) {
        Reference::Runtime("in the tool's own coordinates".into())
    } else {
        match text.number(range) {
            Some(number) => Reference::Named(number.value.to_string().into()),
            None => Reference::Runtime(format!("the reference frame is `{}`", text.show(range))),
        }
    }
}

/// Solution 0 to 7.
fn configuration(solution: f64) -> Configuration {
    let known = (0..8_u8).find(|&number| f64::from(number) == solution);
    let Some(bits) = known else { return Configuration::default() };
    Configuration {
        rear: Some(bits & 4 != 0),
        elbow_down: Some(bits & 2 == 0),
        wrist_negative: Some(bits & 1 != 0),
        ..Configuration::default()
    }
}

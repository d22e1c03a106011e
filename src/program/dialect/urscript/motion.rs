//! Moves: which arguments of a call are positions.

use std::ops::Range;

use crate::program::target::PathKind;

use super::token::Text;

/// A call that moves.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Where to, and how.
    pub goals: Vec<(Range<usize>, PathKind)>,
}

/// Reads a move that starts at token `at`; `None` for other statements. Arguments may be named, in any order.
pub(super) fn motion(text: Text<'_>, at: usize, end: usize) -> Option<Motion> {
    let paths: &[PathKind] = match text.word(at) {
        b"movej" | b"optimovej" | b"servoj" => &[PathKind::Joint],
        b"movel" | b"movep" | b"optimovel" => &[PathKind::Linear],
        b"servoc" => &[PathKind::Other],
        b"movec" => &[PathKind::ArcVia, PathKind::ArcEnd],
        _ => return None,
    };
    if !text.is(at + 1, b'(') {
        return None;
    }
    let (arguments, _) = text.parts(at + 1, end)?;
    let names: &[&[u8]] = if paths.len() == 2 { &[b"pose_via", b"pose_to"] } else { &[b"q", b"pose"] };
    let mut goals: Vec<(Range<usize>, PathKind)> = Vec::new();
    for (place, &path) in paths.iter().enumerate() {
        let (index, accepted) = if paths.len() == 2 { (place, &names[place..=place]) } else { (0, names) };
        goals.extend(argument(text, &arguments, index, accepted).map(|range| (range, path)));
    }
    Some(Motion { goals })
}

/// The argument with one of these names, or the one at this place without a name.
pub(super) fn argument(text: Text<'_>, all: &[Range<usize>], index: usize, names: &[&[u8]]) -> Option<Range<usize>> {
    let named = |range: &&Range<usize>| text.is(range.start + 1, b'=') && !text.is(range.start + 2, b'=');
    let by_name = all.iter().filter(named).find(|range| names.contains(&text.word(range.start)));
    if let Some(range) = by_name {
        return Some(range.start + 2..range.end);
    }
    all.get(index).filter(|range| !named(range)).cloned()
}

//! The calls that move.

use std::ops::Range;

use crate::program::target::PathKind;

use super::code::Text;

/// A move: its goals and its tool.
#[derive(Clone, Debug)]
pub(super) struct Move {
    /// `movel`.
    pub word: String,
    /// Its tokens.
    pub tokens: Range<usize>,
    /// Where to.
    pub goals: Vec<(Range<usize>, PathKind)>,
    /// The tool.
    pub tool: Option<Range<usize>>,
    /// Why it does not simply go there.
    pub computed: Option<String>,
}

/// All moves of a program.
pub(super) fn moves(text: &Text<'_>) -> Vec<Move> {
    let mut found = Vec::new();
    for at in 0..text.tokens.len() {
        if !text.is(at + 1, b'(') {
            continue;
        }
        let word = String::from_utf8_lossy(text.word(at)).into_owned();
        let (paths, altered): (&[PathKind], bool) = match word.as_str() {
            "movej" => (&[PathKind::Joint], false),
            "movel" => (&[PathKind::Linear], false),
            "movec" => (&[PathKind::ArcVia, PathKind::ArcEnd], false),
            "alterMovej" => (&[PathKind::Joint], true),
            "alterMovel" => (&[PathKind::Linear], true),
            "alterMovec" => (&[PathKind::ArcVia, PathKind::ArcEnd], true),
            _ => continue,
        };
        let Some((arguments, close)) = text.parts(at + 1).filter(|(parts, _)| parts.len() >= paths.len()) else {
            continue;
        };
        let computed = altered.then(|| "its path is altered at run time".to_owned());
        let goals = arguments.iter().cloned().zip(paths.iter().copied()).collect();
        found.push(Move { word, tokens: at..close + 1, goals, tool: arguments.get(paths.len()).cloned(), computed });
    }
    found
}

//! Moves by their clauses: `MOVE LINEAR TO p VIA q WITH $TOOL = t ADVANCE`.

use std::ops::Range;

use crate::base::text::Source;
use crate::program::dialect::script::{Kind, Text, Tokens};
use crate::program::target::PathKind;

use super::LEXIS;

/// Words that begin a clause of a move.
const CLAUSES: [&str; 20] = [
    "TO",
    "VIA",
    "WITH",
    "ADVANCE",
    "TIL",
    "SYNCMOVE",
    "SYNCMOVEFLY",
    "ENDMOVE",
    "NEAR",
    "AWAY",
    "RELATIVE",
    "ABOUT",
    "BY",
    "FOR",
    "ALONG",
    "IN",
    "SEGMENT",
    "NODECEL",
    "CANCEL",
    "ARM",
];

/// A move.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Where to, and how; the point on the way first.
    pub goals: Vec<(Range<usize>, PathKind)>,
    /// Why it does not go to a position, if so.
    pub relative: bool,
    /// `$NAME = value` of `WITH`.
    pub with: Vec<(String, Range<usize>)>,
}

/// True for a program with moves of this language: `:=`, or the type of interpolation in the move.
pub(super) fn recognises(source: &Source) -> bool {
    let tokens = Tokens::of(source, &LEXIS);
    let text = tokens.text(source);
    let (mut begins, mut assigns, mut moves, mut typed) = (false, false, false, false);
    for statement in &tokens.statements {
        let word = text.word(statement.start);
        begins |= word == "BEGIN" || (word == "PROGRAM" && statement.len() > 1);
        assigns |= statement.clone().any(|at| text.is(at, b':') && text.is(at + 1, b'='));
        if let Some(motion) = motion(text, statement) {
            moves |= !motion.goals.is_empty();
            let named = |at: &usize| matches!(text.word(*at).as_str(), "LINEAR" | "JOINT" | "CIRCULAR");
            typed |= !motion.goals.is_empty() && statement.clone().take(6).any(|at| named(&at));
        }
    }
    begins && moves && (assigns || typed)
}

/// Reads a move; `None` for other statements.
pub(super) fn motion(text: Text<'_>, statement: &Range<usize>) -> Option<Motion> {
    if !matches!(text.word(statement.start).as_str(), "MOVE" | "MOVEFLY") {
        return None;
    }
    let clauses = clauses(text, &(statement.start + 1..statement.end));
    let head = statement.start + 1..clauses.first().map_or(statement.end, |(start, _)| *start);
    let of_type = |word: &str| statement.clone().take(8).any(|at| text.word(at) == word);
    let circular = of_type("CIRCULAR");
    let path = match (circular, of_type("LINEAR"), of_type("JOINT")) {
        (true, _, _) => PathKind::ArcEnd,
        (_, true, _) => PathKind::Linear,
        (_, _, true) => PathKind::Joint,
        _ => PathKind::Other,
    };
    let mut motion = Motion { goals: Vec::new(), relative: head.is_empty() && clauses.is_empty(), with: Vec::new() };
    for (at, operand) in &clauses {
        match text.word(*at).as_str() {
            "TO" => motion.goals.push((operand.clone(), path)),
            "VIA" => motion.goals.insert(0, (operand.clone(), PathKind::ArcVia)),
            "NEAR" | "AWAY" | "RELATIVE" | "ABOUT" | "BY" | "ALONG" | "FOR" => motion.relative = true,
            "WITH" => motion.with.extend(settings(text, operand)),
            _ => {}
        }
        if text.word(*at) == "NEAR" {
            motion.goals.push((operand.clone(), PathKind::Other));
        }
    }
    Some(motion)
}

/// The clauses of a move: the word of each and what stands behind it.
fn clauses(text: Text<'_>, range: &Range<usize>) -> Vec<(usize, Range<usize>)> {
    let (mut depth, mut found): (usize, Vec<(usize, Range<usize>)>) = (0, Vec::new());
    let close = |found: &mut Vec<(usize, Range<usize>)>, at: usize| {
        if let Some((_, operand)) = found.last_mut() {
            operand.end = at;
        }
    };
    for at in range.clone() {
        match text.kind(at) {
            Some(Kind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
            Some(Kind::Symbol(b')' | b']' | b'}')) => depth = depth.saturating_sub(1),
            Some(Kind::Name) if depth == 0 && CLAUSES.contains(&text.word(at).as_str()) => {
                close(&mut found, at);
                found.push((at, at + 1..range.end));
            }
            _ => {}
        }
    }
    // `MOVE TO p, WITH ..`: the comma belongs to neither.
    for (_, operand) in &mut found {
        while operand.end > operand.start && text.is(operand.end - 1, b',') {
            operand.end -= 1;
        }
    }
    found
}

fn settings(text: Text<'_>, operand: &Range<usize>) -> Vec<(String, Range<usize>)> {
    let parts = text.split(operand).into_iter();
    parts
        .filter(|part| text.is(part.start + 1, b'='))
        .map(|part| (text.word(part.start), part.start + 2..part.end))
        .collect()
}

//! Statements: moves, assignments, the names of variables.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use crate::base::text::Source;
use crate::geometry::orientation::OrientationConvention;
use crate::program::dialect::script::{Kind, Position, Text, Tokens, joints_of, pose_of};
use crate::program::target::{Configuration, ExternalAxis, PathKind, TargetValue};

use super::LEXIS;

/// Numbers of a pose or joint position; a figure or additional axes may follow.
const POSE: usize = 6;

/// True for a move with an encoder or pass marker, or beside `TAKEARM`.
pub(super) fn recognises(source: &Source) -> bool {
    let tokens = Tokens::of(source, &LEXIS);
    let text = tokens.text(source);
    let (mut moves, mut others) = (false, false);
    for statement in &tokens.statements {
        let is_move = text.word(statement.start) == "MOVE"
            && matches!(text.word(statement.start + 1).as_str(), "P" | "L" | "C" | "S")
            && text.is(statement.start + 2, b',');
        moves |= is_move;
        others |= is_move && text.is(statement.start + 3, b'@');
        others |= matches!(text.word(statement.start).as_str(), "TAKEARM" | "CHANGETOOL" | "CHANGEWORK");
    }
    moves && others
}

/// What the declarations of a file say about names.
#[derive(Debug, Default)]
pub(super) struct Names {
    joints: HashSet<String>,
    aliases: HashMap<String, Range<usize>>,
}

impl Names {
    /// Collects `DEFJNT`, `DIM .. AS JOINT` and `#DEFINE`.
    pub fn of(text: Text<'_>, tokens: &Tokens) -> Self {
        let mut names = Self::default();
        for statement in &tokens.statements {
            let start = statement.start;
            let declared = |words: Range<usize>| words.filter(|&at| text.kind(at) == Some(Kind::Name));
            if text.word(start) == "DEFJNT" {
                let parts = text.split(&(start + 1..statement.end));
                names.joints.extend(parts.iter().map(|part| text.word(part.start)));
            }
            if text.word(start) == "DIM" && text.word(statement.end - 1) == "JOINT" {
                names.joints.extend(declared(start + 1..statement.end - 2).map(|at| text.word(at)));
            }
            if text.is(start, b'#') && text.word(start + 1) == "DEFINE" && statement.len() > 3 {
                names.aliases.insert(text.word(start + 2), start + 3..statement.end);
            }
        }
        names
    }

    /// The variable that a range names: its key, and whether it is a joint position.
    pub fn variable(&self, text: Text<'_>, range: &Range<usize>) -> Option<(String, bool)> {
        let word = text.word(range.start);
        if let Some(alias) = self.aliases.get(&word).filter(|_| range.len() == 1) {
            return plain(text, alias);
        }
        let (key, joints) = plain(text, range)?;
        Some((key.clone(), joints || self.joints.contains(&key)))
    }
}

/// `P1`, `P01`, `P[1]`, `name`.
fn plain(text: Text<'_>, range: &Range<usize>) -> Option<(String, bool)> {
    let word = text.word(range.start);
    if word.is_empty() {
        return None;
    }
    if range.len() == 1 {
        let digits = word.get(1..).unwrap_or_default();
        let numbered =
            word.starts_with(['P', 'J', 'T']) && !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        let number = digits.trim_start_matches('0');
        let number = if number.is_empty() { "0" } else { number };
        let key = if numbered { format!("{}{number}", &word[..1]) } else { word.clone() };
        return Some((key, numbered && word.starts_with('J')));
    }
    let index = range.start + 2..range.end - 1;
    let indexed = matches!(word.as_str(), "P" | "J" | "T")
        && text.is(range.start + 1, b'[')
        && text.is(range.end - 1, b']')
        && index.len() == 1;
    let number = text.number(&index).filter(|_| indexed)?;
    Some((format!("{word}{}", number.value), word == "J"))
}

/// `(..)`, `P(..)`, `J(..)`; `None` for anything else.
pub(super) fn position(text: Text<'_>, range: &Range<usize>, joints: bool) -> Option<Position> {
    if range.is_empty() {
        return None;
    }
    let (open, joints) = match text.word(range.start).as_str() {
        "P" => (range.start + 1, false),
        "J" => (range.start + 1, true),
        "" => (range.start, joints),
        _ => return None,
    };
    let (parts, close) = text.is(open, b'(').then(|| text.parts(open, range.end))??;
    if close + 1 != range.end {
        return None;
    }
    let span = text.span(range);
    if parts.len() < POSE {
        return Some(Position::plain(span, Err(format!("{} numbers where a position has six", parts.len()))));
    }
    let numbers = match text.numbers(&parts) {
        Ok(numbers) => numbers,
        Err(part) => {
            let reason = format!("a part of the position is computed (`{}`)", text.show(&part));
            return Some(Position::plain(span, Err(reason)));
        }
    };
    let value = match joints {
        true => joints_of(&numbers[..POSE]).map(TargetValue::Joint),
        false => pose_of(&numbers[..POSE], OrientationConvention::FixedXyz).map(TargetValue::Cartesian),
    };
    let more = numbers.iter().skip(POSE).enumerate().filter(|_| joints);
    Some(Position {
        span,
        value: value.ok_or_else(|| "no position".to_owned()),
        configuration: Configuration::default(),
        external_axes: more
            .map(|(index, field)| ExternalAxis { name: format!("J{}", index + 7), value: field.value })
            .collect(),
    })
}

/// The goals of a move: the range of each pose and how the arm goes there.
pub(super) fn goals(text: Text<'_>, statement: &Range<usize>) -> Vec<(Range<usize>, PathKind)> {
    let parts = text.split(&(statement.start + 1..statement.end));
    let Some((interpolation, operands)) = parts.split_first() else { return Vec::new() };
    let paths: &[PathKind] = match text.word(interpolation.start).as_str() {
        "P" => &[PathKind::Joint],
        "L" => &[PathKind::Linear],
        "C" => &[PathKind::ArcVia, PathKind::ArcEnd],
        _ => &[],
    };
    let Some(&last) = paths.last() else { return Vec::new() };
    // Further goals of one move carry a marker, options do not.
    let further = operands.iter().skip(paths.len()).take_while(|operand| text.is(operand.start, b'@'));
    let first = operands.iter().take(paths.len()).zip(paths.iter().copied());
    first.chain(further.map(|operand| (operand, last))).map(|(operand, path)| (unmarked(text, operand), path)).collect()
}

/// A pose without `@P`, `@E`, `@0`, `@10` before it.
pub(super) fn unmarked(text: Text<'_>, operand: &Range<usize>) -> Range<usize> {
    let marked = text.is(operand.start, b'@');
    operand.start + if marked { 2.min(operand.len()) } else { 0 }..operand.end
}

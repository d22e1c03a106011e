//! Statements: assignments of positions, moves, and what tells the language.

use std::ops::Range;

use crate::base::text::Source;
use crate::geometry::orientation::OrientationConvention;
use crate::program::dialect::script::{Kind, Position, Text, Tokens, joints_of, pose_of};
use crate::program::target::{Configuration, ExternalAxis, PathKind, TargetValue};

use super::LEXIS;

/// Numbers of a position or joint position; two additional axes may follow.
const POSE: usize = 6;

/// The paths of the operands of a move.
pub(super) fn paths(word: &str) -> Option<&'static [PathKind]> {
    Some(match word {
        "MOV" | "MVA" => &[PathKind::Joint],
        "MVS" => &[PathKind::Linear],
        "MVR" => &[PathKind::Linear, PathKind::ArcVia, PathKind::ArcEnd],
        "MVR2" => &[PathKind::Linear, PathKind::ArcEnd, PathKind::ArcVia],
        "MVR3" => &[PathKind::Other, PathKind::Other, PathKind::Other],
        "MVC" => &[PathKind::Linear, PathKind::ArcVia, PathKind::ArcVia],
        _ => return None,
    })
}

/// Words that no other robot language has beside `MOV P1`.
const WORDS: [&str; 13] =
    ["MVS", "MVR", "OVRD", "JOVRD", "SPD", "HOPEN", "HCLOSE", "DLY", "SERVO", "M_OUT", "M_IN", "P_CURR", "HLT"];

/// True for a move to a position or variable beside another word of the language or a position.
pub(super) fn recognises(source: &Source) -> bool {
    let tokens = Tokens::of(source, &LEXIS);
    let text = tokens.text(source);
    let (mut moves, mut others) = (false, false);
    for statement in &tokens.statements {
        let statement = body(text, statement);
        let word = text.word(statement.start);
        let operand = text.word(statement.start + 1);
        let to_position =
            operand.starts_with(['P', 'J']) || (text.is(statement.start + 1, b'(') && statement.len() > POSE);
        moves |= paths(&word).is_some() && to_position;
        others |= WORDS.contains(&word.as_str()) && statement.len() > 1;
        others |= assigned(text, &statement)
            .is_some_and(|(_, value)| matches!(position(text, &value, false), Some(Position { value: Ok(_), .. })));
    }
    moves && others
}

/// A statement without its line number and label.
pub(super) fn body(text: Text<'_>, statement: &Range<usize>) -> Range<usize> {
    let numbered = text.kind(statement.start) == Some(Kind::Number) && statement.len() > 1;
    let start = statement.start + usize::from(numbered);
    start..statement.end
}

/// The name and value of an assignment `name = value`.
pub(super) fn assigned(text: Text<'_>, statement: &Range<usize>) -> Option<(usize, Range<usize>)> {
    let named = text.kind(statement.start) == Some(Kind::Name) && text.is(statement.start + 1, b'=');
    (named && statement.len() > 2).then(|| (statement.start, statement.start + 2..statement.end))
}

/// `(..)` or `(..)(..)`; `None` for anything else.
pub(super) fn position(text: Text<'_>, range: &Range<usize>, joints: bool) -> Option<Position> {
    if !text.is(range.start, b'(') {
        return None;
    }
    let (parts, close) = text.parts(range.start, range.end)?;
    let flags = (close + 1 < range.end).then(|| flags(text, &(close + 1..range.end)));
    let span = text.span(range);
    let configuration = match flags {
        None => Configuration::default(),
        Some(Some(configuration)) => configuration,
        Some(None) => return None,
    };
    if parts.len() < POSE {
        return Some(Position::plain(span, Err(format!("{} numbers where a position has six", parts.len()))));
    }
    let numbers = match text.numbers_with_zeros(&parts) {
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
    let more = numbers.iter().skip(POSE).enumerate().filter(|(_, field)| field.insertion.is_none());
    let external_axes =
        more.map(|(index, field)| ExternalAxis { name: format!("L{}", index + 1), value: field.value }).collect();
    Some(Position { span, value: value.ok_or_else(|| "no position".to_owned()), configuration, external_axes })
}

/// `(fl1,fl2)`; hexadecimal and binary numbers ask for nothing.
fn flags(text: Text<'_>, range: &Range<usize>) -> Option<Configuration> {
    let (parts, close) = text.is(range.start, b'(').then(|| text.parts(range.start, range.end))??;
    if close + 1 != range.end {
        return None;
    }
    let flag = |index: usize| parts.get(index).and_then(|part| text.number(part)).map(|field| field.value);
    let mut configuration = Configuration::default();
    if let Some(bits) = flag(0).and_then(|value| (0..8_u8).find(|&bits| f64::from(bits) == value)) {
        configuration.rear = Some(bits & 4 == 0);
        configuration.elbow_down = Some(bits & 2 == 0);
        configuration.wrist_negative = Some(bits & 1 == 0);
    }
    if flag(1) == Some(0.0) {
        configuration.joint_intervals_deg = [0, 3, 5].map(|joint| (joint, -180.0, 180.0)).to_vec();
    }
    Some(configuration)
}

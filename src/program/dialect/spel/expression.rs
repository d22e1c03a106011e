//! Point expressions: `P3`, `pick`, `P(i)`, `XY(..) /L /1`, `JA(..)`, each with what displaces it.

use crate::base::text::{Source, Span};
use crate::program::number::{NumberField, number_at};
use crate::program::scan::Cursor;
use crate::program::target::{JointNumbers, TargetValue, Units};

use super::points::{Point, Points, pose};

/// Where a motion goes.
#[derive(Clone, Debug)]
pub(super) enum Goal {
    /// A point by its number; with what displaces it or asks for another posture.
    Point(u32, Option<String>),
    /// A position that is written out.
    Literal(Box<Point>),
    /// Any point: `P(i)`.
    Indexed,
    /// Known only at run time, with the reason.
    Runtime(String),
}

/// Words that end a point expression: options of motions.
const OPTIONS: [&str; 17] = [
    "CP",
    "ROT",
    "ECP",
    "Till",
    "Find",
    "Sense",
    "LimZ",
    "SYNC",
    "PerformMode",
    "Cx",
    "C0",
    "C1",
    "C2",
    "C3",
    "C4",
    "C5",
    "C6",
];

/// Reads an expression that begins at the cursor; leaves it behind.
pub(super) fn goal(cursor: &mut Cursor<'_>, source: &Source, file: usize, points: &Points) -> (Goal, Span) {
    cursor.skip_blanks();
    let start = cursor.offset();
    let Some(name) = cursor.name() else {
        skip_part(cursor);
        return (Goal::Runtime("it is computed".into()), Span::new(start, cursor.offset()));
    };
    let word = cursor.slice(name).to_ascii_uppercase();
    cursor.skip_blanks();
    let found = match (word.as_slice(), cursor.peek()) {
        (b"XY", Some(b'(')) => {
            let span = bracket(cursor).map(|inside| Span::new(start, inside.end + 1));
            literal(source, file, span, cursor, false)
        }
        (b"JA" | b"AGLTOPLS", Some(b'(')) => {
            let span = bracket(cursor).map(|inside| Span::new(start, inside.end + 1));
            literal(source, file, span, cursor, true)
        }
        (b"P", Some(b'(')) => match bracket(cursor) {
            Some(inside) => {
                let index = String::from_utf8_lossy(cursor.slice(inside)).trim().to_lowercase();
                match points.macros.meaning(&index).parse() {
                    Ok(number) => Goal::Point(number, None),
                    Err(_) => Goal::Indexed,
                }
            }
            None => Goal::Runtime("it is computed".into()),
        },
        (_, Some(b'(')) => {
            let shown = String::from_utf8_lossy(cursor.slice(name)).into_owned();
            bracket(cursor);
            Goal::Runtime(format!("`{shown}` is known only at run time"))
        }
        _ => match point_number(cursor.slice(name), points) {
            Some(number) => Goal::Point(number, None),
            None => Goal::Runtime("no point file of the job holds it".into()),
        },
    };
    let (changed, end) = modifiers(cursor);
    let goal = match (found, changed) {
        (Goal::Point(number, _), changed) => Goal::Point(number, changed),
        (Goal::Literal(point), None) => Goal::Literal(point),
        (Goal::Literal(_), Some(reason)) => Goal::Runtime(reason),
        (other, _) => other,
    };
    (goal, Span::new(start, end.max(name.end)))
}

/// `P3` or a label.
pub(super) fn point_number(name: &[u8], points: &Points) -> Option<u32> {
    let lower = String::from_utf8_lossy(name).to_lowercase();
    let meaning = points.macros.meaning(&lower);
    let numbered = meaning.strip_prefix('p').filter(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
    numbered.and_then(|digits| digits.parse().ok()).or_else(|| points.labels.get(meaning).copied())
}

/// `XY(..)` with `/L`, `/B`, `/2` behind it, or joint values.
fn literal(source: &Source, file: usize, span: Option<Span>, cursor: &mut Cursor<'_>, joints: bool) -> Goal {
    let Some(span) = span else { return Goal::Runtime("it is computed".into()) };
    let text = source.slice(span);
    let open = text.iter().position(|&byte| byte == b'(').unwrap_or_default() + 1;
    let mut fields = Vec::new();
    let mut at = open;
    for part in text[open..text.len() - 1].split(|&byte| byte == b',') {
        let blanks = part.len() - part.trim_ascii_start().len();
        let number = number_at(part.trim_ascii(), 0).filter(|number| number.span().len() == part.trim_ascii().len());
        let Some(number) = number else { return Goal::Runtime("its numbers are computed".into()) };
        let start = span.start + at + blanks;
        fields.push(number.at(start));
        at += part.len() + 1;
    }
    let Ok(six) = <[NumberField; 6]>::try_from(fields) else {
        return Goal::Runtime("it has not six numbers".into());
    };
    let value = match joints {
        true => TargetValue::Joint(Box::new(JointNumbers { joints: six, units: Units::MM_DEG })),
        false => TargetValue::Cartesian(Box::new(pose(six))),
    };
    let mut point = Point {
        file,
        span,
        shown: String::new(),
        value,
        computed: None,
        configuration: Default::default(),
        external_axes: Vec::new(),
        local: 0,
    };
    loop {
        let before = *cursor;
        cursor.skip_blanks();
        if joints || !cursor.eat(b'/') {
            *cursor = before;
            return Goal::Literal(Box::new(point));
        }
        let word = cursor.skip_while(|byte| byte.is_ascii_alphanumeric());
        match cursor.slice(word).to_ascii_uppercase().as_slice() {
            b"R" => point.configuration.rear = Some(false),
            b"L" => point.configuration.rear = Some(true),
            b"A" => point.configuration.elbow_down = Some(false),
            b"B" => point.configuration.elbow_down = Some(true),
            b"J4F0" => point.configuration.joint_intervals_deg.push((3, -180.0, 180.0)),
            b"J6F0" => point.configuration.joint_intervals_deg.push((5, -180.0, 180.0)),
            digits => {
                if let Some(local) = std::str::from_utf8(digits).ok().and_then(|text| text.parse().ok()) {
                    point.local = local;
                }
            }
        }
    }
}

/// What follows a point and changes it: `+Z(10)`, `:U(90)`, `@1`, `/L`. Gives the reason, and the end of all.
fn modifiers(cursor: &mut Cursor<'_>) -> (Option<String>, usize) {
    let start = cursor.offset();
    let mut end = start;
    loop {
        cursor.skip_blanks();
        match cursor.peek() {
            Some(b'+' | b'-' | b':' | b'@' | b'/' | b'*') => {
                cursor.bump();
                cursor.skip_blanks();
                cursor.skip_while(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
                cursor.skip_blanks();
                if cursor.peek() == Some(b'(') && bracket(cursor).is_none() {
                    cursor.seek(usize::MAX);
                }
                end = cursor.offset();
            }
            _ => break,
        }
    }
    if end == start {
        return (None, end);
    }
    let text = String::from_utf8_lossy(cursor.slice(Span::new(start, end))).trim().to_owned();
    (Some(format!("displaced by `{text}`: it moves with the point")), end)
}

/// What stands in the bracket at the cursor, which goes behind the one that closes.
pub(super) fn bracket(cursor: &mut Cursor<'_>) -> Option<Span> {
    let before = *cursor;
    cursor.bump();
    let start = cursor.offset();
    let mut depth = 1_usize;
    while let Some(byte) = cursor.bump() {
        match byte {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(Span::new(start, cursor.offset() - 1));
        }
    }
    *cursor = before;
    cursor.seek(usize::MAX);
    None
}

/// Goes to the next comma outside of brackets, or to an option.
fn skip_part(cursor: &mut Cursor<'_>) {
    while let Some(byte) = cursor.peek() {
        match byte {
            b',' => return,
            b'(' => {
                bracket(cursor);
            }
            _ if byte.is_ascii_alphabetic() => {
                let before = *cursor;
                let word = cursor.name().unwrap_or_default();
                let word = String::from_utf8_lossy(cursor.slice(word)).into_owned();
                if OPTIONS.iter().any(|option| option.eq_ignore_ascii_case(&word)) {
                    *cursor = before;
                    return;
                }
            }
            _ => {
                cursor.bump();
            }
        }
    }
}

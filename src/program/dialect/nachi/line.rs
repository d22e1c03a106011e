//! Lines: motions and what matters to them.

use crate::base::text::Span;
use crate::program::number::{NumberField, number_at, starts_with_word};
use crate::program::scan::Cursor;
use crate::program::target::PathKind;

/// A line that matters.
#[derive(Clone, Debug)]
pub(super) enum Line {
    /// `MOVEX`.
    Motion(Motion),
    /// `P1=(..)`; the numbers are `None` when they are computed.
    Variable(u32, Span, Option<Vec<NumberField>>),
    /// `MODUSRCOORD 1,1,2,3`: the frame, if its number is written, and the pose variables that it is made of.
    Frame(Option<u32>, Vec<u32>),
    /// `CHGCOORD 1`; `None` when the number is computed.
    Select(Option<u32>),
    /// `SETTOOL 1,..`.
    Tool(Option<u32>),
    /// `SHIFTR`, `SHIFTA`, ..: what comes is displaced.
    Shift,
    /// Other ways come in here.
    Join,
    /// `END`.
    End,
}

/// A motion.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// How the arm goes.
    pub path: PathKind,
    /// `X` for a pose, `J` for joint values, or something else.
    pub coordinates: String,
    /// Where to.
    pub goal: Goal,
    /// `H=`.
    pub tool: Option<u32>,
    /// Values of further mechanisms, by name.
    pub further: Vec<(String, f64)>,
}

/// Where a motion goes.
#[derive(Clone, Debug)]
pub(super) enum Goal {
    /// Numbers in brackets; `None` when one is computed.
    Written(Span, Option<Vec<NumberField>>),
    /// A pose variable.
    Variable(u32, Span),
    /// Anything else.
    Other(Span),
}

/// True for a `MOVEX` with a mechanism and a goal: only this language has it.
pub(super) fn is_motion(bytes: &[u8], line: Span) -> bool {
    matches!(read(bytes, line), Some(Line::Motion(Motion { goal: Goal::Written(..) | Goal::Variable(..), .. })))
}

/// Reads a line; those that do not matter give `None`.
pub(super) fn read(bytes: &[u8], line: Span) -> Option<Line> {
    let mut cursor = Cursor::new(bytes, Span::new(line.start, comment(bytes, line)));
    if line.start == 0 && cursor.rest().starts_with(b"\xef\xbb\xbf") {
        cursor.seek(3);
    }
    cursor.skip_blanks();
    if cursor.peek() == Some(b'*') {
        return Some(Line::Join);
    }
    // A step number may stand in front.
    let number = cursor.skip_while(|byte| byte.is_ascii_digit());
    cursor.skip_blanks();
    if cursor.at_end() && !number.is_empty() {
        return Some(Line::Join);
    }
    let word = cursor.name()?;
    let upper = cursor.slice(word).to_ascii_uppercase();
    cursor.skip_blanks();
    let integers = |cursor: Cursor<'_>| -> Vec<Option<u32>> {
        let parts = cursor.rest().split(|&byte| byte == b',');
        parts.map(|part| std::str::from_utf8(part.trim_ascii()).ok()?.parse().ok()).collect()
    };
    match upper.as_slice() {
        b"MOVEX" => motion(cursor).map(Line::Motion),
        b"MODUSRCOORD" => {
            let numbers = integers(cursor);
            let points = numbers.iter().skip(1).flatten().copied().collect();
            Some(Line::Frame(numbers.first().copied().flatten(), points))
        }
        b"CHGCOORD" => Some(Line::Select(integers(cursor).first().copied().flatten())),
        b"SETTOOL" => Some(Line::Tool(integers(cursor).first().copied().flatten())),
        b"NEXT" | b"FOR" | b"GOSUB" | b"CALLP" | b"ENDIF" | b"ELSE" | b"ENDW" | b"RETURN" => Some(Line::Join),
        b"END" => Some(Line::End),
        // `IF .. THEN CHGCOORD 2`: selected under a condition.
        b"IF" if cursor.rest().to_ascii_uppercase().windows(8).any(|word| word == b"CHGCOORD") => {
            Some(Line::Select(None))
        }
        word if word.starts_with(b"SHIFT") => Some(Line::Shift),
        word if word.first() == Some(&b'P') && cursor.eat(b'=') => {
            let number = variable(word)?;
            cursor.skip_blanks();
            let start = cursor.offset();
            let numbers = bracket(&mut cursor);
            let computed = numbers.is_none() || !cursor.rest().trim_ascii().is_empty();
            let end = if computed { start } else { cursor.offset() };
            Some(Line::Variable(number, Span::new(start, end), numbers.filter(|_| !computed).flatten()))
        }
        _ => None,
    }
}

/// True for a line with a step number, to which jumps may go.
pub(super) fn is_numbered(bytes: &[u8], line: Span) -> bool {
    bytes[line.start..line.end].trim_ascii_start().first().is_some_and(u8::is_ascii_digit)
}

/// True for a line that goes to a step number: `GOTO 20`, `IF .. THEN 20`.
pub(super) fn jumps(bytes: &[u8], line: Span) -> bool {
    let text = bytes[line.start..comment(bytes, line)].to_ascii_uppercase();
    let words = text.split(|byte| !byte.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let pairs = words.clone().zip(words.skip(1));
    pairs.into_iter().any(|(word, next)| {
        matches!(word, b"GOTO" | b"GOSUB" | b"THEN" | b"ELSE") && next.iter().all(u8::is_ascii_digit)
    })
}

/// Where the statement of a line ends: `'` begins a comment, and so does `REM`.
fn comment(bytes: &[u8], line: Span) -> usize {
    let text = &bytes[line.start..line.end];
    if starts_with_word(text.trim_ascii_start(), "REM") {
        return line.start;
    }
    let mut quoted = false;
    let found = text.iter().position(|&byte| {
        quoted ^= byte == b'"';
        byte == b'\'' && !quoted
    });
    found.map_or(line.end, |at| line.start + at)
}

/// What stands behind `MOVEX`: parameters, then the robot's mechanism, then further ones.
fn motion(mut cursor: Cursor<'_>) -> Option<Motion> {
    let mut found: Option<Motion> = None;
    let mut tool = None;
    let mut further = Vec::new();
    while !cursor.at_end() {
        cursor.skip_while(|byte| matches!(byte, b',' | b' ' | b'\t'));
        let start = cursor.offset();
        let word = cursor.skip_while(|byte| !matches!(byte, b',' | b'(' | b' ' | b'\t'));
        let text = cursor.slice(word);
        if let Some(number) = text.strip_prefix(b"H=") {
            tool = tool.or_else(|| std::str::from_utf8(number).ok()?.parse().ok());
        } else if let Some((number, coordinates)) = mechanism(text) {
            cursor.skip_while(|byte| matches!(byte, b',' | b' ' | b'\t'));
            let path = match cursor.slice(cursor.clone().skip_while(|byte| byte.is_ascii_alphanumeric())) {
                b"P" => PathKind::Joint,
                b"L" => PathKind::Linear,
                b"C1" => PathKind::ArcVia,
                b"C2" => PathKind::ArcEnd,
                _ => continue,
            };
            cursor.skip_while(|byte| byte.is_ascii_alphanumeric());
            cursor.skip_while(|byte| matches!(byte, b',' | b' ' | b'\t'));
            let goal = goal(&mut cursor);
            match (&found, &goal) {
                (None, _) => found = Some(Motion { path, coordinates, goal, tool: None, further: Vec::new() }),
                (Some(_), Goal::Written(_, Some(fields))) => {
                    let named = |(at, field): (usize, &NumberField)| (format!("M{number}.{}", at + 1), field.value);
                    further.extend(fields.iter().enumerate().map(named));
                }
                (Some(_), _) => {}
            }
        } else if cursor.peek() == Some(b'(') {
            bracket(&mut cursor);
        }
        if cursor.offset() == start {
            cursor.bump();
        }
    }
    found.map(|motion| Motion { tool, further, ..motion })
}

/// `P12`.
fn variable(word: &[u8]) -> Option<u32> {
    let digits = word.strip_prefix(b"P")?;
    let number: u16 = std::str::from_utf8(digits).ok()?.parse().ok()?;
    Some(number.into())
}

/// `M1X` as number and coordinates.
fn mechanism(text: &[u8]) -> Option<(u32, String)> {
    let rest = text.strip_prefix(b"M")?;
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let number = std::str::from_utf8(&rest[..digits]).ok()?.parse().ok()?;
    let letters = &rest[digits..];
    let known = !letters.is_empty() && letters.iter().all(u8::is_ascii_uppercase);
    known.then(|| (number, String::from_utf8_lossy(letters).into_owned()))
}

fn goal(cursor: &mut Cursor<'_>) -> Goal {
    let start = cursor.offset();
    if cursor.peek() == Some(b'(') {
        return match bracket(cursor) {
            Some(fields) => Goal::Written(Span::new(start, cursor.offset()), fields),
            None => Goal::Other(Span::new(start, cursor.offset())),
        };
    }
    let word = cursor.skip_while(|byte| !matches!(byte, b',' | b' ' | b'\t'));
    variable(cursor.slice(word)).map_or(Goal::Other(word), |number| Goal::Variable(number, word))
}

/// The numbers between brackets; the inner value is `None` when one of them is none, the outer when nothing closes.
fn bracket(cursor: &mut Cursor<'_>) -> Option<Option<Vec<NumberField>>> {
    if !cursor.eat(b'(') {
        return None;
    }
    let inside = cursor.skip_while(|byte| byte != b')');
    if !cursor.eat(b')') {
        return None;
    }
    let mut at = inside.start;
    let mut fields = Vec::new();
    for part in cursor.slice(inside).split(|&byte| byte == b',') {
        let start = at + (part.len() - part.trim_ascii_start().len());
        let text = part.trim_ascii();
        match number_at(text, 0).filter(|field| field.span().len() == text.len()) {
            Some(field) => fields.push(field.at(start)),
            None => return Some(None),
        }
        at += part.len() + 1;
    }
    Some(Some(fields))
}

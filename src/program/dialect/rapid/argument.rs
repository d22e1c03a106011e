//! Arguments of calls, lists in square brackets, and literal numbers.

use std::ops::Range;

use crate::program::number::{NumberField, number_at};

use super::statement::FileText;
use super::token::TokenKind;

/// An argument of a call.
#[derive(Clone, Debug)]
pub struct Argument {
    /// The lower-case name of an optional argument (`\WObj:=w`), none for a positional one.
    pub name: Option<String>,
    /// Its tokens; empty for a switch (`\Conc`).
    pub value: Range<usize>,
}

/// The arguments in a range of tokens: the part of an instruction behind its name, or between round brackets.
///
/// A comma before `\` is allowed, as people write it.
pub fn arguments(text: &FileText, range: Range<usize>) -> Vec<Argument> {
    let mut found = Vec::with_capacity(6);
    for piece in split(text, range, |byte| matches!(byte, b',' | b'\\')) {
        if piece.is_empty() {
            continue;
        }
        let switch = piece.start > 0 && text.is_symbol(piece.start - 1, b'\\');
        if !switch {
            found.push(Argument { name: None, value: piece });
            continue;
        }
        let name = Some(text.key(piece.start));
        if text.kind(piece.start + 1) == Some(TokenKind::Assign) && piece.len() > 1 {
            found.push(Argument { name, value: piece.start + 2..piece.end });
        } else {
            found.push(Argument { name, value: piece.start..piece.start });
            // `\Conc p1`: the comma behind a switch is left out.
            if piece.len() > 1 {
                found.push(Argument { name: None, value: piece.start + 1..piece.end });
            }
        }
    }
    found
}

/// The positional arguments.
pub fn positional(arguments: &[Argument]) -> Vec<&Range<usize>> {
    arguments.iter().filter(|argument| argument.name.is_none()).map(|argument| &argument.value).collect()
}

/// The value of an optional argument.
pub fn named<'a>(arguments: &'a [Argument], name: &str) -> Option<&'a Range<usize>> {
    arguments.iter().find(|argument| argument.name.as_deref() == Some(name)).map(|argument| &argument.value)
}

/// Cuts a range at the separators outside of brackets.
fn split<'t>(
    text: &'t FileText,
    range: Range<usize>,
    is_separator: impl Fn(u8) -> bool + 't,
) -> impl Iterator<Item = Range<usize>> + 't {
    let mut start = Some(range.start);
    std::iter::from_fn(move || {
        let from = start?;
        let mut depth = 0usize;
        for at in from..range.end {
            match text.kind(at) {
                Some(TokenKind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
                Some(TokenKind::Symbol(b')' | b']' | b'}')) => depth = depth.saturating_sub(1),
                Some(TokenKind::Symbol(byte)) if depth == 0 && is_separator(byte) => {
                    start = Some(at + 1);
                    return Some(from..at);
                }
                _ => {}
            }
        }
        start = None;
        Some(from..range.end)
    })
}

/// The elements of a list: the range must be `[`, elements, `]` and nothing else.
pub fn list(text: &FileText, range: &Range<usize>) -> Option<Vec<Range<usize>>> {
    elements(text, range).map(Iterator::collect)
}

fn elements<'t>(text: &'t FileText, range: &Range<usize>) -> Option<impl Iterator<Item = Range<usize>> + 't> {
    if !text.is_symbol(range.start, b'[') || text.after_group(range.start, range.end) != Some(range.end) {
        return None;
    }
    Some(split(text, range.start + 1..range.end - 1, |byte| byte == b','))
}

/// A literal number with an optional sign directly before it; `None` for anything else.
///
/// `- 5` with a blank between is an expression: its number could not be written in its place.
pub fn number(text: &FileText, range: &Range<usize>) -> Option<NumberField> {
    let first = text.tokens.get(range.start)?;
    match range.len() {
        1 if first.kind == TokenKind::Number => number_at(text.source.bytes(), first.span().start),
        2 if matches!(first.kind, TokenKind::Symbol(b'-' | b'+')) => {
            let second = text.tokens.get(range.start + 1)?;
            let joined = second.kind == TokenKind::Number && second.span().start == first.span().end;
            if joined { number_at(text.source.bytes(), first.span().start) } else { None }
        }
        _ => None,
    }
}

/// A list of exactly `N` literal numbers.
pub fn numbers<const N: usize>(text: &FileText, range: &Range<usize>) -> Option<[NumberField; N]> {
    let mut fields = Vec::with_capacity(N);
    for element in elements(text, range)?.take(N + 1) {
        fields.push(number(text, &element)?);
    }
    fields.try_into().ok()
}

/// The values of a list of exactly `N` literal numbers.
pub fn values<const N: usize>(text: &FileText, range: &Range<usize>) -> Option<[f64; N]> {
    numbers::<N>(text, range).map(|fields| fields.map(|field| field.value))
}

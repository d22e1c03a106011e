//! The elements of a tuple `(..)` or list `[..]`: numbers, hexadecimal values, strings, anything else.

use crate::base::text::Span;
use crate::program::number::NumberField;
use crate::program::scan::Cursor;

use super::header::is_blank;

/// One element.
#[derive(Clone, Debug)]
pub(super) enum Element {
    /// A decimal number.
    Number(NumberField),
    /// `&H0601`, `&B1000`, `0x2A`, `0b101`.
    Radix(u64),
    /// The inside of a string.
    Text(Span),
    /// A variable, an expression, nothing.
    Other(Span),
}

/// The closing bracket is missing; where the text stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unclosed(pub Span);

/// Reads from an opening bracket to its closing one and leaves the cursor behind it. One pass, no recursion.
///
/// # Errors
/// [`Unclosed`] when the cursor's range ends before the bracket closes.
pub(super) fn elements(cursor: &mut Cursor<'_>) -> Result<Vec<Element>, Unclosed> {
    let start = cursor.offset();
    let close = if cursor.bump() == Some(b'[') { b']' } else { b')' };
    let mut found = Vec::new();
    loop {
        cursor.skip_while(is_blank);
        let before = *cursor;
        let simple = simple_element(cursor);
        cursor.skip_while(is_blank);
        let element = match simple {
            Some(element) if matches!(cursor.peek(), Some(byte) if byte == b',' || byte == close) => element,
            _ => {
                *cursor = before;
                Element::Other(skip_expression(cursor, close))
            }
        };
        let empty = matches!(&element, Element::Other(span) if span.is_empty());
        match cursor.bump() {
            None => return Err(Unclosed(Span::new(start, cursor.offset()))),
            Some(byte) if byte == close => {
                if !(empty && found.is_empty()) {
                    found.push(element);
                }
                return Ok(found);
            }
            Some(_) => found.push(element),
        }
    }
}

fn simple_element(cursor: &mut Cursor<'_>) -> Option<Element> {
    if let Some(value) = radix_value(cursor) {
        return Some(Element::Radix(value));
    }
    if let Some(number) = cursor.number() {
        return Some(Element::Number(number));
    }
    string(cursor).map(Element::Text)
}

/// A value in hexadecimal or binary spelling; nothing is consumed where there is none.
pub(super) fn radix_value(cursor: &mut Cursor<'_>) -> Option<u64> {
    let rest = cursor.rest();
    let radix = match (rest.first()?, rest.get(1)?.to_ascii_lowercase()) {
        (b'&', b'h') | (b'0', b'x') => 16,
        (b'&', b'b') | (b'0', b'b') => 2,
        _ => return None,
    };
    let digits = rest[2..].iter().take_while(|byte| char::from(**byte).is_digit(radix)).count();
    let text = std::str::from_utf8(&rest[2..2 + digits]).ok()?;
    let value = u64::from_str_radix(text, radix).ok()?;
    cursor.seek(cursor.offset() + 2 + digits);
    Some(value)
}

/// The inside of a string in `".."` or, inside of another string, `\"..\"`.
pub(super) fn string(cursor: &mut Cursor<'_>) -> Option<Span> {
    let escaped = cursor.rest().starts_with(b"\\\"");
    if !escaped && cursor.peek() != Some(b'"') {
        return None;
    }
    let before = *cursor;
    cursor.seek(cursor.offset() + if escaped { 2 } else { 1 });
    let start = cursor.offset();
    while let Some(byte) = cursor.bump() {
        if escaped && byte == b'\\' && cursor.eat(b'"') {
            return Some(Span::new(start, cursor.offset() - 2));
        }
        if !escaped && byte == b'\\' {
            cursor.bump();
        } else if !escaped && byte == b'"' {
            return Some(Span::new(start, cursor.offset() - 1));
        }
    }
    *cursor = before;
    None
}

/// Goes to the next comma or closing bracket outside of brackets and strings.
fn skip_expression(cursor: &mut Cursor<'_>, close: u8) -> Span {
    let start = cursor.offset();
    let mut depth = 0_usize;
    let mut in_string = false;
    while let Some(byte) = cursor.peek() {
        match byte {
            b'"' => in_string = !in_string,
            _ if in_string => {}
            b',' if depth == 0 => break,
            byte if depth == 0 && byte == close => break,
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        cursor.bump();
    }
    Span::new(start, cursor.offset())
}

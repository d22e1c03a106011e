//! Aggregates: `{X 10.5,Y 20,S 'B0110',CM {X 1},IPO_FRAME #BASE}`, optionally with their type in front: `{FRAME: X 1}`.

use crate::base::text::Span;
use crate::program::number::NumberField;
use crate::program::scan::Cursor;

use super::statement::{key, name, trimmed};

/// What a component holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// A decimal number.
    Number(NumberField),
    /// `'B0110'`, `'H1F'`.
    Bits(u64),
    /// The word behind `#`, in lower case.
    Constant(String),
    /// Another aggregate.
    Nested(Span),
    /// A variable, an expression, a string, nothing.
    Other(Span),
}

/// Components in the order of the text, names in lower case.
#[derive(Clone, Debug)]
pub(super) struct Aggregate {
    /// From brace to brace.
    pub span: Span,
    /// The components.
    pub components: Vec<(String, Value)>,
}

/// The closing brace is missing; where the text stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unclosed(pub Span);

impl Aggregate {
    /// The component of this name.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.components.iter().find(|(own, _)| own == name).map(|(_, value)| value)
    }

    /// A component that is a number.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Value::Number(field) => Some(field.value),
            _ => None,
        }
    }

    /// A component that is a whole number or a bit string.
    pub fn integer(&self, name: &str) -> Option<i64> {
        match self.get(name)? {
            Value::Number(field) if field.value.fract() == 0.0 && field.value.abs() < 1e9 => Some(field.value as i64),
            Value::Bits(bits) => i64::try_from(*bits).ok(),
            _ => None,
        }
    }
}

/// Reads the aggregate at the cursor, which then stands behind it. Nested ones stay unread: no recursion.
///
/// # Errors
/// [`Unclosed`] when the cursor's range ends before the brace closes.
pub(super) fn aggregate(bytes: &[u8], cursor: &mut Cursor<'_>) -> Result<Aggregate, Unclosed> {
    let start = cursor.offset();
    let Some(end) = closing(cursor) else { return Err(Unclosed(Span::new(start, start + cursor.rest().len()))) };
    let mut inside = Cursor::new(bytes, Span::new(start + 1, end - 1));
    skip_type(&mut inside);
    let body = Span::new(inside.offset(), end - 1);
    let components = super::statement::split_at_commas(bytes, body).into_iter().filter_map(|part| {
        let mut cursor = Cursor::new(bytes, part);
        let name = key(bytes, name(&mut cursor)?);
        // Strings are spelled `POINT2[] "..."`.
        while cursor.eat(b'[') || cursor.eat(b']') {}
        let value = trimmed(bytes, Span::new(cursor.offset(), part.end));
        Some((name, read_value(bytes, value)))
    });
    let components = components.collect();
    cursor.seek(end);
    Ok(Aggregate { span: Span::new(start, end), components })
}

fn skip_type(cursor: &mut Cursor<'_>) {
    let before = *cursor;
    cursor.skip_blanks();
    name(cursor);
    cursor.skip_blanks();
    if !cursor.eat(b':') {
        *cursor = before;
    }
}

/// The offset behind the brace that closes the one at the cursor.
fn closing(cursor: &Cursor<'_>) -> Option<usize> {
    let (mut depth, mut in_string) = (0usize, false);
    for (index, &byte) in cursor.rest().iter().enumerate() {
        match byte {
            b'"' => in_string = !in_string,
            _ if in_string => {}
            b'{' => depth += 1,
            b'}' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return Some(cursor.offset() + index + 1);
                }
            }
            _ => {}
        }
    }
    None
}

fn read_value(bytes: &[u8], span: Span) -> Value {
    let mut cursor = Cursor::new(bytes, span);
    match cursor.peek() {
        Some(b'{') => return Value::Nested(span),
        Some(b'#') => return Value::Constant(key(bytes, Span::new(span.start + 1, span.end))),
        Some(b'\'') => return bits(cursor.rest()).map_or(Value::Other(span), Value::Bits),
        _ => {}
    }
    match cursor.number() {
        Some(field) if cursor.at_end() => Value::Number(field),
        _ => Value::Other(span),
    }
}

/// `'B0110'`, `'H1F'`, `'D12'`.
fn bits(text: &[u8]) -> Option<u64> {
    let inside = text.strip_prefix(b"'")?.strip_suffix(b"'")?;
    let radix = match inside.first()?.to_ascii_uppercase() {
        b'B' => 2,
        b'H' => 16,
        b'D' => 10,
        _ => return None,
    };
    u64::from_str_radix(std::str::from_utf8(&inside[1..]).ok()?, radix).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Aggregate, Unclosed> {
        let mut cursor = Cursor::new(text.as_bytes(), Span::new(0, text.len()));
        aggregate(text.as_bytes(), &mut cursor)
    }

    #[test]
    fn components_of_every_kind() {
        let all = read("{E6POS: X 1.5, y -2,S 'B110',T 'H1f',POINT2[] \"a,}\",CM {X 1,Y 2},IPO_FRAME #TCP,Z z+1}");
        let all = all.expect("closed");
        assert_eq!((all.number("x"), all.number("y")), (Some(1.5), Some(-2.0)));
        assert_eq!((all.integer("s"), all.integer("t")), (Some(6), Some(31)));
        assert!(matches!(all.get("cm"), Some(Value::Nested(_))));
        assert_eq!(all.get("ipo_frame"), Some(&Value::Constant("tcp".into())));
        assert!(matches!(all.get("z"), Some(Value::Other(_))));
        assert!(matches!(all.get("point2"), Some(Value::Other(_))));
    }

    #[test]
    fn an_open_brace_is_told() {
        assert!(read("{X 1,Y 2").is_err());
        assert!(read("{X 1,CM {Y 2}").is_err());
        let deep = "{A ".repeat(100_000);
        assert!(read(&deep).is_err());
    }
}

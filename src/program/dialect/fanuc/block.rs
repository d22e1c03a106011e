//! The text of one point: `P[1:"name"]{ GP1: UF : 1, UT : 2, CONFIG : '..', X = .. mm, .. };`, as entries of group 1.

use crate::base::text::Span;
use crate::program::number::NumberField;
use crate::program::scan::Cursor;

/// The robot's group.
const ROBOT_GROUP: u32 = 1;
/// Columns behind `=` in which controllers print a number, right-aligned.
const CONTROLLER_COLUMNS: usize = 10;

/// One point as written.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// The number of the point.
    pub number: u32,
    /// From `P` to the brace that closes.
    pub span: Span,
    /// What group 1 says; empty when the point has no group 1.
    pub entries: Vec<Entry>,
    /// The closing brace is there.
    pub closed: bool,
}

/// `key : value` or `key = value`.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    /// The key in upper case: `UF`, `X`, `J1`, `CONFIG`.
    pub key: String,
    /// Key and value.
    pub span: Span,
    /// The value.
    pub value: EntryValue,
}

/// What stands behind the key.
#[derive(Clone, Debug)]
pub(super) enum EntryValue {
    /// Behind `=`.
    Number(NumberField),
    /// `********`: not taught.
    Stars,
    /// Between quotes.
    Quoted(Span),
    /// A word or number behind `:`.
    Word(Span),
    /// Nothing of these.
    Broken,
}

/// All points of a `/POS` section.
pub(super) fn blocks(bytes: &[u8], section: Span) -> Vec<Block> {
    let mut cursor = Cursor::new(bytes, section);
    let mut found = Vec::new();
    loop {
        cursor.skip_space();
        match header(&mut cursor) {
            Some((start, number)) => found.push(block(bytes, &mut cursor, start, number)),
            None if cursor.at_end() => return found,
            None => {
                cursor.skip_while(|byte| !is_line_end(byte));
            }
        }
    }
}

/// `P[1] {` or `P[1:"name"]{`; leaves the cursor behind the brace.
fn header(cursor: &mut Cursor<'_>) -> Option<(usize, u32)> {
    let before = *cursor;
    let start = cursor.offset();
    let number = point_number(cursor);
    if number.is_some() {
        cursor.skip_blanks();
        if cursor.eat(b':') {
            cursor.skip_blanks();
            if cursor.eat(b'"') {
                cursor.skip_while(|byte| byte != b'"' && !is_line_end(byte));
                cursor.eat(b'"');
            }
            cursor.skip_while(|byte| byte != b']' && !is_line_end(byte));
        }
    }
    let opened = number.is_some() && cursor.eat(b']') && {
        cursor.skip_space();
        cursor.eat(b'{')
    };
    if opened {
        return number.map(|number| (start, number));
    }
    *cursor = before;
    None
}

fn point_number(cursor: &mut Cursor<'_>) -> Option<u32> {
    if !cursor.eat(b'P') {
        return None;
    }
    cursor.skip_blanks();
    if !cursor.eat(b'[') {
        return None;
    }
    cursor.skip_blanks();
    let digits = cursor.skip_while(|byte| byte.is_ascii_digit());
    std::str::from_utf8(cursor.slice(digits)).ok()?.parse().ok()
}

fn block(bytes: &[u8], cursor: &mut Cursor<'_>, start: usize, number: u32) -> Block {
    let body_start = cursor.offset();
    let mut block = Block { number, span: Span::new(start, body_start), entries: Vec::new(), closed: false };
    // A file that is cut and joined may hold the next point before this one closes.
    let mut line_begins = false;
    while let Some(byte) = cursor.peek() {
        let mut ahead = *cursor;
        if byte == b'}' || (line_begins && header(&mut ahead).is_some()) {
            break;
        }
        line_begins = is_line_end(byte);
        cursor.bump();
    }
    let body = Span::new(body_start, cursor.offset());
    block.closed = cursor.eat(b'}');
    block.span.end = cursor.offset();
    block.entries = robot_entries(bytes, body);
    block
}

fn robot_entries(bytes: &[u8], body: Span) -> Vec<Entry> {
    let mut cursor = Cursor::new(bytes, body);
    let mut entries = Vec::new();
    let mut group = ROBOT_GROUP;
    while !cursor.at_end() {
        cursor.skip_while(|byte| byte.is_ascii_whitespace() || byte == b',');
        let start = cursor.offset();
        let Some(key) = cursor.name() else {
            cursor.bump();
            continue;
        };
        let key = String::from_utf8_lossy(cursor.slice(key)).to_ascii_uppercase();
        cursor.skip_blanks();
        let value = if cursor.eat(b':') {
            if let Some(number) = key.strip_prefix("GP").and_then(|number| number.parse().ok()) {
                group = number;
                continue;
            }
            word(&mut cursor)
        } else if cursor.eat(b'=') {
            number(bytes, &mut cursor)
        } else {
            EntryValue::Broken
        };
        if group == ROBOT_GROUP {
            entries.push(Entry { key, span: Span::new(start, cursor.offset()), value });
        }
    }
    entries
}

fn word(cursor: &mut Cursor<'_>) -> EntryValue {
    cursor.skip_blanks();
    if cursor.eat(b'\'') {
        let quoted = cursor.skip_while(|byte| byte != b'\'' && !is_line_end(byte));
        return if cursor.eat(b'\'') { EntryValue::Quoted(quoted) } else { EntryValue::Broken };
    }
    let word = cursor.skip_while(|byte| byte.is_ascii_alphanumeric());
    if word.is_empty() { EntryValue::Broken } else { EntryValue::Word(word) }
}

fn number(bytes: &[u8], cursor: &mut Cursor<'_>) -> EntryValue {
    let column_start = cursor.offset();
    let only_blanks = cursor.skip_while(|byte| byte == b' ').len();
    cursor.skip_blanks();
    if !cursor.skip_while(|byte| byte == b'*').is_empty() {
        unit(cursor);
        return EntryValue::Stars;
    }
    let aligned = cursor.offset() == column_start + only_blanks;
    let Some(field) = cursor.number() else { return EntryValue::Broken };
    // `12.3.4` is no number, and neither is `1-2`.
    if cursor.peek().is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'+' | b'-')) {
        cursor.skip_while(|byte| !byte.is_ascii_whitespace() && byte != b',');
        unit(cursor);
        return EntryValue::Broken;
    }
    let column = Span::new(column_start, field.span().end);
    let in_column = aligned && column.len() >= CONTROLLER_COLUMNS && bytes.get(field.span().end) == Some(&b' ');
    unit(cursor);
    EntryValue::Number(if in_column { field.in_column_from(column_start) } else { field })
}

/// `mm` or `deg` behind a number, which would else be taken for a key.
fn unit(cursor: &mut Cursor<'_>) {
    cursor.skip_blanks();
    cursor.skip_while(|byte| byte.is_ascii_alphabetic());
}

fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

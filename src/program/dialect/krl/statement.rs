//! KRL text as statements: one a line, without its comment.

use crate::base::text::{Source, Span};
use crate::program::scan::Cursor;

/// The statements of a file that are not blank, in order, trimmed. Header lines (`&ACCESS RVP`) are none.
pub(super) fn statements(source: &Source) -> impl Iterator<Item = Span> + '_ {
    let bytes = source.bytes();
    source.lines().filter_map(move |line| {
        let start = if line.start == 0 && bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { line.start };
        let code = without_comment(bytes, Span::new(start, line.end));
        let text = &bytes[code.start..code.end];
        let blanks = text.len() - text.trim_ascii_start().len();
        let length = text.trim_ascii().len();
        let span = Span::new(code.start + blanks, code.start + blanks + length);
        (length > 0 && bytes[span.start] != b'&').then_some(span)
    })
}

/// The part of a line before its comment; a `;` in a string is none.
fn without_comment(bytes: &[u8], line: Span) -> Span {
    let mut in_string = false;
    let is_comment = |&byte: &u8| {
        in_string ^= byte == b'"';
        byte == b';' && !in_string
    };
    let length = bytes[line.start..line.end].iter().position(is_comment);
    Span::new(line.start, length.map_or(line.end, |length| line.start + length))
}

/// The first word of a statement in lower case and what follows it, without blanks between. System variables keep
/// their `$`.
pub(super) fn first_word(bytes: &[u8], statement: Span) -> (String, Span) {
    let mut cursor = Cursor::new(bytes, statement);
    let name = name(&mut cursor).map(|span| key(bytes, span)).unwrap_or_default();
    cursor.skip_blanks();
    (name, Span::new(cursor.offset(), statement.end))
}

/// A name, with the `$` of a system variable; `$` may stand inside of a name, too.
pub(super) fn name(cursor: &mut Cursor<'_>) -> Option<Span> {
    let first = cursor.peek()?;
    if !(first.is_ascii_alphabetic() || matches!(first, b'_' | b'$') || first >= 0x80) {
        return None;
    }
    Some(cursor.skip_while(is_name_byte))
}

/// Letters, digits, `_`, `$`; bytes above 0x7f count as letters.
pub(super) fn is_name_byte(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'$') || byte >= 0x80
}

/// Names are compared without regard to case.
pub(super) fn key(bytes: &[u8], span: Span) -> String {
    String::from_utf8_lossy(&bytes[span.start..span.end]).to_lowercase()
}

/// Splits at the commas outside of brackets, braces, parentheses and strings; blanks around the parts are dropped.
pub(super) fn split_at_commas(bytes: &[u8], span: Span) -> Vec<Span> {
    let (mut depth, mut in_string, mut start) = (0usize, false, span.start);
    let mut parts = Vec::new();
    for at in span.start..span.end {
        match bytes[at] {
            b'"' => in_string = !in_string,
            _ if in_string => {}
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            b',' if depth == 0 => {
                parts.push(trimmed(bytes, Span::new(start, at)));
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(trimmed(bytes, Span::new(start, span.end)));
    parts
}

/// A range without the blanks at its ends.
pub(super) fn trimmed(bytes: &[u8], span: Span) -> Span {
    let text = &bytes[span.start..span.end];
    let blanks = text.len() - text.trim_ascii_start().len();
    let start = span.start + blanks;
    Span::new(start, start + text.trim_ascii().len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_headers_and_blank_lines_are_no_statements() {
        let source = Source::new(
            "t",
            "\u{feff}&ACCESS RVP\r\n;FOLD PTP P1 {X 1}\r\n  MSG[]=\"a;b\" ; c}\r\n\r\nPTP XP1;x\r\n;ENDFOLD",
        );
        let found: Vec<_> = statements(&source).map(|span| source.text(span).into_owned()).collect();
        assert_eq!(found, ["MSG[]=\"a;b\"", "PTP XP1"]);
    }

    #[test]
    fn parts_are_split_outside_of_brackets() {
        let bytes = b"{X 1,Y 2}, p[1,2] ,CA 90";
        let parts = split_at_commas(bytes, Span::new(0, bytes.len()));
        let texts: Vec<_> = parts.iter().map(|span| &bytes[span.start..span.end]).collect();
        assert_eq!(texts, [&b"{X 1,Y 2}"[..], b"p[1,2]", b"CA 90"]);
    }
}

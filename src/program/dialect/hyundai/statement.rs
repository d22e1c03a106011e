//! A job as statements: one a line, without its comment, with its step label apart.

use crate::base::text::{Source, Span};
use crate::program::number::starts_with_word;
use crate::program::scan::Cursor;

use super::header::{Generation, Header, eat_step_label, is_blank};

/// One statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Statement {
    /// From the label to the last byte before comment and trailing blanks.
    pub span: Span,
    /// The step label: `S4`.
    pub label: Option<Span>,
    /// What follows the label or line number.
    pub body: Span,
}

/// All statements that are not blank, in order. `IF .. THEN statement` gives the whole and then the part after `THEN`.
pub(super) fn statements(source: &Source, header: &Header) -> Vec<Statement> {
    let comment = match header.generation {
        Generation::Hi5 => b'\'',
        Generation::Hi6 => b'#',
    };
    let mut found = Vec::new();
    for line in source.lines().filter(|&line| Some(line) != header.line) {
        let Some(statement) = statement(source.bytes(), without_comment(source.bytes(), line, comment)) else {
            continue;
        };
        found.push(statement);
        if let Some(inner) = after_then(source.bytes(), statement.body) {
            found.push(Statement { body: inner, ..statement });
        }
    }
    found
}

fn statement(bytes: &[u8], code: Span) -> Option<Statement> {
    let mut cursor = Cursor::new(bytes, code);
    cursor.skip_while(|byte| is_blank(byte) || matches!(byte, 0xef | 0xbb | 0xbf));
    let start = cursor.offset();
    let end = start + cursor.rest().trim_ascii_end().len();
    let label = eat_step_label(&mut cursor);
    if label.is_none() {
        let line_number = cursor;
        cursor.skip_while(|byte| byte.is_ascii_digit());
        if cursor.skip_while(is_blank).is_empty() {
            cursor = line_number;
        }
    }
    let body = Span::new(cursor.offset(), end);
    let remark = starts_with_word(cursor.rest(), "REM");
    (start < end && !remark).then_some(Statement { span: Span::new(start, end), label, body })
}

/// The part of a line before its comment; a comment sign in a string is none.
fn without_comment(bytes: &[u8], line: Span, comment: u8) -> Span {
    let mut in_string = false;
    for at in line.start..line.end {
        match bytes[at] {
            b'"' if at == 0 || bytes[at - 1] != b'\\' => in_string = !in_string,
            byte if byte == comment && !in_string => return Span::new(line.start, at),
            _ => {}
        }
    }
    line
}

/// What stands after `THEN` in a one-line `IF`.
fn after_then(bytes: &[u8], body: Span) -> Option<Span> {
    let text = &bytes[body.start..body.end];
    if !starts_with_word(text, "IF") && !starts_with_word(text, "ELSEIF") {
        return None;
    }
    let mut in_string = false;
    for at in 0..text.len() {
        in_string ^= text[at] == b'"';
        let word_starts = at > 0 && !text[at - 1].is_ascii_alphanumeric();
        if !in_string && word_starts && starts_with_word(&text[at..], "THEN") {
            let rest = Span::new(body.start + at + "THEN".len(), body.end);
            let blanks = bytes[rest.start..rest.end].iter().take_while(|&&byte| is_blank(byte)).count();
            return (rest.start + blanks < rest.end).then(|| Span::new(rest.start + blanks, rest.end));
        }
    }
    None
}

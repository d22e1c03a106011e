//! The statements under `/MN`: a line number, a colon, a body that ends in `;` and may go on in further lines.

use crate::base::text::Span;
use crate::program::scan::Cursor;

/// A statement without its line number and semicolon. Inside, line ends and colons at the start of a line may stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Statement {
    /// Its bytes.
    pub span: Span,
}

/// The statements in order, without comments (`!..`), remarked statements (`//..`) and empty ones.
///
/// A line that starts with a number starts a statement, even if the one before lacks its semicolon.
pub(super) fn statements(bytes: &[u8], lines: &[Span]) -> Vec<Statement> {
    let mut found: Vec<Statement> = Vec::new();
    let mut open = false;
    for &line in lines {
        let mut cursor = Cursor::new(bytes, line);
        cursor.skip_blanks();
        let numbered = !cursor.skip_while(|byte| byte.is_ascii_digit()).is_empty();
        cursor.skip_blanks();
        if !cursor.eat(b':') {
            continue;
        }
        cursor.skip_blanks();
        let start = cursor.offset();
        let rest = cursor.rest();
        let comment = rest.first() == Some(&b'!') || rest.starts_with(b"//");
        let semicolon = rest.iter().position(|&byte| byte == b';');
        let end = semicolon.map_or(line.end, |at| start + at);
        let goes_on = open && !numbered;
        open = semicolon.is_none() && (goes_on || !comment);
        if goes_on {
            if let Some(last) = found.last_mut() {
                last.span.end = end;
            }
        } else if !comment && start < end {
            found.push(Statement { span: Span::new(start, end) });
        } else {
            open = false;
        }
    }
    for statement in &mut found {
        statement.span.end =
            statement.span.start + bytes[statement.span.start..statement.span.end].trim_ascii_end().len();
    }
    found
}

/// Skips blanks and the line ends and colons of a statement that goes on in the next line.
pub(super) fn skip_gap(cursor: &mut Cursor<'_>) {
    cursor.skip_while(|byte| byte.is_ascii_whitespace() || byte == b':');
}

/// Reads `[..]` with brackets inside and gives what stands between; `None` without one, or when it does not close.
pub(super) fn bracket(cursor: &mut Cursor<'_>) -> Option<Span> {
    let before = *cursor;
    if !cursor.eat(b'[') {
        return None;
    }
    let start = cursor.offset();
    let mut depth = 1_usize;
    while let Some(byte) = cursor.bump() {
        match byte {
            b'[' => depth += 1,
            b']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(Span::new(start, cursor.offset() - 1));
        }
    }
    *cursor = before;
    None
}

/// The number in a bracket's text, in front of a comment: `12`, `12:home`.
pub(super) fn index(text: &[u8]) -> Option<u32> {
    let number = text.split(|&byte| byte == b':').next().unwrap_or_default();
    std::str::from_utf8(number.trim_ascii()).ok()?.parse().ok()
}

/// Text of a bracket without comments, for names: `R[1:part]` becomes `R[1]`.
pub(super) fn without_comments(text: &[u8]) -> String {
    let mut plain = String::new();
    let mut in_comment = false;
    for letter in String::from_utf8_lossy(text).chars() {
        in_comment = letter == ':' || (in_comment && letter != ']');
        if !in_comment && !letter.is_whitespace() {
            plain.push(letter);
        }
    }
    plain
}

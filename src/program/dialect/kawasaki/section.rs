//! The sections of a file: programs, `.TRANS`, `.JOINTS`, and the rest.

use crate::base::text::{Source, Span};
use crate::program::scan::Cursor;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// What a file is divided into.
#[derive(Clone, Debug, Default)]
pub(super) struct Sections {
    /// The programs, in order.
    pub programs: Vec<Body>,
    /// Lines of `.TRANS` and `.JOINTS`: they differ by the `#` before a name.
    pub locations: Vec<Span>,
    /// Lines of all other sections.
    pub system: Vec<Span>,
    /// The section that the file ends in, when its `.END` is missing.
    pub open: Option<Span>,
}

/// One program.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// Lower case.
    pub name: String,
    /// As written, lower case: `.x`.
    pub parameters: Vec<String>,
    /// Its lines without comments; blank ones are left out.
    pub lines: Vec<Span>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Program,
    Locations,
    Other,
}

/// True when the content can only be AS: a program with its `.END`, or a section of locations with values.
pub(super) fn recognises(source: &Source) -> bool {
    let (mut head, mut ends) = (false, false);
    for line in source.lines() {
        match header(source.bytes(), line) {
            Some(Header::Program(..)) => head = true,
            Some(Header::Locations) => head = true,
            Some(Header::End) if head => ends = true,
            _ => {}
        }
    }
    head && ends
}

/// Divides a file.
pub(super) fn sections(source: &Source) -> Sections {
    let bytes = source.bytes();
    let mut found = Sections::default();
    let mut kind = Kind::Other;
    for line in source.lines() {
        match header(bytes, line) {
            Some(Header::Program(name, parameters)) => {
                found.programs.push(Body { name, parameters, lines: Vec::new() });
                found.open = Some(line);
                kind = Kind::Program;
                continue;
            }
            Some(Header::Locations) if kind != Kind::Program => {
                found.open = Some(line);
                kind = Kind::Locations;
                continue;
            }
            Some(Header::End) => {
                found.open = None;
                kind = Kind::Other;
                continue;
            }
            _ => {}
        }
        match (kind, found.programs.last_mut()) {
            (Kind::Program, Some(program)) => program.lines.extend(without_comment(bytes, line)),
            (Kind::Locations, _) => found.locations.push(line),
            _ => found.system.push(line),
        }
    }
    found
}

enum Header {
    Program(String, Vec<String>),
    Locations,
    End,
}

/// `.PROGRAM name(.a,.b)..`, `.TRANS`, `.JOINTS`, `.END`.
fn header(bytes: &[u8], line: Span) -> Option<Header> {
    let mut cursor = Cursor::new(bytes, line);
    if line.start == 0 && cursor.rest().starts_with(BYTE_ORDER_MARK) {
        cursor.seek(BYTE_ORDER_MARK.len());
    }
    cursor.skip_blanks();
    if !cursor.eat(b'.') {
        return None;
    }
    let word = cursor.slice(cursor.clone().skip_while(is_name_part)).to_ascii_uppercase();
    cursor.skip_while(is_name_part);
    cursor.skip_blanks();
    let alone = cursor.at_end() || cursor.peek() == Some(b';');
    match word.as_slice() {
        b"END" if alone => Some(Header::End),
        b"TRANS" | b"JOINTS" if alone => Some(Header::Locations),
        b"PROGRAM" => {
            let name = cursor.skip_while(is_name_part);
            cursor.skip_blanks();
            if name.is_empty() || !cursor.eat(b'(') {
                return None;
            }
            let inside = cursor.skip_while(|byte| byte != b')');
            let words = cursor.slice(inside).split(|&byte| byte == b',');
            let parameters = words.map(|word| lower(word.trim_ascii())).filter(|word| !word.is_empty()).collect();
            Some(Header::Program(lower(cursor.slice(name)), parameters))
        }
        _ => None,
    }
}

/// The statement of a line; `None` when there is nothing but a comment.
fn without_comment(bytes: &[u8], line: Span) -> Option<Span> {
    let mut quoted = false;
    let text = &bytes[line.start..line.end];
    let comment = text.iter().position(|&byte| {
        quoted ^= byte == b'"';
        byte == b';' && !quoted
    });
    let statement = &text[..comment.unwrap_or(text.len())];
    let end = line.start + statement.trim_ascii_end().len();
    (end > line.start).then(|| Span::new(line.start, end))
}

/// Letters of names: points stand inside of them.
pub(super) fn is_name_part(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.') || byte >= 0x80
}

/// Text in lower case, for keys.
pub(super) fn lower(text: &[u8]) -> String {
    String::from_utf8_lossy(text).to_lowercase()
}

//! Just enough XML: tags with their attributes, and CDATA. Nothing is decoded; what is broken ends the reading of a tag.

use crate::base::text::Span;
use crate::program::scan::Cursor;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// The name spaces of VAL3 files: of version 7 and later, and of version 6.
const NAME_SPACES: [&[u8]; 4] = [
    b"http://www.staubli.com/robotics/VAL3/",
    b"xmlns=\"DataNameSpace\"",
    b"xmlns=\"ProgramNameSpace\"",
    b"xmlns=\"ProjectNameSpace\"",
];
/// The name space stands in the first element.
const HEAD: usize = 2000;

/// A part of a file.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// `<name a="b">`, `<name/>`.
    Open(Tag),
    /// `</name>`, by its name.
    Close(Span),
    /// What stands inside of `<![CDATA[..]]>` or, in version 6, of `<code>`, and whether it is closed.
    Text(Span, bool),
}

/// A tag that opens an element.
#[derive(Clone, Debug)]
pub(super) struct Tag {
    /// From `<` to `>`.
    pub span: Span,
    /// Its name.
    pub name: Span,
    /// Names and values, the values without their quotes.
    pub attributes: Vec<(Span, Span)>,
    /// It has no content: `/>`.
    pub empty: bool,
}

/// True when the content can only be a file of a VAL3 application.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes).trim_ascii_start();
    let head = &text[..text.len().min(HEAD)];
    let has = |space: &&[u8]| head.windows(space.len()).any(|window| window == *space);
    text.first() == Some(&b'<') && NAME_SPACES.iter().any(has)
}

/// The parts of a file in order. The last element of the pair is false when the text stops inside of a tag.
pub(super) fn parts(bytes: &[u8]) -> (Vec<Part>, bool) {
    let mut cursor = Cursor::new(bytes, Span::new(0, bytes.len()));
    let mut found = Vec::new();
    loop {
        cursor.skip_while(|byte| byte != b'<');
        if cursor.at_end() {
            return (found, true);
        }
        let start = cursor.offset();
        let rest = cursor.rest();
        if rest.starts_with(b"<![CDATA[") {
            let from = start + 9;
            let length = find(&bytes[from..], b"]]>");
            let end = length.map_or(bytes.len(), |length| from + length);
            found.push(Part::Text(Span::new(from, end), length.is_some()));
            cursor.seek(end);
        } else if rest.starts_with(b"<!--") {
            match find(rest, b"-->") {
                Some(length) => cursor.seek(start + length),
                None => return (found, false),
            }
        } else if rest.starts_with(b"<?") || rest.starts_with(b"<!") {
            cursor.skip_while(|byte| byte != b'>');
        } else if rest.starts_with(b"</") {
            cursor.seek(start + 2);
            let name = cursor.skip_while(is_name_part);
            found.push(Part::Close(name));
        } else {
            match tag(&mut cursor, start) {
                Some(tag) => {
                    let is_code = &bytes[tag.name.start..tag.name.end] == b"code" && !tag.empty;
                    found.push(Part::Open(tag));
                    if is_code && !cursor.rest().trim_ascii_start().starts_with(b"<![CDATA[") {
                        let from = cursor.offset();
                        let length = find(&bytes[from..], b"</code");
                        let end = length.map_or(bytes.len(), |length| from + length);
                        found.push(Part::Text(Span::new(from, end), length.is_some()));
                        cursor.seek(end);
                    }
                }
                None if cursor.at_end() => return (found, false),
                None => {}
            }
        }
    }
}

fn tag(cursor: &mut Cursor<'_>, start: usize) -> Option<Tag> {
    cursor.bump();
    let name = cursor.skip_while(is_name_part);
    let mut attributes = Vec::new();
    loop {
        cursor.skip_space();
        match cursor.peek()? {
            b'>' => {
                cursor.bump();
                return Some(Tag { span: Span::new(start, cursor.offset()), name, attributes, empty: false });
            }
            b'/' => {
                cursor.bump();
                if cursor.eat(b'>') {
                    return Some(Tag { span: Span::new(start, cursor.offset()), name, attributes, empty: true });
                }
            }
            b'<' => return None,
            _ => {
                let name = cursor.skip_while(is_name_part);
                cursor.skip_space();
                if name.is_empty() || !cursor.eat(b'=') {
                    cursor.bump();
                    continue;
                }
                cursor.skip_space();
                let quote = cursor.peek().filter(|byte| matches!(byte, b'"' | b'\''))?;
                cursor.bump();
                let value = cursor.skip_while(|byte| byte != quote);
                if !cursor.eat(quote) {
                    return None;
                }
                attributes.push((name, value));
            }
        }
    }
}

fn is_name_part(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b':' | b'-' | b'.')
}

fn find(text: &[u8], wanted: &[u8]) -> Option<usize> {
    text.windows(wanted.len()).position(|window| window == wanted)
}

impl Tag {
    /// The value of an attribute.
    pub fn attribute(&self, bytes: &[u8], wanted: &str) -> Option<Span> {
        let found = self.attributes.iter().find(|(name, _)| &bytes[name.start..name.end] == wanted.as_bytes());
        found.map(|(_, value)| *value)
    }

    /// The text of an attribute.
    pub fn text(&self, bytes: &[u8], wanted: &str) -> Option<String> {
        self.attribute(bytes, wanted).map(|span| String::from_utf8_lossy(&bytes[span.start..span.end]).into_owned())
    }
}

//! A file as its bytes, and places in it.
//!
//! Robot programs arrive as ASCII, Latin-1, CP949, Shift-JIS or UTF-8. All of these keep ASCII bytes below 0x40
//! unambiguous, so the project works on bytes and decodes only what it shows to a person.

use std::borrow::Cow;
use std::fmt;

/// A half-open range of byte offsets in one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Span {
    /// Offset of the first byte.
    pub start: usize,
    /// Offset after the last byte.
    pub end: usize,
}

impl Span {
    /// The range `start..end`; an inverted pair becomes the empty range at `start`.
    pub fn new(start: usize, end: usize) -> Self {
        Self { start, end: end.max(start) }
    }

    /// Number of bytes.
    pub fn len(&self) -> usize {
        self.end - self.start
    }

    /// True for a place between two bytes.
    pub fn is_empty(&self) -> bool {
        self.start == self.end
    }

    /// True when `other` lies inside this range.
    pub fn contains(&self, other: Span) -> bool {
        self.start <= other.start && other.end <= self.end
    }

    /// The smallest range that holds both.
    pub fn to(&self, other: Span) -> Span {
        Span::new(self.start.min(other.start), self.end.max(other.end))
    }
}

/// A line and column, both counted from one; the column counts bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineColumn {
    /// Line, from one.
    pub line: usize,
    /// Column in bytes, from one.
    pub column: usize,
}

/// How the lines of a file end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Newline {
    /// `\n` only, or no line end at all.
    Lf,
    /// `\r\n` only.
    CrLf,
    /// `\r` only.
    Cr,
    /// More than one kind.
    Mixed,
}

impl fmt::Display for Newline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Newline::Lf => "lf",
            Newline::CrLf => "crlf",
            Newline::Cr => "cr",
            Newline::Mixed => "mixed",
        })
    }
}

/// How the bytes of a file spell characters, as far as the bytes tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Only bytes below 0x80.
    Ascii,
    /// Valid UTF-8 with bytes above 0x7f.
    Utf8,
    /// UTF-8 that starts with a byte-order mark.
    Utf8Bom,
    /// Korean Windows code page 949.
    Cp949,
    /// Japanese Shift-JIS.
    ShiftJis,
    /// Anything else: every byte is a character.
    Latin1,
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Encoding::Ascii => "ascii",
            Encoding::Utf8 => "utf-8",
            Encoding::Utf8Bom => "utf-8-bom",
            Encoding::Cp949 => "cp949",
            Encoding::ShiftJis => "shift-jis",
            Encoding::Latin1 => "latin-1",
        })
    }
}

/// One input file: its name for messages, its bytes, and where its lines start.
#[derive(Clone, Debug)]
pub struct Source {
    name: String,
    bytes: Vec<u8>,
    line_starts: Vec<usize>,
}

impl Source {
    /// Takes the bytes as they are; never fails.
    pub fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        let bytes = bytes.into();
        let mut line_starts = vec![0];
        let mut at = 0;
        while at < bytes.len() {
            let lone_cr = bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n');
            if bytes[at] == b'\n' || lone_cr {
                line_starts.push(at + 1);
            }
            at += 1;
        }
        Self { name: name.into(), bytes, line_starts }
    }

    /// The name shown in messages: a path, or `<stdin>`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The bytes, all of them.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The bytes of a range; a range outside the file gives what lies inside.
    pub fn slice(&self, span: Span) -> &[u8] {
        let end = span.end.min(self.bytes.len());
        &self.bytes[span.start.min(end)..end]
    }

    /// Text of a range for people: UTF-8 where it is valid, else byte by byte as Latin-1.
    pub fn text(&self, span: Span) -> Cow<'_, str> {
        match std::str::from_utf8(self.slice(span)) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => Cow::Owned(self.slice(span).iter().map(|&byte| char::from(byte)).collect()),
        }
    }

    /// Line and column of a byte offset, both from one.
    pub fn line_column(&self, offset: usize) -> LineColumn {
        let line = self.line_starts.partition_point(|&start| start <= offset);
        LineColumn { line, column: offset - self.line_starts[line - 1] + 1 }
    }

    /// Line of a byte offset, from one.
    pub fn line(&self, offset: usize) -> usize {
        self.line_column(offset).line
    }

    /// The ranges of all lines, without their line ends.
    pub fn lines(&self) -> impl Iterator<Item = Span> + '_ {
        (0..self.line_starts.len()).map(|index| {
            let start = self.line_starts[index];
            let mut end = self.line_starts.get(index + 1).copied().unwrap_or(self.bytes.len());
            while end > start && matches!(self.bytes[end - 1], b'\n' | b'\r') {
                end -= 1;
            }
            Span::new(start, end)
        })
    }

    /// How the lines end.
    pub fn newline(&self) -> Newline {
        let (mut lf, mut crlf, mut cr) = (false, false, false);
        for (at, &byte) in self.bytes.iter().enumerate() {
            match byte {
                b'\n' if at > 0 && self.bytes[at - 1] == b'\r' => crlf = true,
                b'\n' => lf = true,
                b'\r' if self.bytes.get(at + 1) != Some(&b'\n') => cr = true,
                _ => {}
            }
        }
        match (lf, crlf, cr) {
            (_, false, false) => Newline::Lf,
            (false, true, false) => Newline::CrLf,
            (false, false, true) => Newline::Cr,
            _ => Newline::Mixed,
        }
    }

    /// True for data that is no text in any encoding that robots use: more than a tenth of control characters.
    pub fn is_binary(&self) -> bool {
        const LOOKED_AT: usize = 4096;
        let start = &self.bytes[..self.bytes.len().min(LOOKED_AT)];
        let is_control = |byte: &&u8| byte.is_ascii_control() && !byte.is_ascii_whitespace();
        start.iter().filter(is_control).count() * 10 > start.len()
    }

    /// How characters are spelled. `multibyte` is the code page that the file's dialect uses where it is not UTF-8.
    pub fn encoding(&self, multibyte: Option<Encoding>) -> Encoding {
        if self.bytes.is_ascii() {
            return Encoding::Ascii;
        }
        if self.bytes.starts_with(b"\xef\xbb\xbf") && std::str::from_utf8(&self.bytes).is_ok() {
            return Encoding::Utf8Bom;
        }
        if std::str::from_utf8(&self.bytes).is_ok() {
            return Encoding::Utf8;
        }
        let codec = match multibyte {
            Some(Encoding::Cp949) => encoding_rs::EUC_KR,
            Some(Encoding::ShiftJis) => encoding_rs::SHIFT_JIS,
            _ => return Encoding::Latin1,
        };
        match codec.decode_without_bom_handling_and_without_replacement(&self.bytes) {
            Some(_) => multibyte.unwrap_or(Encoding::Latin1),
            None => Encoding::Latin1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_from_one_whatever_the_line_end() {
        let source = Source::new("t", "ab\r\ncd\rx\nend");
        assert_eq!(source.line_column(0), LineColumn { line: 1, column: 1 });
        assert_eq!(source.line_column(4), LineColumn { line: 2, column: 1 });
        assert_eq!(source.line_column(7).line, 3);
        assert_eq!(source.line_column(11), LineColumn { line: 4, column: 3 });
        let lines: Vec<_> = source.lines().map(|span| source.text(span).into_owned()).collect();
        assert_eq!(lines, ["ab", "cd", "x", "end"]);
        assert_eq!(source.newline(), Newline::Mixed);
    }

    #[test]
    fn encodings_are_told_by_bytes() {
        assert_eq!(Source::new("t", "abc").encoding(None), Encoding::Ascii);
        assert_eq!(Source::new("t", "\u{feff}abc").encoding(None), Encoding::Utf8Bom);
        assert_eq!(Source::new("t", "gr\u{fc}n").encoding(None), Encoding::Utf8);
        assert_eq!(Source::new("t", b"gr\xfcn".to_vec()).encoding(None), Encoding::Latin1);
        let korean = b"\xbf\xeb\xc1\xa2".to_vec();
        assert_eq!(Source::new("t", korean).encoding(Some(Encoding::Cp949)), Encoding::Cp949);
    }

    #[test]
    fn text_in_any_code_page_is_not_binary() {
        assert!(!Source::new("t", "").is_binary());
        assert!(!Source::new("t", [&b"\xbf\xeb\xc1\xa2\r\n".repeat(9)[..], b"\x1a"].concat()).is_binary());
        assert!(Source::new("t", b"M\0O\0D\0U\0L\0E\0".to_vec()).is_binary());
    }
}

//! VAL3 statements as tokens, and the calls among them.

use std::ops::Range;

use crate::base::text::{Source, Span};
use crate::program::dialect::brackets;
use crate::program::number::number_at;
use crate::program::scan::Cursor;

/// Tokens between two brackets of a call, at most: text that never closes them is not searched to its end each time.
const LONGEST_CALL: usize = 4096;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or keyword; `lib:name` is one.
    Name,
    /// A number without sign.
    Number,
    /// A string with its quotes.
    Text,
    /// Any other byte.
    Symbol(u8),
    /// The end of a line.
    LineEnd,
}

impl Kind {
    fn symbol(self) -> Option<u8> {
        if let Kind::Symbol(byte) = self { Some(byte) } else { None }
    }
}

/// The code of one program.
#[derive(Clone, Debug)]
pub(super) struct Text<'a> {
    /// Its file.
    pub source: &'a Source,
    /// Its tokens, without blanks and comments.
    pub tokens: Vec<(Kind, Span)>,
}

/// A variable as an expression names it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Name {
    /// Without index.
    pub base: String,
    /// The key of the element; `None` when it is known only at run time.
    pub key: Option<String>,
    /// The token behind it.
    pub end: usize,
}

impl<'a> Text<'a> {
    /// Cuts the code into tokens.
    pub fn of(source: &'a Source, span: Span) -> Self {
        let bytes = source.bytes();
        let mut cursor = Cursor::new(bytes, span);
        let mut tokens = Vec::new();
        loop {
            cursor.skip_blanks();
            let start = cursor.offset();
            let Some(byte) = cursor.peek() else { break };
            let kind = match byte {
                b'\n' | b'\r' => {
                    cursor.bump();
                    Kind::LineEnd
                }
                b'/' if cursor.rest().starts_with(b"//") => {
                    cursor.skip_while(|byte| !matches!(byte, b'\n' | b'\r'));
                    continue;
                }
                b'"' => {
                    cursor.bump();
                    cursor.skip_while(|byte| !matches!(byte, b'"' | b'\n' | b'\r'));
                    cursor.eat(b'"');
                    Kind::Text
                }
                b'0'..=b'9' | b'.' => match number_at(bytes, start).filter(|number| number.span().end <= span.end) {
                    Some(number) => {
                        cursor.seek(number.span().end);
                        Kind::Number
                    }
                    None => {
                        cursor.bump();
                        Kind::Symbol(byte)
                    }
                },
                _ if cursor.name().is_some() => {
                    if cursor.peek() == Some(b':') {
                        let mut ahead = cursor;
                        ahead.bump();
                        if ahead.name().is_some() {
                            cursor = ahead;
                        }
                    }
                    Kind::Name
                }
                _ => {
                    cursor.bump();
                    Kind::Symbol(byte)
                }
            };
            tokens.push((kind, Span::new(start, cursor.offset())));
        }
        Self { source, tokens }
    }

    /// The word at a token; empty for anything but a name.
    pub fn word(&self, at: usize) -> &'a [u8] {
        match self.tokens.get(at) {
            Some((Kind::Name, span)) => self.source.slice(*span),
            _ => &[],
        }
    }

    /// True when a token is this symbol.
    pub fn is(&self, at: usize, symbol: u8) -> bool {
        self.tokens.get(at).is_some_and(|(kind, _)| *kind == Kind::Symbol(symbol))
    }

    /// The bytes of a range of tokens.
    pub fn span(&self, range: &Range<usize>) -> Span {
        let last = range.end.checked_sub(1).filter(|_| range.start < range.end);
        match (self.tokens.get(range.start), last.and_then(|last| self.tokens.get(last))) {
            (Some((_, first)), Some((_, last))) => first.to(*last),
            _ => Span::default(),
        }
    }

    /// The text of a range for people.
    pub fn show(&self, range: &Range<usize>) -> String {
        self.source.text(self.span(range)).into_owned()
    }

    /// The parts between a bracket and the one that closes it, divided at commas, and the closing one. A line end closes
    /// nothing: a statement stands in one line.
    pub fn parts(&self, open: usize) -> Option<(Vec<Range<usize>>, usize)> {
        let symbols = self.tokens.iter().enumerate().skip(open).take(LONGEST_CALL).map(|(at, (kind, _))| (at, *kind));
        let symbols = symbols.take_while(|(_, kind)| *kind != Kind::LineEnd).map(|(at, kind)| (at, kind.symbol()));
        brackets::parts_without_empty_last(open, symbols)
    }

    /// `name`, `name[2]`, `name["home"]`, `name[n]` at a token.
    pub fn name(&self, at: usize) -> Option<Name> {
        let base = String::from_utf8_lossy(self.word(at)).into_owned();
        if base.is_empty() {
            return None;
        }
        if !self.is(at + 1, b'[') {
            return Some(Name { base, key: Some("0".into()), end: at + 1 });
        }
        let (parts, close) = self.parts(at + 1)?;
        let constant = |part: &Range<usize>| match (part.len(), self.tokens.get(part.start)?) {
            (1, (Kind::Number, span)) => Some(self.source.text(*span).into_owned()),
            (1, (Kind::Text, span)) => Some(self.source.text(*span).trim_matches('"').to_owned()),
            _ => None,
        };
        let keys: Option<Vec<String>> = parts.iter().map(constant).collect();
        Some(Name { base, key: keys.map(|keys| keys.join(",")), end: close + 1 })
    }

    /// The name that is the whole range.
    pub fn only_name(&self, range: &Range<usize>) -> Option<Name> {
        self.name(range.start).filter(|name| name.end == range.end)
    }
}

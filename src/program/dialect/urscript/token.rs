//! URScript as tokens: names, numbers, strings, symbols, line ends.

use crate::base::text::{Source, Span};
use crate::program::dialect::brackets;
use crate::program::number::number_at;
use crate::program::scan::Cursor;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or keyword.
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

/// A token and its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token {
    /// What it is.
    pub kind: Kind,
    /// Where.
    pub span: Span,
}

/// All tokens but blanks, comments (`#..`) and trace lines of the pendant (`$ 12 "MoveL"`).
pub(super) fn tokens(source: &Source) -> Vec<Token> {
    let bytes = source.bytes();
    let mut found = Vec::new();
    for line in source.lines() {
        let mut cursor = Cursor::new(bytes, line);
        let first = found.len();
        loop {
            cursor.skip_while(|byte| byte.is_ascii_whitespace() || matches!(byte, 0xef | 0xbb | 0xbf));
            let start = cursor.offset();
            let Some(byte) = cursor.peek() else { break };
            let kind = match byte {
                b'#' => break,
                b'$' if found.len() == first => break,
                b'"' => {
                    cursor.bump();
                    cursor.skip_while(|byte| byte != b'"');
                    cursor.eat(b'"');
                    Kind::Text
                }
                _ if cursor.name().is_some() => Kind::Name,
                b'0'..=b'9' | b'.' => match number_at(bytes, start) {
                    Some(number) if number.span().end <= line.end => {
                        cursor.seek(number.span().end);
                        Kind::Number
                    }
                    _ => {
                        cursor.bump();
                        Kind::Symbol(byte)
                    }
                },
                _ => {
                    cursor.bump();
                    Kind::Symbol(byte)
                }
            };
            found.push(Token { kind, span: Span::new(start, cursor.offset()) });
        }
        found.push(Token { kind: Kind::LineEnd, span: Span::new(line.end, line.end) });
    }
    found
}

/// The tokens of a file with its bytes.
#[derive(Clone, Copy)]
pub(super) struct Text<'a> {
    /// The file.
    pub source: &'a Source,
    /// Its tokens.
    pub tokens: &'a [Token],
}

impl<'a> Text<'a> {
    /// The word at a token; empty for anything but a name.
    pub fn word(&self, at: usize) -> &'a [u8] {
        match self.tokens.get(at) {
            Some(token) if token.kind == Kind::Name => self.source.slice(token.span),
            _ => &[],
        }
    }

    /// True when a token is this symbol.
    pub fn is(&self, at: usize, symbol: u8) -> bool {
        self.tokens.get(at).is_some_and(|token| token.kind == Kind::Symbol(symbol))
    }

    /// The bytes from the first to the last token of a range.
    pub fn span(&self, range: &std::ops::Range<usize>) -> Span {
        match (self.tokens.get(range.start), range.end.checked_sub(1).and_then(|last| self.tokens.get(last))) {
            (Some(first), Some(last)) if range.start < range.end => first.span.to(last.span),
            _ => Span::default(),
        }
    }

    /// The text of a range for people.
    pub fn show(&self, range: &std::ops::Range<usize>) -> String {
        self.source.text(self.span(range)).into_owned()
    }

    /// Divides what stands between two brackets at commas outside of inner brackets. `open` is the first bracket.
    /// Gives the parts and the token of the closing bracket.
    pub fn parts(&self, open: usize, end: usize) -> Option<(Vec<std::ops::Range<usize>>, usize)> {
        let symbols = (open..end.min(self.tokens.len())).map(|at| (at, self.tokens[at].kind.symbol()));
        brackets::parts_without_empty_last(open, symbols)
    }

    /// The names in a statement that a bracket follows, outside of all brackets.
    pub fn calls(&self, statement: &std::ops::Range<usize>) -> Vec<usize> {
        let (mut depth, mut found) = (0_usize, Vec::new());
        for at in statement.clone() {
            match self.tokens[at].kind {
                Kind::Name if depth == 0 && self.is(at + 1, b'(') => found.push(at),
                Kind::Symbol(b'(' | b'[' | b'{') => depth += 1,
                Kind::Symbol(b')' | b']' | b'}') => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        found
    }
}

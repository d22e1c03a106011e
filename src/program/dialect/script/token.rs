//! Text as tokens in statements: names, numbers, strings, symbols.

use std::ops::Range;

use crate::base::text::{Source, Span};
use crate::program::dialect::brackets;
use crate::program::number::{Insertion, NumberField, number_at, starts_with_word};
use crate::program::scan::Cursor;
use crate::program::target::{CartesianNumbers, JointNumbers, Units};

/// How a language is cut into tokens.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Lexis {
    /// What opens a comment that goes to the end of its line.
    pub comments: &'static [&'static str],
    /// Words that do, at the start of a statement.
    pub comment_words: &'static [&'static str],
    /// Quotes of strings, each closed by its like.
    pub quotes: &'static [u8],
    /// Bytes beside letters, digits and underscores that names may hold.
    pub in_names: &'static [u8],
    /// An open bracket carries a statement over to the next line.
    pub brackets_join: bool,
    /// What carries a statement over to the next line, at the end of one.
    pub carries_on: Option<u8>,
    /// What divides statements within a line.
    pub divides: Option<u8>,
}

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Kind {
    /// A name or keyword.
    Name,
    /// A number without sign.
    Number,
    /// A string with its quotes.
    Text,
    /// Any other byte.
    Symbol(u8),
}

impl Kind {
    fn symbol(self) -> Option<u8> {
        if let Kind::Symbol(byte) = self { Some(byte) } else { None }
    }
}

/// A token and its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) struct Token {
    /// What it is.
    pub kind: Kind,
    /// Where.
    pub span: Span,
}

/// The tokens of a file and the statements that they make.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct Tokens {
    tokens: Vec<Token>,
    /// The tokens of each statement; none is empty.
    pub statements: Vec<Range<usize>>,
    /// The last statement has a bracket that nothing closes.
    pub unclosed: bool,
}

impl Tokens {
    /// Cuts a file.
    pub fn of(source: &Source, lexis: &Lexis) -> Self {
        let mut all = Self::default();
        let (mut start, mut depth) = (0, 0_usize);
        for line in source.lines() {
            let first = all.tokens.len();
            cut_line(source.bytes(), line, lexis, start == first, &mut all.tokens);
            for at in first..all.tokens.len() {
                match all.tokens[at].kind {
                    Kind::Symbol(b'(' | b'[' | b'{') => depth += 1,
                    Kind::Symbol(b')' | b']' | b'}') => depth = depth.saturating_sub(1),
                    Kind::Symbol(byte) if lexis.divides == Some(byte) && depth == 0 => {
                        all.end(start, at);
                        start = at + 1;
                    }
                    _ => {}
                }
            }
            let carried = lexis.carries_on.is_some_and(|byte| {
                all.tokens.last().is_some_and(|last| all.tokens.len() > first && last.kind == Kind::Symbol(byte))
            });
            if carried {
                all.tokens.pop();
            } else if depth == 0 || !lexis.brackets_join {
                all.end(start, all.tokens.len());
                (start, depth) = (all.tokens.len(), 0);
            }
        }
        all.unclosed = depth > 0;
        all.end(start, all.tokens.len());
        all
    }

    fn end(&mut self, start: usize, end: usize) {
        if start < end {
            self.statements.push(start..end);
        }
    }

    /// The tokens with their file.
    pub fn text<'a>(&'a self, source: &'a Source) -> Text<'a> {
        Text { source, tokens: &self.tokens }
    }
}

fn cut_line(bytes: &[u8], line: Span, lexis: &Lexis, begins: bool, found: &mut Vec<Token>) {
    let mut cursor = Cursor::new(bytes, line);
    // Nothing but a line number so far.
    let mut numbered = true;
    let in_name =
        |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80 || lexis.in_names.contains(&byte);
    loop {
        cursor.skip_while(|byte| byte.is_ascii_whitespace());
        if cursor.rest().starts_with(b"\xef\xbb\xbf") {
            cursor.seek(cursor.offset() + 3);
            continue;
        }
        let start = cursor.offset();
        let Some(byte) = cursor.peek() else { break };
        let is_comment = |word: &&str| begins && numbered && starts_with_word(cursor.rest(), word);
        if lexis.comments.iter().any(|mark| cursor.rest().starts_with(mark.as_bytes()))
            || lexis.comment_words.iter().any(is_comment)
        {
            break;
        }
        let kind = if lexis.quotes.contains(&byte) {
            cursor.bump();
            cursor.skip_while(|other| other != byte);
            cursor.eat(byte);
            Kind::Text
        } else if byte.is_ascii_digit() || (byte == b'.' && cursor.rest().get(1).is_some_and(u8::is_ascii_digit)) {
            match number_at(&bytes[..line.end], start) {
                Some(number) => {
                    cursor.seek(number.span().end);
                    Kind::Number
                }
                None => {
                    cursor.bump();
                    Kind::Symbol(byte)
                }
            }
        } else if in_name(byte) {
            cursor.skip_while(in_name);
            Kind::Name
        } else {
            cursor.bump();
            Kind::Symbol(byte)
        };
        numbered &= kind == Kind::Number;
        found.push(Token { kind, span: Span::new(start, cursor.offset()) });
    }
}

/// The tokens of a file with its bytes.
#[derive(Clone, Copy)]
pub(in super::super) struct Text<'a> {
    /// The file.
    pub source: &'a Source,
    tokens: &'a [Token],
}

impl<'a> Text<'a> {
    /// What a token is.
    pub fn kind(&self, at: usize) -> Option<Kind> {
        self.tokens.get(at).map(|token| token.kind)
    }

    /// The word at a token in upper case; empty for anything but a name.
    pub fn word(&self, at: usize) -> String {
        match self.tokens.get(at) {
            Some(token) if token.kind == Kind::Name => self.source.text(token.span).to_ascii_uppercase(),
            _ => String::new(),
        }
    }

    /// True when a token is this symbol.
    pub fn is(&self, at: usize, symbol: u8) -> bool {
        self.kind(at) == Some(Kind::Symbol(symbol))
    }

    /// The bytes from the first to the last token of a range.
    pub fn span(&self, range: &Range<usize>) -> Span {
        match (self.tokens.get(range.start), range.end.checked_sub(1).and_then(|last| self.tokens.get(last))) {
            (Some(first), Some(last)) if range.start < range.end => first.span.to(last.span),
            _ => Span::default(),
        }
    }

    /// The text of a range for people, not too long.
    pub fn show(&self, range: &Range<usize>) -> String {
        const MOST: usize = 60;
        let text = self.source.text(self.span(range)).into_owned();
        match text.char_indices().nth(MOST) {
            Some((end, _)) => format!("{}..", &text[..end]),
            None => text,
        }
    }

    /// The line of a token, from one.
    pub fn line(&self, at: usize) -> usize {
        self.tokens.get(at).map_or(1, |token| self.source.line(token.span.start))
    }

    /// Divides what stands between two brackets at commas outside of inner brackets; empty parts count. `open` is the
    /// first bracket. Gives the parts and the token of the closing bracket.
    pub fn parts(&self, open: usize, end: usize) -> Option<(Vec<Range<usize>>, usize)> {
        let symbols = (open..end.min(self.tokens.len())).map(|at| (at, self.tokens[at].kind.symbol()));
        let (mut parts, close) = brackets::parts(open, symbols)?;
        // `()` holds nothing; in `(,)` two parts were left out.
        if matches!(parts.as_slice(), [only] if only.is_empty()) {
            parts.clear();
        }
        Some((parts, close))
    }

    /// The names in a range that a bracket follows, outside of all brackets.
    pub fn calls(&self, range: &Range<usize>) -> Vec<usize> {
        let (mut depth, mut found) = (0_usize, Vec::new());
        for at in range.clone() {
            match self.kind(at) {
                Some(Kind::Name) if depth == 0 && self.is(at + 1, b'(') => found.push(at),
                Some(Kind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
                Some(Kind::Symbol(b')' | b']' | b'}')) => depth = depth.saturating_sub(1),
                _ => {}
            }
        }
        found
    }

    /// Divides a range at commas outside of brackets; empty parts count.
    pub fn split(&self, range: &Range<usize>) -> Vec<Range<usize>> {
        let (mut depth, mut start, mut parts) = (0_usize, range.start, Vec::new());
        for at in range.clone() {
            match self.kind(at) {
                Some(Kind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
                Some(Kind::Symbol(b')' | b']' | b'}')) => depth = depth.saturating_sub(1),
                Some(Kind::Symbol(b',')) if depth == 0 => {
                    parts.push(start..at);
                    start = at + 1;
                }
                _ => {}
            }
        }
        parts.push(start..range.end);
        parts
    }

    /// The numbers between the brackets of a list. One that is left out is zero, to be inserted where it would stand.
    ///
    /// # Errors
    /// The part that is no plain number.
    pub fn numbers_with_zeros(&self, parts: &[Range<usize>]) -> Result<Vec<NumberField>, Range<usize>> {
        let left_out = |part: &Range<usize>| {
            let at = self.tokens.get(part.start).map_or(0, |token| token.span.start);
            let insertion = Insertion { before: String::new(), after: String::new(), repeats: false };
            NumberField::left_out(at, 0.0, 2, insertion)
        };
        let read = |part: &Range<usize>| match part.is_empty() {
            true => Ok(left_out(part)),
            false => self.number(part).ok_or_else(|| part.clone()),
        };
        parts.iter().map(read).collect()
    }

    /// A number with a sign directly before it, where a range is nothing else.
    pub fn number(&self, range: &Range<usize>) -> Option<NumberField> {
        let signed = range.len() == 2 && (self.is(range.start, b'-') || self.is(range.start, b'+'));
        if !(signed || range.len() == 1) {
            return None;
        }
        let last = self.tokens.get(range.end - 1).filter(|token| token.kind == Kind::Number)?;
        let field = number_at(self.source.bytes(), self.tokens[range.start].span.start)?;
        (field.span().end == last.span.end).then_some(field)
    }

    /// The numbers of ranges; the first that is none otherwise.
    ///
    /// # Errors
    /// The range that is no plain number.
    pub fn numbers(&self, ranges: &[Range<usize>]) -> Result<Vec<NumberField>, Range<usize>> {
        ranges.iter().map(|range| self.number(range).ok_or_else(|| range.clone())).collect()
    }
}

/// Six numbers as a pose in millimetres and degrees.
pub(in super::super) fn pose_of(
    numbers: &[NumberField],
    convention: crate::geometry::orientation::OrientationConvention,
) -> Option<Box<CartesianNumbers>> {
    let [x, y, z, a, b, c] = numbers else { return None };
    Some(Box::new(CartesianNumbers {
        position: [x.clone(), y.clone(), z.clone()],
        orientation: [a.clone(), b.clone(), c.clone()].into(),
        convention,
        units: Units::MM_DEG,
    }))
}

/// Six numbers as joint values in degrees.
pub(in super::super) fn joints_of(numbers: &[NumberField]) -> Option<Box<JointNumbers>> {
    let joints: [NumberField; 6] = numbers.to_vec().try_into().ok()?;
    Some(Box::new(JointNumbers { joints, units: Units::MM_DEG }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASIC: Lexis = Lexis {
        comments: &["'"],
        comment_words: &["REM"],
        quotes: b"\"",
        in_names: b"$",
        brackets_join: false,
        carries_on: Some(b'&'),
        divides: Some(b':'),
    };

    fn statements(text: &str, lexis: &Lexis) -> Vec<String> {
        let source = Source::new("t", text);
        let tokens = Tokens::of(&source, lexis);
        tokens.statements.iter().map(|range| tokens.text(&source).show(range)).collect()
    }

    #[test]
    fn statements_end_with_lines_unless_something_carries_them_on() {
        assert_eq!(
            statements("10 MOV P1 ' there: now\r\n20 REM x\r\nA$=\"':\" : B = (1, &\n 2)\nREM", &BASIC),
            ["10 MOV P1", "20", "A$=\"':\"", "B = (1, &\n 2)"]
        );
        let joining = Lexis { comments: &["#"], brackets_join: true, divides: None, ..BASIC };
        assert_eq!(statements("a(1,\n 2) # x\nb\n", &joining), ["a(1,\n 2)", "b"]);
    }

    #[test]
    fn signed_numbers_are_one_number() {
        let source = Source::new("t", "(-1.5,+.25, 3.,1+2,)");
        let tokens = Tokens::of(&source, &BASIC);
        let text = tokens.text(&source);
        let (parts, close) = text.parts(0, usize::MAX).expect("closed");
        let values: Vec<_> = parts.iter().map(|part| text.number(part).map(|field| field.value)).collect();
        assert_eq!(values, [Some(-1.5), Some(0.25), Some(3.0), None, None]);
        assert_eq!(text.numbers(&parts[..3]).map(|all| all.len()), Ok(3));
        assert!(text.numbers(&parts).is_err() && text.is(close, b')'));
    }
}

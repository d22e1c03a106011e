//! A cursor over the bytes of a program: the few steps that every dialect's reader is made of.

use crate::base::text::Span;

use super::number::{NumberField, number_at};

/// A position in a byte string. Copying one is how a reader looks ahead.
#[derive(Clone, Copy, Debug)]
pub struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    end: usize,
}

impl<'a> Cursor<'a> {
    /// A cursor at the start of `span`, which does not see past its end.
    pub fn new(bytes: &'a [u8], span: Span) -> Self {
        let end = span.end.min(bytes.len());
        Self { bytes, at: span.start.min(end), end }
    }

    /// The byte offset in the file.
    pub fn offset(&self) -> usize {
        self.at
    }

    /// True when nothing is left.
    pub fn at_end(&self) -> bool {
        self.at >= self.end
    }

    /// The next byte, not consumed.
    pub fn peek(&self) -> Option<u8> {
        self.bytes[..self.end].get(self.at).copied()
    }

    /// What is left.
    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..self.end]
    }

    /// Consumes and gives the next byte.
    pub fn bump(&mut self) -> Option<u8> {
        let byte = self.peek()?;
        self.at += 1;
        Some(byte)
    }

    /// Goes to a byte offset inside the span.
    pub fn seek(&mut self, offset: usize) {
        self.at = offset.min(self.end);
    }

    /// Skips blanks, tabs and line ends.
    pub fn skip_space(&mut self) {
        self.skip_while(|byte| byte.is_ascii_whitespace());
    }

    /// Skips blanks and tabs, not line ends.
    pub fn skip_blanks(&mut self) {
        self.skip_while(|byte| matches!(byte, b' ' | b'\t'));
    }

    /// Skips bytes while `keep_going` holds and gives their range.
    pub fn skip_while(&mut self, keep_going: impl Fn(u8) -> bool) -> Span {
        let start = self.at;
        while self.peek().is_some_and(&keep_going) {
            self.at += 1;
        }
        Span::new(start, self.at)
    }

    /// Consumes `byte` if it is next.
    pub fn eat(&mut self, byte: u8) -> bool {
        let next = self.peek() == Some(byte);
        if next {
            self.at += 1;
        }
        next
    }

    /// Consumes `word` in any case if it is next and ends there (no letter, digit or underscore follows).
    pub fn eat_word(&mut self, word: &str) -> bool {
        let matched = super::number::starts_with_word(self.rest(), word);
        if matched {
            self.at += word.len();
        }
        matched
    }

    /// A name: a letter or underscore, then letters, digits, underscores; bytes above 0x7f count as letters.
    pub fn name(&mut self) -> Option<Span> {
        let first = self.peek()?;
        if !(first.is_ascii_alphabetic() || first == b'_' || first >= 0x80) {
            return None;
        }
        Some(self.skip_while(|byte| byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80))
    }

    /// A signed number, if one stands here.
    pub fn number(&mut self) -> Option<NumberField> {
        let field = number_at(&self.bytes[..self.end], self.at)?;
        self.at = field.span().end;
        Some(field)
    }

    /// The bytes of a range.
    pub fn slice(&self, span: Span) -> &'a [u8] {
        &self.bytes[span.start..span.end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cursor_stays_inside_its_span() {
        let bytes = b"p10 := [1.5, 2]";
        let mut cursor = Cursor::new(bytes, Span::new(0, 11));
        assert_eq!(cursor.name().map(|span| cursor.slice(span)), Some(&b"p10"[..]));
        cursor.skip_space();
        assert!(cursor.eat(b':') && cursor.eat(b'=') && !cursor.eat(b'['));
        cursor.skip_space();
        assert!(cursor.eat(b'['));
        assert_eq!(cursor.number().map(|number| number.value), Some(1.5));
        assert!(cursor.at_end());
        assert_eq!(cursor.bump(), None);
        assert!(!Cursor::new(bytes, Span::new(0, 3)).eat_word("p1"));
    }
}

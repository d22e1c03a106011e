//! A line as a block: words, comments, and what is neither.

use crate::base::text::Span;
use crate::program::number::{NumberField, number_at};
use crate::program::scan::Cursor;

/// A block.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    /// `G1`, `X10.5`, `A3=0.5`, in the order of the text.
    pub words: Vec<Word>,
    /// `TRAORI`, `CYCLE832`, `GOTOF`: names that are no addresses, in upper case.
    pub keywords: Vec<String>,
    /// What stands in comments.
    pub comments: Vec<Span>,
    /// From the first to the last word.
    pub span: Span,
    /// Characters that belong to nothing known.
    pub opaque: bool,
}

/// An address with its value.
#[derive(Clone, Debug)]
pub(super) struct Word {
    /// The address in upper case: `X`, `A3`.
    pub address: String,
    /// The number; `None` for parameters and expressions.
    pub value: Option<NumberField>,
    /// The whole word.
    pub span: Span,
}

impl Block {
    /// The first word with this address.
    pub fn word(&self, address: &str) -> Option<&Word> {
        self.words.iter().find(|word| word.address == address)
    }

    /// The numbers of the words with this address.
    pub fn numbers<'a>(&'a self, address: &'a str) -> impl Iterator<Item = f64> + 'a {
        let of_address = self.words.iter().filter(move |word| word.address == address);
        of_address.filter_map(|word| word.value.as_ref().map(|field| field.value))
    }
}

/// Reads a line.
pub(super) fn block(bytes: &[u8], line: Span) -> Block {
    let mut cursor = Cursor::new(bytes, line);
    let mut block = Block::default();
    loop {
        cursor.skip_while(|byte| byte.is_ascii_whitespace() || matches!(byte, 0xef | 0xbb | 0xbf | b'/'));
        let start = cursor.offset();
        match cursor.peek() {
            None => break,
            // `%` opens a program, with its name behind it, or a comment (KUKA.CNC).
            Some(b';' | b'%') => {
                block.comments.push(Span::new(start + 1, line.end));
                break;
            }
            Some(b'(') => {
                cursor.bump();
                let inside = cursor.skip_while(|byte| byte != b')');
                cursor.eat(b')');
                block.comments.push(inside);
                continue;
            }
            Some(byte) if byte.is_ascii_alphabetic() => {
                if let Some(word) = word(bytes, &mut cursor) {
                    block.words.push(word);
                } else {
                    block.keywords.push(keyword(&mut cursor));
                }
            }
            Some(_) => {
                block.opaque = true;
                // A bracket is an argument list, up to its end.
                cursor.bump();
            }
        }
        let here = Span::new(start, cursor.offset());
        block.span = if block.span.is_empty() { here } else { block.span.to(here) };
    }
    block
}

/// `X10.5`, `X 10.5`, `X=10.5`, `A3=0.5`, `X#101`, `X=R1+2`.
fn word(bytes: &[u8], cursor: &mut Cursor<'_>) -> Option<Word> {
    let mut ahead = *cursor;
    let start = ahead.offset();
    let letter = ahead.bump()?.to_ascii_uppercase();
    let mut address = char::from(letter).to_string();
    let digits = {
        let mut extended = ahead;
        let digits = extended.skip_while(|byte| byte.is_ascii_digit());
        extended.skip_blanks();
        (extended.peek() == Some(b'=') && digits.len() <= 2).then_some((digits, extended))
    };
    if let Some((digits, extended)) = digits {
        address += &String::from_utf8_lossy(extended.slice(digits));
        ahead = extended;
        ahead.eat(b'=');
    } else if ahead.peek().is_some_and(|byte| byte.is_ascii_alphabetic() || byte == b'_') {
        return None;
    }
    ahead.skip_blanks();
    let written = number_at(&bytes[..ahead.offset() + ahead.rest().len()], ahead.offset());
    let value = match written {
        // No exponents in this language: `X10E5` is an X and an E.
        Some(field) if !bytes[field.span().start..field.span().end].iter().any(|byte| matches!(byte, b'e' | b'E')) => {
            ahead.seek(field.span().end);
            Some(field)
        }
        _ => {
            ahead.skip_while(|byte| !byte.is_ascii_whitespace() && byte != b';');
            None
        }
    };
    // `X10+R1`: the number is a part of an expression.
    let goes_on = matches!(ahead.peek(), Some(b'+' | b'-' | b'*' | b'['));
    let value = if goes_on {
        ahead.skip_while(|byte| !byte.is_ascii_whitespace() && byte != b';');
        None
    } else {
        value
    };
    let end = ahead.offset();
    *cursor = ahead;
    Some(Word { address, value, span: Span::new(start, end) })
}

/// A name, with the brackets behind it.
fn keyword(cursor: &mut Cursor<'_>) -> String {
    let name = cursor.skip_while(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    let text = String::from_utf8_lossy(cursor.slice(name)).to_ascii_uppercase();
    if cursor.peek() == Some(b'(') {
        cursor.skip_while(|byte| byte != b')');
        cursor.eat(b')');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Block {
        block(line.as_bytes(), Span::new(0, line.len()))
    }

    fn words(line: &str) -> Vec<(String, Option<f64>)> {
        read(line).words.into_iter().map(|word| (word.address, word.value.map(|field| field.value))).collect()
    }

    #[test]
    fn words_of_every_spelling() {
        assert_eq!(
            words("/N10 g01X-.5 Y 2. (to X9) Z=3.25 A3=0.5 F1200 ;X7"),
            [("N", 10.0), ("G", 1.0), ("X", -0.5), ("Y", 2.0), ("Z", 3.25), ("A3", 0.5), ("F", 1200.0)]
                .map(|(address, value)| (address.to_owned(), Some(value)))
        );
        let runtime = ["X#101", "Y=R1+2", "Z[#1+5]", "A10E5", "B1+R2"];
        for text in runtime {
            assert_eq!(words(text), [(text[..1].to_owned(), None)], "{text}");
        }
    }

    #[test]
    fn names_and_comments() {
        let read = read("TRAORI CYCLE832(0.05,X1) G0 (falsetarget: x)");
        assert_eq!(read.keywords, ["TRAORI", "CYCLE832"]);
        assert_eq!((read.words.len(), read.comments.len(), read.opaque), (1, 1, false));
        assert!(super::block(b"\xff$$", Span::new(0, 3)).opaque);
    }
}

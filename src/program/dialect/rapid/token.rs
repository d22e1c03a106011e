//! RAPID text as a flat list of tokens. Comments, blanks and the `%%%` header leave no token; any bytes give tokens.

use crate::base::text::{Source, Span};
use crate::program::number::number_at;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// An identifier or keyword.
    Name,
    /// An unsigned decimal number; a sign before it is a symbol of its own.
    Number,
    /// A string with its quotes.
    Text,
    /// `:=`
    Assign,
    /// A `robtarget` or `jointtarget` that holds nothing but numbers, from bracket to bracket: most of a long program. What
    /// stands in it is looked at when it is asked for, with [`tokens_in`].
    Position,
    /// Any other byte; `#` stands for a number that is not decimal (`0x1F`) or not finite.
    Symbol(u8),
}

/// A piece of the text. Large programs have tens of millions of them: places are kept in four bytes.
#[derive(Clone, Copy, Debug)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    start: u32,
    end: u32,
}

impl Token {
    /// Where it stands.
    pub fn span(&self) -> Span {
        Span::new(self.start as usize, self.end as usize)
    }
}

/// The tokens of a file, at most `limit` of them.
pub fn tokens(source: &Source, limit: usize) -> Vec<Token> {
    // No controller holds a program of four gigabytes; of a file that size the rest is not read.
    let bytes = &source.bytes()[..source.bytes().len().min(u32::MAX as usize)];
    let mut at = header_end(bytes);
    let mut found = Vec::new();
    while at < bytes.len() && found.len() < limit {
        let byte = bytes[at];
        if byte.is_ascii_whitespace() || byte == 0 {
            at += 1;
            continue;
        }
        if byte == b'!' {
            at = line_end(bytes, at);
            continue;
        }
        let (kind, end) = match position_end(bytes, at) {
            Some(end) => (TokenKind::Position, end),
            None => token_at(bytes, at),
        };
        found.push(Token { kind, start: at as u32, end: end as u32 });
        at = end;
    }
    found
}

/// The tokens in a [`TokenKind::Position`].
pub fn tokens_in(source: &Source, position: Span) -> Vec<Token> {
    let bytes = source.slice(Span::new(0, position.end));
    let mut found = Vec::with_capacity(position.len());
    let mut at = position.start;
    while at < bytes.len() {
        if bytes[at].is_ascii_whitespace() {
            at += 1;
            continue;
        }
        let (kind, end) = token_at(bytes, at);
        found.push(Token { kind, start: at as u32, end: end as u32 });
        at = end;
    }
    found
}

/// Numbers in the lists of a position: place, turn, configuration and additional axes; joints and additional axes; joints.
const POSITIONS: [&[usize]; 3] = [&[3, 4, 4, 6], &[6, 6], &[6]];

/// The end of the [`TokenKind::Position`] that begins here, if one does.
fn position_end(bytes: &[u8], open: usize) -> Option<usize> {
    if bytes.get(open) != Some(&b'[') {
        return None;
    }
    let (mut counts, mut lists, mut is_open) = ([0; 4], 0, false);
    for (at, &byte) in bytes.iter().enumerate().skip(open + 1) {
        match byte {
            b'[' if !is_open && lists < counts.len() => {
                (is_open, counts[lists]) = (true, 1);
                lists += 1;
            }
            b']' if is_open => is_open = false,
            b']' => return POSITIONS.contains(&&counts[..lists]).then_some(at + 1),
            b',' if is_open => counts[lists - 1] += 1,
            b'0'..=b'9' | b'.' | b'-' | b'+' if is_open => {}
            b'e' | b'E' if is_open && is_exponent(bytes, at) => {}
            b',' | b' ' | b'\t' | b'\r' | b'\n' => {}
            _ => return None,
        }
    }
    None
}

/// True for a letter that has a digit before and behind it, or a sign behind it.
fn is_exponent(bytes: &[u8], letter: usize) -> bool {
    bytes[letter - 1].is_ascii_digit()
        && bytes.get(letter + 1).is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b'-' | b'+'))
}

fn token_at(bytes: &[u8], at: usize) -> (TokenKind, usize) {
    let byte = bytes[at];
    let next = bytes.get(at + 1).copied();
    if byte == b'"' {
        return (TokenKind::Text, string_end(bytes, at));
    }
    if byte == b':' && next == Some(b'=') {
        return (TokenKind::Assign, at + 2);
    }
    if is_name_byte(byte) && !byte.is_ascii_digit() {
        return (TokenKind::Name, name_end(bytes, at));
    }
    if byte.is_ascii_digit() || (byte == b'.' && next.is_some_and(|next| next.is_ascii_digit())) {
        return match number_end(bytes, at) {
            Some(end) if !bytes.get(end).is_some_and(|&byte| is_name_byte(byte)) => (TokenKind::Number, end),
            Some(end) => (TokenKind::Symbol(b'#'), name_end(bytes, end)),
            None => (TokenKind::Symbol(b'#'), unreadable_number_end(bytes, at)),
        };
    }
    (TokenKind::Symbol(byte), at + 1)
}

/// The end of a number, `None` where it is not finite. A short one without exponent always is: its value is not needed.
fn number_end(bytes: &[u8], at: usize) -> Option<usize> {
    const SHORT: usize = 300;
    let plain = bytes[at..].iter().take_while(|&&byte| byte.is_ascii_digit() || byte == b'.').count();
    let points = bytes[at..at + plain].iter().filter(|&&byte| byte == b'.').count();
    let has_exponent = matches!(bytes.get(at + plain), Some(b'e' | b'E'));
    if points <= 1 && plain < SHORT && !has_exponent {
        return Some(at + plain);
    }
    number_at(bytes, at).map(|field| field.span().end)
}

/// Bytes above 0x7f are letters: Latin-1 allows them in names of some controllers, and UTF-8 spells letters with them.
fn is_name_byte(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

fn name_end(bytes: &[u8], from: usize) -> usize {
    from + bytes[from..].iter().take_while(|&&byte| is_name_byte(byte)).count()
}

fn unreadable_number_end(bytes: &[u8], from: usize) -> usize {
    let digits = bytes[from..].iter().take_while(|&&byte| is_name_byte(byte) || byte == b'.').count();
    from + digits.max(1)
}

fn line_end(bytes: &[u8], from: usize) -> usize {
    from + bytes[from..].iter().take_while(|&&byte| byte != b'\n' && byte != b'\r').count()
}

/// A string ends at its quote (`""` is a quote inside) or, unclosed, at the line end.
fn string_end(bytes: &[u8], open: usize) -> usize {
    let mut at = open + 1;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'"' if bytes.get(at + 1) == Some(&b'"') => at += 2,
            b'"' => return at + 1,
            b'\n' | b'\r' => return at,
            _ => at += 1,
        }
    }
    at
}

/// The end of the `%%%` ... `%%%` block (version, language) with which controllers head a file.
fn header_end(bytes: &[u8]) -> usize {
    let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let blanks = bytes[start..].iter().take_while(|byte| byte.is_ascii_whitespace()).count();
    let head = start + blanks;
    if !bytes[head..].starts_with(b"%%%") {
        return start;
    }
    // The closing mark stands near: a file that opens a header and never closes it is read from after the mark.
    let window = &bytes[head + 3..bytes.len().min(head + 4096)];
    window.windows(3).position(|three| three == b"%%%").map_or(head + 3, |close| head + close + 6)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<String> {
        let source = Source::new("t", text);
        tokens(&source, usize::MAX).iter().map(|token| source.text(token.span()).into_owned()).collect()
    }

    #[test]
    fn comments_strings_and_headers_leave_the_right_tokens() {
        assert_eq!(
            texts("%%%\n VERSION:1\n%%%\nTPWrite \"a!\"\"b\";!c;\r\nx:=-.5E-3;"),
            ["TPWrite", "\"a!\"\"b\"", ";", "x", ":=", "-", ".5E-3", ";"]
        );
        assert_eq!(texts("0x1F 1e999 \"open\nz10"), ["0x1F", "1e999", "\"open", "z10"]);
    }

    #[test]
    fn positions_of_numbers_alone_are_one_token() {
        let kinds =
            |text: &str| tokens(&Source::new("t", text), usize::MAX).iter().map(|token| token.kind).collect::<Vec<_>>();
        let position = "[[1,-2.5,3e+1],[1,0,0,0],\n [0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
        assert_eq!(kinds(&format!("{position},")), [TokenKind::Position, TokenKind::Symbol(b',')]);
        assert_eq!(kinds("[[1,2,3,4,5,6]]"), [TokenKind::Position]);
        let source = Source::new("t", position);
        assert_eq!(tokens_in(&source, Span::new(0, position.len())).len(), 17 + 1 + 13 + 3 + 10);
        for other in ["[[1,2,3],[1,0,0,0]]", "[[1,2,3,4,5,x]]", "[[1,2,3,4,5,6]", "[1,2]", "[[1,2,3,4,5,1E]]"] {
            assert!(!kinds(other).contains(&TokenKind::Position), "{other}");
        }
    }

    #[test]
    fn other_number_systems_are_not_taken_for_decimal() {
        let source = Source::new("t", "0x1F 12 1.5");
        let kinds: Vec<_> = tokens(&source, 9).iter().map(|token| token.kind).collect();
        assert_eq!(kinds, [TokenKind::Symbol(b'#'), TokenKind::Number, TokenKind::Number]);
    }
}

//! Lines into cells.

use crate::base::text::Span;

/// The delimiters that a header may choose.
const DELIMITERS: [u8; 3] = [b',', b';', b'\t'];

/// The delimiter that a header line uses: the one that it has most often.
pub(super) fn delimiter(header: &[u8]) -> u8 {
    let count = |delimiter: u8| header.iter().filter(|&&byte| byte == delimiter).count();
    DELIMITERS.into_iter().rev().max_by_key(|&delimiter| count(delimiter)).unwrap_or(b',')
}

/// The cells of a line, without blanks and quotes around them. A quoted cell may hold delimiters, not line ends.
pub(super) fn cells(bytes: &[u8], line: Span, delimiter: u8) -> Vec<Span> {
    let mut cells = Vec::new();
    let (mut start, mut quoted) = (line.start, false);
    for at in line.start..line.end {
        quoted ^= bytes[at] == b'"';
        if bytes[at] == delimiter && !quoted {
            cells.push(bare(bytes, Span::new(start, at)));
            start = at + 1;
        }
    }
    cells.push(bare(bytes, Span::new(start, line.end)));
    cells
}

fn bare(bytes: &[u8], cell: Span) -> Span {
    let trimmed = trimmed(bytes, cell);
    let quoted = trimmed.len() >= 2 && bytes[trimmed.start] == b'"' && bytes[trimmed.end - 1] == b'"';
    if quoted { self::trimmed(bytes, Span::new(trimmed.start + 1, trimmed.end - 1)) } else { trimmed }
}

/// The range without blanks at its ends.
pub(super) fn trimmed(bytes: &[u8], span: Span) -> Span {
    let text = &bytes[span.start..span.end];
    let start = span.start + (text.len() - text.trim_ascii_start().len());
    Span::new(start, start + text.trim_ascii().len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_keep_delimiters_and_blanks_go() {
        let line = b" 1.5 ;\"a;b\"; \" -2 \";;";
        assert_eq!(delimiter(b"x_mm;y_mm;name, long"), b';');
        assert_eq!(delimiter(b"x"), b',');
        let read: Vec<&[u8]> =
            cells(line, Span::new(0, line.len()), b';').into_iter().map(|cell| &line[cell.start..cell.end]).collect();
        assert_eq!(read, [&b"1.5"[..], b"a;b", b"-2", b"", b""]);
    }
}

//! The lines of a job: which section each belongs to, and where comments begin.

use crate::base::text::{Source, Span};
use crate::program::number::starts_with_word;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// A line with its section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// Under `//POS`: a pseudo instruction or a position.
    Position(Span),
    /// Under `//INST`, before `NOP`: `///ATTR SC,RW,RJ`.
    Head(Span),
    /// An instruction, without its comment.
    Instruction(Span),
}

#[derive(Clone, Copy, PartialEq)]
enum Section {
    Other,
    Positions,
    Instructions,
}

/// True when the content can only be a job: `/JOB` before anything but comments, then `//NAME`, `//POS` or `//INST`.
pub(super) fn recognises(source: &Source) -> bool {
    let mut lines = source
        .lines()
        .map(|line| without_mark(source.slice(line)).trim_ascii())
        .filter(|text| !text.is_empty() && text.first() != Some(&b'\''));
    lines.next() == Some(b"/JOB")
        && lines.any(|text| ["//NAME", "//POS", "//INST"].iter().any(|mark| starts_with_word(text, mark)))
}

/// The lines that mean something, in order.
pub(super) fn lines(source: &Source) -> Vec<Line> {
    let mut section = Section::Other;
    let mut found = Vec::new();
    for line in source.lines() {
        let text = without_mark(source.slice(line));
        let mark = |word: &str| starts_with_word(text, word);
        if mark("/JOB") {
            section = Section::Other;
        } else if mark("//POS") {
            section = Section::Positions;
        } else if mark("//INST") {
            section = Section::Instructions;
        } else if text.starts_with(b"//") && !text.starts_with(b"///") {
            section = Section::Other;
        } else if text.starts_with(b"///") {
            found.push(if section == Section::Positions { Line::Position(line) } else { Line::Head(line) });
        } else {
            let code = code(source.bytes(), line);
            // Some jobs have no //INST: their instructions begin with NOP.
            if starts_with_word(source.slice(code), "NOP") && section == Section::Positions {
                section = Section::Instructions;
            }
            match section {
                _ if code.is_empty() => {}
                Section::Positions => found.push(Line::Position(code)),
                Section::Instructions => found.push(Line::Instruction(code)),
                Section::Other => {}
            }
        }
    }
    found
}

/// The part of a line without leading blanks and without its comment: `'..`, or `//..` behind a blank.
fn code(bytes: &[u8], line: Span) -> Span {
    let blanks = bytes[line.start..line.end].iter().take_while(|byte| byte.is_ascii_whitespace()).count();
    let start = line.start + blanks;
    let text = &bytes[start..line.end];
    let mut in_string = false;
    let mut end = text.len();
    for (at, &byte) in text.iter().enumerate() {
        in_string ^= byte == b'"';
        let slashes = byte == b'/' && text.get(at + 1) == Some(&b'/');
        if !in_string && (byte == b'\'' || slashes) {
            end = at;
            break;
        }
    }
    Span::new(start, start + text[..end].trim_ascii_end().len())
}

fn without_mark(text: &[u8]) -> &[u8] {
    text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text)
}

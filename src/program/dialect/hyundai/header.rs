//! The first line of a job, and how a job is told from other languages.
//!
//! Hi4/Hi5: `Program File Format Version : 1.6  MechType: 458(HA006B-01)  TotalAxis: 7  AuxAxis: 1`.
//! Hi6: `Hyundai Robot Job File; { version: 1.6, mech_type: "780(YL012-0D)", total_axis: 6, aux_axis: 0 }`, where a
//! count of -1 means that it is not given.

use crate::base::text::{Source, Span};
use crate::program::number::number_at;
use crate::program::scan::Cursor;

/// The two languages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Generation {
    /// Hi4, Hi5, Hi5a: comments start with `'`.
    Hi5,
    /// Hi6 HRScript: comments start with `#`.
    Hi6,
}

/// What the header says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Header {
    /// Which language the file is in.
    pub generation: Generation,
    /// The header line; `None` when the file has none.
    pub line: Option<Span>,
    /// Axes of robot and additional axes together.
    pub total_axes: Option<usize>,
    /// Additional axes.
    pub auxiliary_axes: Option<usize>,
}

const HI5_TITLE: &[u8] = b"Program File Format Version";
const HI6_TITLE: &[u8] = b"Hyundai Robot Job File";
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The words with which a motion statement starts.
pub(super) const MOTION_WORDS: [&str; 2] = ["MOVE", "SMOV"];

/// Reads the header. Without one the spelling of the first motion statement decides on the language.
pub(super) fn header(source: &Source) -> Header {
    if let Some((line, generation)) = title(source) {
        let text = source.slice(line);
        let (total, auxiliary): (&[u8], &[u8]) = match generation {
            Generation::Hi5 => (b"TotalAxis", b"AuxAxis"),
            Generation::Hi6 => (b"total_axis", b"aux_axis"),
        };
        return Header {
            generation,
            line: Some(line),
            total_axes: count_after(text, total),
            auxiliary_axes: count_after(text, auxiliary),
        };
    }
    let lower_case = source.lines().map(|line| source.slice(line)).find_map(first_motion_word);
    let generation = if lower_case == Some(true) { Generation::Hi6 } else { Generation::Hi5 };
    Header { generation, line: None, total_axes: None, auxiliary_axes: None }
}

/// True when the content can only be a Hyundai job: its header, or motion statements as no other language has them.
pub(super) fn recognises(source: &Source) -> bool {
    title(source).is_some() || source.lines().any(|line| is_hyundai_move(source.slice(line)))
}

/// The first line that is not blank, if it is a header.
fn title(source: &Source) -> Option<(Span, Generation)> {
    let (line, text) = source
        .lines()
        .map(|line| {
            let text = source.slice(line);
            let mark = if text.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
            (line, text[mark..].trim_ascii())
        })
        .find(|(_, text)| !text.is_empty())?;
    if text.starts_with(HI5_TITLE) && contains(text, b"Axis") {
        Some((line, Generation::Hi5))
    } else if text.starts_with(HI6_TITLE) {
        Some((line, Generation::Hi6))
    } else {
        None
    }
}

/// True for a labelled `S1 MOVE P,..`, or a `MOVE P,..` whose parameters have the names that only this maker uses.
fn is_hyundai_move(line: &[u8]) -> bool {
    let mut cursor = Cursor::new(line, Span::new(0, line.len()));
    cursor.skip_blanks();
    let labelled = eat_step_label(&mut cursor).is_some();
    if !MOTION_WORDS.iter().any(|word| cursor.eat_word(word)) || cursor.skip_while(is_blank).is_empty() {
        return false;
    }
    let parameters = cursor.rest();
    let has = |word: &[u8]| contains(parameters, word);
    let comma = parameters.iter().position(|&byte| byte == b',');
    let interpolation = comma.is_some_and(|comma| (1..=2).contains(&comma));
    let named = (has(b"S=") && has(b"A=") && has(b"T=")) || (has(b"spd=") && has(b"accu="));
    let station = labelled && parameters.starts_with(b"S");
    named || (labelled && interpolation && (has(b"S=") || has(b"spd=") || has(b"tg="))) || (station && has(b"spd="))
}

/// Whether the first motion word of a line is in lower case; `None` for a line without one.
fn first_motion_word(line: &[u8]) -> Option<bool> {
    let mut cursor = Cursor::new(line, Span::new(0, line.len()));
    cursor.skip_blanks();
    eat_step_label(&mut cursor);
    let first = cursor.peek()?;
    MOTION_WORDS.iter().any(|word| cursor.eat_word(word)).then(|| first.is_ascii_lowercase())
}

/// Consumes a step label and the blanks after it: `S4   `.
pub(super) fn eat_step_label(cursor: &mut Cursor<'_>) -> Option<Span> {
    let before = *cursor;
    let start = cursor.offset();
    let digits = if cursor.eat(b'S') || cursor.eat(b's') {
        cursor.skip_while(|byte| byte.is_ascii_digit())
    } else {
        Span::new(start, start)
    };
    if digits.is_empty() || cursor.skip_while(is_blank).is_empty() {
        *cursor = before;
        return None;
    }
    Some(Span::new(start, digits.end))
}

/// Blanks between words.
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t')
}

fn count_after(text: &[u8], word: &[u8]) -> Option<usize> {
    let at = text.windows(word.len()).position(|window| window == word)? + word.len();
    let mut cursor = Cursor::new(text, Span::new(at, text.len()));
    cursor.skip_while(|byte| is_blank(byte) || byte == b':');
    let number = number_at(text, cursor.offset())?;
    (number.decimals() == 0 && (1.0..=32.0).contains(&number.value) || number.value == 0.0)
        .then_some(number.value as usize)
}

fn contains(text: &[u8], word: &[u8]) -> bool {
    text.windows(word.len()).any(|window| window == word)
}

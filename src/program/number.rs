//! Numbers in program text: where they stand, how they were written, and how to write another in their place.

use nom::branch::alt;
use nom::bytes::complete::{tag_no_case, take_while, take_while1};
use nom::character::complete::one_of;
use nom::combinator::{opt, recognize};
use nom::{IResult, Parser};

use crate::base::text::Span;

use super::decimal::{Decimal, POWERS_OF_TEN};

/// A number in the text of a program, or a place where one may be inserted. Large programs have millions of them: a place
/// is kept in four bytes, a length in two.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NumberField {
    /// The value as written, in the file's own unit.
    pub value: f64,
    /// Text to put before and after an inserted number; `None` where the number is written.
    pub insertion: Option<Box<Insertion>>,
    start: u32,
    length: u16,
    decimals: u8,
    /// Bytes of its fixed column; 0 where it has none.
    column: u8,
}

/// What surrounds a number that is inserted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Insertion {
    /// For example ` x="`.
    pub before: String,
    /// For example `"`.
    pub after: String,
    /// True where a number that is left out is that of the target before (G-code). A corrected program writes all of
    /// them, changed or not, or targets would take over the corrected numbers of others.
    pub repeats: bool,
}

impl NumberField {
    /// A number that is written at `span`; `None` where no program is so large, no number so long.
    fn written(span: Span, value: f64, decimals: usize) -> Option<Self> {
        Some(Self {
            value,
            insertion: None,
            start: u32::try_from(span.start).ok()?,
            length: u16::try_from(span.len()).ok()?,
            decimals: u8::try_from(decimals).ok()?,
            column: 0,
        })
    }

    /// A number that stands in no file.
    pub fn unplaced(value: f64) -> Self {
        Self { value, ..Self::default() }
    }

    /// A number that is left out at a place, and what would surround it there.
    pub fn left_out(at: usize, value: f64, decimals: usize, insertion: Insertion) -> Self {
        Self { insertion: Some(Box::new(insertion)), ..Self::unplaced(value) }.with_decimals(decimals).at(at)
    }

    /// The same number at another place.
    #[must_use]
    pub fn at(self, start: usize) -> Self {
        Self { start: start.try_into().unwrap_or(u32::MAX), ..self }
    }

    fn with_decimals(self, decimals: usize) -> Self {
        Self { decimals: decimals.try_into().unwrap_or(u8::MAX), ..self }
    }

    /// The same number in a fixed column that begins at `start` and ends with it; a column wider than any is none.
    #[must_use]
    pub fn in_column_from(self, start: usize) -> Self {
        let width = self.span().end.saturating_sub(start);
        Self { column: width.try_into().unwrap_or(0), ..self }
    }

    /// Its bytes; empty where the language leaves a default out and a number would have to be inserted.
    pub fn span(&self) -> Span {
        let start = self.start as usize;
        Span::new(start, start + usize::from(self.length))
    }

    /// Digits after the decimal point, exponent counted in (`1.25e-3` has five).
    pub fn decimals(&self) -> usize {
        usize::from(self.decimals)
    }

    /// The columns it may fill, blanks included, in languages with fixed columns: the number stays right-aligned.
    pub fn column(&self) -> Option<Span> {
        let end = self.span().end;
        (self.column > 0).then(|| Span::new(end.saturating_sub(usize::from(self.column)), end))
    }

    /// True for a number that is left out because it is that of the target before.
    pub fn repeats(&self) -> bool {
        self.insertion.as_ref().is_some_and(|insertion| insertion.repeats)
    }
}

/// How a language lets numbers be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberRules {
    /// No more than this many digits after the point.
    pub max_decimals: usize,
    /// A number written without a point may get one.
    pub integers_may_gain_point: bool,
}

impl Default for NumberRules {
    fn default() -> Self {
        Self { max_decimals: 9, integers_may_gain_point: true }
    }
}

fn digits(input: &[u8]) -> IResult<&[u8], &[u8]> {
    take_while1(|byte: u8| byte.is_ascii_digit()).parse(input)
}

fn exponent(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize((one_of(&b"eE"[..]), opt(one_of(&b"+-"[..])), digits)).parse(input)
}

/// An unsigned decimal number: `1`, `1.5`, `1.`, `.5`, each with or without an exponent.
///
/// `1ELSE` gives `1`: an exponent letter without digits is not part of the number. (nom's own `recognize_float`
/// fails on it for good, which is why the rule stands here.)
pub fn unsigned(input: &[u8]) -> IResult<&[u8], &[u8]> {
    let any_digits = take_while(|byte: u8| byte.is_ascii_digit());
    let with_point = recognize((digits, opt((nom::bytes::complete::tag(&b"."[..]), any_digits))));
    let point_first = recognize((nom::bytes::complete::tag(&b"."[..]), digits));
    recognize((alt((with_point, point_first)), opt(exponent))).parse(input)
}

/// A number with an optional sign directly before it.
pub fn signed(input: &[u8]) -> IResult<&[u8], &[u8]> {
    recognize((opt(one_of(&b"+-"[..])), unsigned)).parse(input)
}

/// `9E9` and its spellings: ABB's word for an axis that is not there.
pub fn is_nine_e_nine(value: f64) -> bool {
    value >= 8.999e9
}

/// True when `text` starts with `word` in any case and no letter, digit or underscore follows.
pub fn starts_with_word(text: &[u8], word: &str) -> bool {
    let matched: IResult<&[u8], &[u8]> = tag_no_case(word.as_bytes()).parse(text);
    match matched {
        Ok((rest, _)) => !rest.first().is_some_and(|&byte| byte == b'_' || byte.is_ascii_alphanumeric()),
        Err(_) => false,
    }
}

/// Reads a signed number at `at`, without skipping blanks; `None` when there is none or it is not finite.
pub fn number_at(bytes: &[u8], at: usize) -> Option<NumberField> {
    let rest = bytes.get(at..)?;
    let (length, value, decimals) = plain_number(rest).or_else(|| any_number(rest))?;
    NumberField::written(Span::new(at, at + length), value, decimals)
}

/// Length, value and decimals of a number of any spelling.
fn any_number(text: &[u8]) -> Option<(usize, f64, usize)> {
    let (_, text) = signed(text).ok()?;
    let value: f64 = std::str::from_utf8(text).ok()?.parse().ok()?;
    value.is_finite().then(|| (text.len(), value, decimals_of(text)))
}

/// The same for the spelling of nearly all numbers, without exponent and with at most fifteen digits: there digits and
/// power of ten are exact doubles, and their quotient is the nearest double (Clinger 1990). `None` for all others.
fn plain_number(text: &[u8]) -> Option<(usize, f64, usize)> {
    const MOST_DIGITS: usize = 15;
    let signed = matches!(text.first(), Some(b'+' | b'-'));
    let start = usize::from(signed);
    let (mut at, mut digits, mut point) = (start, 0u64, None);
    while let Some(&byte) = text.get(at) {
        match byte {
            b'0'..=b'9' => digits = digits.wrapping_mul(10).wrapping_add(u64::from(byte - b'0')),
            b'.' if point.is_none() => point = Some(at),
            _ => break,
        }
        at += 1;
        if at - start > MOST_DIGITS + 1 {
            return None;
        }
    }
    let count = at - start - usize::from(point.is_some());
    let has_exponent = matches!(text.get(at), Some(b'e' | b'E'));
    if count == 0 || count > MOST_DIGITS || has_exponent {
        return None;
    }
    let decimals = point.map_or(0, |point| at - point - 1);
    let size = digits as f64 / POWERS_OF_TEN[decimals];
    Some((at, if text[0] == b'-' { -size } else { size }, decimals))
}

fn decimals_of(text: &[u8]) -> usize {
    let split = text.iter().position(|byte| matches!(byte, b'e' | b'E')).unwrap_or(text.len());
    let (mantissa, exponent) = text.split_at(split);
    let places = mantissa.iter().position(|&byte| byte == b'.').map_or(0, |point| mantissa.len() - point - 1);
    let shift: i64 = std::str::from_utf8(exponent.get(1..).unwrap_or_default())
        .ok()
        .and_then(|digits| digits.parse().ok())
        .unwrap_or(0);
    usize::try_from((places as i64).saturating_sub(shift)).unwrap_or(0).min(17)
}

/// `decimal` in the style of `field`: a leading `+` stays, a negative zero is written without its sign, a fixed column
/// keeps its width where the digits fit.
///
/// Returns the range to replace (the column where there is one) and the text.
pub fn written(field: &NumberField, original: &[u8], decimal: &Decimal) -> (Span, String) {
    let mut text = decimal.text();
    if original.first() == Some(&b'+') && !text.starts_with('-') {
        text.insert(0, '+');
    }
    if let Some(insertion) = &field.insertion {
        return (field.span(), format!("{}{text}{}", insertion.before, insertion.after));
    }
    match field.column() {
        Some(column) => (column, format!("{text:>width$}", width = column.len())),
        None => (field.span(), text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(text: &str) -> NumberField {
        number_at(text.as_bytes(), 0).expect("a number")
    }

    #[test]
    fn numbers_of_every_spelling() {
        for (text, value, length, decimals) in [
            ("1", 1.0, 1, 0),
            ("1.", 1.0, 2, 0),
            (".5]", 0.5, 2, 1),
            ("-12.340,", -12.34, 7, 3),
            ("+1E+2;", 100.0, 5, 0),
            ("9E9", 9e9, 3, 0),
            ("-1.2E-05", -1.2e-5, 8, 6),
            ("1ELSE", 1.0, 1, 0),
            ("1e+x", 1.0, 1, 0),
        ] {
            let field = field(text);
            assert_eq!((field.value, field.span().len(), field.decimals()), (value, length, decimals), "{text}");
        }
        for text in ["", "-", ".", "e5", "abc", "1e999"] {
            assert!(number_at(text.as_bytes(), 0).is_none(), "{text}");
        }
    }

    #[test]
    fn numbers_are_written_in_the_style_of_their_field() {
        let plain = field("-12.34");
        assert_eq!(written(&plain, b"-12.34", &Decimal::nearest(-0.00001, 3)).1, "0.000");
        assert_eq!(written(&plain, b"+12.34", &Decimal::nearest(1.5, 2)).1, "+1.50");
        let column = field("1.5").at(6).in_column_from(0);
        assert_eq!(written(&column, b"1.5", &Decimal::nearest(2.25, 3)), (Span::new(0, 9), "    2.250".into()));
        let insertion = Insertion { before: " x=\"".into(), after: "\"".into(), repeats: false };
        let absent = NumberField::left_out(7, 0.0, 0, insertion);
        assert_eq!(written(&absent, b"", &Decimal::nearest(2.25, 2)), (Span::new(7, 7), " x=\"2.25\"".into()));
    }

    proptest::proptest! {
        #[test]
        fn plain_numbers_are_read_as_any_number_is(text in "[+-]?[0-9]{0,17}\\.?[0-9]{0,17}([eE][+-]?[0-9]{1,2})?[ ,.eE]?") {
            if let Some((length, value, decimals)) = plain_number(text.as_bytes()) {
                let (known_length, known_value, known_decimals) = any_number(text.as_bytes()).expect("a number");
                proptest::prop_assert_eq!((length, decimals), (known_length, known_decimals));
                proptest::prop_assert_eq!(value.to_bits(), known_value.to_bits());
            }
        }
    }

    #[test]
    fn words_end_where_names_end() {
        assert!(starts_with_word(b"MoveL p", "movel"));
        assert!(!starts_with_word(b"MoveLDO p", "movel"));
    }
}

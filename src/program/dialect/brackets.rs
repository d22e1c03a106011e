//! Lists in brackets, whatever a language's tokens are.

use std::ops::Range;

/// Divides what stands between two brackets at commas outside of inner brackets. Gives the parts, empty ones too, and the
/// token of the closing bracket; `None` where no bracket closes the first.
///
/// # Arguments
/// * `open` - the token of the first bracket
/// * `symbols` - the tokens from there on, with their byte where they are a symbol
pub(super) fn parts(
    open: usize,
    symbols: impl Iterator<Item = (usize, Option<u8>)>,
) -> Option<(Vec<Range<usize>>, usize)> {
    let (mut depth, mut start, mut parts) = (0_usize, open + 1, Vec::new());
    for (at, symbol) in symbols {
        match symbol {
            Some(b'(' | b'[' | b'{') => depth += 1,
            Some(b')' | b']' | b'}') => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    parts.push(start..at);
                    return Some((parts, at));
                }
            }
            Some(b',') if depth == 1 => {
                parts.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
    }
    None
}

/// The same where nothing behind the last comma is no part.
pub(super) fn parts_without_empty_last(
    open: usize,
    symbols: impl Iterator<Item = (usize, Option<u8>)>,
) -> Option<(Vec<Range<usize>>, usize)> {
    let (mut parts, close) = parts(open, symbols)?;
    if parts.last().is_some_and(Range::is_empty) {
        parts.pop();
    }
    Some((parts, close))
}

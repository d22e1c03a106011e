//! Telling G-code by its content.

use crate::base::text::Source;

use super::block::block;

/// Lines that are looked at.
const MOST_LINES: usize = 300;

/// True when three of five lines with code are blocks of words alone, with a motion and coordinates among them.
pub(super) fn recognises(source: &Source) -> bool {
    let (mut blocks, mut others, mut moves, mut coordinates) = (0, 0, false, false);
    for line in source.lines().take(MOST_LINES) {
        let block = block(source.bytes(), line);
        if block.words.is_empty() && block.keywords.is_empty() && !block.opaque {
            continue;
        }
        if block.opaque || !block.keywords.is_empty() {
            // Numbered blocks, `#TRAFO ON` and `$TC_DP3[1,1]=0` are of this language, but not of it alone.
            let known = block.word("N").is_some() || matches!(source.slice(block.span).first(), Some(b'#' | b'$'));
            others += usize::from(!known);
            continue;
        }
        blocks += 1;
        moves |= block.numbers("G").any(|code| (0.0..=3.0).contains(&code));
        coordinates |= ["X", "Y", "Z"].iter().any(|address| block.word(address).is_some());
    }
    moves && coordinates && blocks * 2 >= others * 3
}

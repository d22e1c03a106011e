//! Circular steps pair up: the first is the via point, the second the end point.

use std::sync::Arc;

use crate::program::target::PathKind;

/// Sets the path of circular motions, given in program order as word and path. A circular step that is left over at
/// the end of a run, or whose neighbour has another word, belongs to no arc that the text shows.
pub(super) fn pair_up(motions: &mut [(Arc<str>, &mut PathKind)]) {
    let mut at = 0;
    while at < motions.len() {
        if *motions[at].1 != PathKind::ArcVia {
            at += 1;
            continue;
        }
        let paired = match motions.get(at + 1) {
            Some(next) => *next.1 == PathKind::ArcVia && next.0 == motions[at].0,
            None => false,
        };
        if paired {
            *motions[at + 1].1 = PathKind::ArcEnd;
        } else {
            *motions[at].1 = PathKind::Other;
        }
        at += if paired { 2 } else { 1 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circular_steps_pair_up_and_a_single_one_stands_alone() {
        let words = ["MOVE L", "MOVE C", "MOVE C", "MOVE C", "MOVE C", "MOVE C", "SMOV C", "SMOV C"];
        let mut paths: Vec<PathKind> =
            words.iter().map(|word| if word.ends_with('C') { PathKind::ArcVia } else { PathKind::Linear }).collect();
        let mut motions: Vec<(Arc<str>, &mut PathKind)> =
            words.iter().map(|&word| word.into()).zip(paths.iter_mut()).collect();
        pair_up(&mut motions);
        use PathKind::{ArcEnd, ArcVia, Linear, Other};
        assert_eq!(paths, [Linear, ArcVia, ArcEnd, ArcVia, ArcEnd, Other, ArcVia, ArcEnd]);
    }
}

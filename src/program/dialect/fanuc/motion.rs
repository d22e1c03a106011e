//! Motion statements: `J P[1] 100% FINE`, `L PR[R[1]] 500mm/sec CNT50`, `C P[2]` and in the next line `P[3] ..`.

use std::sync::Arc;

use crate::base::text::Span;
use crate::program::scan::Cursor;
use crate::program::target::PathKind;

use super::statement::{Statement, bracket, index, skip_gap, without_comments};

/// A motion statement.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// `J`, `L`, `C`, `A`, `S`.
    pub word: Arc<str>,
    /// Where to; two of an arc.
    pub goals: Vec<(Goal, PathKind)>,
    /// Why the arm does not simply go there, if so.
    pub computed: Option<String>,
}

/// What stands where the position belongs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// `P[3]`.
    Point(u32, Span),
    /// `P[R[1]]`, as written without comments.
    Indirect(String, Span),
    /// `PR[1]`, `PAL_1[BTM]`: filled at run time.
    Register(String, Span),
}

/// Reads a motion statement; `None` when it is another one.
pub(super) fn motion(bytes: &[u8], statement: Statement) -> Option<Motion> {
    let mut cursor = Cursor::new(bytes, statement.span);
    let letter = cursor.bump()?;
    let path = match letter {
        b'J' => PathKind::Joint,
        b'L' => PathKind::Linear,
        b'C' => PathKind::ArcVia,
        // Each point of a row of these ends one piece of an arc and begins the next.
        b'A' => PathKind::ArcEnd,
        b'S' => PathKind::Other,
        _ => return None,
    };
    if cursor.skip_while(|byte| matches!(byte, b' ' | b'\t')).is_empty() {
        return None;
    }
    let first = goal(&mut cursor)?;
    let mut goals = vec![(first, path)];
    if path == PathKind::ArcVia {
        skip_gap(&mut cursor);
        goals.extend(goal(&mut cursor).map(|end| (end, PathKind::ArcEnd)));
    }
    let word = char::from(letter).to_string().into();
    Some(Motion { word, goals, computed: displaced(cursor.rest()) })
}

fn goal(cursor: &mut Cursor<'_>) -> Option<Goal> {
    let before = *cursor;
    let start = cursor.offset();
    let name = cursor.name().map(|name| cursor.slice(name));
    let inside = name.and_then(|_| bracket(cursor));
    let (Some(name), Some(inside)) = (name, inside) else {
        *cursor = before;
        return None;
    };
    let span = Span::new(start, cursor.offset());
    Some(match (name, index(cursor.slice(inside))) {
        (b"P", Some(number)) => Goal::Point(number, span),
        (b"P", None) => Goal::Indirect(without_comments(cursor.slice(span)), span),
        _ => Goal::Register(without_comments(cursor.slice(span)), span),
    })
}

/// Why the options behind the position move the goal, if they do. `Skip` ends a move early and moves nothing.
fn displaced(options: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(options).to_uppercase();
    if let Some(at) = ["PR[", "VR["].iter().filter_map(|register| text.find(register)).min() {
        let register: String = text[at..].chars().take_while(|&letter| letter != ']').collect();
        return Some(format!("displaced by {}", without_comments(format!("{register}]").as_bytes())));
    }
    let words = || text.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
    if words().any(|word| word.contains("OFFSET")) {
        return Some("displaced by the offset condition in force".into());
    }
    words().find_map(|word| {
        Some(match word {
            "INC" => "incremental: relative to where the arm stands".into(),
            "COORD" => "moves in step with a positioner: the goal depends on where that stands".into(),
            "RTCP" => "remote TCP: the robot holds the work piece, and where the tool stands is not in the text".into(),
            _ => return None,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<Motion> {
        motion(text.as_bytes(), Statement { span: Span::new(0, text.len()) })
    }

    #[test]
    fn motions_are_told_by_letter_and_bracket() {
        let one = read("J P[12:\"over\"] 100% FINE").expect("a motion");
        assert!(matches!(one.goals[..], [(Goal::Point(12, _), PathKind::Joint)]));
        let arc = read("C P[3]    \r\n    :  P[4] 100mm/sec FINE").expect("a motion");
        assert!(matches!(
            arc.goals[..],
            [(Goal::Point(3, _), PathKind::ArcVia), (Goal::Point(4, _), PathKind::ArcEnd)]
        ));
        let indirect = read("L P[R[5:row]] max_Geschw. CNT0").expect("a motion");
        assert!(matches!(&indirect.goals[0].0, Goal::Indirect(text, _) if text == "P[R[5]]"));
        for text in ["LBL[1]", "JMP LBL[1]", "CALL P[1]", "A=P[1]", "J", "J 5", "LP[1]", "L P[1", ""] {
            assert!(read(text).is_none(), "{text}");
        }
    }

    #[test]
    fn displacements_are_told_in_any_language() {
        let reason = |text: &str| read(text).and_then(|motion| motion.computed);
        assert_eq!(
            reason("J P[1] 100% CNT0 ZEIT VOR .10sek,P-SPS WKZ_Offset ,PR[5:x] ").as_deref(),
            Some("displaced by PR[5]")
        );
        assert!(reason("L P[1] 5mm/sec FINE Offset").is_some());
        assert!(reason("L P[1] 5mm/sec FINE INC").is_some());
        assert!(reason("L P[1] R[1:PR]mm/sec CNT100 ACC100 Skip,LBL[2]").is_none());
        assert!(reason("L P[1] 5mm/sec CNT100 COORD PTH").is_some());
    }
}

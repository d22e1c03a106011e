//! Motion instructions: `MOVJ C00002 VJ=50.00`, `MOVL P125 V=25.0 PL=0`, `MOVL P[B000] BP001 V=5.0 +MOVJ EC001`.

use crate::base::text::Span;
use crate::program::scan::Cursor;
use crate::program::target::PathKind;

use super::positions::{Kind, split};

/// A motion instruction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Motion {
    /// `MOVL`.
    pub word: String,
    /// How the arm travels.
    pub path: PathKind,
    /// Where to.
    pub goal: Goal,
    /// Why the arm does not simply go there, if so.
    pub computed: Option<String>,
}

/// The operand of a motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// `C00002`, `P125`.
    Position(Kind, u32, Span),
    /// `LP000`, `P[B000]`: known only at run time.
    Runtime(String, Span),
    /// `EC00001` alone: the robot stands still.
    OtherAxes,
}

/// Reads a motion instruction; `None` when it is another one.
pub(super) fn motion(bytes: &[u8], line: Span) -> Option<Motion> {
    let mut cursor = Cursor::new(bytes, line);
    let second_group = cursor.eat(b'+');
    let word = cursor.name()?;
    let word = String::from_utf8_lossy(cursor.slice(word)).into_owned();
    let (path, reason) = match word.as_str() {
        "MOVJ" => (PathKind::Joint, None),
        "MOVL" => (PathKind::Linear, None),
        "MOVC" => (PathKind::ArcEnd, None),
        "MOVS" => (PathKind::Other, None),
        "IMOV" => (PathKind::Other, Some("incremental: relative to where the arm stands")),
        "EIMOVL" | "EIMOVC" => (PathKind::Other, Some("incremental: relative to where the arm stands")),
        _ if word.strip_prefix('S').is_some_and(|plain| matches!(plain, "MOVJ" | "MOVL" | "MOVC" | "MOVS")) => {
            (PathKind::Other, Some("moves in step with a station: the goal depends on where that stands"))
        }
        _ => return None,
    };
    cursor.skip_blanks();
    let goal = goal(&mut cursor)?;
    let second = second_group.then_some("the motion of a second group");
    Some(Motion { word, path, goal, computed: reason.or(second).map(str::to_owned) })
}

fn goal(cursor: &mut Cursor<'_>) -> Option<Goal> {
    let start = cursor.offset();
    let name = cursor.name()?;
    let text = cursor.slice(name);
    if cursor.peek() == Some(b'[') {
        cursor.skip_while(|byte| byte != b' ' && byte != b'\t');
        let span = Span::new(start, cursor.offset());
        return Some(Goal::Runtime(String::from_utf8_lossy(cursor.slice(span)).into_owned(), span));
    }
    let (letters, number) = split(text)?;
    Some(match letters.as_str() {
        "C" => Goal::Position(Kind::Step, number, name),
        "P" | "PX" => Goal::Position(Kind::Variable, number, name),
        "BC" | "EC" | "BP" | "EX" => Goal::OtherAxes,
        _ => Goal::Runtime(String::from_utf8_lossy(text).into_owned(), name),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<Motion> {
        motion(text.as_bytes(), Span::new(0, text.len()))
    }

    #[test]
    fn operands_of_every_kind() {
        let goal = |text: &str| read(text).map(|motion| motion.goal);
        assert!(matches!(goal("MOVL P125 V=25.0 PL=0"), Some(Goal::Position(Kind::Variable, 125, _))));
        assert!(matches!(goal("MOVJ C00002 T0000 VJ=50.00"), Some(Goal::Position(Kind::Step, 2, _))));
        assert!(matches!(goal("MOVL C0003 BC0003 EC0003 V=5.0"), Some(Goal::Position(Kind::Step, 3, _))));
        assert!(matches!(goal("MOVL P[B000] V=5.0"), Some(Goal::Runtime(text, _)) if text == "P[B000]"));
        assert!(matches!(goal("MOVL LP000 V=5.0"), Some(Goal::Runtime(..))));
        assert_eq!(goal("MOVJ EC00001 VJ=5.00"), Some(Goal::OtherAxes));
        for text in ["", "MOVJ", "MOVE P1", "NOP", "SET P001 P002", "MOVLP001", "+", "MOVL P99999999999"] {
            assert!(read(text).is_none(), "{text}");
        }
    }

    #[test]
    fn motions_that_lead_elsewhere_say_why() {
        assert!(read("IMOV P001 V=201.0").is_some_and(|motion| motion.computed.is_some()));
        assert!(read("SMOVL C00001 V=5.0").is_some_and(|motion| motion.computed.is_some()));
        assert!(read("+MOVL C00001").is_some_and(|motion| motion.computed.is_some()));
        assert!(read("MOVL C00001 V=5.0 +MOVJ EC00001").is_some_and(|motion| motion.computed.is_none()));
    }
}

//! Motion statements.

use crate::base::text::Span;
use crate::program::scan::Cursor;
use crate::program::target::PathKind;

use super::expression::{Expression, Number, numbers};

/// A motion.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// The word of the language.
    pub word: String,
    /// How the arm goes.
    pub path: PathKind,
    /// Where to.
    pub goal: Goal,
    /// Why it does not simply go there.
    pub computed: Option<String>,
}

/// Where a motion goes.
#[derive(Clone, Debug)]
pub(super) enum Goal {
    /// A location.
    Location(Expression),
    /// The joint values of a block step, with the numbers of its tool and work piece.
    Block { span: Span, joints: Vec<Number>, tool: Option<String>, work: Option<String> },
    /// Onwards from where the arm stands.
    Relative(Span),
}

/// Reads a motion; `None` when the statement is something else. The cursor stands behind the word.
pub(super) fn motion(word: &str, cursor: &Cursor<'_>, statement: Span) -> Option<Motion> {
    let mut cursor = *cursor;
    let path = match word {
        "JMOVE" | "JAPPRO" | "JWS" | "JOINT" => PathKind::Joint,
        "LMOVE" | "LAPPRO" | "XMOVE" | "LWS" | "LWC" | "LWE" | "LINEAR" | "LINEAR2" | "FLIN" => PathKind::Linear,
        "C1MOVE" | "C1WC" | "CIR1" => PathKind::ArcVia,
        "C2MOVE" | "C2WC" | "C2WE" | "CIR2" => PathKind::ArcEnd,
        "HMOVE" | "HAPPRO" | "DRAW" | "TDRAW" | "DRIVE" | "LDEPART" | "JDEPART" | "HDEPART" => PathKind::Other,
        _ => return None,
    };
    let made = |goal, computed: Option<&str>| {
        Some(Motion { word: word.to_owned(), path, goal, computed: computed.map(str::to_owned) })
    };
    match word {
        "DRAW" | "TDRAW" | "DRIVE" | "LDEPART" | "JDEPART" | "HDEPART" => made(Goal::Relative(statement), None),
        "JOINT" | "LINEAR" | "LINEAR2" | "FLIN" | "CIR1" | "CIR2" => {
            block(&mut cursor).and_then(|goal| made(goal, None))
        }
        _ => {
            // `LMOVE = 3` would be a variable, `LMOVE[2] = 3` too.
            cursor.skip_blanks();
            if matches!(cursor.peek(), None | Some(b'=' | b'[')) {
                return None;
            }
            let computed = match word {
                "XMOVE" => Some("a search: the arm stops where the signal comes"),
                "JAPPRO" | "LAPPRO" | "HAPPRO" => Some("approached at a distance: it moves with the location"),
                _ => None,
            };
            made(Goal::Location(Expression::read(&mut cursor)), computed)
        }
    }
}

/// ` SPEED9 ACCU1 TIMER0 TOOL1 WORK0 CLAMP1 (OFF,0,0,O) .. #[1,2,3,4,5,6]`
fn block(cursor: &mut Cursor<'_>) -> Option<Goal> {
    let at = cursor.rest().windows(2).position(|pair| pair == b"#[")?;
    let start = cursor.offset() + at;
    let words = cursor.slice(Span::new(cursor.offset(), start));
    let numbered = |word: &str| {
        let mut parts = words.split(|byte: &u8| byte.is_ascii_whitespace());
        let found = parts.find_map(|part| {
            let digits = part.get(word.len()..).filter(|_| part[..word.len()].eq_ignore_ascii_case(word.as_bytes()))?;
            (!digits.is_empty() && digits.iter().all(u8::is_ascii_digit)).then_some(digits)
        });
        found.map(|digits| String::from_utf8_lossy(digits).into_owned())
    };
    let (tool, work) = (numbered("TOOL"), numbered("WORK"));
    cursor.seek(start + 1);
    let (joints, end) = numbers(cursor, b']')?;
    Some(Goal::Block { span: Span::new(start, end), joints, tool, work })
}

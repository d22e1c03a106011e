//! Motion statements: `PTP XP1 C_PTP`, `LIN {X 1,..}`, `CIRC aux, end, CA 90`, `SPTP XP1 WITH $TOOL = STOOL2(FP1)`.

use std::sync::Arc;

use crate::base::text::Span;
use crate::program::scan::Cursor;
use crate::program::target::PathKind;

use super::aggregate::{Aggregate, Unclosed, aggregate};
use super::reference::{Reference, reference};
use super::statement::{first_word, name, split_at_commas, trimmed};

/// Where a motion goes.
#[derive(Clone, Debug)]
pub(super) enum Goal {
    /// Written in the statement.
    Written(Aggregate),
    /// A variable.
    Named(Reference),
    /// An expression.
    Expression(Span),
    /// A brace that does not close.
    Broken(Unclosed),
}

/// A motion statement.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Its word as written.
    pub word: Arc<str>,
    /// It goes on from where the arm stands.
    pub is_relative: bool,
    /// Its goals and how the arm travels there.
    pub goals: Vec<(Goal, PathKind)>,
    /// An arc ends where its angle says, not at its end point.
    pub has_angle: bool,
    /// What stands behind `WITH`.
    pub with: Option<Span>,
}

/// Reads a motion statement.
pub(super) fn motion(bytes: &[u8], statement: Span) -> Motion {
    let (word, rest) = first_word(bytes, statement);
    let (head, with) = split_at_with(bytes, rest);
    let mut parts = split_at_commas(bytes, head).into_iter();
    let is_relative = word.ends_with("_rel");
    let paths: &[PathKind] = match word.trim_end_matches("_rel") {
        "ptp" | "sptp" => &[PathKind::Joint],
        "lin" | "slin" => &[PathKind::Linear],
        "circ" | "scirc" => &[PathKind::ArcVia, PathKind::ArcEnd],
        _ => &[PathKind::Other],
    };
    let goals = paths.iter().filter_map(|path| Some((goal(bytes, parts.next()?), *path))).collect();
    let has_angle = parts.any(|part| first_word(bytes, part).0 == "ca");
    let spelled = &bytes[statement.start..statement.start + word.len().min(statement.len())];
    Motion { word: String::from_utf8_lossy(spelled).into(), is_relative, goals, has_angle, with }
}

/// What stands before the word `WITH`, and behind it.
pub(super) fn split_at_with(bytes: &[u8], span: Span) -> (Span, Option<Span>) {
    let mut cursor = Cursor::new(bytes, span);
    let mut in_string = false;
    while let Some(byte) = cursor.peek() {
        let at = cursor.offset();
        let before_name = !in_string && name(&mut cursor).is_some();
        if before_name {
            if bytes[at..cursor.offset()].eq_ignore_ascii_case(b"with") {
                return (trimmed(bytes, Span::new(span.start, at)), Some(Span::new(cursor.offset(), span.end)));
            }
            continue;
        }
        in_string ^= byte == b'"';
        cursor.bump();
    }
    (span, None)
}

fn goal(bytes: &[u8], part: Span) -> Goal {
    let mut cursor = Cursor::new(bytes, part);
    let simple = if cursor.peek() == Some(b'{') {
        match aggregate(bytes, &mut cursor) {
            Ok(written) => Some(Goal::Written(written)),
            Err(unclosed) => return Goal::Broken(unclosed),
        }
    } else {
        reference(bytes, &mut cursor).map(Goal::Named)
    };
    cursor.skip_blanks();
    let expression = Span::new(part.start, approximation(bytes, part));
    match simple {
        Some(goal) if cursor.offset() >= expression.end => goal,
        _ => Goal::Expression(trimmed(bytes, expression)),
    }
}

/// Where the words `C_PTP`, `C_DIS`, `#TOOL` and the like begin that may stand behind a goal.
fn approximation(bytes: &[u8], part: Span) -> usize {
    let mut cursor = Cursor::new(bytes, part);
    let mut depth = 0usize;
    while let Some(byte) = cursor.peek() {
        let at = cursor.offset();
        if let Some(word) = name(&mut cursor) {
            let text = &bytes[word.start..word.end];
            if depth == 0 && at > part.start && text.len() > 2 && text[..2].eq_ignore_ascii_case(b"c_") {
                return at;
            }
            continue;
        }
        match byte {
            b'{' | b'(' | b'[' => depth += 1,
            b'}' | b')' | b']' => depth = depth.saturating_sub(1),
            b'#' if depth == 0 => return at,
            _ => {}
        }
        cursor.bump();
    }
    part.end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> String {
        let bytes = text.as_bytes();
        let found = motion(bytes, Span::new(0, bytes.len()));
        let shown: Vec<String> = found
            .goals
            .iter()
            .map(|(goal, path)| match goal {
                Goal::Written(written) => format!("{path:?} {}", &text[written.span.start..written.span.end]),
                Goal::Named(named) => format!("{path:?} {}", &text[named.span.start..named.span.end]),
                Goal::Expression(span) => format!("{path:?} ? {}", &text[span.start..span.end]),
                Goal::Broken(_) => "broken".into(),
            })
            .collect();
        let with = found.with.map(|span| format!(" with{}", &text[span.start..span.end])).unwrap_or_default();
        format!("{} {}{with}", found.word, shown.join(" | "))
    }

    #[test]
    fn goals_of_every_kind() {
        assert_eq!(read("PTP XP1 C_PTP C_DIS"), "PTP Joint XP1");
        assert_eq!(read("lin{X 1,Y 2}C_DIS"), "lin Linear {X 1,Y 2}");
        assert_eq!(read("CIRC p[1], {X 1} , CA 90 C_DIS"), "CIRC ArcVia p[1] | ArcEnd {X 1}");
        assert_eq!(read("LIN p[2] :{X 0,Z 5} C_VEL"), "LIN Linear ? p[2] :{X 0,Z 5}");
        assert_eq!(read("SLIN calc(a, b - 1)"), "SLIN Linear ? calc(a, b - 1)");
        assert_eq!(
            read("SPTP P1 WITH $TOOL = STOOL2(F), $BASE = B C_Spl"),
            "SPTP Joint P1 with $TOOL = STOOL2(F), $BASE = B C_Spl"
        );
        assert_eq!(read("LIN_REL {Z 5}#TOOL"), "LIN_REL Linear {Z 5}");
        assert_eq!(read("LIN {X 1"), "LIN broken");
        assert_eq!(read("PTP"), "PTP Joint ? ");
    }
}

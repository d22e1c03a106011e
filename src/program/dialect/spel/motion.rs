//! Motions.

use crate::base::text::{Source, Span};
use crate::program::scan::Cursor;
use crate::program::target::PathKind;

use super::expression::{Goal, goal};
use super::points::Points;

/// A motion.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// The word of the language.
    pub word: String,
    /// Where to, one or more, with the text of each.
    pub goals: Vec<(Goal, Span, PathKind)>,
    /// Why it does not simply go there.
    pub computed: Option<String>,
}

/// Reads a motion; `None` when the statement is something else.
pub(super) fn motion(source: &Source, file: usize, statement: Span, points: &Points) -> Option<Motion> {
    let mut cursor = Cursor::new(source.bytes(), statement);
    let name = cursor.name()?;
    let word = source.text(name).into_owned();
    let mut computed = None;
    let paths: &[PathKind] = match word.to_ascii_lowercase().as_str() {
        "go" | "jump" | "pass" => &[PathKind::Joint],
        "move" => &[PathKind::Linear],
        "arc" | "arc3" => &[PathKind::ArcVia, PathKind::ArcEnd],
        "jump3" | "jump3cp" => &[PathKind::Linear, PathKind::Joint, PathKind::Linear],
        "tgo" | "tmove" => {
            computed = Some("onwards in the tool from where the arm stands".to_owned());
            &[PathKind::Other]
        }
        "bgo" | "bmove" => {
            computed = Some("onwards in the local from where the arm stands".to_owned());
            &[PathKind::Other]
        }
        "cvmove" | "pulse" | "ptran" | "jtran" => {
            let reason = format!("`{word}` goes to no position of the text");
            let goals = vec![(Goal::Runtime(reason), statement, PathKind::Other)];
            return Some(Motion { word, goals, computed: None });
        }
        _ => return None,
    };
    cursor.skip_blanks();
    // `Go = 1` is a variable.
    if matches!(cursor.peek(), None | Some(b'=')) {
        return None;
    }
    let all_goals = word.eq_ignore_ascii_case("pass");
    let mut goals = Vec::new();
    loop {
        let path = paths.get(goals.len()).copied().unwrap_or(PathKind::Joint);
        let (goal, span) = goal(&mut cursor, source, file, points);
        goals.push((goal, span, path));
        cursor.skip_blanks();
        if (goals.len() >= paths.len() && !all_goals) || !cursor.eat(b',') {
            break;
        }
    }
    Some(Motion { word, goals, computed })
}

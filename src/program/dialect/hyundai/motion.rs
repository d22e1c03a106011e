//! Motion statements: `MOVE L,(..)U1,S=100mm/s,A=1,T=2`, `SMOV S1,C,S=23mm/s,A=1,T=0  (..)A`,
//! `move P,tg=po[0],spd=80%,accu=1,tool=3 until di2  [..]`.

use std::sync::Arc;

use crate::base::text::Span;
use crate::program::scan::Cursor;
use crate::program::target::{PathKind, Reference};

use super::elements::string;
use super::expression::{Goal, goal};
use super::header::{MOTION_WORDS, is_blank};
use super::written_pose::PoseFault;

/// A motion statement.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// `MOVE L`, `SMOV C`: the words as written.
    pub word: Arc<str>,
    /// How the arm travels; arcs are paired up later.
    pub path: PathKind,
    /// Where to; `None` when the text does not hold it.
    pub goal: Option<Goal>,
    /// The tool, if the statement names one.
    pub tool: Option<Reference>,
    /// Why the arm does not simply go to the goal, if so.
    pub computed: Option<String>,
}

/// Reads a motion statement; `None` when `body` is something else.
pub(super) fn motion(bytes: &[u8], body: Span, total_axes: Option<usize>) -> Option<Motion> {
    let mut cursor = Cursor::new(bytes, body);
    let keyword = Span::new(body.start, body.start + MOTION_WORDS[0].len());
    let synchronous = cursor.eat_word(MOTION_WORDS[1]);
    if (!synchronous && !cursor.eat_word(MOTION_WORDS[0])) || cursor.skip_while(is_blank).is_empty() {
        return None;
    }
    if synchronous {
        cursor.name()?;
        cursor.skip_blanks();
        cursor.eat(b',');
        cursor.skip_blanks();
    }
    let interpolation = cursor.name()?;
    let interpolation_text = cursor.slice(interpolation).to_ascii_uppercase();
    cursor.skip_blanks();
    if !cursor.at_end() && !matches!(cursor.peek(), Some(b',' | b'(' | b'[')) {
        return None;
    }
    let path = match interpolation_text.as_slice() {
        b"P" | b"SP" => PathKind::Joint,
        b"L" | b"SL" => PathKind::Linear,
        b"C" | b"SC" => PathKind::ArcVia,
        _ => PathKind::Other,
    };
    let text = |span: Span| String::from_utf8_lossy(cursor.slice(span)).into_owned();
    let outline = outline(bytes, Span::new(interpolation.end, body.end));
    let mut motion = Motion {
        word: format!("{} {}", text(keyword), text(interpolation)).into(),
        path,
        goal: None,
        tool: None,
        computed: None,
    };
    for parameter in &outline.parameters {
        read_parameter(bytes, *parameter, total_axes, &mut motion);
    }
    recorded_pose(bytes, &outline, total_axes, &mut motion);
    if synchronous {
        note(&mut motion, "moves in step with a positioner: the goal depends on where the station stands");
    }
    if path == PathKind::Other {
        note(&mut motion, "an interpolation that is not known");
    } else if interpolation_text.len() == 2 {
        note(&mut motion, "stationary-tool motion: the pose is that of the work piece");
    }
    if outline.until {
        note(&mut motion, "the motion ends where its `until` condition comes true");
    }
    Some(motion)
}

fn note(motion: &mut Motion, reason: &str) {
    motion.computed.get_or_insert_with(|| reason.to_owned());
}

fn read_parameter(bytes: &[u8], span: Span, total_axes: Option<usize>, motion: &mut Motion) {
    let mut cursor = Cursor::new(bytes, span);
    cursor.skip_blanks();
    let start = cursor.offset();
    let keyword = cursor.name().map(|name| cursor.slice(name).to_ascii_lowercase());
    cursor.skip_blanks();
    let is_keyword = keyword.is_some() && cursor.eat(b'=');
    cursor.skip_blanks();
    let value = Span::new(if is_keyword { cursor.offset() } else { start }, span.end);
    if value.is_empty() {
        return;
    }
    match keyword.as_deref() {
        Some(b"t" | b"tool") if is_keyword => motion.tool = Some(tool(bytes, value)),
        Some(name) if is_keyword && name != b"tg" => {}
        _ => {
            motion.goal = Some(match goal(bytes, value, total_axes) {
                Goal::Broken(PoseFault::NotConstant(_)) => Goal::Expression(value),
                goal => goal,
            });
        }
    }
}

/// The tool number, or that it is a variable.
fn tool(bytes: &[u8], span: Span) -> Reference {
    let text = String::from_utf8_lossy(&bytes[span.start..span.end]).trim().to_owned();
    match text.parse::<u32>() {
        Ok(number) => Reference::Named(number.to_string().into()),
        Err(_) => Reference::Runtime(format!("the tool number is `{text}`")),
    }
}

/// The pose after the parameters: the goal, unless a parameter names another one.
fn recorded_pose(bytes: &[u8], outline: &Outline, total_axes: Option<usize>, motion: &mut Motion) {
    if matches!(motion.goal, Some(Goal::Shift)) {
        note(motion, "the recorded pose is displaced by a shift");
        motion.goal = None;
    }
    let Some(span) = outline.recorded else { return };
    match goal(bytes, span, total_axes) {
        Goal::Broken(PoseFault::NotConstant(_)) if outline.until => {}
        recorded if motion.goal.is_none() => motion.goal = Some(recorded),
        _ => {}
    }
}

/// Where the parts of a motion statement stand.
struct Outline {
    /// Between the commas outside of brackets.
    parameters: Vec<Span>,
    /// There is an `until`.
    until: bool,
    /// The bracket at the end, after a blank.
    recorded: Option<Span>,
}

/// Divides what follows the interpolation. One pass.
fn outline(bytes: &[u8], span: Span) -> Outline {
    let mut cursor = Cursor::new(bytes, span);
    let mut outline = Outline { parameters: Vec::new(), until: false, recorded: None };
    let (mut depth, mut start, mut last_solid) = (0_usize, None, b'P');
    let mut parameters_end = None;
    let mut opened = None;
    while let Some(byte) = cursor.peek() {
        let at = cursor.offset();
        let after_blank = at > span.start && is_blank(bytes[at - 1]);
        match byte {
            b'"' if string(&mut cursor).is_some() => {
                last_solid = byte;
                continue;
            }
            b'\\' => {
                cursor.bump();
            }
            b'(' | b'[' => {
                // A recorded pose follows a finished parameter, not a comma or an operator.
                if depth == 0 && after_blank && !matches!(last_solid, b',' | b'=' | b'+' | b'-' | b'*' | b'/') {
                    opened = Some(at);
                } else if depth == 0 {
                    opened = None;
                }
                depth += 1;
            }
            b')' | b']' => depth = depth.saturating_sub(1),
            b',' if depth == 0 && parameters_end.is_none() => {
                outline.parameters.extend(start.map(|start| Span::new(start, at)));
                start = Some(at + 1);
                opened = None;
            }
            _ if depth == 0 && after_blank && cursor.eat_word("until") => {
                outline.until = true;
                parameters_end.get_or_insert(at);
                last_solid = b',';
                continue;
            }
            byte if depth == 0 && !is_blank(byte) && !byte.is_ascii_alphanumeric() => opened = None,
            _ => {}
        }
        if !is_blank(byte) {
            last_solid = byte;
        }
        cursor.bump();
    }
    outline.recorded = opened.map(|at| Span::new(at, span.end));
    let end = parameters_end.or(opened).unwrap_or(span.end);
    outline.parameters.extend(start.filter(|&start| start < end).map(|start| Span::new(start, end)));
    outline
}

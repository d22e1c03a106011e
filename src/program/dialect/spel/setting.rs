//! Tools and locals: `Tool 1`, `TLSet 1, XY(..)`, `Local 2, XY(..)`.

use std::collections::HashMap;

use crate::base::text::{Source, Span};
use crate::geometry::pose::Pose;
use crate::program::number::{NumberField, number_at};
use crate::program::scan::Cursor;
use crate::program::target::{Definition, FrameData, Program, Reference, ToolData};

use super::expression::bracket;
use super::macros::Macros;
use super::points::pose;

/// What a statement sets.
#[derive(Clone, Debug)]
pub(super) enum Setting {
    /// `Tool n`.
    Select(Reference),
    /// `TLSet n, ..`.
    Tool(u32, Result<Pose, String>),
    /// `Local n, ..`.
    Local(u32, Result<Pose, String>),
    /// A tool or local whose number is a variable, or `Base`: nothing that it may mean is known.
    Unknown(String),
}

/// Reads a statement; `None` when it sets nothing.
pub(super) fn setting(source: &Source, statement: Span, macros: &Macros) -> Option<Setting> {
    let mut cursor = Cursor::new(source.bytes(), statement);
    let name = cursor.name()?;
    let word = source.text(name).to_lowercase();
    let line = source.line(statement.start);
    cursor.skip_blanks();
    if matches!(cursor.peek(), None | Some(b'=')) {
        return None;
    }
    let from = cursor.offset();
    let number = number(&mut cursor, macros);
    cursor.skip_blanks();
    match word.as_str() {
        "tool" if number.is_some() && cursor.at_end() => {
            number.map(|number| Setting::Select(Reference::Named(number.to_string().into())))
        }
        "tool" => {
            let shown = source.text(Span::new(from, statement.end));
            Some(Setting::Select(Reference::Runtime(format!("`{shown}` in line {line} selects the tool"))))
        }
        "tlset" | "local" => {
            let Some(number) = number else {
                return Some(Setting::Unknown(format!("line {line} sets a tool or local whose number is a variable")));
            };
            let value = cursor.eat(b',').then(|| constant(&mut cursor)).flatten();
            let value = value.ok_or_else(|| format!("it is set at run time in line {line}"));
            Some(if word == "tlset" { Setting::Tool(number, value) } else { Setting::Local(number, value) })
        }
        "base" => Some(Setting::Unknown(format!("the base is set in line {line}"))),
        _ => None,
    }
}

/// A number, or a name that stands for one.
fn number(cursor: &mut Cursor<'_>, macros: &Macros) -> Option<u32> {
    let word = cursor.skip_while(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    macros.meaning(&String::from_utf8_lossy(cursor.slice(word)).to_lowercase()).parse().ok()
}

/// `XY(..)` of numbers; those that are missing behind the last are zero.
fn constant(cursor: &mut Cursor<'_>) -> Option<Pose> {
    cursor.skip_blanks();
    if !cursor.eat_word("XY") {
        return None;
    }
    cursor.skip_blanks();
    let inside = (cursor.peek() == Some(b'(')).then(|| bracket(cursor)).flatten()?;
    cursor.skip_blanks();
    if !cursor.at_end() {
        return None;
    }
    let mut six = [0.0; 6];
    let parts: Vec<&[u8]> = cursor.slice(inside).split(|&byte| byte == b',').map(<[u8]>::trim_ascii).collect();
    if parts.len() > six.len() {
        return None;
    }
    for (place, part) in six.iter_mut().zip(parts) {
        *place = number_at(part, 0).filter(|field| field.span().len() == part.len())?.value;
    }
    let field = NumberField::unplaced;
    pose(six.map(field)).pose()
}

/// Files tools and locals in a program; one that is set twice to different values has none.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    tools: HashMap<u32, (usize, Span, Result<Pose, String>)>,
    locals: HashMap<u32, (usize, Span, Result<Pose, String>)>,
}

impl Definitions {
    /// Adds what a statement defines.
    pub fn add(&mut self, file: usize, span: Span, setting: &Setting) {
        let (known, number, value) = match setting {
            Setting::Tool(number, value) => (&mut self.tools, number, value),
            Setting::Local(number, value) => (&mut self.locals, number, value),
            Setting::Select(_) | Setting::Unknown(_) => return,
        };
        known
            .entry(*number)
            .and_modify(|(_, _, first)| {
                if first != value && first.is_ok() {
                    *first = Err("it is set to different values".into());
                }
            })
            .or_insert_with(|| (file, span, value.clone()));
    }

    /// Tool 0 is the flange, local 0 the robot's base.
    pub fn finish(self, program: &mut Program) {
        let zero = || (0, (0, Span::default(), Ok(Pose::identity())));
        for (number, (file, span, value)) in self.tools.into_iter().chain([zero()]) {
            let value = value.map(|pose| ToolData { pose, held_by_robot: true, load: None });
            let value = value.map_err(|reason| format!("tool {number}: {reason}"));
            program.tools.insert(number.to_string(), Definition { file, span, value });
        }
        for (number, (file, span, value)) in self.locals.into_iter().chain([zero()]) {
            let value = value.map(|pose| FrameData { pose, held_by_robot: false, on: None });
            let value = value.map_err(|reason| format!("local {number}: {reason}"));
            program.frames.insert(number.to_string(), Definition { file, span, value });
        }
    }
}

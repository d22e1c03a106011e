//! The files of a job into targets.

use std::ops::Range;
use std::sync::Arc;

use crate::base::text::Source;
use crate::geometry::pose::Pose;
use crate::program::dialect::script::{Kind, Position, Positions, Text, Tokens};
use crate::program::target::{PathKind, Program, Reference, TargetValue, Use, Way};

use super::LEXIS;
use super::clause::{Motion, motion};
use super::frames::{Frames, Own};
use super::value::position;

/// Words at which other ways may come in.
const JOINING: [&str; 20] = [
    "IF",
    "ELSE",
    "ENDIF",
    "FOR",
    "ENDFOR",
    "WHILE",
    "ENDWHILE",
    "REPEAT",
    "UNTIL",
    "SELECT",
    "CASE",
    "ENDSELECT",
    "CYCLE",
    "ROUTINE",
    "BEGIN",
    "END",
    "GOTO",
    "CALL",
    "CONDITION",
    "ENDCONDITION",
];
/// Statements with brackets that hand no variable to a routine that may change it.
const HARMLESS: [&str; 8] = ["IF", "WHILE", "UNTIL", "SELECT", "CASE", "WRITE", "WAIT", "RETURN"];

/// Reads the files; each sees its own variables only.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        let tokens = Tokens::of(source, &LEXIS);
        let text = tokens.text(source);
        let mut reader = Reader { file, text, positions: Positions::new(file), frames: Frames::default() };
        tokens.statements.iter().for_each(|statement| reader.assign(statement));
        tokens.statements.iter().for_each(|statement| reader.select(statement));
        for statement in &tokens.statements {
            reader.statement(statement, &mut program);
        }
        reader.positions.finish(&mut program);
    }
    program
}

/// A file while it is read.
struct Reader<'a> {
    file: usize,
    text: Text<'a>,
    positions: Positions,
    frames: Frames,
}

/// The `:=` of an assignment.
fn assigns(text: Text<'_>, statement: &Range<usize>) -> Option<usize> {
    statement.clone().find(|&at| text.is(at, b':') && text.is(at + 1, b'='))
}

impl Reader<'_> {
    /// Notes what a statement gives a variable, or hands to a routine.
    fn assign(&mut self, statement: &Range<usize>) {
        let text = self.text;
        let first = text.word(statement.start);
        let line = text.line(statement.start);
        if first.is_empty() {
            return;
        }
        if let Some(at) = assigns(text, statement) {
            let shown = text.show(&(statement.start..statement.start + 1));
            if at > statement.start + 1 {
                return self.positions.change(&first, &shown, format!("a part of it is set in line {line}"));
            }
            let value = at + 2..statement.end;
            let computed = || Position::plain(text.span(&value), Err(format!("`{}` is computed", text.show(&value))));
            let given = position(text, &value).unwrap_or_else(computed);
            return self.positions.define(&first, &shown, given, line);
        }
        let called = text.is(statement.start + 1, b'(') && !HARMLESS.contains(&first.as_str());
        let arguments = called.then(|| text.parts(statement.start + 1, statement.end)).flatten();
        for argument in arguments.map(|(parts, _)| parts).unwrap_or_default() {
            if argument.len() == 1 && text.kind(argument.start) == Some(Kind::Name) {
                let shown = text.show(&argument);
                let reason = format!("line {line} hands it to `{}`, which may change it", first.to_lowercase());
                self.positions.change(&text.word(argument.start), &shown, reason);
            }
        }
    }

    /// Notes what a statement sets for the moves behind it, and where ways meet.
    fn select(&mut self, statement: &Range<usize>) {
        let text = self.text;
        let offset = text.span(statement).start;
        let first = text.word(statement.start);
        let label = text.is(statement.start + 1, b':') && text.is(statement.start + 2, b':');
        // Where no routine stands before it, the program begins at its `BEGIN` and nowhere else.
        let starts = first == "BEGIN" && self.frames.joins.is_empty();
        if label || (JOINING.contains(&first.as_str()) && !starts) {
            self.frames.joins.push(offset);
        }
        if motion(text, statement).is_some() {
            return;
        }
        match assigns(text, statement) {
            Some(at) if first.starts_with('$') && at == statement.start + 1 => {
                let value = self.constant(&(at + 2..statement.end));
                self.frames.set(&first, offset, text.line(statement.start), value);
            }
            // `$TOOL.X := ..`
            Some(_) if first.starts_with('$') => {
                let reason = Err("a part of it is set".to_owned());
                self.frames.set(&first, offset, text.line(statement.start), reason);
            }
            Some(_) => {}
            None if JOINING.contains(&first.as_str()) => {}
            // A routine may set anything.
            None if text.is(statement.start + 1, b'(') || statement.len() == 1 => {
                self.frames.joins.push(text.span(statement).end);
            }
            None => {}
        }
    }

    /// Makes targets of a move. All selections are known: one further down may come round a loop.
    fn statement(&mut self, statement: &Range<usize>, program: &mut Program) {
        if let Some(motion) = motion(self.text, statement) {
            self.moved(&motion, statement, program);
        }
    }

    fn moved(&mut self, motion: &Motion, statement: &Range<usize>, program: &mut Program) {
        let text = self.text;
        let span = text.span(statement);
        let mut own = Own::default();
        for (name, value) in &motion.with {
            let value = self.constant(value);
            if let Some(place) = own.place(name) {
                *place = Some(value);
            }
        }
        let (tool, frame) = self.frames.at(span.start, &own, self.file, program);
        let relative = || "relative to a position, or to the present one".to_owned();
        let one = |path| {
            Use::new(
                self.file,
                span,
                Way {
                    motion: Arc::from(text.word(statement.start).as_str()),
                    path,
                    tool: tool.clone(),
                    frame: frame.clone(),
                    grip_load: Reference::Unnamed,
                    computed: motion.relative.then(relative),
                },
            )
        };
        if motion.goals.is_empty() {
            let nowhere = Position::plain(span, Err(relative()));
            return self.positions.go_inline(nowhere, one(PathKind::Other));
        }
        for (goal, path) in &motion.goals {
            let one = one(*path);
            if let Some(inline) = position(text, goal) {
                self.positions.go_inline(inline, one);
            } else if goal.len() == 1 && text.kind(goal.start) == Some(Kind::Name) {
                self.positions.go(&text.word(goal.start), &text.show(goal), text.span(goal), one);
            } else {
                let place = if goal.is_empty() { span } else { text.span(goal) };
                let reason = format!("`{}` is computed", text.show(goal));
                self.positions.go_inline(Position::plain(place, Err(reason)), one);
            }
        }
    }

    /// The pose of a literal, or of a variable that gets one.
    fn constant(&self, range: &Range<usize>) -> Result<Pose, String> {
        let text = self.text;
        let null = text.word(range.start) == "POS"
            && range.len() == 4
            && text.number(&(range.start + 2..range.start + 3)).is_some();
        if null {
            return Ok(Pose::identity());
        }
        let pose = |position: &Position| match &position.value {
            Ok(TargetValue::Cartesian(numbers)) => numbers.pose().ok_or_else(|| "no pose".to_owned()),
            Ok(_) => Err("no pose".to_owned()),
            Err(reason) => Err(reason.clone()),
        };
        if let Some(written) = position(text, range) {
            return pose(&written);
        }
        match range.len() {
            1 => self.positions.value(&text.word(range.start), &text.show(range)).and_then(pose),
            _ => Err(format!("`{}` is computed", text.show(range))),
        }
    }
}

//! The files of a job into targets.

use std::ops::Range;
use std::sync::Arc;

use crate::base::text::Source;
use crate::geometry::pose::Pose;
use crate::program::dialect::script::{Position, Positions, Selected, Text, Tokens, under_condition};
use crate::program::target::{Definition, FrameData, PathKind, Program, Reference, TargetValue, ToolData, Use, Way};

use super::LEXIS;
use super::statement::{Names, goals, position, unmarked};

/// Words at which other ways may come in.
const JOINING: [&str; 20] = [
    "IF", "ELSE", "ELSEIF", "ENDIF", "END", "FOR", "NEXT", "DO", "LOOP", "WHILE", "WEND", "SELECT", "CASE", "GOSUB",
    "CALL", "GOTO", "ON", "RETURN", "SUB", "FUNCTION",
];
/// Words that set a part of the variable behind them.
const PART_SETTERS: [&str; 9] = ["LETX", "LETY", "LETZ", "LETRX", "LETRY", "LETRZ", "LETF", "LETJ", "LETR"];

/// Reads the files; each sees its own variables only.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        let tokens = Tokens::of(source, &LEXIS);
        let text = tokens.text(source);
        let names = Names::of(text, &tokens);
        let mut reader = Reader { file, text, names, positions: Positions::new(file), selected: Selected::default() };
        tokens.statements.iter().for_each(|statement| reader.assign(statement));
        for statement in &tokens.statements {
            reader.select(statement, &mut program);
        }
        tokens.statements.iter().for_each(|statement| reader.statement(statement));
        reader.positions.finish(&mut program);
    }
    program
}

/// A file while it is read.
struct Reader<'a> {
    file: usize,
    text: Text<'a>,
    names: Names,
    positions: Positions,
    selected: Selected,
}

impl Reader<'_> {
    /// Notes what a statement gives a variable.
    fn assign(&mut self, statement: &Range<usize>) {
        let text = self.text;
        match text.word(statement.start).as_str() {
            "DEFPOS" | "DEFJNT" => {
                let declared = text.split(&(statement.start + 1..statement.end));
                declared.iter().for_each(|part| self.assign_one(part));
            }
            _ => self.assign_one(statement),
        }
    }

    fn assign_one(&mut self, statement: &Range<usize>) {
        let text = self.text;
        let first = text.word(statement.start);
        let start = statement.start + usize::from(first == "LET" || PART_SETTERS.contains(&first.as_str()));
        let Some(equals) = (start..statement.end).find(|&at| text.is(at, b'=')) else { return };
        let Some((key, joints)) = self.names.variable(text, &(start..equals)) else { return };
        let (shown, line) = (text.show(&(start..equals)), text.line(start));
        if PART_SETTERS.contains(&first.as_str()) {
            return self.positions.change(&key, &shown, format!("a part of it is set in line {line}"));
        }
        let value = equals + 1..statement.end;
        let computed = || Position::plain(text.span(&value), Err(format!("`{}` is computed", text.show(&value))));
        let given = position(text, &value, joints).unwrap_or_else(computed);
        self.positions.define(&key, &shown, given, line);
    }

    /// Notes the tools and frames that a statement selects or defines, and where ways meet.
    fn select(&mut self, statement: &Range<usize>, program: &mut Program) {
        let text = self.text;
        let offset = text.span(statement).start;
        if text.is(statement.start, b'*') || JOINING.contains(&text.word(statement.start).as_str()) {
            self.selected.joins.push(offset);
        }
        for inner in commands(text, statement) {
            let rest = inner.start + 1..inner.end;
            let conditional = (inner.start > statement.start).then(|| under_condition(text.line(statement.start)));
            match text.word(inner.start).as_str() {
                "CHANGETOOL" => {
                    let tool = numbered(text, &rest, "tool");
                    self.selected.tools.push(offset, conditional.unwrap_or(tool));
                }
                "CHANGEWORK" => {
                    let frame = numbered(text, &rest, "work coordinate system");
                    self.selected.frames.push(offset, conditional.unwrap_or(frame));
                }
                word @ ("TOOL" | "WORK") => self.defined(word == "TOOL", &rest, program),
                _ => {}
            }
        }
        if matches!(text.word(statement.start).as_str(), "GOSUB" | "CALL") {
            self.selected.joins.push(text.span(statement).end);
        }
    }

    /// Makes targets of the moves of a statement. All selections are known: one further down may come round a loop.
    fn statement(&mut self, statement: &Range<usize>) {
        let text = self.text;
        for inner in commands(text, statement) {
            let rest = inner.start + 1..inner.end;
            match text.word(inner.start).as_str() {
                "MOVE" => {
                    for (goal, path) in goals(text, &inner) {
                        self.go(&goal, path, "MOVE", statement, None);
                    }
                }
                "SETSPLINEPOINT" => {
                    if let Some(goal) = text.split(&rest).get(1) {
                        self.go(goal, PathKind::Other, "SETSPLINEPOINT", statement, None);
                    }
                }
                "APPROACH" => {
                    if let Some(goal) = text.split(&rest).get(1) {
                        let reason = "an approach along the tool: it goes along with the position".to_owned();
                        self.go(&unmarked(text, goal), PathKind::Other, "APPROACH", statement, Some(reason));
                    }
                }
                word @ ("DEPART" | "DRAW" | "DRIVE" | "DRIVEA" | "ROTATE" | "ROTATEH") => {
                    let reason = "relative to the present position, or of single axes".to_owned();
                    let one = self.one(word, PathKind::Other, statement, None);
                    self.positions.go_inline(Position::plain(text.span(statement), Err(reason)), one);
                }
                _ => {}
            }
        }
    }

    fn one(&self, word: &str, path: PathKind, statement: &Range<usize>, computed: Option<String>) -> Use {
        let span = self.text.span(statement);
        Use::new(
            self.file,
            span,
            Way {
                motion: Arc::from(word),
                path,
                tool: self.selected.tool(span.start),
                frame: self.selected.frame(span.start),
                grip_load: Reference::Unnamed,
                computed,
            },
        )
    }

    fn go(&mut self, goal: &Range<usize>, path: PathKind, word: &str, statement: &Range<usize>, why: Option<String>) {
        let text = self.text;
        let extended = goal.clone().find(|&at| matches!(text.word(at).as_str(), "EX" | "EXA"));
        let along = extended.map(|_| "additional axes move along (EX)".to_owned());
        let one = self.one(word, path, statement, why.or(along));
        let goal = goal.start..extended.unwrap_or(goal.end);
        if let Some(inline) = position(text, &goal, false) {
            return self.positions.go_inline(inline, one);
        }
        match self.names.variable(text, &goal) {
            Some((key, _)) => self.positions.go(&key, &text.show(&goal), text.span(&goal), one),
            None => {
                let reason = format!("`{}` is computed", text.show(&goal));
                self.positions.go_inline(Position::plain(text.span(&goal), Err(reason)), one);
            }
        }
    }

    /// `TOOL 1, pose`, `WORK 1, pose`.
    fn defined(&self, is_tool: bool, rest: &Range<usize>, program: &mut Program) {
        let text = self.text;
        let parts = text.split(rest);
        let [number, pose] = &parts[..] else { return };
        let Some(number) = text.number(number) else { return };
        let (file, span) = (self.file, text.span(rest));
        let key = Program::key(&number.value.to_string());
        let known = if is_tool { program.tools.contains_key(&key) } else { program.frames.contains_key(&key) };
        let pose = if known { Err("it is defined more than once".to_owned()) } else { self.constant(pose) };
        if is_tool {
            let value = pose.map(|pose| ToolData { pose, held_by_robot: true, load: None });
            program.tools.insert(key, Definition { file, span, value });
        } else {
            let value = pose.map(|pose| FrameData { pose, held_by_robot: false, on: None });
            program.frames.insert(key, Definition { file, span, value });
        }
    }

    fn constant(&self, range: &Range<usize>) -> Result<Pose, String> {
        let text = self.text;
        let pose = |position: &Position| match &position.value {
            Ok(TargetValue::Cartesian(numbers)) => numbers.pose().ok_or_else(|| "no pose".to_owned()),
            Ok(_) => Err("no pose".to_owned()),
            Err(reason) => Err(reason.clone()),
        };
        if let Some(written) = position(text, range, false) {
            return pose(&written);
        }
        let (key, _) = self.names.variable(text, range).ok_or_else(|| format!("`{}` is computed", text.show(range)))?;
        self.positions.value(&key, &text.show(range)).and_then(pose)
    }
}

/// The commands of a statement, those of one-line branches too.
fn commands(text: Text<'_>, statement: &Range<usize>) -> Vec<Range<usize>> {
    let begins = |at: &usize| *at == statement.start || matches!(text.word(*at - 1).as_str(), "THEN" | "ELSE");
    let divides = |at: &usize| matches!(text.word(*at).as_str(), "THEN" | "ELSE" | "ENDIF");
    let command = |at: usize| at..(at + 1..statement.end).find(divides).unwrap_or(statement.end);
    statement.clone().filter(begins).map(command).collect()
}

fn numbered(text: Text<'_>, operand: &Range<usize>, what: &str) -> Reference {
    match text.number(operand) {
        Some(number) => Reference::Named(number.value.to_string().into()),
        None => Reference::Runtime(format!("the number of the {what} is `{}`", text.show(operand))),
    }
}

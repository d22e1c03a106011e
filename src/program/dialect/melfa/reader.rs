//! The files of a job into targets.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;

use crate::base::text::Source;
use crate::geometry::pose::Pose;
use crate::program::dialect::script::{Kind, Position, Positions, Selected, Text, Tokens, under_condition};
use crate::program::target::{Definition, FrameData, PathKind, Program, Reference, TargetValue, ToolData, Use, Way};

use super::LEXIS;
use super::statement::{assigned, body, paths, position};

/// Words at which other ways may come in.
const JOINING: [&str; 14] = [
    "GOTO", "GOSUB", "RETURN", "IF", "ELSE", "ENDIF", "FOR", "NEXT", "WHILE", "WEND", "SELECT", "CASE", "CALLP",
    "BREAK",
];

/// Reads the files; each sees its own variables only.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        let tokens = Tokens::of(source, &LEXIS);
        let text = tokens.text(source);
        let statements: Vec<Range<usize>> = tokens.statements.iter().map(|one| body(text, one)).collect();
        let mut reader =
            Reader { file, text, positions: Positions::new(file), selected: Selected::default(), guided: None };
        let jumped_to = jumped_to(text, &statements);
        let list = list_of_positions(text, &statements);
        statements[..list].iter().for_each(|statement| reader.assign(statement));
        reader.settle(&statements[..list], &statements[list..]);
        for (whole, statement) in tokens.statements.iter().zip(&statements) {
            let numbered = whole.start < statement.start;
            if numbered && jumped_to.contains(&text.show(&(whole.start..whole.start + 1))) {
                reader.selected.joins.push(text.span(statement).start);
            }
            reader.select(statement, &mut program);
        }
        statements.iter().for_each(|statement| reader.statement(statement));
        reader.positions.finish(&mut program);
    }
    program
}

/// Where the list of saved positions behind the program begins: the last statements, all of them positions.
fn list_of_positions(text: Text<'_>, statements: &[Range<usize>]) -> usize {
    let saved = |statement: &Range<usize>| {
        assigned(text, statement).is_some_and(|(_, value)| position(text, &value, false).is_some())
    };
    statements.iter().rposition(|statement| !saved(statement)).map_or(0, |last| last + 1)
}

/// The line numbers that jumps name: `GOTO 100`, `IF .. THEN 100`, `ON M1 GOSUB 100,200`.
fn jumped_to(text: Text<'_>, statements: &[Range<usize>]) -> HashSet<String> {
    let mut found = HashSet::new();
    for statement in statements {
        let jumps = |at: &usize| matches!(text.word(*at).as_str(), "GOTO" | "GOSUB" | "THEN" | "ELSE");
        for at in statement.clone().filter(jumps) {
            let addresses =
                (at + 1..statement.end).take_while(|&at| text.kind(at) == Some(Kind::Number) || text.is(at, b','));
            found.extend(addresses.map(|at| text.show(&(at..at + 1))));
        }
    }
    found
}

/// A file while it is read.
struct Reader<'a> {
    file: usize,
    text: Text<'a>,
    positions: Positions,
    selected: Selected,
    /// Why moves do not go where their positions say.
    guided: Option<String>,
}

impl Reader<'_> {
    /// Notes what a statement gives a variable, also behind `Then`.
    fn assign(&mut self, statement: &Range<usize>) {
        let text = self.text;
        let first = text.word(statement.start);
        if first == "DEF" {
            return;
        }
        let behind_then = statement.clone().filter(|&at| matches!(text.word(at).as_str(), "THEN" | "ELSE"));
        let starts: Vec<usize> = std::iter::once(statement.start).chain(behind_then.map(|at| at + 1)).collect();
        for (index, &start) in starts.iter().enumerate() {
            let end = starts.get(index + 1).map_or(statement.end, |next| next - 1);
            let Some((name, value)) = assigned(text, &(start..end)) else { continue };
            let (key, shown, line) = (text.word(name), text.show(&(name..name + 1)), text.line(name));
            // `P1.Z = 90`
            if let Some((variable, _)) = key.split_once('.') {
                let reason = format!("a part of it is set in line {line}");
                self.positions.change(variable, shown.split('.').next().unwrap_or(&shown), reason);
                continue;
            }
            let joints = key.starts_with('J');
            let computed = || Position::plain(text.span(&value), Err(format!("`{}` is computed", text.show(&value))));
            let given = position(text, &value, joints).unwrap_or_else(computed);
            self.positions.define(&key, &shown, given, line);
        }
    }

    /// Brings the saved positions together with what the program sets. A variable that the program sets once, before any
    /// branch and before any move to it, has that value; one that it sets otherwise has the saved value for a while.
    fn settle(&mut self, program: &[Range<usize>], list: &[Range<usize>]) {
        let text = self.text;
        // A routine that is called comes back; a label is passed.
        let leaves = |one: &Range<usize>| {
            joins(text, one) && !text.is(one.start, b'*') && !matches!(text.word(one.start).as_str(), "CALLP" | "GOSUB")
        };
        let straight = program.iter().position(leaves).unwrap_or(program.len());
        let mut first_named: HashMap<String, usize> = HashMap::new();
        for (index, statement) in program.iter().enumerate() {
            for at in statement.clone().filter(|&at| text.kind(at) == Some(Kind::Name)) {
                first_named.entry(text.word(at)).or_insert(index);
            }
        }
        for statement in list {
            let Some((name, _)) = assigned(text, statement) else { continue };
            let (key, shown) = (text.word(name), text.show(&(name..name + 1)));
            if !self.positions.knows(&key) {
                self.assign(statement);
                continue;
            }
            let set_first = first_named
                .get(&key)
                .is_some_and(|&index| index < straight && assigned(text, &program[index]).is_some());
            if !set_first {
                self.positions.change(&key, &shown, "the program sets it, and a saved value holds before".to_owned());
            }
        }
    }

    /// Notes the tools and frames that a statement selects, and where ways meet.
    fn select(&mut self, statement: &Range<usize>, program: &mut Program) {
        let text = self.text;
        let offset = text.span(statement).start;
        let line = text.line(statement.start);
        if joins(text, statement) {
            self.selected.joins.push(offset);
        }
        for (at, rest) in commands(text, statement) {
            let conditional = (at > statement.start).then(|| under_condition(line));
            match text.word(at).as_str() {
                "TOOL" => {
                    let tool = self.tool(&rest, line, program);
                    self.selected.tools.push(offset, conditional.unwrap_or(tool));
                }
                "M_TOOL" if text.is(at + 1, b'=') => {
                    let tool = numbered(text, &(at + 2..rest.end), "tool");
                    self.selected.tools.push(offset, conditional.unwrap_or(tool));
                }
                "BASE" => {
                    let frame = self.base(&rest, line, program);
                    self.selected.frames.push(offset, conditional.unwrap_or(frame));
                }
                _ => {}
            }
        }
        if text.word(statement.start) == "CALLP" || text.word(statement.start) == "GOSUB" {
            self.selected.joins.push(text.span(statement).end);
        }
    }

    /// Makes targets of the moves of a statement. All selections are known: one further down may come round a loop.
    fn statement(&mut self, statement: &Range<usize>) {
        let text = self.text;
        for (at, rest) in commands(text, statement) {
            let word = text.word(at);
            if matches!(word.as_str(), "CMP" | "FSC" | "TRK") {
                let off = text.word(at + 1) == "OFF";
                let line = text.line(statement.start);
                self.guided = (!off).then(|| format!("guided by `{word}` since line {line}"));
            } else if let Some(paths) = paths(&word) {
                self.moved(&word, paths, &rest, statement);
            }
        }
    }

    fn moved(&mut self, word: &str, paths: &[PathKind], rest: &Range<usize>, statement: &Range<usize>) {
        let text = self.text;
        // What is done beside the move, and how joints turn.
        let end = rest.clone().find(|&at| matches!(text.word(at).as_str(), "WTH" | "WTHIF" | "TYPE"));
        let operands = text.split(&(rest.start..end.unwrap_or(rest.end)));
        let offset = text.span(statement).start;
        let approach = (paths.len() == 1)
            .then(|| operands.get(1).filter(|operand| !operand.is_empty()))
            .flatten()
            .filter(|_| word != "MVA")
            .map(|operand| {
                format!("{} mm along the tool from the position: it goes along with it", text.show(operand))
            });
        let centre = (word == "MVR3").then(|| "an arc about a centre".to_owned());
        for (operand, &path) in operands.iter().zip(paths) {
            let one = Use::new(
                self.file,
                text.span(statement),
                Way {
                    motion: Arc::from(word),
                    path,
                    tool: self.selected.tool(offset),
                    frame: self.selected.frame(offset),
                    grip_load: Reference::Unnamed,
                    computed: self.guided.clone().or_else(|| centre.clone()).or_else(|| approach.clone()),
                },
            );
            self.go(operand, statement, one);
        }
    }

    fn go(&mut self, operand: &Range<usize>, statement: &Range<usize>, one: Use) {
        let text = self.text;
        if operand.is_empty() {
            let here = Position::plain(text.span(statement), Err("relative to the present position".into()));
            return self.positions.go_inline(here, one);
        }
        if operand.len() == 1 && text.kind(operand.start) == Some(Kind::Name) {
            let (key, shown) = (text.word(operand.start), text.show(operand));
            return self.positions.go(&key, &shown, text.span(operand), one);
        }
        let computed = || Position::plain(text.span(operand), Err(format!("`{}` is computed", text.show(operand))));
        let inline = position(text, operand, false).unwrap_or_else(computed);
        self.positions.go_inline(inline, one);
    }

    fn tool(&mut self, operand: &Range<usize>, line: usize, program: &mut Program) -> Reference {
        let name = format!("Tool {} in line {line}", self.text.show(operand));
        match self.constant(operand) {
            Ok(pose) => {
                let value = Ok(ToolData { pose, held_by_robot: true, load: None });
                let definition = Definition { file: self.file, span: self.text.span(operand), value };
                program.tools.insert(Program::key(&name), definition);
                Reference::Named(name.into())
            }
            Err(reason) => Reference::Runtime(format!("the tool is set in line {line}: {reason}")),
        }
    }

    fn base(&mut self, operand: &Range<usize>, line: usize, program: &mut Program) -> Reference {
        if self.text.number(operand).is_some() {
            return numbered(self.text, operand, "work coordinate system");
        }
        let name = format!("Base {} in line {line}", self.text.show(operand));
        match self.constant(operand) {
            Ok(world_t_base) => {
                let value = Ok(FrameData { pose: world_t_base.inverse(), held_by_robot: false, on: None });
                let definition = Definition { file: self.file, span: self.text.span(operand), value };
                program.frames.insert(Program::key(&name), definition);
                Reference::Named(name.into())
            }
            Err(reason) => Reference::Runtime(format!("the base is set in line {line}: {reason}")),
        }
    }

    /// The pose of a literal, of a variable with one value, or of the initial tool and base.
    fn constant(&self, operand: &Range<usize>) -> Result<Pose, String> {
        let text = self.text;
        let word = text.word(operand.start);
        if operand.len() == 1 && matches!(word.as_str(), "P_NTOOL" | "P_NBASE" | "P_ZERO") {
            return Ok(Pose::identity());
        }
        let pose = |position: &Position| match &position.value {
            Ok(TargetValue::Cartesian(numbers)) => numbers.pose().ok_or_else(|| "no pose".to_owned()),
            Ok(_) => Err("no pose".to_owned()),
            Err(reason) => Err(reason.clone()),
        };
        if operand.len() == 1 && !word.is_empty() {
            return self.positions.value(&word, &text.show(operand)).and_then(pose);
        }
        position(text, operand, false)
            .map_or_else(|| Err(format!("`{}` is computed", text.show(operand))), |position| pose(&position))
    }
}

/// The commands of a statement, those behind `Then` and `Else` too: the first token of each, and what follows it.
fn commands(text: Text<'_>, statement: &Range<usize>) -> Vec<(usize, Range<usize>)> {
    let divides = |at: usize| matches!(text.word(at).as_str(), "THEN" | "ELSE");
    let begins = |at: &usize| *at == statement.start || divides(*at - 1);
    let command = |at: usize| (at, at + 1..(at + 1..statement.end).find(|&at| divides(at)).unwrap_or(statement.end));
    statement.clone().filter(begins).map(command).collect()
}

/// True for a label, a branch, a loop, a call.
fn joins(text: Text<'_>, statement: &Range<usize>) -> bool {
    text.is(statement.start, b'*') || JOINING.contains(&text.word(statement.start).as_str())
}

fn numbered(text: Text<'_>, operand: &Range<usize>, what: &str) -> Reference {
    match text.number(operand) {
        Some(number) => Reference::Named(number.value.to_string().into()),
        None => Reference::Runtime(format!("the number of the {what} is `{}`", text.show(operand))),
    }
}

//! The files of a job into targets.

use std::ops::Range;
use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Source;
use crate::geometry::orientation::OrientationConvention;
use crate::program::dialect::script::{
    Kind, Position, Positions, Selected, Text, Tokens, joints_of, pose_of, under_condition,
};
use crate::program::target::{PathKind, Program, Reference, TargetValue, Use, Way};

use super::LEXIS;
use super::motion::{Bare, Motion, is_motion, motion, reference};
use super::names::{Names, indent};

/// Names of names are followed this deep.
const MAX_DEPTH: usize = 8;

/// True for a move beside a `posx(..)` or `posj(..)`.
pub(super) fn recognises(source: &Source) -> bool {
    let tokens = Tokens::of(source, &LEXIS);
    let text = tokens.text(source);
    let (mut moves, mut positions) = (false, false);
    for statement in &tokens.statements {
        for at in statement.clone().filter(|&at| text.kind(at) == Some(Kind::Name) && text.is(at + 1, b'(')) {
            let word = text.word(at);
            moves |= is_motion(&word);
            positions |= word == "POSX" || word == "POSJ";
        }
    }
    moves && positions
}

/// Reads the files; each sees its own names only.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        let tokens = Tokens::of(source, &LEXIS);
        let text = tokens.text(source);
        if tokens.unclosed {
            let span = tokens.statements.last().map(|last| text.span(last)).unwrap_or_default();
            let message = "a bracket is not closed: nothing behind it can be read";
            program.diagnostics.push(Diagnostic::error("truncated", message).at(file, span, ""));
        }
        let names = Names::of(text, &tokens);
        let selected = selected(text, &tokens);
        let mut reader = Reader { file, text, names, positions: Positions::new(file), selected };
        for (index, statement) in tokens.statements.iter().enumerate() {
            reader.statement(index, statement);
        }
        reader.positions.finish(&mut program);
    }
    program
}

/// Follows the selections of a file.
fn selected(text: Text<'_>, tokens: &Tokens) -> Selected {
    let mut selected = Selected::default();
    let defines = |statement: &Range<usize>| text.word(statement.start) == "DEF";
    let functions: Vec<String> =
        tokens.statements.iter().filter(|one| defines(one)).map(|one| text.word(one.start + 1)).collect();
    let mut depth = 0;
    for statement in &tokens.statements {
        let offset = text.span(statement).start;
        let indent = indent(text, statement);
        // Where indentation changes, other ways may come in.
        if indent != depth {
            selected.joins.push(offset);
            depth = indent;
        }
        // `if ready: set_tcp("gun")`
        let opens = matches!(text.word(statement.start).as_str(), "IF" | "ELIF" | "ELSE" | "FOR" | "WHILE" | "EXCEPT");
        let conditional = opens.then(|| under_condition(text.line(statement.start)));
        for at in text.calls(statement) {
            let word = text.word(at);
            let first = || text.parts(at + 1, statement.end).and_then(|(parts, _)| parts.first().cloned());
            match word.as_str() {
                "SET_TCP" => {
                    let tool = first().map_or(Reference::Unnamed, |range| tool(text, &range));
                    selected.tools.push(offset, conditional.clone().unwrap_or(tool));
                }
                "SET_REF_COORD" => {
                    let frame = first().map(|range| value_of(text, &range)).map(|range| reference(text, &range));
                    selected.frames.push(offset, conditional.clone().unwrap_or(frame.unwrap_or_default()));
                }
                _ if functions.contains(&word) && !defines(statement) => {
                    selected.joins.push(text.span(statement).end);
                }
                _ => {}
            }
        }
    }
    selected
}

/// The value of `name=value`.
fn value_of(text: Text<'_>, range: &Range<usize>) -> Range<usize> {
    if text.is(range.start + 1, b'=') { range.start + 2..range.end } else { range.clone() }
}

fn tool(text: Text<'_>, range: &Range<usize>) -> Reference {
    let range = value_of(text, range);
    let is_text = range.len() == 1 && text.kind(range.start) == Some(Kind::Text);
    let shown = text.source.text(text.span(&range)).into_owned();
    let name = shown.trim_matches(|quote| quote == '"' || quote == '\'');
    match (is_text, name.is_empty()) {
        (true, false) => Reference::Named(name.into()),
        (true, true) => Reference::Named("flange".into()),
        (false, _) => Reference::Runtime(format!("the TCP is `{shown}`")),
    }
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
    fn statement(&mut self, index: usize, statement: &Range<usize>) {
        if self.text.word(statement.start) == "DEF" {
            return;
        }
        for at in self.text.calls(statement) {
            let method = at > statement.start && self.text.is(at - 1, b'.');
            if !method && let Some(motion) = motion(self.text, at, statement.end) {
                self.moved(index, statement, &motion);
            }
        }
    }

    fn moved(&mut self, index: usize, statement: &Range<usize>, motion: &Motion) {
        for (range, path) in &motion.goals {
            if motion.lists {
                for element in self.elements(range, index) {
                    self.go(&element, *path, index, statement, motion);
                }
            } else {
                self.go(range, *path, index, statement, motion);
            }
        }
    }

    /// The elements of a list that is written in the move, or held by a name.
    fn elements(&self, range: &Range<usize>, index: usize) -> Vec<Range<usize>> {
        let mut range = range.clone();
        if range.len() == 1
            && let Ok(value) = self.names.meaning(self.text, range.start, index).value
        {
            range = value;
        }
        let list = self.text.is(range.start, b'[').then(|| self.text.parts(range.start, range.end)).flatten();
        list.map_or(vec![range], |(parts, _)| parts.into_iter().filter(|part| !part.is_empty()).collect())
    }

    fn go(&mut self, goal: &Range<usize>, path: PathKind, index: usize, statement: &Range<usize>, motion: &Motion) {
        let offset = self.text.span(statement).start;
        let frame = motion.frame.clone();
        let one = Use::new(
            self.file,
            self.text.span(statement),
            Way {
                motion: Arc::from(motion.word.as_str()),
                path,
                tool: self.selected.tool(offset),
                frame: frame.unwrap_or_else(|| self.selected.frame(offset)),
                grip_load: Reference::Unnamed,
                computed: motion.computed.clone(),
            },
        );
        let mention = self.text.span(goal);
        let mut named: Option<(String, String)> = None;
        let mut value = goal.clone();
        for _ in 0..MAX_DEPTH {
            if value.len() != 1 || self.text.kind(value.start) != Some(Kind::Name) {
                break;
            }
            let meaning = self.names.meaning(self.text, value.start, index);
            let shown = self.text.show(&value);
            match meaning.value {
                Ok(range) => {
                    named = Some((meaning.key, shown));
                    value = range;
                }
                Err(reason) => {
                    self.positions.change(&meaning.key, &shown, reason);
                    self.positions.go(&meaning.key, &shown, mention, one);
                    return;
                }
            }
        }
        let mut position = Position::plain(mention, self.value(&value, motion.bare));
        position.configuration = motion.configuration.clone();
        match named {
            Some((key, shown)) => {
                if self.positions.knows(&key) {
                    self.positions.ask(&key, &motion.configuration);
                } else {
                    position.span = self.text.span(&value);
                    self.positions.define(&key, &shown, position, self.text.line(value.start));
                }
                self.positions.go(&key, &shown, mention, one);
            }
            None => self.positions.go_inline(position, one),
        }
    }

    /// `posx(..)`, `posj(..)`, `[..]`.
    fn value(&self, range: &Range<usize>, bare: Bare) -> Result<TargetValue, String> {
        let text = self.text;
        let computed = || Err(format!("`{}` is computed", text.show(range)));
        let (kind, open) = match text.word(range.start).as_str() {
            "POSX" => (Bare::Pose, range.start + 1),
            "POSJ" => (Bare::Joints, range.start + 1),
            _ => (bare, range.start),
        };
        if !(text.is(open, b'(') && open > range.start || text.is(open, b'[')) {
            return computed();
        }
        let Some((mut parts, close)) = text.parts(open, range.end) else { return computed() };
        if close + 1 != range.end {
            return computed();
        }
        // `posx([1, 2, 3, 4, 5, 6])`
        if let [only] = &parts[..]
            && text.is(only.start, b'[')
            && let Some((inner, _)) = text.parts(only.start, only.end)
        {
            parts = inner;
        }
        parts.retain(|part| !part.is_empty());
        let numbers = match text.numbers(&parts) {
            Ok(numbers) => numbers,
            Err(part) => {
                return Err(format!("a part of the position is computed (`{}`)", text.show(&part)));
            }
        };
        let count = numbers.len();
        let value = match kind {
            Bare::Pose => pose_of(&numbers, OrientationConvention::EulerZyz).map(TargetValue::Cartesian),
            Bare::Joints => joints_of(&numbers).map(TargetValue::Joint),
        };
        value.ok_or_else(|| format!("a position of {count} numbers"))
    }
}

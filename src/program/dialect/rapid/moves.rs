//! The moves of a job: which positions they go to, with which tool, in which frame, with which load.

use std::ops::Range;
use std::sync::Arc;

use crate::program::shared::Shared;
use crate::program::target::{Configuration, PathKind, Reference, Target, TargetValue, Use, Way};

use super::argument::{Argument, arguments, named, positional};
use super::definition::DefinitionKeys;
use super::flow::{Flow, Setting, State};
use super::motion::{MotionName, motion_name, path_of_unknown, stands_still};
use super::position::Positions;
use super::statement::{FileText, Statement, StatementKind};
use super::symbol::{Job, Scope};
use super::token::TokenKind;

/// Reads all moves of a job into `positions`.
pub fn read_moves<'a>(job: &Job<'a>, keys: &DefinitionKeys, flow: &Flow, positions: &mut Positions<'_, 'a>) {
    let mut reader =
        Reader { job, keys, flow, positions, supervised: Vec::new(), passed: Vec::new(), ways: Shared::default() };
    for (file, text) in job.files.iter().enumerate() {
        for (index, statement) in text.statements.iter().enumerate() {
            if statement.kind == StatementKind::Call {
                reader.statement(text, statement, index, job.scopes[file][index]);
            }
        }
    }
    reader.passed_on();
    reader.drop_unsupervised_configurations();
}

struct Reader<'r, 'j, 'a> {
    job: &'r Job<'a>,
    keys: &'r DefinitionKeys,
    flow: &'r Flow,
    positions: &'r mut Positions<'j, 'a>,
    /// By target: some move that goes there has its configuration supervised.
    supervised: Vec<bool>,
    /// Positions that calls hand to procedures of the job.
    passed: Vec<Passed>,
    ways: Shared<Way>,
}

/// A position that a call hands to a parameter.
struct Passed {
    file: usize,
    statement: usize,
    scope: Scope,
    parameter: usize,
    value: Range<usize>,
}

/// A move before its targets are looked up.
struct Move {
    points: Vec<(Range<usize>, PathKind)>,
    tool: Option<Range<usize>>,
}

impl<'a> Reader<'_, '_, 'a> {
    fn statement(&mut self, text: &FileText<'a>, statement: &Statement, index: usize, scope: Scope) {
        let start = statement.tokens.start;
        if text.kind(start) != Some(TokenKind::Name) || statement.tokens.len() < 2 {
            return;
        }
        let name = text.key(start);
        let all = arguments(text, start + 1..statement.tokens.end);
        if let Some(routine) = self.job.routine(&name, scope) {
            self.note_passed(text, &all, routine, index, scope);
            return;
        }
        if stands_still(&name) {
            return;
        }
        let found = match motion_name(&name) {
            Some(motion) => self.known_move(text, &all, motion, scope),
            None => self.move_by_shape(text, &all, &name, scope),
        };
        let Some(found) = found else { return };
        let state = self.flow.at(scope.file, index);
        let grip = if named(&all, "tload").is_some() {
            Reference::Runtime(format!("`\\TLoad` in line {} gives tool and load together", text.line(start)))
        } else {
            state.get(Setting::Grip)
        };
        let span = text.span(&statement.tokens);
        let template = Way {
            motion: Arc::from(text.display(start).as_ref()),
            path: PathKind::Other,
            tool: self.tool(text, found.tool.as_ref(), scope, start),
            frame: match named(&all, "wobj") {
                Some(range) => self.keys.reference(self.job, text, range, scope),
                None => Reference::Named("wobj0".into()),
            },
            grip_load: grip,
            computed: displaced_by(&state),
        };
        for (range, path) in &found.points {
            let supervised = is_supervised(&state, *path);
            for target in self.positions.targets_of(text, range, scope) {
                self.supervised.resize(self.positions.targets.len(), false);
                self.supervised[target] |= supervised;
                let way = self.ways.share(Way { path: *path, ..template.clone() });
                self.positions.targets[target].add_use(Use::new(scope.file, span, way));
            }
        }
    }

    fn tool(&self, text: &FileText, range: Option<&Range<usize>>, scope: Scope, start: usize) -> Reference {
        match range {
            Some(range) => self.keys.reference(self.job, text, range, scope),
            None => Reference::Runtime(format!("the move in line {} names no tool", text.line(start))),
        }
    }

    fn known_move(&self, text: &FileText, all: &[Argument], motion: MotionName, scope: Scope) -> Option<Move> {
        let values = positional(all);
        let mut first = 0;
        if motion.search {
            // Signal, variable for what is found, then the points.
            first = 2;
        }
        let count = if motion.circular { 2 } else { 1 };
        let wanted: Vec<Range<usize>> = values.iter().skip(first).take(count).map(|range| (*range).clone()).collect();
        if wanted.is_empty() {
            return None;
        }
        let last = wanted.len() - 1;
        let path = |at: usize| if motion.circular && at < last { PathKind::ArcVia } else { motion.path };
        let points = wanted.into_iter().enumerate().map(|(at, range)| (range, path(at))).collect();
        Some(Move { points, tool: self.tool_argument(text, all, first + count, motion.after_tool, scope) })
    }

    /// An instruction that is none of ABB's: positions first, and a tool behind them.
    fn move_by_shape(&self, text: &FileText, all: &[Argument], name: &str, scope: Scope) -> Option<Move> {
        let values = positional(all);
        let first = values.iter().position(|range| self.positions.is_position(text, range, scope))?;
        let count = values[first..].iter().take_while(|range| self.positions.is_position(text, range, scope)).count();
        let tool = self.tool_argument(text, all, first + count, 0, scope)?;
        let looks_like_tool = tool.len() == 1 && text.kind(tool.start) == Some(TokenKind::Name);
        if first > 2 || values.len() < first + count + 2 || !looks_like_tool {
            return None;
        }
        let arc = count == 2 && path_of_unknown(name) == PathKind::ArcEnd;
        let path = |at: usize| match (arc, at) {
            (true, 0) => PathKind::ArcVia,
            (true, _) => PathKind::ArcEnd,
            _ => path_of_unknown(name),
        };
        let points = (0..count).map(|at| (values[first + at].clone(), path(at))).collect();
        Some(Move { points, tool: Some(tool) })
    }

    /// The tool: declared as one, else what stands before `\WObj`, else the last argument but `after`.
    fn tool_argument(
        &self,
        text: &FileText,
        all: &[Argument],
        points_end: usize,
        after: usize,
        scope: Scope,
    ) -> Option<Range<usize>> {
        let values = positional(all);
        let behind = values.get(points_end..).unwrap_or_default();
        let is_tool = |range: &&&Range<usize>| {
            let key = text.key(range.start);
            let declared = self.job.known_symbol(&key, scope).is_some_and(|symbol| symbol.data_type == "tooldata");
            declared || key == "tool0"
        };
        if let Some(range) = behind.iter().rev().find(is_tool) {
            return Some((*range).clone());
        }
        let frame = all.iter().position(|argument| argument.name.as_deref() == Some("wobj"));
        let before_frame = frame.and_then(|at| all[..at].iter().rposition(|argument| argument.name.is_none()));
        if let Some(at) = before_frame {
            let place = positional(&all[..=at]).len() - 1;
            return (place >= points_end).then(|| all[at].value.clone());
        }
        behind.len().checked_sub(after + 1).map(|at| behind[at].clone())
    }

    /// Remembers positions that a call hands to a procedure of the job.
    fn note_passed(&mut self, text: &FileText, all: &[Argument], routine: usize, statement: usize, scope: Scope) {
        let parameters = &self.job.routines[routine].parameters;
        let mut place = 0;
        for argument in all {
            let parameter = match &argument.name {
                None => {
                    place += 1;
                    parameters.get(place - 1).copied()
                }
                Some(name) => {
                    let called = |&&index: &&usize| self.job.symbols[index].display.eq_ignore_ascii_case(name);
                    parameters.iter().find(called).copied()
                }
            };
            let Some(parameter) = parameter else { continue };
            if !argument.value.is_empty() && self.positions.is_position(text, &argument.value, scope) {
                self.passed.push(Passed {
                    file: scope.file,
                    statement,
                    scope,
                    parameter,
                    value: argument.value.clone(),
                });
            }
        }
    }

    /// Positions that reach a move as a parameter: the call is listed as their use, which is known only at run time.
    fn passed_on(&mut self) {
        for passed in std::mem::take(&mut self.passed) {
            let Some(moved) = self.positions.of_symbol(passed.parameter) else { continue };
            let Some(inner) = moved.first().and_then(|&target| self.positions.targets[target].uses.first()).cloned()
            else {
                continue;
            };
            let text = &self.job.files[passed.file];
            let tokens = &text.statements[passed.statement].tokens;
            let (callee, line) = (text.display(tokens.start), self.job.files[inner.file].source.line(inner.span.start));
            let reason = format!("passed to `{callee}`, which moves there as its parameter in line {line}");
            let outer = Use::new(passed.file, text.span(tokens), inner.way).computed_by(reason);
            for target in self.positions.targets_of(text, &passed.value, passed.scope) {
                self.supervised.resize(self.positions.targets.len(), false);
                self.supervised[target] = true;
                self.positions.targets[target].add_use(outer.clone());
            }
        }
    }

    /// Where `ConfL\Off` or `ConfJ\Off` holds for all moves to a target, its configuration data asks for nothing.
    fn drop_unsupervised_configurations(&mut self) {
        self.supervised.resize(self.positions.targets.len(), false);
        let used = |target: &Target| !target.uses.is_empty();
        for (target, supervised) in self.positions.targets.iter_mut().zip(&self.supervised) {
            if used(target) && !supervised && !matches!(target.value, TargetValue::Unwritten) {
                target.configuration = Configuration::unsaid();
            }
        }
    }
}

fn displaced_by(state: &State) -> Option<String> {
    [Setting::Displacement, Setting::AxisOffset].into_iter().find_map(|setting| match state.get(setting) {
        Reference::Runtime(reason) if reason.starts_with("set differently") => {
            Some("a displacement may be in force: it is set on some ways to this move only".into())
        }
        Reference::Runtime(reason) => Some(reason),
        _ => None,
    })
}

fn is_supervised(state: &State, path: PathKind) -> bool {
    let setting = if path == PathKind::Joint { Setting::ConfigurationJoint } else { Setting::ConfigurationLinear };
    !matches!(state.get(setting), Reference::Named(_))
}

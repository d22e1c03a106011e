//! Settings that stay in force from statement to statement: the gripped load, program displacements, and whether
//! configurations are supervised.
//!
//! Settings are followed through branches, loops and calls as far as the order of the program is fixed. Where two ways
//! to a statement disagree, the setting is known only at run time.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use crate::program::target::Reference;

use super::argument::{arguments, named, positional};
use super::definition::DefinitionKeys;
use super::statement::{FileText, Statement, StatementKind};
use super::symbol::{Job, Scope};

/// What can be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// `GripLoad`
    Grip,
    /// `PDispOn`, `PDispSet`
    Displacement,
    /// `EOffsOn`, `EOffsSet`
    AxisOffset,
    /// `ConfL`: `Named("off")` when configurations of linear moves are not supervised.
    ConfigurationLinear,
    /// `ConfJ`
    ConfigurationJoint,
}

const SETTINGS: usize = 5;

/// The settings at a statement; `None` for one that a routine leaves as its caller had it.
#[derive(Clone, Debug, PartialEq)]
pub struct State([Option<Reference>; SETTINGS]);

impl State {
    fn unchanged() -> Self {
        Self([const { None }; SETTINGS])
    }

    fn at_start() -> Self {
        Self([const { Some(Reference::Unnamed) }; SETTINGS])
    }

    /// A setting; nothing set is [`Reference::Unnamed`].
    pub fn get(&self, setting: Setting) -> Reference {
        self.0[setting as usize].clone().unwrap_or_default()
    }

    fn joined(old: Option<Self>, new: Option<&Self>) -> Option<Self> {
        let (Some(mut old), Some(new)) = (old.clone(), new) else { return old.or_else(|| new.cloned()) };
        for (mine, theirs) in old.0.iter_mut().zip(&new.0) {
            // What is known only at run time stays so, with its first reason.
            if mine != theirs && !matches!(mine, Some(Reference::Runtime(_))) {
                *mine = Some(match theirs {
                    Some(Reference::Runtime(reason)) => Reference::Runtime(reason.clone()),
                    _ => Reference::Runtime("set differently on different ways to this statement".into()),
                });
            }
        }
        Some(old)
    }

    fn then(&self, effect: &Self) -> Self {
        let mut after = self.clone();
        for (mine, theirs) in after.0.iter_mut().zip(&effect.0) {
            if theirs.is_some() {
                mine.clone_from(theirs);
            }
        }
        after
    }
}

/// The settings of a job at each of its statements.
#[derive(Default)]
pub struct Flow {
    states: HashMap<(usize, usize), State>,
}

/// A routine, or the statements of a file outside of any.
struct Unit {
    file: usize,
    routine: Option<usize>,
    range: Range<usize>,
}

/// What a statement does.
#[derive(Clone, Debug)]
enum Step {
    Sets(State),
    Calls(usize),
}

/// Programs that call each other in circles settle in a few rounds; more rounds than this change nothing.
const MAX_ROUNDS: usize = 12;

impl Flow {
    /// Follows the program.
    pub fn of(job: &Job, keys: &DefinitionKeys) -> Self {
        let mut steps = HashMap::new();
        let mut any = false;
        for (file, text) in job.files.iter().enumerate() {
            for (index, statement) in text.statements.iter().enumerate() {
                let step = step(job, keys, text, statement, job.scopes[file][index]);
                any |= matches!(step, Some(Step::Sets(_)));
                steps.extend(step.map(|step| ((file, index), step)));
            }
        }
        if !any {
            return Self::default();
        }
        Follower::new(job, steps).run()
    }

    /// The settings when a statement is reached.
    pub fn at(&self, file: usize, statement: usize) -> State {
        self.states.get(&(file, statement)).cloned().unwrap_or_else(State::at_start)
    }
}

fn step(job: &Job, keys: &DefinitionKeys, text: &FileText, statement: &Statement, scope: Scope) -> Option<Step> {
    if statement.kind != StatementKind::Call {
        return None;
    }
    let start = statement.tokens.start;
    let name = text.key(start);
    if let Some(routine) = job.routine(&name, scope) {
        return Some(Step::Calls(routine));
    }
    let rest = arguments(text, start + 1..statement.tokens.end);
    let since = |what: &str| {
        Reference::Runtime(format!("{what} is in force since `{}` in line {}", text.display(start), text.line(start)))
    };
    let off = || if named(&rest, "off").is_some() { Reference::Named("off".into()) } else { Reference::Unnamed };
    let (setting, value) = match name.as_str() {
        "gripload" => {
            let load = positional(&rest).first().map(|range| keys.reference(job, text, range, scope));
            (Setting::Grip, load.unwrap_or_default())
        }
        "pdispon" | "pdispset" => (Setting::Displacement, since("a program displacement")),
        "pdispoff" => (Setting::Displacement, Reference::Unnamed),
        "eoffson" | "eoffsset" => (Setting::AxisOffset, since("an offset of additional axes")),
        "eoffsoff" => (Setting::AxisOffset, Reference::Unnamed),
        "confl" => (Setting::ConfigurationLinear, off()),
        "confj" => (Setting::ConfigurationJoint, off()),
        _ => return None,
    };
    let mut state = State::unchanged();
    state.0[setting as usize] = Some(value);
    Some(Step::Sets(state))
}

struct Follower<'j, 'a> {
    job: &'j Job<'a>,
    steps: HashMap<(usize, usize), Step>,
    units: Vec<Unit>,
    effects: Vec<Option<State>>,
    entries: Vec<Option<State>>,
}

impl<'j, 'a> Follower<'j, 'a> {
    fn new(job: &'j Job<'a>, steps: HashMap<(usize, usize), Step>) -> Self {
        let routines = job.routines.iter().enumerate();
        let mut units: Vec<_> = routines
            .map(|(index, routine)| Unit {
                file: routine.scope.file,
                routine: Some(index),
                range: routine.body.clone(),
            })
            .collect();
        let outside = job.files.iter().enumerate();
        units.extend(outside.map(|(file, text)| Unit { file, routine: None, range: 0..text.statements.len() }));
        let count = units.len();
        Self { job, steps, units, effects: vec![None; count], entries: vec![None; count] }
    }

    fn run(mut self) -> Flow {
        let (order, called) = self.call_order();
        for _ in 0..MAX_ROUNDS {
            let mut settled = true;
            for &unit in &order {
                let effect = self.walk(unit, &State::unchanged(), &mut |_, _, _| {});
                settled &= self.effects[unit] == effect;
                self.effects[unit] = effect;
            }
            if settled {
                break;
            }
        }
        for unit in 0..self.units.len() {
            if !called.contains(&unit) {
                self.entries[unit] = Some(State::at_start());
            }
        }
        let mut flow = Flow::default();
        for _ in 0..MAX_ROUNDS {
            let before = self.entries.clone();
            for &unit in order.iter().rev() {
                let entry = self.entries[unit].clone().unwrap_or_else(State::at_start);
                let mut handed: Vec<(usize, State)> = Vec::new();
                let file = self.units[unit].file;
                self.walk(unit, &entry, &mut |index, state, callee| {
                    flow.states.insert((file, index), state.clone());
                    handed.extend(callee.map(|callee| (callee, state.clone())));
                });
                for (callee, state) in handed {
                    self.entries[callee] = State::joined(self.entries[callee].take(), Some(&state));
                }
            }
            if before == self.entries {
                break;
            }
        }
        flow
    }

    /// The units with callees before callers, and all that are called.
    fn call_order(&self) -> (Vec<usize>, HashSet<usize>) {
        let callees: Vec<Vec<usize>> = self.units.iter().map(|unit| self.callees(unit)).collect();
        let called = callees.iter().flatten().copied().collect();
        let (mut order, mut visited) = (Vec::new(), vec![false; self.units.len()]);
        for root in 0..self.units.len() {
            let mut stack = vec![(root, 0)];
            while let Some((unit, next)) = stack.pop() {
                if next == 0 && std::mem::replace(&mut visited[unit], true) {
                    continue;
                }
                match callees[unit].get(next) {
                    Some(&callee) => {
                        stack.push((unit, next + 1));
                        if !visited[callee] {
                            stack.push((callee, 0));
                        }
                    }
                    None => order.push(unit),
                }
            }
        }
        (order, called)
    }

    fn callees(&self, unit: &Unit) -> Vec<usize> {
        let found = unit.range.clone().filter_map(|index| match self.steps.get(&(unit.file, index)) {
            Some(Step::Calls(routine)) if self.belongs(unit, index) => Some(*routine),
            _ => None,
        });
        found.collect::<HashSet<_>>().into_iter().collect()
    }

    fn belongs(&self, unit: &Unit, index: usize) -> bool {
        self.job.scopes[unit.file][index].routine == unit.routine
    }

    /// Goes through a unit; `visit` sees each statement's state and the routine that it calls. Gives the state at the
    /// end, none when the end is never reached.
    fn walk(&self, unit: usize, entry: &State, visit: &mut dyn FnMut(usize, &State, Option<usize>)) -> Option<State> {
        let mut carried = Carried::default();
        for _ in 0..MAX_ROUNDS {
            let before = carried.clone();
            let exit = self.pass(unit, entry, &mut carried, visit);
            if before == carried {
                return exit;
            }
        }
        self.pass(unit, entry, &mut carried, visit)
    }

    fn pass(
        &self,
        unit: usize,
        entry: &State,
        carried: &mut Carried,
        visit: &mut dyn FnMut(usize, &State, Option<usize>),
    ) -> Option<State> {
        let unit = &self.units[unit];
        let text = &self.job.files[unit.file];
        let mut path = Path { now: Some(entry.clone()), exit: None, seen: Some(entry.clone()), open: Vec::new() };
        let mut in_handler = false;
        for index in unit.range.clone() {
            if !self.belongs(unit, index) {
                continue;
            }
            let statement = &text.statements[index];
            let step = self.steps.get(&(unit.file, index));
            if let (Some(now), StatementKind::Call) = (&path.now, statement.kind) {
                let callee = match step {
                    Some(Step::Calls(routine)) => Some(*routine),
                    _ => None,
                };
                visit(index, now, callee);
            }
            if statement.kind == StatementKind::Handler {
                path.end();
                path.now.clone_from(&path.seen);
                in_handler = true;
                continue;
            }
            let before = statement.conditional.then(|| path.now.clone()).flatten();
            let returns = text.is_word(statement.tokens.start, &["RETURN"]);
            self.advance(&mut path, statement.kind, index, step, returns, carried);
            path.now = State::joined(before, path.now.as_ref());
        }
        if !in_handler {
            path.end();
        }
        path.exit
    }

    fn advance(
        &self,
        path: &mut Path,
        kind: StatementKind,
        index: usize,
        step: Option<&Step>,
        returns: bool,
        carried: &mut Carried,
    ) {
        match kind {
            StatementKind::If => path.open.push(Open { entry: path.now.clone(), joined: None, complete: false, index }),
            StatementKind::Test => {
                path.open.push(Open { entry: path.now.take(), joined: None, complete: false, index });
            }
            StatementKind::Branch | StatementKind::Else => path.next_branch(kind == StatementKind::Else),
            StatementKind::EndBranches => path.end_branches(),
            StatementKind::Loop => {
                path.now = State::joined(path.now.take(), carried.loops.get(&index));
                path.open.push(Open { entry: path.now.clone(), joined: None, complete: false, index });
            }
            StatementKind::EndLoop => {
                if let Some(open) = path.open.pop() {
                    path.now = State::joined(open.entry, path.now.as_ref());
                    if let Some(now) = &path.now {
                        carried.loops.insert(open.index, now.clone());
                    }
                }
            }
            StatementKind::Goto => carried.jumps = State::joined(carried.jumps.take(), path.now.take().as_ref()),
            StatementKind::Label => path.now = State::joined(path.now.take(), carried.jumps.as_ref()),
            StatementKind::Leave if returns => path.end(),
            StatementKind::Leave => path.now = None,
            _ => {
                let effect = match step {
                    Some(Step::Sets(state)) => Some(state),
                    Some(Step::Calls(routine)) => self.effects[*routine].as_ref(),
                    None => None,
                };
                if let (Some(effect), Some(now)) = (effect, &path.now) {
                    path.now = Some(now.then(effect));
                    path.seen = State::joined(path.seen.take(), path.now.as_ref());
                }
            }
        }
    }
}

/// What flows backwards: from the ends of loops to their heads, from jumps to labels.
#[derive(Clone, Debug, Default, PartialEq)]
struct Carried {
    loops: HashMap<usize, State>,
    jumps: Option<State>,
}

/// A block that is not closed yet.
struct Open {
    entry: Option<State>,
    joined: Option<State>,
    complete: bool,
    index: usize,
}

/// The way through a routine so far. No state: no way leads here.
struct Path {
    now: Option<State>,
    exit: Option<State>,
    seen: Option<State>,
    open: Vec<Open>,
}

impl Path {
    fn end(&mut self) {
        self.exit = State::joined(self.exit.take(), self.now.take().as_ref());
    }

    fn next_branch(&mut self, last: bool) {
        if let Some(open) = self.open.last_mut() {
            open.joined = State::joined(open.joined.take(), self.now.as_ref());
            open.complete |= last;
            self.now.clone_from(&open.entry);
        }
    }

    fn end_branches(&mut self) {
        if let Some(open) = self.open.pop() {
            self.now = State::joined(open.joined, self.now.as_ref());
            if !open.complete {
                self.now = State::joined(self.now.take(), open.entry.as_ref());
            }
        }
    }
}

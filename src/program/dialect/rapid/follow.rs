//! The walk along every way that a program may take, for the settings in force at each statement.
//!
//! First the effect of each routine on its caller's settings, then the settings with which each routine is entered.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use super::flow::{State, Step};
use super::statement::StatementKind;
use super::symbol::Job;

/// The settings at statements, by file and statement.
pub type States = HashMap<(usize, usize), State>;

/// The settings at each call of a job, from what each of its statements does.
pub fn follow(job: &Job, steps: HashMap<(usize, usize), Step>) -> States {
    Follower::new(job, steps).run()
}

/// A routine, or the statements of a file outside of any.
struct Unit {
    file: usize,
    routine: Option<usize>,
    range: Range<usize>,
}

/// Programs that call each other in circles settle in a few rounds; more rounds than this change nothing.
const MAX_ROUNDS: usize = 12;

/// The walk through all units.
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

    fn run(mut self) -> States {
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
        let mut states = States::new();
        for _ in 0..MAX_ROUNDS {
            let before = self.entries.clone();
            for &unit in order.iter().rev() {
                let entry = self.entries[unit].clone().unwrap_or_else(State::at_start);
                let mut handed: Vec<(usize, State)> = Vec::new();
                let file = self.units[unit].file;
                self.walk(unit, &entry, &mut |index, state, callee| {
                    states.insert((file, index), state.clone());
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
        states
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

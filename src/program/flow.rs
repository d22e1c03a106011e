//! Settings that stay in force from statement to statement, followed along every way that a program may take: through
//! branches, loops, jumps and calls, as far as the order of the program is fixed.
//!
//! Where two ways to a statement disagree, the setting is known only at run time. First the effect of each routine on
//! its caller's settings is found, then the settings with which each routine is entered.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::target::Reference;

/// `N` settings; `None` for one that a routine leaves as its caller had it.
#[derive(Clone, Debug, PartialEq)]
pub struct State<const N: usize>([Option<Reference>; N]);

/// What a statement does to the settings or to the order of the program.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Step<const N: usize> {
    /// Nothing.
    #[default]
    Plain,
    /// Sets some of the settings.
    Sets(Vec<(usize, Reference)>),
    /// Calls a routine of the job: its index.
    Calls(usize),
    /// Begins a branch that may be passed over: `IF`.
    If,
    /// Begins branches of which none is the first: `SWITCH`.
    Switch,
    /// Begins another branch.
    Branch,
    /// Begins the branch that is taken when no other is.
    Else,
    /// Ends all branches.
    EndBranches,
    /// Begins a loop.
    Loop,
    /// Ends a loop.
    EndLoop,
    /// Leaves the innermost loop.
    LeaveLoop,
    /// Goes to some label of the routine.
    Jump,
    /// A label.
    Label,
    /// Leaves the routine.
    Return,
}

/// The state before each step of each routine.
pub type States<const N: usize> = Vec<Vec<Arc<State<N>>>>;

/// Routines that call each other in circles settle in a few rounds; more rounds than this change nothing.
const MAX_ROUNDS: usize = 12;

type Shared<const N: usize> = Option<Arc<State<N>>>;

impl<const N: usize> State<N> {
    fn unchanged() -> Self {
        Self([const { None }; N])
    }

    fn at_start() -> Self {
        Self([const { Some(Reference::Unnamed) }; N])
    }

    /// A setting; nothing set is [`Reference::Unnamed`].
    pub fn get(&self, setting: usize) -> &Reference {
        const NOTHING: &Reference = &Reference::Unnamed;
        self.0[setting].as_ref().unwrap_or(NOTHING)
    }

    fn then(&self, sets: &[(usize, Reference)]) -> Self {
        let mut after = self.clone();
        for (setting, value) in sets {
            after.0[*setting] = Some(value.clone());
        }
        after
    }

    fn after_call(&self, effect: &Self) -> Self {
        let mut after = self.clone();
        for (mine, theirs) in after.0.iter_mut().zip(&effect.0) {
            if theirs.is_some() {
                mine.clone_from(theirs);
            }
        }
        after
    }
}

fn joined<const N: usize>(old: Shared<N>, new: &Shared<N>) -> Shared<N> {
    let (Some(old), Some(new)) = (&old, new) else { return old.or_else(|| new.clone()) };
    if Arc::ptr_eq(old, new) || old == new {
        return Some(Arc::clone(old));
    }
    let mut both = State::clone(old);
    for (mine, theirs) in both.0.iter_mut().zip(&new.0) {
        // What is known only at run time stays so, with its first reason.
        if mine != theirs && !matches!(mine, Some(Reference::Runtime(_))) {
            *mine = Some(match theirs {
                Some(Reference::Runtime(reason)) => Reference::Runtime(reason.clone()),
                _ => Reference::disputed(mine.as_ref(), theirs.as_ref()),
            });
        }
    }
    Some(Arc::new(both))
}

/// The settings before each step of each routine. A routine that no other one calls starts with nothing set, and so
/// does a statement that no way leads to.
pub fn follow<const N: usize>(routines: &[Vec<Step<N>>]) -> States<N> {
    let mut effects: Vec<Shared<N>> = vec![None; routines.len()];
    let (order, called) = call_order(routines);
    let unchanged = Arc::new(State::unchanged());
    for _ in 0..MAX_ROUNDS {
        let mut settled = true;
        for &routine in &order {
            let effect = Walk::new(&routines[routine], &effects).run(&unchanged, &mut |_, _| {});
            settled &= effects[routine] == effect;
            effects[routine] = effect;
        }
        if settled {
            break;
        }
    }
    let start = Arc::new(State::at_start());
    let mut entries: Vec<Shared<N>> =
        (0..routines.len()).map(|routine| (!called.contains(&routine)).then(|| Arc::clone(&start))).collect();
    let mut states: States<N> = routines.iter().map(|steps| vec![Arc::clone(&start); steps.len()]).collect();
    for _ in 0..MAX_ROUNDS {
        let before = entries.clone();
        for &routine in order.iter().rev() {
            let entry = entries[routine].clone().unwrap_or_else(|| Arc::clone(&start));
            let steps = &routines[routine];
            let known = &mut states[routine];
            Walk::new(steps, &effects).run(&entry, &mut |index, state| {
                known[index] = Arc::clone(state);
                if let Step::Calls(callee) = steps[index] {
                    entries[callee] = joined(entries[callee].take(), &Some(Arc::clone(state)));
                }
            });
        }
        if before == entries {
            break;
        }
    }
    states
}

/// The routines with callees before callers, and all that are called.
fn call_order<const N: usize>(routines: &[Vec<Step<N>>]) -> (Vec<usize>, HashSet<usize>) {
    let callees: Vec<Vec<usize>> = routines
        .iter()
        .map(|steps| {
            let calls = steps.iter().filter_map(|step| match step {
                Step::Calls(callee) => Some(*callee),
                _ => None,
            });
            calls.collect::<HashSet<_>>().into_iter().collect()
        })
        .collect();
    let called = callees.iter().flatten().copied().collect();
    let (mut order, mut visited) = (Vec::new(), vec![false; routines.len()]);
    for root in 0..routines.len() {
        let mut stack = vec![(root, 0)];
        while let Some((routine, next)) = stack.pop() {
            if next == 0 && std::mem::replace(&mut visited[routine], true) {
                continue;
            }
            match callees[routine].get(next) {
                Some(&callee) => {
                    stack.push((routine, next + 1));
                    if !visited[callee] {
                        stack.push((callee, 0));
                    }
                }
                None => order.push(routine),
            }
        }
    }
    (order, called)
}

/// A block that is not closed yet.
struct Open<const N: usize> {
    entry: Shared<N>,
    joined: Shared<N>,
    complete: bool,
    index: usize,
}

/// What flows backwards: from the ends of loops to their heads, from jumps to labels.
#[derive(Clone, Default, PartialEq)]
struct Carried<const N: usize> {
    loops: HashMap<usize, Shared<N>>,
    jumps: Shared<N>,
}

/// The way through one routine. No state: no way leads here.
struct Walk<'a, const N: usize> {
    steps: &'a [Step<N>],
    effects: &'a [Shared<N>],
    carried: Carried<N>,
    now: Shared<N>,
    exit: Shared<N>,
    open: Vec<Open<N>>,
}

impl<'a, const N: usize> Walk<'a, N> {
    fn new(steps: &'a [Step<N>], effects: &'a [Shared<N>]) -> Self {
        let carried = Carried { loops: HashMap::new(), jumps: None };
        Self { steps, effects, carried, now: None, exit: None, open: Vec::new() }
    }

    /// Goes through the routine; `visit` sees the state before each step. Gives the state at the end, none when the end
    /// is never reached.
    fn run(mut self, entry: &Arc<State<N>>, visit: &mut dyn FnMut(usize, &Arc<State<N>>)) -> Shared<N> {
        for _ in 0..MAX_ROUNDS {
            let before = self.carried.clone();
            self.now = Some(Arc::clone(entry));
            self.exit = None;
            self.open.clear();
            for index in 0..self.steps.len() {
                if let Some(now) = &self.now {
                    visit(index, now);
                }
                self.step(index);
            }
            self.end();
            if before == self.carried {
                break;
            }
        }
        self.exit
    }

    fn end(&mut self) {
        self.exit = joined(self.exit.take(), &self.now.take());
    }

    fn open(&mut self, index: usize, entry: Shared<N>) {
        self.open.push(Open { entry, joined: None, complete: false, index });
    }

    fn step(&mut self, index: usize) {
        match &self.steps[index] {
            Step::Plain => {}
            Step::Sets(sets) => self.now = self.now.take().map(|now| Arc::new(now.then(sets))),
            Step::Calls(callee) => {
                if let (Some(effect), Some(now)) = (&self.effects[*callee], &self.now) {
                    self.now = Some(Arc::new(now.after_call(effect)));
                }
            }
            Step::If => self.open(index, self.now.clone()),
            Step::Switch => {
                let entry = self.now.take();
                self.open(index, entry);
            }
            Step::Branch => self.next_branch(false),
            Step::Else => self.next_branch(true),
            Step::EndBranches => {
                if let Some(open) = self.open.pop() {
                    self.now = joined(open.joined, &self.now);
                    if !open.complete {
                        self.now = joined(self.now.take(), &open.entry);
                    }
                }
            }
            Step::Loop => {
                if let Some(carried) = self.carried.loops.get(&index) {
                    self.now = joined(self.now.take(), carried);
                }
                self.open(index, self.now.clone());
            }
            Step::EndLoop => {
                if let Some(open) = self.open.pop() {
                    self.carried.loops.insert(open.index, self.now.clone());
                    self.now = joined(joined(open.entry, &self.now), &open.joined);
                }
            }
            Step::LeaveLoop => {
                let left = self.now.take();
                let is_loop = |open: &&mut Open<N>| matches!(self.steps[open.index], Step::Loop);
                if let Some(open) = self.open.iter_mut().rev().find(is_loop) {
                    open.joined = joined(open.joined.take(), &left);
                }
            }
            Step::Jump => self.carried.jumps = joined(self.carried.jumps.take(), &self.now.take()),
            Step::Label => self.now = joined(self.now.take(), &self.carried.jumps),
            Step::Return => self.end(),
        }
    }

    fn next_branch(&mut self, last: bool) {
        if let Some(open) = self.open.last_mut() {
            open.joined = joined(open.joined.take(), &self.now);
            open.complete |= last;
            self.now.clone_from(&open.entry);
        }
    }
}

/// What holds where a program has selected nothing yet, in languages whose controllers keep a selection from program to
/// program: the only selection that the job makes; where it makes several, whichever was left; else `otherwise`.
pub fn left_over(selections: &[Reference], otherwise: Reference, what: &str) -> Reference {
    let Some((first, others)) = selections.split_first() else { return otherwise };
    if others.iter().all(|other| other == first) {
        return first.clone();
    }
    Reference::Runtime(format!("no {what} is selected on the way here: what the last program left holds"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(name: &str) -> Step<1> {
        Step::Sets(vec![(0, Reference::Named(name.into()))])
    }

    /// The setting before the last step of the first routine: a name, `-` for none, `?` for run time.
    fn last(routines: &[Vec<Step<1>>]) -> String {
        match follow(routines)[0].last().expect("a step").get(0) {
            Reference::Named(name) => name.to_string(),
            Reference::Unnamed => "-".into(),
            Reference::Runtime(_) => "?".into(),
        }
    }

    #[test]
    fn branches_join() {
        use Step::{Branch, Else, EndBranches, If, Plain, Return, Switch};
        assert_eq!(last(&[vec![Plain]]), "-");
        assert_eq!(last(&[vec![set("a"), If, set("b"), EndBranches, Plain]]), "?");
        assert_eq!(last(&[vec![set("a"), If, set("b"), Else, set("b"), EndBranches, Plain]]), "b");
        assert_eq!(last(&[vec![set("a"), If, set("b"), Return, EndBranches, Plain]]), "a");
        assert_eq!(last(&[vec![Switch, Branch, set("b"), Else, set("b"), EndBranches, Plain]]), "b");
        assert_eq!(last(&[vec![Switch, Branch, set("b"), EndBranches, Plain]]), "?");
    }

    #[test]
    fn what_a_loop_sets_comes_back_to_its_head() {
        use Step::{EndLoop, Loop, Plain};
        let states = follow(&[vec![set("a"), Loop, Plain, set("b"), EndLoop]]);
        assert!(matches!(states[0][2].get(0), Reference::Runtime(_)));
        let states = follow(&[vec![set("a"), Loop, set("b"), Plain, EndLoop, Plain]]);
        assert_eq!(states[0][3].get(0), &Reference::Named("b".into()));
        assert!(matches!(states[0][5].get(0), Reference::Runtime(_)));
    }

    #[test]
    fn jumps_and_exits_carry_their_settings() {
        use Step::{EndBranches, EndLoop, If, Jump, Label, LeaveLoop, Loop, Plain};
        assert_eq!(last(&[vec![set("a"), If, set("b"), Jump, EndBranches, Label, Plain]]), "?");
        assert_eq!(last(&[vec![set("b"), Loop, LeaveLoop, EndLoop, Plain]]), "b");
        assert_eq!(last(&[vec![set("a"), Loop, set("b"), LeaveLoop, EndLoop, Plain]]), "?");
    }

    #[test]
    fn calls_set_for_their_caller_and_enter_with_its_settings() {
        let routines = [vec![set("a"), Step::Calls(1), Step::Calls(2), Step::Plain], vec![Step::Plain], vec![set("c")]];
        let states = follow(&routines);
        assert_eq!(states[0][3].get(0), &Reference::Named("c".into()));
        assert_eq!(states[1][0].get(0), &Reference::Named("a".into()));
        // A circle of calls ends.
        follow(&[vec![set("a"), Step::<1>::Calls(1)], vec![Step::Calls(0)]]);
    }
}

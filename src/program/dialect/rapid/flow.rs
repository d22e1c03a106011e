//! Settings that stay in force from statement to statement: the gripped load, program displacements, and whether
//! configurations are supervised.
//!
//! Settings are followed through branches, loops and calls as far as the order of the program is fixed. Where two ways
//! to a statement disagree, the setting is known only at run time.

use std::collections::HashMap;

use crate::program::target::Reference;

use super::argument::{arguments, named, positional};
use super::definition::DefinitionKeys;
use super::follow::follow;
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
    /// All settings as the caller had them.
    pub fn unchanged() -> Self {
        Self([const { None }; SETTINGS])
    }

    /// Nothing set.
    pub fn at_start() -> Self {
        Self([const { Some(Reference::Unnamed) }; SETTINGS])
    }

    /// A setting; nothing set is [`Reference::Unnamed`].
    pub fn get(&self, setting: Setting) -> Reference {
        self.0[setting as usize].clone().unwrap_or_default()
    }

    /// Where two ways meet; no state stands for no way.
    pub fn joined(old: Option<Self>, new: Option<&Self>) -> Option<Self> {
        let (Some(mut old), Some(new)) = (old.clone(), new) else { return old.or_else(|| new.cloned()) };
        for (mine, theirs) in old.0.iter_mut().zip(&new.0) {
            // What is known only at run time stays so, with its first reason.
            if mine != theirs && !matches!(mine, Some(Reference::Runtime(_))) {
                *mine = Some(match theirs {
                    Some(Reference::Runtime(reason)) => Reference::Runtime(reason.clone()),
                    _ => Reference::disputed(mine.as_ref(), theirs.as_ref()),
                });
            }
        }
        Some(old)
    }

    /// The settings after a routine with this effect.
    pub fn then(&self, effect: &Self) -> Self {
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

/// What a statement does.
#[derive(Clone, Debug)]
pub enum Step {
    /// Settings.
    Sets(State),
    /// A routine of the job runs.
    Calls(usize),
}

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
        Self { states: follow(job, steps) }
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

//! Whether named physics is worth having where a learner could have told the same: the whole way, search and learner
//! included, gone again without some records, and judged on those.
//!
//! Lines of a spectrum can stand for any curve, and a search that has seen a record flatters the cause that it chose for it:
//! held-out figures of causes chosen on all records would not show that (Varma & Simon 2006, nested cross-validation).

use crate::identify::problem::{NoPose, Problem};
use crate::identify::robust::lengths_of;
use crate::identify::state::State;
use crate::identify::unknown::Unknown;
use crate::learn::choose::{in_errors, learn};
use crate::learn::folds::folds;
use crate::measure::recording::Kind;

use super::fitted::Ground;
use super::search::search;

/// Parts into which the records are dealt.
const FOLDS: usize = 3;
/// Standard errors by which held-out distances must be smaller without the names for these to be left out.
const CLEARLY: f64 = 1.0;

/// False when records held out are clearly nearer to a model that leaves everything beyond the ground to the learner.
///
/// # Errors
/// [`NoPose`] when a model cannot place a record.
pub fn names_are_worth_having(ground: &Ground<'_>, kind: Kind, seed: u64) -> Result<bool, NoPose> {
    let observations: Vec<_> = ground.problem.records.iter().map(|record| record.observation).collect();
    let fold_of = folds(&observations, FOLDS, seed);
    let (mut named, mut learned) = (Vec::new(), Vec::new());
    for fold in 0..FOLDS {
        let (held_out, kept): (Vec<usize>, Vec<usize>) = (0..fold_of.len()).partition(|&index| fold_of[index] == fold);
        let held_out = ground.problem.subset(&held_out);
        let kept = Ground { problem: ground.problem.subset(&kept), ..ground.clone() };
        let without = kept.fit(&[])?.estimate;
        let with = search(&kept, kind, seed)?.fitted.estimate;
        for (estimate, lengths) in [(with, &mut named), (without, &mut learned)] {
            let state = after_learning(&estimate.problem, &estimate.fit.state, &estimate.fit.unknowns, seed)?;
            lengths.extend(lengths_of(&held_out, &held_out.residuals(&state)?));
        }
    }
    Ok(in_errors(&named, &learned) <= CLEARLY)
}

fn after_learning(problem: &Problem<'_>, state: &State, unknowns: &[Unknown], seed: u64) -> Result<State, NoPose> {
    Ok(learn(problem, state, unknowns, seed)?.state.unwrap_or_else(|| state.clone()))
}

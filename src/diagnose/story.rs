//! Whether names alone tell as much as a function without a name.
//!
//! Two causes at once often look like one function of two joints, which then explains more than either name; taken in, it
//! leaves nothing for the names to explain. So before a nameless function is believed, stories are told to their ends, to
//! first order: some of names alone, each with another beginning, and one that begins with the function and goes on with
//! whatever comes. The one with the strongest evidence in all decides what comes first.

use super::evidence::DECIDES;
use super::projection::Projection;
use super::rank::{Ranked, Suspect, rank, searched};
use super::regressors::Regressors;

/// Causes of one story at most.
const MOST_CAUSES: usize = 6;
/// Names with which a story is begun: the strongest is not always the true one.
const BEGINNINGS: usize = 3;

/// The name (its place in `named`) with which a story of names alone begins that tells the records at least as well as one
/// that begins with `function`; `None` where there is none.
///
/// # Arguments
/// * `named` - names that could come first, the strongest first
/// * `standing` - suspects whose place needs no search, named and nameless
/// * `projection` - beyond which the stories are told
pub fn names_tell_it(
    function: &Ranked<'_>,
    named: &[&Ranked<'_>],
    standing: &[Suspect],
    regressors: &Regressors<'_, '_>,
    projection: &Projection,
) -> Option<usize> {
    let everything: Vec<&Suspect> = standing.iter().collect();
    let names: Vec<&Suspect> = standing.iter().filter(|suspect| suspect.candidate().is_some()).collect();
    let told_from = |first: &Ranked<'_>, by: &[&Suspect]| {
        first.evidence + told(by, regressors, &projection.with(&first.suspect.columns), MOST_CAUSES - 1)
    };
    let stories = named.iter().take(BEGINNINGS).map(|first| told_from(first, &names)).enumerate();
    let (best, evidence) = stories.min_by(|a, b| a.1.total_cmp(&b.1))?;
    // A story that has not come as far as the other one's beginning need not be compared with its end.
    (evidence < function.evidence && evidence <= told_from(function, &everything)).then_some(best)
}

/// Evidence, summed up, of the causes that a forward search takes in.
fn told(standing: &[&Suspect], regressors: &Regressors<'_, '_>, projection: &Projection, most: usize) -> f64 {
    let mut projection = projection.clone();
    let mut total = 0.0;
    for _ in 0..most {
        let fine = searched(regressors, &projection);
        let all: Vec<&Suspect> = fine.iter().chain(standing.iter().copied()).collect();
        let ranked = rank(&all, &projection);
        let Some(best) = ranked.first().filter(|best| best.evidence < -DECIDES) else { break };
        total += best.evidence;
        projection = projection.with(&best.suspect.columns);
    }
    total
}

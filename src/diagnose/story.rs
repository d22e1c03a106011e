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
    let evidence_from = |first: &Ranked<'_>, by: &[&Suspect]| {
        told_from(first, by, Some(regressors), projection, (MOST_CAUSES, &|_| 0.0)).evidence
    };
    let stories = named.iter().take(BEGINNINGS).map(|first| evidence_from(first, &names)).enumerate();
    let (best, evidence) = stories.min_by(|a, b| a.1.total_cmp(&b.1))?;
    // A story that has not come as far as the other one's beginning need not be compared with its end.
    (evidence < function.evidence && evidence <= evidence_from(function, &everything)).then_some(best)
}

/// What a forward search takes in, to first order.
#[derive(Clone, Debug)]
pub struct Story {
    /// Evidence, summed up.
    pub evidence: f64,
    /// One after the other.
    pub causes: Vec<Suspect>,
}

/// The story that begins with a suspect.
///
/// # Arguments
/// * `regressors` - to search the constants of places anew at each step
/// * `most` - causes at most
/// * `least` - squares that a further cause must explain of a projection
pub fn told_from(
    first: &Ranked<'_>,
    standing: &[&Suspect],
    regressors: Option<&Regressors<'_, '_>>,
    projection: &Projection,
    (most, least): (usize, &dyn Fn(&Projection) -> f64),
) -> Story {
    let mut projection = first.suspect.beside(projection);
    let mut story = Story { evidence: first.evidence, causes: vec![first.suspect.clone()] };
    while story.causes.len() < most {
        let fine = regressors.map_or_else(Vec::new, |regressors| searched(regressors, &projection));
        let all: Vec<&Suspect> = fine.iter().chain(standing.iter().copied()).collect();
        let ranked = rank(&all, &projection);
        let least = least(&projection);
        let is_new = |suspect: &Suspect| {
            let Some(candidate) = suspect.candidate() else { return true };
            !story.causes.iter().filter_map(Suspect::candidate).any(|told| told.same_as(candidate))
        };
        let sound = |ranked: &&Ranked<'_>| {
            ranked.evidence < -DECIDES && ranked.gain.explained > least && is_new(ranked.suspect)
        };
        let Some(best) = ranked.iter().find(sound) else { break };
        story.evidence += best.evidence;
        projection = best.suspect.beside(&projection);
        story.causes.push(best.suspect.clone());
    }
    story
}

//! Which learner, if any: by records that were held out, the simplest that is as good as the best.

use nalgebra::DVector;
use serde::Serialize;

use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;
use crate::identify::unknown::Unknown;

use super::additive::{Fitted, Regression};
use super::folds::{FOLDS, folds};
use super::learned::{Kind, Learned, of_network, of_regression, share_of_network, share_of_terms};
use super::network::{Bag, Course, FEW, MANY, MOST_RECORDS};
use super::samples::Samples;
use super::subject::Subject;
use super::term::{Family, Term, terms};

/// Records below which nothing is learned: each fold must still show every joint in most of its range.
const FEWEST: usize = 60;

/// A learner that was tried.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Candidate {
    /// Its name; `none` is geometry and named physics alone.
    pub name: &'static str,
    /// Functions in it; of a network, its weights.
    pub functions: usize,
    /// Numbers that the records determined, those of geometry included.
    pub determined: f64,
    /// Mean distance of held-out records, mm.
    pub heldout_mean_mm: f64,
    /// Root of the mean square of it, mm.
    pub heldout_rms_mm: f64,
    /// The largest, mm.
    pub heldout_max_mm: f64,
    /// Distance of each record, m.
    #[serde(skip)]
    lengths_m: Vec<f64>,
}

fn name(family: Family) -> &'static str {
    match family {
        Family::Own => "own_angle",
        Family::Fine => "own_angle_fine",
        Family::Lines => "own_angle_lines",
        Family::Loaded => "own_angle_load_approach",
        Family::Crossed => "all_joints",
    }
}

/// Which learners are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rivals {
    /// Sums of functions of one variable.
    Curves,
    /// Those and the network of joint errors.
    All,
}

/// A learner that was tried, with what is needed to take it.
enum Tried<'a> {
    Additive(Option<Family>, Box<Regression<'a>>, Box<Fitted>),
    Network(Box<Course<'a>>, Bag),
}

/// Tries every family of learners on the records of a problem, the network of joint errors last, and keeps the simplest
/// within one standard error of the best (Breiman et al. 1984), the error that of the paired differences of held-out
/// distances. A network is judged by few restarts; only where it is chosen are more trained.
///
/// # Arguments
/// * `state` - as identified, without a learner
/// * `unknowns` - what was free there
/// * `subject` - what a learner may look at
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn learn(
    problem: &Problem<'_>,
    (state, unknowns): (&State, &[Unknown]),
    subject: &Subject,
    rivals: Rivals,
    seed: u64,
) -> Result<Learned, NoPose> {
    let samples = Samples::new(problem, state, unknowns)?;
    let fold_of = folds(&samples.observations, FOLDS, seed);
    let sigmas_m: Vec<f64> = problem.records.iter().map(|record| record.sigma_m).collect();
    let enough = samples.count() >= FEWEST;
    let mut tried: Vec<(Candidate, Tried<'_>)> = Vec::new();
    for family in std::iter::once(None).chain(Family::ALL.into_iter().map(Some)) {
        let terms = family.filter(|_| enough).map_or_else(Vec::new, |family| admitted(&samples, family, subject));
        if family.is_some() && (terms.is_empty() || was_tried(&terms, &tried)) {
            continue;
        }
        let regression = Regression::new(&samples, state, unknowns, terms, &fold_of);
        let Some(fitted) = regression.fit() else { continue };
        let Some(left) = regression.held_out(&fitted) else { continue };
        let determined = fitted.posterior.determined;
        let functions = regression.terms.len();
        let candidate = Candidate::new(family.map_or("none", name), functions, determined, &left, &sigmas_m);
        tried.push((candidate, Tried::Additive(family, Box::new(regression), Box::new(fitted))));
    }
    if rivals == Rivals::All && enough && samples.count() <= MOST_RECORDS {
        let course = Course::new(&samples, subject, state, unknowns, seed);
        if let Some(bag) = course.train(FEW)
            && let Some(left) = course.held_out(&bag, &fold_of)
        {
            let determined = bag.determined() + unknowns.len() as f64;
            let candidate = Candidate::new("network", bag.weights(), determined, &left, &sigmas_m);
            tried.push((candidate, Tried::Network(Box::new(course), bag)));
        }
    }
    let lengths: Vec<&[f64]> = tried.iter().map(|(candidate, _)| candidate.lengths_m.as_slice()).collect();
    let chosen = simplest_of_the_best(&lengths);
    let own = (state, unknowns);
    let rows = samples.missing.len();
    let mut learned = match tried.get(chosen) {
        Some((candidate, Tried::Additive(Some(family), regression, fitted))) => {
            let mut learned = of_regression(*family, regression, fitted, own, &sigmas_m);
            learned.hold_against(&candidate.lengths_m, rows, share_of_terms(regression, fitted), &sigmas_m);
            learned
        }
        Some((candidate, Tried::Network(course, few))) => {
            let many = course.train(MANY);
            let bag = many.as_ref().unwrap_or(few);
            let learned = of_network(course, bag, &samples, own, &sigmas_m);
            learned.map_or_else(
                || Learned::nothing(&samples),
                |mut learned| {
                    let share = share_of_network(bag, unknowns.len());
                    learned.hold_against(&candidate.lengths_m, rows, share, &sigmas_m);
                    learned
                },
            )
        }
        _ => Learned::nothing(&samples),
    };
    learned.candidates = tried.into_iter().map(|(candidate, _)| candidate).collect();
    learned.chosen = chosen;
    Ok(learned)
}

/// Learns what was chosen before, from other records.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn learn_again(
    problem: &Problem<'_>,
    (state, unknowns): (&State, &[Unknown]),
    subject: &Subject,
    before: Learned,
    seed: u64,
) -> Result<Learned, NoPose> {
    let samples = Samples::new(problem, state, unknowns)?;
    let sigmas_m: Vec<f64> = problem.records.iter().map(|record| record.sigma_m).collect();
    let again = match before.kind {
        None => return Ok(before),
        Some(Kind::Additive(family)) => {
            // Nothing is held out: the parts are there to be summed up side by side.
            let parts: Vec<usize> = (0..samples.count()).map(|record| record % FOLDS).collect();
            let regression = Regression::new(&samples, state, unknowns, admitted(&samples, family, subject), &parts);
            let fitted = regression.fit();
            fitted.map(|fitted| of_regression(family, &regression, &fitted, (state, unknowns), &sigmas_m))
        }
        Some(Kind::Network) => {
            let course = Course::new(&samples, subject, state, unknowns, seed);
            let bag = course.train(MANY);
            bag.and_then(|bag| of_network(&course, &bag, &samples, (state, unknowns), &sigmas_m))
        }
    };
    let mut learned = again.unwrap_or_else(|| Learned::nothing(&samples));
    (learned.candidates, learned.chosen) = (before.candidates, before.chosen);
    learned.held_out_ratio = before.held_out_ratio;
    Ok(learned)
}

/// The terms of a family that a learner may have.
fn admitted(samples: &Samples<'_>, family: Family, subject: &Subject) -> Vec<Term> {
    let mut all = terms(samples, family);
    all.retain(|term| subject.admits(term));
    all
}

/// True for terms that a simpler family had too: of few joints and variables the families are often the same.
fn was_tried(terms: &[Term], tried: &[(Candidate, Tried<'_>)]) -> bool {
    tried.iter().any(|(_, tried)| matches!(tried, Tried::Additive(_, regression, _) if regression.terms == terms))
}

impl Candidate {
    fn new(name: &'static str, functions: usize, determined: f64, left: &[DVector<f64>], sigmas_m: &[f64]) -> Self {
        // Rows of a position come first: the distance is theirs, orientations do not count in it.
        let position = |left: &DVector<f64>| left.rows(0, left.len().min(3)).norm();
        let lengths_m: Vec<f64> = left.iter().zip(sigmas_m).map(|(left, sigma)| position(left) * sigma).collect();
        let count = lengths_m.len().max(1) as f64;
        let square = lengths_m.iter().map(|length| length * length).sum::<f64>() / count;
        Self {
            name,
            functions,
            determined,
            heldout_mean_mm: 1e3 * lengths_m.iter().sum::<f64>() / count,
            heldout_rms_mm: 1e3 * square.sqrt(),
            heldout_max_mm: 1e3 * lengths_m.iter().copied().fold(0.0, f64::max),
            lengths_m,
        }
    }
}

/// Mean of the paired differences of two sets of distances over its standard error: by how much the first are larger.
fn in_errors(lengths: &[f64], others: &[f64]) -> f64 {
    let differences: Vec<f64> = lengths.iter().zip(others).map(|(one, other)| one - other).collect();
    let count = differences.len().max(2) as f64;
    let mean = differences.iter().sum::<f64>() / count;
    let variance = differences.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / (count - 1.0);
    if mean == 0.0 { 0.0 } else { mean / (variance / count).sqrt() }
}

/// The first whose mean exceeds the smallest by no more than the standard error of the difference.
fn simplest_of_the_best(lengths: &[&[f64]]) -> usize {
    let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len().max(1) as f64;
    let best = (0..lengths.len()).min_by(|&a, &b| mean(lengths[a]).total_cmp(&mean(lengths[b]))).unwrap_or(0);
    (0..best).find(|&index| in_errors(lengths[index], lengths[best]) <= 1.0).unwrap_or(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_simplest_within_one_standard_error_wins() {
        let noise = |index: usize| ((index * 7919 % 101) as f64 / 50.0 - 1.0) * 0.3;
        let base: Vec<f64> = (0..100).map(|index| 1.0 + noise(index)).collect();
        let hardly: Vec<f64> = (0..100).map(|index| base[index] - 0.001 + 0.1 * noise(index + 13)).collect();
        let clearly: Vec<f64> = base.iter().map(|length| 0.5 * length).collect();
        assert_eq!(simplest_of_the_best(&[&base, &hardly]), 0);
        assert_eq!(simplest_of_the_best(&[&base, &clearly, &hardly]), 1);
        assert_eq!(simplest_of_the_best(&[&clearly, &base]), 0);
    }
}

//! Which learner, if any: by records that were held out, the simplest that is as good as the best.

use nalgebra::DVector;
use serde::Serialize;

use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;
use crate::identify::unknown::Unknown;

use super::additive::{Fitted, Regression};
use super::folds::folds;
use super::samples::Samples;
use super::term::{Family, terms};

/// Parts into which the records are dealt.
const FOLDS: usize = 10;
/// Records below which nothing is learned: each fold must still show every joint in most of its range.
const FEWEST: usize = 60;

/// Records that are asked how uncertain a learner is; with more, some of them.
const MOST_ASKED: usize = 500;

/// A learner that was tried.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Candidate {
    /// Its name; `none` is geometry and named physics alone.
    pub name: &'static str,
    /// Functions in it.
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

/// What was learned.
#[derive(Clone, Debug)]
pub struct Learned {
    /// All that was tried, the simplest first.
    pub candidates: Vec<Candidate>,
    /// Index of the one that is used; zero is `none`.
    pub chosen: usize,
    /// Its family.
    pub family: Option<Family>,
    /// The state with geometry moved and the learner on; `None` when none is used.
    pub state: Option<State>,
    /// Factor on the records' sigmas that gives the noise which the learner leaves.
    pub noise_scale: f64,
    /// Degrees of freedom behind that.
    pub freedom: f64,
    /// Mean square of the error that the learner itself is expected to make in a pose like the records', beside that of
    /// the geometry, m^2: its variance, were it all that there is.
    pub error_m2: f64,
    /// What held-out records say of that: their mean square error over it. One where none were held out.
    pub held_out_ratio: f64,
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

/// Tries every family of learners on the records of a problem and keeps the simplest within one standard error of the
/// best (Breiman et al. 1984), the error that of the paired differences of held-out distances.
///
/// # Arguments
/// * `state` - as identified, without a learner
/// * `unknowns` - what was free there
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn learn(problem: &Problem<'_>, state: &State, unknowns: &[Unknown], seed: u64) -> Result<Learned, NoPose> {
    let samples = Samples::new(problem, state, unknowns)?;
    let fold_of = folds(&samples.observations, FOLDS, seed);
    let sigmas_m: Vec<f64> = problem.records.iter().map(|record| record.sigma_m).collect();
    let enough = samples.count() >= FEWEST;
    let mut tried: Vec<(Option<Family>, Candidate, Regression<'_>, Fitted)> = Vec::new();
    for family in std::iter::once(None).chain(Family::ALL.into_iter().map(Some)) {
        let terms = family.filter(|_| enough).map_or_else(Vec::new, |family| terms(&samples, family));
        if family.is_some() && terms.is_empty() {
            continue;
        }
        let regression = Regression::new(&samples, state, unknowns, terms, &fold_of);
        let Some(fitted) = regression.fit() else { continue };
        let Some(left) = regression.held_out(&fitted) else { continue };
        let candidate = Candidate::new(family.map_or("none", name), &regression, &fitted, &left, &sigmas_m);
        tried.push((family, candidate, regression, fitted));
    }
    let lengths: Vec<&[f64]> = tried.iter().map(|(_, candidate, ..)| candidate.lengths_m.as_slice()).collect();
    let chosen = simplest_of_the_best(&lengths);
    let candidates: Vec<Candidate> = tried.iter().map(|(_, candidate, ..)| candidate.clone()).collect();
    let mut learned = match tried.get(chosen) {
        Some((Some(family), candidate, regression, fitted)) => {
            let mut learned = taken(*family, regression, fitted, (state, unknowns), &sigmas_m);
            let rows = samples.missing.len().max(1) as f64;
            let noise_m2 = 3.0 * fitted.variances.noise * mean(sigmas_m.iter().map(|sigma| sigma * sigma));
            let expected_m2 = noise_m2 + learned.error_m2 / share_of_terms(regression, fitted);
            // A mean square scatters by this part of itself; only what is beyond two of that is more than expected.
            let beyond_chance_m2 = expected_m2 * (1.0 + 2.0 * (2.0 / rows).sqrt());
            let missed_m2 = mean(candidate.lengths_m.iter().map(|length| length * length));
            if learned.error_m2 > 0.0 {
                learned.held_out_ratio = 1.0 + (missed_m2 - beyond_chance_m2).max(0.0) / learned.error_m2;
            }
            learned
        }
        _ => Learned::nothing(&samples),
    };
    (learned.candidates, learned.chosen) = (candidates, chosen);
    Ok(learned)
}

/// Learns what was chosen before, from other records.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn learn_again(
    problem: &Problem<'_>,
    state: &State,
    unknowns: &[Unknown],
    before: Learned,
) -> Result<Learned, NoPose> {
    let samples = Samples::new(problem, state, unknowns)?;
    let Some(family) = before.family else { return Ok(before) };
    let sigmas_m: Vec<f64> = problem.records.iter().map(|record| record.sigma_m).collect();
    // Nothing is held out: the parts are there to be summed up side by side.
    let parts: Vec<usize> = (0..samples.count()).map(|record| record % FOLDS).collect();
    let regression = Regression::new(&samples, state, unknowns, terms(&samples, family), &parts);
    let mut learned = match regression.fit() {
        Some(fitted) => taken(family, &regression, &fitted, (state, unknowns), &sigmas_m),
        None => Learned::nothing(&samples),
    };
    (learned.candidates, learned.chosen) = (before.candidates, before.chosen);
    learned.held_out_ratio = before.held_out_ratio;
    Ok(learned)
}

impl Learned {
    fn nothing(samples: &Samples<'_>) -> Self {
        Self {
            candidates: Vec::new(),
            chosen: 0,
            family: None,
            state: None,
            noise_scale: 1.0,
            freedom: samples.missing.len() as f64,
            error_m2: 0.0,
            held_out_ratio: 1.0,
        }
    }
}

/// A regression as what was learned.
fn taken(
    family: Family,
    regression: &Regression<'_>,
    fitted: &Fitted,
    (state, unknowns): (&State, &[Unknown]),
    sigmas_m: &[f64],
) -> Learned {
    let samples = regression.samples;
    let mut learned = Learned::nothing(samples);
    let mut moved = state.clone();
    regression.move_geometry(fitted, unknowns, &mut moved);
    moved.model.learner = regression.curves(fitted).map(Into::into);
    learned.family = Some(family);
    learned.noise_scale = fitted.variances.noise.sqrt();
    learned.freedom -= fitted.posterior.determined;
    learned.error_m2 = error_of_terms_m2(regression, fitted, sigmas_m);
    learned.state = Some(moved);
    learned
}

/// Mean square of the error that the terms are expected to make in a pose like the records', beside that of geometry, m^2.
pub fn error_of_terms_m2(regression: &Regression<'_>, fitted: &Fitted, sigmas_m: &[f64]) -> f64 {
    let samples = regression.samples;
    let asked: Vec<usize> = (0..samples.count()).step_by(samples.count().div_ceil(MOST_ASKED).max(1)).collect();
    let variance = regression.predicted_variance(fitted, &asked);
    let mut first = 0;
    let squares = asked.iter().map(|&record| {
        let count = samples.rows_of(record).len();
        let position = variance[first..first + count.min(3)].iter().sum::<f64>();
        first += count;
        position * sigmas_m[record] * sigmas_m[record]
    });
    share_of_terms(regression, fitted) * mean(squares)
}

/// Share of a regression's own error that is not geometry's, which has about one noise variance for each of its numbers.
fn share_of_terms(regression: &Regression<'_>, fitted: &Fitted) -> f64 {
    (1.0 - regression.geometry as f64 / fitted.posterior.determined).max(0.05)
}

fn mean(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0usize), |(sum, count), number| (sum + number, count + 1));
    sum / count.max(1) as f64
}

impl Candidate {
    fn new(
        name: &'static str,
        regression: &Regression<'_>,
        fitted: &Fitted,
        left: &[DVector<f64>],
        sigmas_m: &[f64],
    ) -> Self {
        // Rows of a position come first: the distance is theirs, orientations do not count in it.
        let position = |left: &DVector<f64>| left.rows(0, left.len().min(3)).norm();
        let lengths_m: Vec<f64> = left.iter().zip(sigmas_m).map(|(left, sigma)| position(left) * sigma).collect();
        let count = lengths_m.len().max(1) as f64;
        let square = lengths_m.iter().map(|length| length * length).sum::<f64>() / count;
        Self {
            name,
            functions: regression.terms.len(),
            determined: fitted.posterior.determined,
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

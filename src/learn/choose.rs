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
const FOLDS: usize = 5;
/// Waves a joint revolution of the finest function. Public data of real arms show energy up to 30.
const FINEST: f64 = 40.0;
/// Records below which nothing is learned: each fold must still show every joint in most of its range.
const FEWEST: usize = 60;

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
    /// The state with geometry moved and the learner on; `None` when none is used.
    pub state: Option<State>,
    /// Factor on the records' sigmas that gives the noise which the learner leaves.
    pub noise_scale: f64,
    /// Degrees of freedom behind that.
    pub freedom: f64,
    /// Mean square of the error that the learner itself is expected to make in a pose like the records', beside that of
    /// the geometry, m^2.
    pub error_m2: f64,
}

fn name(family: Family) -> &'static str {
    match family {
        Family::Own => "own_angle",
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
/// * `family` - the only one to try, where it was chosen before
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn learn(
    problem: &Problem<'_>,
    state: &State,
    unknowns: &[Unknown],
    seed: u64,
    only: Option<usize>,
) -> Result<Learned, NoPose> {
    let samples = Samples::new(problem, state, unknowns)?;
    let fold_of = folds(&samples.observations, FOLDS, seed);
    let sigmas_m: Vec<f64> = problem.records.iter().map(|record| record.sigma_m).collect();
    let families: Vec<Option<Family>> = std::iter::once(None).chain(Family::ALL.into_iter().map(Some)).collect();
    let enough = samples.count() >= FEWEST;
    let mut tried: Vec<(Candidate, Regression, Fitted)> = Vec::new();
    for (index, &family) in families.iter().enumerate() {
        let wanted = only.is_none_or(|only| only == index) || index == 0;
        if !wanted || (family.is_some() && !enough) {
            continue;
        }
        let terms = family.map_or_else(Vec::new, |family| terms(&samples, family, FINEST));
        let regression = Regression::new(&samples, state, unknowns, terms, &fold_of);
        let Some(fitted) = regression.fit() else { continue };
        let Some(left) = regression.held_out(&fitted.variances) else { continue };
        let candidate = Candidate::new(family.map_or("none", name), &regression, &fitted, &left, &sigmas_m);
        tried.push((candidate, regression, fitted));
    }
    let lengths: Vec<&[f64]> = tried.iter().map(|(candidate, ..)| candidate.lengths_m.as_slice()).collect();
    let chosen = if only.is_some() { tried.len().saturating_sub(1) } else { simplest_of_the_best(&lengths) };
    let mut learned = Learned {
        candidates: tried.iter().map(|(candidate, ..)| candidate.clone()).collect(),
        chosen,
        state: None,
        noise_scale: 1.0,
        freedom: samples.missing.len() as f64,
        error_m2: 0.0,
    };
    if let Some((_, regression, fitted)) = tried.get(chosen).filter(|_| chosen > 0) {
        let mut moved = state.clone();
        regression.move_geometry(fitted, unknowns, &mut moved);
        moved.model.learner = regression.curves(fitted).map(Into::into);
        learned.noise_scale = fitted.variances.noise.sqrt();
        learned.freedom -= fitted.posterior.determined;
        // Geometry has its own share in this, about one noise variance for each of its numbers.
        let learnt = 1.0 - (regression.geometry as f64 / fitted.posterior.determined).min(1.0);
        let variance = regression.predicted_variance(fitted);
        let squares = sigmas_m.iter().enumerate().map(|(record, sigma_m)| {
            let rows = samples.rows_of(record);
            variance.rows(rows.start, rows.len().min(3)).sum() * sigma_m * sigma_m
        });
        learned.error_m2 = learnt * squares.sum::<f64>() / samples.count() as f64;
        learned.state = Some(moved);
    }
    Ok(learned)
}

impl Candidate {
    fn new(
        name: &'static str,
        regression: &Regression,
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
pub fn in_errors(lengths: &[f64], others: &[f64]) -> f64 {
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

//! One identification: robust start, fit with its own noise level, gross errors out, until nothing changes.

use nalgebra::DVector;

use super::estimate::{Estimate, estimate};
use super::problem::{NoPose, Problem};
use super::robust;
use super::state::State;
use super::unknown::Unknown;

/// Largest part of the records that may be gross errors: beyond, it is not the records that are wrong.
pub const MOST_EXCLUDED: f64 = 0.25;
/// Rounds of fitting and testing.
const ROUNDS: usize = 8;

/// A fit with the records that it does without.
#[derive(Clone, Debug)]
pub struct Identified<'a> {
    /// The fit and its noise level, over the records that were kept.
    pub estimate: Estimate<'a>,
    /// Indices of the kept records in the problem that was given.
    pub kept: Vec<usize>,
    /// Indices of the gross errors there.
    pub excluded: Vec<usize>,
}

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IdentifyError {
    /// The model cannot place a record.
    #[error(transparent)]
    NoPose(#[from] NoPose),
    /// Too many records do not fit.
    #[error(
        "{excluded} of {records} records stand off by more than {limit_mm:.2} mm from what the others say: too many for gross \
         errors; the recording mixes set-ups, tools or robots, or its columns are in disorder"
    )]
    TooManyOutliers {
        /// How many.
        excluded: usize,
        /// Of how many.
        records: usize,
        /// Beyond which distance, mm.
        limit_mm: f64,
    },
}

/// Identifies `unknowns` from records of which up to a quarter may be gross errors.
///
/// # Arguments
/// * `stated` - true when the records' sigmas are stated rather than a start value (see [`estimate`])
///
/// # Errors
/// [`IdentifyError`].
pub fn identify<'a>(
    problem: &Problem<'a>,
    start: State,
    unknowns: &[Unknown],
    stated: bool,
) -> Result<Identified<'a>, IdentifyError> {
    let state = robust::fit(problem, start, unknowns)?;
    let lengths = robust::lengths_of(problem, &problem.residuals(&state)?);
    let limit = robust::limit(problem.records.len());
    let far_m = limit * robust::spread_m(&lengths);
    let mut in_fit: Vec<bool> = lengths.iter().map(|&length| length <= far_m).collect();
    let mut state = state;
    let mut round = 0;
    loop {
        round += 1;
        let kept: Vec<usize> = (0..in_fit.len()).filter(|&index| in_fit[index]).collect();
        let excluded: Vec<usize> = (0..in_fit.len()).filter(|&index| !in_fit[index]).collect();
        if excluded.len() as f64 > MOST_EXCLUDED * in_fit.len() as f64 {
            let (excluded, records) = (excluded.len(), in_fit.len());
            return Err(IdentifyError::TooManyOutliers { excluded, records, limit_mm: far_m * 1e3 });
        }
        let estimate = estimate(problem.subset(&kept), state, unknowns, stated)?;
        let next: Vec<bool> =
            deviations(problem, &estimate, &in_fit)?.iter().map(|&deviation| deviation <= limit).collect();
        if next == in_fit || round == ROUNDS {
            return Ok(Identified { estimate, kept, excluded });
        }
        state = estimate.fit.state;
        in_fit = next;
    }
}

/// Deviation of every record of `problem` from what the fit says of it (see [`robust::deviations`]).
///
/// # Errors
/// [`NoPose`] when the fitted model cannot place a record.
pub fn deviations(problem: &Problem<'_>, estimate: &Estimate<'_>, in_fit: &[bool]) -> Result<Vec<f64>, NoPose> {
    let mut all = problem.clone();
    for record in &mut all.records {
        record.sigma_m *= estimate.scale;
    }
    let fit = &estimate.fit;
    let residuals: DVector<f64> = all.residuals(&fit.state)?;
    let mut jacobian = all.jacobian(&fit.state, &fit.unknowns)?;
    let whitening = all.whitening();
    for mut column in jacobian.column_iter_mut() {
        column.component_mul_assign(&whitening);
    }
    Ok(robust::deviations(&all, fit, &residuals, &jacobian, in_fit))
}

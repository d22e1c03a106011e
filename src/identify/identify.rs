//! One identification: robust start, fit with its own noise level, gross errors out, until nothing changes.

use nalgebra::DVector;

use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::DOF;

use super::estimate::{Estimate, estimate};
use super::problem::{NoPose, Problem};
use super::robust;
use super::state::State;
use super::unknown::{Prior, Unknown, UnknownId};

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
    let mut physics = vec![false; in_fit.len()];
    let mut round = 0;
    loop {
        round += 1;
        let kept: Vec<usize> = (0..in_fit.len()).filter(|&index| in_fit[index]).collect();
        let estimate = estimate(problem.subset(&kept), state, unknowns, stated)?;
        let mut next: Vec<bool> = deviations(problem, &estimate, &in_fit)?
            .iter()
            .zip(&physics)
            .map(|(&deviation, &physics)| physics || deviation <= limit)
            .collect();
        let excluded: Vec<usize> = (0..in_fit.len()).filter(|&index| !next[index]).collect();
        for index in of_one_joint(problem, &estimate, &excluded)? {
            (physics[index], next[index]) = (true, true);
        }
        if next == in_fit || round == ROUNDS {
            let excluded: Vec<usize> = (0..in_fit.len()).filter(|&index| !in_fit[index]).collect();
            if excluded.len() as f64 > MOST_EXCLUDED * in_fit.len() as f64 {
                let (excluded, records) = (excluded.len(), in_fit.len());
                return Err(IdentifyError::TooManyOutliers { excluded, records, limit_mm: far_m * 1e3 });
            }
            return Ok(Identified { estimate, kept, excluded });
        }
        state = estimate.fit.state;
        in_fit = next;
    }
}

/// Fewest records, and least part of those that stand off, that make a pattern.
const PATTERN: (usize, f64) = (5, 0.5);
/// Largest turn of a joint that a drive brings about by itself, rad: a wrong reading is usually larger.
const DRIVE_RAD: f64 = 5e-3;
/// What a turn of one joint must leave at most of a deviation to explain it.
const EXPLAINED: f64 = 0.35;

/// Records that stand off because of one and the same joint: many of them, by small turns. That is physics which the
/// model lacks (play that is taken up the other way, a drive that softens), not mistakes in the recording, and leaving
/// such records out would hide it.
///
/// # Errors
/// [`NoPose`] when the fitted model cannot place a record.
pub fn of_one_joint(problem: &Problem<'_>, estimate: &Estimate<'_>, far: &[usize]) -> Result<Vec<usize>, NoPose> {
    if far.len() < PATTERN.0 {
        return Ok(Vec::new());
    }
    let state = &estimate.fit.state;
    let of_far = problem.subset(far);
    let residuals = of_far.residuals(state)?;
    let any = Prior { mean: 0.0, sigma: 1.0 };
    let zeros: Vec<Unknown> = (0..DOF)
        .map(|joint| Unknown { id: UnknownId::Model(ParameterId::Row(joint, RowQuantity::Offset)), prior: any })
        .collect();
    let levers = of_far.jacobian(state, &zeros)?;
    let firsts = of_far.first_rows();
    let explained_by = |joint: usize| -> Vec<usize> {
        let explains = |&place: &usize| {
            let miss = residuals.fixed_rows::<3>(firsts[place]).into_owned();
            let lever = levers.fixed_view::<3, 1>(firsts[place], joint).into_owned();
            let turn = lever.dot(&miss) / lever.norm_squared().max(f64::MIN_POSITIVE);
            turn.abs() < DRIVE_RAD && (miss - lever * turn).norm() < EXPLAINED * miss.norm()
        };
        (0..far.len()).filter(explains).map(|place| far[place]).collect()
    };
    let most = (0..DOF).map(explained_by).max_by_key(Vec::len).unwrap_or_default();
    let pattern = most.len() >= PATTERN.0 && most.len() as f64 >= PATTERN.1 * far.len() as f64;
    Ok(if pattern { most } else { Vec::new() })
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

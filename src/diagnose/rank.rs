//! All causes, named and unnamed, ranked by what they would explain of a projection.

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::identify::problem::NoPose;

use super::candidate::{Candidate, candidates};
use super::evidence;
use super::free::{FreeFunction, free_functions};
use super::projection::{Gain, Projection};
use super::regressors::Regressors;
use super::scan;

/// Differences of evidence that count as none.
const EQUAL: f64 = 0.02;

/// A cause with or without a name.
#[derive(Clone, Debug)]
pub enum Cause {
    /// An effect of the registry.
    Named(Candidate),
    /// Structure that no effect is known for.
    Free(FreeFunction),
}

/// A cause with its columns.
#[derive(Clone, Debug)]
pub struct Suspect {
    /// Which.
    pub cause: Cause,
    /// Its columns, whitened.
    pub columns: DMatrix<f64>,
    /// How many causes like it are looked at.
    pub looked_at: f64,
}

/// A suspect with what it explains.
#[derive(Clone, Debug)]
pub struct Ranked<'s> {
    /// Which.
    pub suspect: &'s Suspect,
    /// What it explains.
    pub gain: Gain,
    /// Evidence against it: see [`evidence::penalised`].
    pub evidence: f64,
}

/// Every suspect whose place needs no search.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn suspects(regressors: &Regressors<'_, '_>) -> Result<Vec<Suspect>, NoPose> {
    let named = candidates(regressors.model(), regressors.problem);
    let columns = regressors.columns(&named)?;
    let mut all: Vec<Suspect> =
        named.into_iter().zip(columns).map(|(candidate, columns)| Suspect::named(candidate, columns)).collect();
    let free = free_functions(regressors);
    let looked_at = evidence::looked_at(free.len() as f64);
    all.par_extend(free.into_par_iter().map(|function| {
        let columns = function.columns(regressors);
        Suspect { cause: Cause::Free(function), columns, looked_at }
    }));
    Ok(all)
}

/// The suspects whose order, moment or torque is searched for in this projection.
pub fn searched(regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Suspect> {
    scan::searched(regressors, projection)
        .into_iter()
        .map(|candidate| Suspect::through(candidate, regressors))
        .collect()
}

/// Ranks suspects, the strongest first. Named ones that need numbers which physics does not make believable are left
/// out.
pub fn rank<'s>(suspects: &[&'s Suspect], projection: &Projection) -> Vec<Ranked<'s>> {
    let mut all: Vec<Ranked<'s>> = suspects
        .par_iter()
        .copied()
        .filter_map(|suspect| {
            let (gain, evidence) = match &suspect.cause {
                Cause::Named(candidate) => {
                    let gain = projection.gain(&suspect.columns);
                    let doubt = evidence::doubt(&candidate.instances, &gain.values, &gain.sigmas)?;
                    let evidence = suspect.evidence(&gain, projection) + doubt;
                    (gain, evidence)
                }
                Cause::Free(_) => projection.smooth_gain(&suspect.columns, suspect.looked_at),
            };
            (gain.rank > 0).then_some(Ranked { suspect, gain, evidence })
        })
        .collect();
    // Equal ones stay in the order of the registry: differences below this are rounding.
    all.sort_by_key(|ranked| (ranked.evidence / EQUAL).round() as i64);
    all
}

impl Suspect {
    /// A named cause with its columns.
    pub fn named(candidate: Candidate, columns: DMatrix<f64>) -> Self {
        Self { looked_at: evidence::looked_at(candidate.places), cause: Cause::Named(candidate), columns }
    }

    /// A named cause that acts through the levers.
    pub fn through(candidate: Candidate, regressors: &Regressors<'_, '_>) -> Self {
        let columns = scan::columns_through(regressors, &candidate.instances);
        Self::named(candidate, columns)
    }

    /// Evidence against it from a gain.
    pub fn evidence(&self, gain: &Gain, projection: &Projection) -> f64 {
        let chosen = match &self.cause {
            Cause::Named(candidate) => candidate.chosen_constants,
            Cause::Free(_) => 0,
        };
        evidence::penalised(gain.explained, projection.cost, projection.rows, gain.rank + chosen, self.looked_at)
    }

    /// A projection with it free beside all else.
    #[must_use]
    pub fn beside(&self, projection: &Projection) -> Projection {
        match &self.cause {
            Cause::Named(_) => projection.with(&self.columns),
            Cause::Free(_) => projection.with_smooth(&self.columns),
        }
    }

    /// The named cause.
    pub fn candidate(&self) -> Option<&Candidate> {
        match &self.cause {
            Cause::Named(candidate) => Some(candidate),
            Cause::Free(_) => None,
        }
    }
}

//! Named physics in a calibration: found on identification and training records, judged on records that neither saw,
//! delivered with all that the calibration delivers. What has no name is left to the learner.

use crate::identify::calibrate::{Outcome, StageState};
use crate::identify::problem::{NoPose, Problem};
use crate::measure::recording::{Kind, Recording};
use crate::model::arm::EffectInstance;

use super::baseline::FEWEST_RECORDS;
use super::fitted::Ground;
use super::search::search;
use super::worth::names_are_worth_having;

/// Name of the stage.
pub const STAGE: &str = "named_physics";

/// Adds the named physics that the records show beyond geometry and compliance: a further stage, and the delivered model
/// with it. Returns what was added.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn add(outcome: &mut Outcome<'_>, recordings: &[Recording], seed: u64) -> Result<Vec<EffectInstance>, NoPose> {
    let records = outcome.to_learn_from();
    if records.len() < FEWEST_RECORDS {
        return Ok(Vec::new());
    }
    let (ground_of_names, kind) = (ground(outcome, &records), Kind::of(recordings));
    let found = search(&ground_of_names, kind, seed)?.fitted;
    if found.terms.is_empty() || !names_are_worth_having(&ground_of_names, &found, seed)? {
        return Ok(Vec::new());
    }
    let fit = &found.estimate.fit;
    let stage = StageState { name: STAGE, free: fit.unknowns.len(), trained: true, state: fit.state.clone() };
    let delivered = match outcome.fitted == records {
        true => found.estimate,
        false => ground(outcome, &outcome.fitted).fit(&found.terms)?.estimate,
    };
    outcome.problem = as_stated(outcome);
    for record in &mut outcome.problem.records {
        record.sigma_m *= delivered.scale;
    }
    outcome.delivered = delivered;
    outcome.stages.push(stage);
    Ok(found.terms.into_iter().flat_map(|term| term.instances).collect())
}

fn ground<'a>(outcome: &Outcome<'a>, records: &[usize]) -> Ground<'a> {
    Ground {
        problem: as_stated(outcome).subset(records),
        stated: outcome.sigma_stated,
        state: outcome.last_state().clone(),
        unknowns: outcome.delivered.fit.unknowns.clone(),
        ripple: None,
    }
}

/// The records with the sigmas that the calibration started from: each fit finds its own noise level.
fn as_stated<'a>(outcome: &Outcome<'a>) -> Problem<'a> {
    let mut problem = outcome.problem.clone();
    for record in &mut problem.records {
        record.sigma_m /= outcome.delivered.scale;
    }
    problem
}

//! What a diagnosis starts from: the model as given, refitted, gross errors set aside.

use crate::identify::calibrate::Refusal;
use crate::measure::observation::{Observation, SetName};
use crate::measure::recording::Recording;
use crate::model::arm::ArmModel;

use crate::identify::estimate::Estimate;
use crate::identify::gather::{Gathered, LeftOut, gather, problem_of};
use crate::identify::identifiability::selection_of;
use crate::identify::identify::{Identified, identify};
use crate::identify::problem::Problem;
use crate::identify::sanity;
use crate::identify::settle::settle;
use crate::identify::stations;
use crate::identify::unknown::{Scope, Unknown};

/// Fewest records in which anything is looked for: below, the geometry alone takes all of them.
pub const FEWEST_RECORDS: usize = 20;

/// The refitted model as given, and the records that it stands on.
#[derive(Clone, Debug)]
pub struct Baseline<'a> {
    /// All usable records.
    pub problem: Problem<'a>,
    /// True when records state their sigma.
    pub stated: bool,
    /// What is free before anything is missing: frames, rows, loop, stations, effects that the model has.
    pub unknowns: Vec<Unknown>,
    /// The fit without its gross errors.
    pub identified: Identified<'a>,
    /// Records that were not usable at all.
    pub left_out: Vec<LeftOut>,
}

impl<'a> Baseline<'a> {
    /// The fit.
    pub fn estimate(&self) -> &Estimate<'a> {
        &self.identified.estimate
    }
}

/// Refits the model as given to the records.
///
/// Effects whose parameters are all zero are off: they are taken out, and become candidates again.
///
/// # Errors
/// [`Refusal`], as for a calibration.
pub fn baseline<'a>(given: &ArmModel, recordings: &'a [Recording], seed: u64) -> Result<Baseline<'a>, Refusal> {
    let given = without_silent_effects(given);
    let Gathered { mut entries, left_out } = gather(&given, recordings);
    // Records set apart for validation are nobody's to learn from.
    entries.retain(|entry| entry.observation.set != Some(SetName::Validate));
    if entries.len() < FEWEST_RECORDS {
        return Err(Refusal::TooFewRecords { measured: entries.len() });
    }
    let grouping = stations::group(&entries, recordings);
    let reference: Vec<&Observation> =
        stations::members_of(&grouping, 0).into_iter().map(|index| entries[index].observation).collect();
    let checked = sanity::check(&given, &reference)?;
    let placed = stations::start(&given, &entries, &grouping, &checked.placement);
    let (problem, stated) = problem_of(&entries, &grouping, &given.robot, None);
    let placed = settle(&problem, placed, seed)?;
    let unknowns = selection_of(&problem, &placed.state, Scope::Everything, &placed.own_frame, seed)?.free;
    let identified = identify(&problem, placed.state, &unknowns, stated)?;
    Ok(Baseline { problem, stated, unknowns, identified, left_out })
}

fn without_silent_effects(given: &ArmModel) -> ArmModel {
    let mut model = given.clone();
    let sounding: Vec<bool> = given.parameters.effects.iter().map(|values| values.iter().any(|v| *v != 0.0)).collect();
    let mut keep = sounding.iter();
    model.effects.retain(|_| keep.next().copied().unwrap_or(false));
    let mut keep = sounding.iter();
    model.parameters.effects.retain(|_| keep.next().copied().unwrap_or(false));
    model
}

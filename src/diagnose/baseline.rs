//! What a diagnosis starts from: the model as given, refitted, gross errors set aside.

use crate::identify::calibrate::Refusal;
use crate::measure::observation::{Observation, SetName};
use crate::measure::recording::Recording;
use crate::model::arm::ArmModel;

use crate::identify::estimate::estimate;
use crate::identify::gather::{Gathered, LeftOut, gather, problem_of};
use crate::identify::identifiability::selection_of;
use crate::identify::identify::{Identified, IdentifyError, identify};
use crate::identify::problem::{NoPose, Problem};
use crate::identify::robust::limit;
use crate::identify::sanity;
use crate::identify::settle::settle;
use crate::identify::stations;
use crate::identify::unknown::{Scope, Unknown};

/// Fewest records in which anything is looked for: below, the geometry alone takes all of them.
pub const FEWEST_RECORDS: usize = 20;

/// Gross errors are few: where more than this part of the records stands off, they may be a cause that the others do not
/// show.
const CROWD: f64 = 0.05;

/// The refitted model as given, and the records that it stands on.
#[derive(Clone, Debug)]
pub struct Baseline<'a> {
    /// All usable records.
    pub problem: Problem<'a>,
    /// True when records state their sigma.
    pub stated: bool,
    /// What is free before anything is missing: frames, rows, loop, stations, effects that the model has.
    pub unknowns: Vec<Unknown>,
    /// The fit without its gross errors, or that there are too many.
    pub identified: Result<Identified<'a>, IdentifyError>,
    /// Where many records stand off: the fit to all.
    pub crowd: Option<Crowd<'a>>,
    /// Records that were not usable at all.
    pub left_out: Vec<LeftOut>,
}

/// Too many records stand off from what the others say for all of them to be mistakes.
#[derive(Clone, Debug)]
pub struct Crowd<'a> {
    /// The fit to all records.
    pub all: Identified<'a>,
    /// How many stand off.
    pub apart: usize,
    /// Standard deviation per axis of those that agree, m.
    pub agreed_sigma_m: f64,
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
    let identified = identify(&problem, placed.state.clone(), &unknowns, stated);
    let records = problem.records.len();
    let (apart, agreed_sigma_m) = match &identified {
        Ok(identified) => (identified.excluded.len(), identified.estimate.spread.sigma_m),
        Err(IdentifyError::TooManyOutliers { excluded, limit_mm, .. }) => (*excluded, limit_mm * 1e-3 / limit(records)),
        Err(IdentifyError::NoPose(error)) => return Err(error.clone().into()),
    };
    let is_crowd = apart as f64 > CROWD * records as f64;
    let crowd = is_crowd.then(|| -> Result<Crowd<'a>, NoPose> {
        let estimate = estimate(problem.clone(), placed.state, &unknowns, stated)?;
        let all = Identified { estimate, kept: (0..records).collect(), excluded: Vec::new() };
        Ok(Crowd { all, apart, agreed_sigma_m })
    });
    let crowd = crowd.transpose()?;
    Ok(Baseline { problem, stated, unknowns, identified, crowd, left_out })
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

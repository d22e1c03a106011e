//! The whole way from recordings to a model: check, place, split, identify, judge.

use crate::base::units::mm_from_m;
use crate::measure::observation::Observation;
use crate::measure::recording::Recording;
use crate::model::arm::ArmModel;

use super::estimate::{Estimate, estimate};
use super::gather::{Entry, Gathered, LeftOut, gather, problem_of};
use super::identifiability::{Selection, selection_of};
use super::identify::{Identified, IdentifyError, deviations, identify};
use super::outlier::{Scene, explain};
use super::prior::reach_m;
use super::problem::{NoPose, Problem, expected_pose};
use super::robust;
use super::sanity::{self, Misread};
use super::settle::settle;
use super::split::{Split, SplitSource, split};
use super::state::State;
use super::stations::{self, Grouping, Start};
use super::unknown::Scope;

/// What a person may decide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of everything that is drawn.
    pub seed: u64,
    /// Standard uncertainty of positions per axis, m, for records that state none.
    pub sigma_m: Option<f64>,
    /// Fit the delivered model to training records too. The stages never see them.
    pub refit_with_training: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { seed: 1, sigma_m: None, refit_with_training: true }
    }
}

/// Why there is no model.
#[derive(Clone, Debug, thiserror::Error)]
pub enum Refusal {
    /// Too few records.
    #[error("{measured} records with a measured position; at least {FEWEST_RECORDS} are needed")]
    TooFewRecords {
        /// How many there are.
        measured: usize,
    },
    /// No record to identify from.
    #[error("no record is in the `identify` or `train` set")]
    NothingToIdentifyFrom,
    /// The recording is not what it seems.
    #[error(transparent)]
    Misread(#[from] Misread),
    /// The identification failed.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// What is left is too large for this to be a model of the arm.
    #[error(
        "after identification {left_mm:.2} mm per axis are left, more than any arm of this size does: the records are not of \
         one robot with one tool, or its nominal numbers are wrong"
    )]
    DoesNotFit {
        /// Standard deviation per axis, mm.
        left_mm: f64,
    },
}

impl From<NoPose> for Refusal {
    fn from(error: NoPose) -> Self {
        Refusal::Identify(error.into())
    }
}

/// Fewest records that are fitted.
pub const FEWEST_RECORDS: usize = 10;
/// Residuals beyond this part of the reach are no model of the arm.
const LARGEST_REST: f64 = 1.5e-3;

/// One step of the stage table with its state.
#[derive(Clone, Debug)]
pub struct StageState {
    /// Its name.
    pub name: &'static str,
    /// How many numbers were free.
    pub free: usize,
    /// True when it has seen training records, not identification records alone.
    pub trained: bool,
    /// The state.
    pub state: State,
}

/// What a calibration found, before it is written down.
#[derive(Clone, Debug)]
pub struct Outcome<'a> {
    /// The nominal model with base and tool where they were placed.
    pub nominal: ArmModel,
    /// All usable records, with the sigmas of the delivered fit.
    pub problem: Problem<'a>,
    /// They again, with their files.
    pub entries: Vec<Entry<'a>>,
    /// Who may use which of them.
    pub split: Split,
    /// Stations and who belongs to which.
    pub grouping: Grouping,
    /// Stations with a frame of their own.
    pub own_frame: Vec<bool>,
    /// Nominal, frames, geometry, geometry and compliance.
    pub stages: Vec<StageState>,
    /// The delivered fit.
    pub delivered: Estimate<'a>,
    /// Indices of the records that it was fitted to.
    pub fitted: Vec<usize>,
    /// For each usable record: false when it is a gross error.
    pub sound: Vec<bool>,
    /// What was free and what was redundant.
    pub selection: Selection,
    /// Records that were not used.
    pub left_out: Vec<LeftOut>,
    /// True when records state their sigma.
    pub sigma_stated: bool,
}

impl Outcome<'_> {
    /// Sound records of the identification and training sets: those that named physics and a learner may use.
    pub fn to_learn_from(&self) -> Vec<usize> {
        let mut records: Vec<usize> = self.split.identify.iter().chain(&self.split.train).copied().collect();
        records.sort_unstable();
        records.dedup();
        records.retain(|&index| self.sound[index]);
        records
    }

    /// The state of the last stage.
    pub fn last_state(&self) -> &State {
        self.stages.last().map_or(&self.delivered.fit.state, |last| &last.state)
    }
}

/// Identifies a robot from recordings.
///
/// # Arguments
/// * `start` - the nominal arm, or a model whose values are where the fit starts
/// * `progress` - told of each step
///
/// # Errors
/// [`Refusal`] with a sentence for the person who made the recording.
pub fn calibrate<'a>(
    start: &ArmModel,
    recordings: &'a [Recording],
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<Outcome<'a>, Refusal> {
    progress("reading records");
    let Gathered { entries, mut left_out } = gather(start, recordings);
    if entries.len() < FEWEST_RECORDS {
        let mostly_impossible =
            left_out.iter().filter(|left| left.reason.code() == "impossible").count() > entries.len();
        return Err(if mostly_impossible {
            Misread::Impossible.into()
        } else {
            Refusal::TooFewRecords { measured: entries.len() }
        });
    }
    progress("placing the robot");
    let grouping = stations::group(&entries, recordings);
    let reference: Vec<&Observation> =
        stations::members_of(&grouping, 0).into_iter().map(|index| entries[index].observation).collect();
    let checked = sanity::check(start, &reference)?;
    let placed = stations::start(start, &entries, &grouping, &checked.placement);
    let nominal = placed.state.model.clone();
    let observations: Vec<&Observation> = entries.iter().map(|entry| entry.observation).collect();
    let split = split(&observations, options.seed);
    if split.identify.is_empty() {
        return Err(Refusal::NothingToIdentifyFrom);
    }
    let (problem, sigma_stated) = problem_of(&entries, &grouping, &nominal.robot, options.sigma_m);

    progress("identifying");
    let for_identification = problem.subset(&split.identify);
    let Start { own_frame, state } = settle(&for_identification, placed, options.seed)?;
    let selection = selection_of(&for_identification, &state, Scope::Everything, &own_frame, options.seed)?;
    let Identified { estimate: identified, kept, excluded } =
        identify(&for_identification, state.clone(), &selection.free, sigma_stated)?;
    check_rest(&identified, &nominal)?;
    let kept: Vec<usize> = kept.into_iter().map(|index| split.identify[index]).collect();
    let excluded: Vec<usize> = excluded.into_iter().map(|index| split.identify[index]).collect();

    progress("testing every record");
    let in_fit: Vec<bool> = (0..entries.len()).map(|index| kept.contains(&index)).collect();
    let limit = robust::limit(entries.len());
    let far = deviations(&problem, &identified, &in_fit)?;
    let sound: Vec<bool> =
        (0..entries.len()).map(|index| !excluded.contains(&index) && (in_fit[index] || far[index] <= limit)).collect();
    left_out.extend(reasons(&problem, &entries, &identified, &sound, limit)?);

    progress("fitting the stages");
    let kept_problem = problem.subset(&kept);
    let mut stages = vec![StageState { name: "nominal", free: 0, trained: false, state: state.clone() }];
    for (name, scope) in [("frames", Scope::Frames), ("geometry", Scope::Geometry)] {
        let free = selection_of(&kept_problem, &state, scope, &own_frame, options.seed)?.free;
        let fitted = estimate(kept_problem.clone(), state.clone(), &free, sigma_stated)?;
        stages.push(StageState { name, free: free.len(), trained: false, state: fitted.fit.state });
    }
    if selection.free.len() > stages.last().map_or(0, |stage| stage.free) {
        let state = identified.fit.state.clone();
        stages.push(StageState { name: "geometry_compliance", free: selection.free.len(), trained: false, state });
    }

    let fitted = records_for_delivery(&split, &sound, options);
    let delivered = if fitted == kept {
        identified
    } else {
        progress("fitting the delivered model");
        estimate(problem.subset(&fitted), identified.fit.state, &selection.free, sigma_stated)?
    };
    let mut problem = problem;
    for record in &mut problem.records {
        record.sigma_m *= delivered.scale;
    }
    Ok(Outcome {
        nominal,
        problem,
        entries,
        split,
        grouping,
        own_frame,
        stages,
        delivered,
        fitted,
        sound,
        selection,
        left_out,
        sigma_stated,
    })
}

fn check_rest(identified: &Estimate<'_>, nominal: &ArmModel) -> Result<(), Refusal> {
    if identified.spread.sigma_m > LARGEST_REST * reach_m(&nominal.robot) {
        return Err(Refusal::DoesNotFit { left_mm: mm_from_m(identified.spread.sigma_m) });
    }
    Ok(())
}

/// The gross errors with what explains them.
fn reasons(
    problem: &Problem<'_>,
    entries: &[Entry<'_>],
    identified: &Estimate<'_>,
    sound: &[bool],
    limit: f64,
) -> Result<Vec<LeftOut>, NoPose> {
    let state = &identified.fit.state;
    let arm = state.model.prepared();
    let lengths = robust::lengths_of(problem, &problem.residuals(state)?);
    let frames: Vec<_> = state.stations.iter().map(super::state::Station::pose).collect();
    let expected: Vec<_> = problem
        .records
        .iter()
        .filter_map(|record| {
            let pose = expected_pose(&arm, &frames[record.station], record.observation).ok()?;
            Some((record.observation.id.clone(), pose.translation))
        })
        .collect();
    let scene = Scene { arm: &arm, expected: &expected };
    let gross = (0..entries.len()).filter(|&index| !sound[index]);
    Ok(gross
        .map(|index| {
            let record = &problem.records[index];
            let limit_m = limit * record.sigma_m * identified.scale;
            LeftOut {
                recording: entries[index].recording,
                id: record.observation.id.clone(),
                line: record.observation.line,
                away_m: Some(lengths[index]),
                reason: explain(&scene, record.observation, &frames[record.station], limit_m),
            }
        })
        .collect())
}

/// Which records the delivered model is fitted to: identification records, training records where wanted, and all
/// records where it was the tool that held some out for its figures.
fn records_for_delivery(split: &Split, sound: &[bool], options: &Options) -> Vec<usize> {
    let mut chosen = split.identify.clone();
    if options.refit_with_training {
        chosen.extend(&split.train);
    }
    if split.source == SplitSource::Regions {
        chosen.extend(&split.validate);
    }
    chosen.sort_unstable();
    chosen.dedup();
    chosen.retain(|&index| sound[index]);
    chosen
}

//! The learner in a calibration: learned on identification and training records, judged on records that neither saw,
//! delivered with all that the calibration delivers.

use nalgebra::Vector3;

use crate::identify::calibrate::{Outcome, StageState};
use crate::identify::estimate::{Estimate, estimate, root_mean_square};
use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;

use super::choose::{Rivals, learn, learn_again};
use super::learned::Learned;
use super::paper::train;
use super::samples::Samples;
use super::subject::Subject;

/// Name of the stage.
pub const STAGE: &str = "learner";

/// Adds the learner, where held-out records say that it helps: a further stage, and the delivered model with it.
///
/// # Errors
/// [`NoPose`] when a model cannot place a record.
pub fn add(outcome: &mut Outcome<'_>, seed: u64) -> Result<Learned, NoPose> {
    let unknowns = outcome.delivered.fit.unknowns.clone();
    let records = outcome.to_learn_from();
    let identified = outcome.last_state().clone();
    let problem = outcome.problem.subset(&records);
    let mut learned = learn(&problem, (&identified, &unknowns), &Subject::Everything, Rivals::All, seed)?;
    let Some(state) = learned.state.clone() else { return Ok(learned) };
    outcome.stages.push(StageState { name: STAGE, free: unknowns.len(), trained: true, state });
    if outcome.fitted != records {
        let problem = outcome.problem.subset(&outcome.fitted);
        let identified = (&outcome.delivered.fit.state, &unknowns[..]);
        learned = learn_again(&problem, identified, &Subject::Everything, learned, seed)?;
    }
    deliver(outcome, &learned)?;
    Ok(learned)
}

/// Adds the network of the paper instead: learned on the training records alone, whatever it is worth.
///
/// The delivered model is the last stage, identified on the identification records alone, with the network.
///
/// # Errors
/// [`NoPose`] when a model cannot place a record.
pub fn add_paper_network(outcome: &mut Outcome<'_>, seed: u64) -> Result<(), NoPose> {
    let records: Vec<usize> = outcome.split.train.iter().copied().filter(|&index| outcome.sound[index]).collect();
    let problem = outcome.problem.subset(&records);
    let with_network = |mut state: State| {
        state.model.learner = Some(train(&problem, &state, seed)?.into());
        Ok(state)
    };
    // The delivered model may have seen the validation records: the stage must not.
    let identified = outcome.last_state().clone();
    let free = outcome.delivered.fit.unknowns.len();
    let state = with_network(identified)?;
    outcome.stages.push(StageState { name: "network", free, trained: true, state });
    outcome.delivered.fit.state = with_network(outcome.delivered.fit.state.clone())?;
    Ok(())
}

/// Puts the learner into the delivered estimate.
fn deliver(outcome: &mut Outcome<'_>, learned: &Learned) -> Result<(), NoPose> {
    let problem = outcome.problem.subset(&outcome.fitted);
    let Some(delivered) = with_learner(problem, &outcome.delivered, learned)? else { return Ok(()) };
    for record in &mut outcome.problem.records {
        record.sigma_m *= learned.noise_scale;
    }
    outcome.delivered = delivered;
    Ok(())
}

/// An estimate with what was learned beside it, and how sure that is; `None` where nothing was.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn with_learner<'a>(
    problem: Problem<'a>,
    before: &Estimate<'_>,
    learned: &Learned,
) -> Result<Option<Estimate<'a>>, NoPose> {
    let Some(mut state) = learned.state.clone() else { return Ok(None) };
    // The regression's own variance, which believes that it has all the functions that there are, is the least; what held-out
    // regions are missed by, whose records have less company than a fresh pose would, is the most. The mean of the two.
    let error_m2 = learned.error_m2 * 0.5 * (1.0 + learned.held_out_ratio);
    calibrate_uncertainty(&problem, &mut state, error_m2)?;
    let noise = (learned.noise_scale, learned.freedom.max(1.0));
    Ok(Some(beside_learner(problem, state, before, noise)?))
}

/// The estimate beside a learner that a state holds.
///
/// What the records leave is less than the noise by what the learner took of it: its regression knows how much that is, the fit
/// beside a fixed learner does not.
///
/// # Arguments
/// * `noise_scale`, `freedom` - factor on the records' sigmas that gives the noise which it leaves, and what is behind that
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn beside_learner<'a>(
    mut problem: Problem<'a>,
    state: State,
    before: &Estimate<'_>,
    (noise_scale, freedom): (f64, f64),
) -> Result<Estimate<'a>, NoPose> {
    for record in &mut problem.records {
        record.sigma_m *= noise_scale;
    }
    let sigma_m = root_mean_square(problem.records.iter().map(|record| record.sigma_m));
    let mut beside = estimate(problem, state, &before.fit.unknowns, true)?;
    beside.scale *= before.scale * noise_scale;
    (beside.spread.sigma_m, beside.spread.freedom) = (sigma_m, freedom);
    Ok(beside)
}

/// Scales the uncertainty of the learner so that, over the records, it adds up to the mean square error that they are expected
/// to make, m^2. Curves' own uncertainties are marginal: two that turn parallel axes share an error and undo it.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn calibrate_uncertainty(problem: &Problem<'_>, state: &mut State, error_m2: f64) -> Result<(), NoPose> {
    let samples = Samples::new(problem, state, &[])?;
    let Some(learner) = &mut state.model.learner else { return Ok(()) };
    let mut claimed_m2 = 0.0;
    for record in 0..samples.count() {
        let (angles, torques) = (&samples.actuators_rad[record], &samples.torque_nm[record]);
        let sigma = learner.sigma_rad(angles, torques, &samples.observations[record].conditions);
        let sigma_m = problem.records[record].sigma_m;
        let first = samples.rows[record];
        for (actuator, sigma) in sigma.iter().enumerate() {
            let lever = Vector3::from_fn(|axis, _| samples.levers[(first + axis, actuator)] * sigma_m);
            claimed_m2 += (lever * *sigma).norm_squared();
        }
    }
    claimed_m2 /= samples.count().max(1) as f64;
    if claimed_m2 > 0.0 {
        learner.scale_sigma((error_m2 / claimed_m2).sqrt());
    }
    Ok(())
}

//! What else the arm might do: every effect that the tool knows at every place where it can sit, and how a recording
//! would show it.

use nalgebra::DMatrix;

use crate::geometry::real::DUAL_WIDTH;
use crate::measure::observation::Observation;
use crate::model::arm::EffectInstance;
use crate::model::effect::{EFFECTS, Location, MovingFrame, Place};
use crate::model::parameters::ParameterId;
use crate::model::robot::{DOF, Robot};

use super::problem::{NoPose, Problem};
use super::state::State;
use super::unknown::{Prior, Unknown, UnknownId};

/// Moments at which a step is tried: inner parts of the recording's duration.
const MOMENTS: usize = 7;

/// Every effect at every place that the records can speak of. Effects that have an order (periodic errors) or a pair of
/// joints are left out: they are a family of their own.
pub fn effects_at_places(robot: &Robot, observations: &[&Observation]) -> Vec<EffectInstance> {
    let needed = |effect: &EffectInstance| {
        let met =
            observations.iter().filter(|record| effect.effect.meta().needs.met_by(robot, &record.conditions)).count();
        2 * met > observations.len()
    };
    EFFECTS
        .iter()
        .flat_map(|&effect| {
            let place = effect.meta().place;
            places(place, observations).into_iter().map(move |location| EffectInstance { effect, location })
        })
        .filter(needed)
        .collect()
}

fn places(place: Place, observations: &[&Observation]) -> Vec<Location> {
    let here = Location::default();
    let frames = [MovingFrame::Base, MovingFrame::Tool];
    match place {
        Place::Joint | Place::JointLaw | Place::JointOwnOrder => (0..DOF).map(Location::at_joint).collect(),
        Place::Link => (1..=DOF).map(|link| Location { link: Some(link), ..here }).collect(),
        Place::Base => vec![Location { base: Some(true), ..here }],
        Place::Payload => vec![Location { payload: Some(true), ..here }],
        Place::Clock => vec![Location { clock: Some(true), ..here }],
        Place::Frame => frames.map(|frame| Location { frame: Some(frame), ..here }).to_vec(),
        Place::FrameMoment => {
            let moments = moments_s(observations);
            frames
                .into_iter()
                .flat_map(|frame| {
                    moments.iter().map(move |&at_s| Location { frame: Some(frame), at_s: Some(at_s), ..here })
                })
                .collect()
        }
        Place::JointOrder | Place::JointPair => Vec::new(),
    }
}

fn moments_s(observations: &[&Observation]) -> Vec<f64> {
    let mut times: Vec<f64> = observations.iter().filter_map(|record| record.conditions.time_s).collect();
    times.sort_by(f64::total_cmp);
    if times.len() <= MOMENTS {
        return Vec::new();
    }
    (1..=MOMENTS).map(|part| times[part * (times.len() - 1) / (MOMENTS + 1)]).collect()
}

/// Derivatives of the residuals by each parameter of each effect, added to the model with all parameters zero: metres
/// and radians per unit, a matrix for each effect.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn effect_columns(
    problem: &Problem<'_>,
    state: &State,
    effects: &[EffectInstance],
) -> Result<Vec<DMatrix<f64>>, NoPose> {
    let count_of = |instance: &EffectInstance| instance.effect.meta().parameters.len();
    let mut all = Vec::with_capacity(effects.len());
    let mut next = 0;
    while next < effects.len() {
        // As many effects at a time as one pass carries derivatives.
        let mut end = next + 1;
        while end < effects.len() && effects[next..=end].iter().map(count_of).sum::<usize>() <= DUAL_WIDTH {
            end += 1;
        }
        let batch = &effects[next..end];
        let mut widened = state.clone();
        let mut unknowns = Vec::new();
        for instance in batch {
            let index = widened.model.effects.len();
            widened.model.effects.push(*instance);
            widened.model.parameters.effects.push(vec![0.0; count_of(instance)]);
            unknowns.extend((0..count_of(instance)).map(|parameter| Unknown {
                id: UnknownId::Model(ParameterId::Effect(index, parameter)),
                prior: Prior { mean: 0.0, sigma: 1.0 },
            }));
        }
        let columns = problem.jacobian(&widened, &unknowns)?;
        let mut first = 0;
        for instance in batch {
            all.push(columns.columns(first, count_of(instance)).into_owned());
            first += count_of(instance);
        }
        next = end;
    }
    Ok(all)
}

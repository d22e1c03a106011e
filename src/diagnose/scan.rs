//! The fine search over constants of a place: the order of a periodic error, the moment of a step.

use rayon::prelude::*;

use crate::model::arm::EffectInstance;
use crate::model::effect::{EFFECTS, Effect, Location, Place};
use crate::model::robot::DOF;

use super::candidate::{Candidate, FRAMES, is_told};
use super::evidence;
use super::free::{Variable, values};
use super::projection::Projection;
use super::regressors::Regressors;

/// Highest order: twice a harmonic drive's ratio of 101, with room.
const HIGHEST_ORDER: f64 = 212.0;
/// Points of the grid on one line's width (one over the range in revolutions): a line between two points loses 5 %.
const POINTS_ON_A_LINE: f64 = 4.0;
/// Joints that turn less than this part of a revolution show no order.
const SMALLEST_RANGE: f64 = 0.05;
/// Fewest records on either side of a step.
const FEWEST_ON_A_SIDE: usize = 8;
/// Moments tried at first.
const MOMENTS: usize = 48;
/// Rounds of narrowing an order.
const NARROWINGS: usize = 12;

/// The best order of each joint beyond what is free.
pub fn orders(regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Candidate> {
    let Some(effect) = of_place(Place::JointOrder) else { return Vec::new() };
    (0..DOF).filter_map(|joint| best_order(effect, joint, regressors, projection)).collect()
}

fn best_order(
    effect: &'static dyn Effect,
    joint: usize,
    regressors: &Regressors<'_, '_>,
    projection: &Projection,
) -> Option<Candidate> {
    let range = range(&values(regressors, Variable::Position(joint))) / std::f64::consts::TAU;
    if range < SMALLEST_RANGE {
        return None;
    }
    let explained = |order: f64| {
        let location = Location { order: Some(order), ..Location::at_joint(joint) };
        projection.gain(&regressors.through(&EffectInstance { effect, location })).explained
    };
    let step = 1.0 / (POINTS_ON_A_LINE * range);
    let count = ((HIGHEST_ORDER - 0.5) / step) as usize;
    let (best, _) = (0..count)
        .into_par_iter()
        .map(|index| 0.5 + step * index as f64)
        .map(|order| (order, explained(order)))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    let (mut low, mut high) = ((best - step).max(0.25), best + step);
    for _ in 0..NARROWINGS {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if explained(left) < explained(right) { low = left } else { high = right }
    }
    let found = 0.5 * (low + high);
    // Independent lines: two for each revolution of the range and whole order, on six joints.
    let places = DOF as f64 * (2.0 * HIGHEST_ORDER * range).max(1.0);
    let rows = projection.rows;
    let worth =
        |explained: f64, chosen: usize| evidence::penalised(explained, projection.cost, rows, 2 + chosen, places);
    let whole = found.round().max(1.0);
    let (order, chosen_constants) =
        if worth(explained(whole), 0) <= worth(explained(found), 1) { (whole, 0) } else { (rounded(found), 1) };
    let location = Location { order: Some(order), ..Location::at_joint(joint) };
    Some(Candidate { instances: vec![EffectInstance { effect, location }], places, chosen_constants })
}

/// The best moment of a step of each frame.
pub fn moments(regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Candidate> {
    let Some(effect) = of_place(Place::FrameMoment) else { return Vec::new() };
    let mut times: Vec<f64> =
        regressors.problem.records.iter().filter_map(|record| record.observation.conditions.time_s).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    if times.len() <= 2 * FEWEST_ON_A_SIDE {
        return Vec::new();
    }
    let between: Vec<f64> = times[FEWEST_ON_A_SIDE - 1..=times.len() - FEWEST_ON_A_SIDE]
        .windows(2)
        .map(|pair| 0.5 * (pair[0] + pair[1]))
        .collect();
    let stride = between.len().div_ceil(MOMENTS).max(1);
    let places = (FRAMES.len() * between.len()) as f64;
    let mut found = Vec::new();
    for frame in FRAMES {
        let instance = |at_s: f64| EffectInstance {
            effect,
            location: Location { frame: Some(frame), at_s: Some(at_s), ..Location::default() },
        };
        let best_of = |indices: Vec<usize>| {
            indices
                .into_par_iter()
                .map(|index| (index, projection.gain(&regressors.through(&instance(between[index]))).explained))
                .max_by(|a, b| a.1.total_cmp(&b.1))
        };
        let Some((coarse, _)) = best_of((0..between.len()).step_by(stride).collect()) else { continue };
        let near = coarse.saturating_sub(stride)..(coarse + stride + 1).min(between.len());
        let Some((best, _)) = best_of(near.collect()) else { continue };
        found.push(Candidate { instances: vec![instance(between[best])], places, chosen_constants: 0 });
    }
    found.retain(|candidate| {
        let known = &regressors.model().effects;
        is_told(candidate.effect(), regressors.model(), regressors.problem)
            && !known.iter().any(|known| known.location == *candidate.location())
    });
    found
}

/// The effect of the registry whose place has constants to be searched.
fn of_place(place: Place) -> Option<&'static dyn Effect> {
    EFFECTS.iter().copied().find(|effect| effect.meta().place == place)
}

fn range(values: &[f64]) -> f64 {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (high - low).max(0.0)
}

/// Two decimals: finer than any recording tells.
fn rounded(order: f64) -> f64 {
    (100.0 * order).round() / 100.0
}

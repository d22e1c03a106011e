//! The fine search over constants of a place: the order of a periodic error, the moment of a step, the torque at which a
//! drive changes its behaviour.

use nalgebra::{Complex, DMatrix};
use rayon::prelude::*;

use crate::model::arm::EffectInstance;
use crate::model::effect::{EFFECTS, Effect, Location, MovingFrame, Place, SpringLaw};
use crate::model::robot::DOF;

use super::candidate::{Candidate, FRAMES, is_told, with_companion};
use super::evidence::{self, HOPELESS};
use super::free::{Variable, values};
use super::projection::Projection;
use super::regressors::Regressors;

/// Orders that differ by less are one.
pub const SAME_ORDER: f64 = 0.1;
/// Highest order: twice the ratio of the slowest strain wave gears (1:160), with room.
const HIGHEST_ORDER: f64 = 340.0;
/// Lowest order that is searched for between whole numbers: the output's own orders are whole, and a shaft before it turns
/// several times as fast.
const LOWEST_ORDER: f64 = 3.0;
/// Points of the grid on one line's width (one over the range in revolutions): a line between two points loses 5 %.
const POINTS_ON_A_LINE: f64 = 4.0;
/// Orders up to here are asked exactly, and of the higher ones this many.
const ALL_BELOW: f64 = 12.0;
/// See [`ALL_BELOW`].
const STRONGEST: usize = 16;
/// Orders of the periodogram between two sines made anew.
const ORDERS_AT_ONCE: usize = 64;
/// Joints that turn less than this part of a revolution show no order.
const SMALLEST_RANGE: f64 = 0.05;
/// Fewest records on either side of a step.
const FEWEST_ON_A_SIDE: usize = 8;
/// Moments tried at first.
const MOMENTS: usize = 48;
/// Rounds of narrowing a constant: to a hundredth of the range.
const NARROWINGS: usize = 10;
/// Laws that explain less than this part of the best one on their grids are not narrowed.
const NEARLY: f64 = 0.8;
/// Torques at which an effect may change its behaviour.
struct Turning {
    effect: &'static str,
    law: Option<SpringLaw>,
    /// The smallest and the largest, in parts of the joint's largest torque in the recording, and the factor between two that
    /// are tried.
    low: f64,
    high: f64,
    factor: f64,
}

/// Friction holds half a per cent or nearly all; a knee below a twentieth is play, a rounded one far beyond all torques a
/// cubic law.
const TURNING_TORQUES: [Turning; 4] = [
    Turning { effect: "backlash", law: None, low: 0.005, high: 0.8, factor: 1.15 },
    Turning { effect: "joint_stiffening", law: None, low: 0.05, high: 3.0, factor: 1.3 },
    Turning { effect: "joint_stiffening", law: Some(SpringLaw::Cubic), low: 0.05, high: 3.0, factor: 1.3 },
    Turning { effect: "joint_stiffening", law: Some(SpringLaw::Knee), low: 0.05, high: 0.95, factor: 1.15 },
];

/// Times in which a drift may level off, in parts of the recording's duration: the shortest, the longest (nearly steady), and
/// the factor between two of them.
const LEVELLING: (f64, f64, f64) = (0.05, 2.0, 1.4);

/// The best candidate of each kind and joint or frame whose constant is searched for.
pub fn searched(regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Candidate> {
    let mut all = orders(regressors, projection);
    all.extend(turning_torques(regressors, projection));
    all.extend(moments(regressors, projection));
    all.extend(FRAMES.iter().filter_map(|&frame| levelling_drift(frame, regressors, projection)));
    all
}

/// The candidate with its constant searched for again; `None` for one that has none.
pub fn tuned(candidate: &Candidate, regressors: &Regressors<'_, '_>, projection: &Projection) -> Option<Candidate> {
    let (effect, location) = (candidate.effect(), candidate.location());
    let joint = location.joint_index();
    let again = match effect.meta().place {
        Place::JointOrder if candidate.chosen_constants > 0 => best_order(effect, joint?, regressors, projection),
        Place::Joint | Place::JointLaw if candidate.chosen_constants > 0 => {
            best_turning_torque(effect, joint?, regressors, projection)
        }
        Place::Frame => levelling_drift(location.frame?, regressors, projection),
        Place::FrameMoment => moments_of(effect, regressors, projection)
            .into_iter()
            .find(|found| found.location().frame == location.frame),
        _ => None,
    }?;
    // The straight part of a spring stays with it, wherever it came from.
    let mut instances = candidate.instances.clone();
    instances[0].location = *again.location();
    Some(Candidate { instances, ..again })
}

/// The best torque at which each joint's drive may change its behaviour.
fn turning_torques(regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Candidate> {
    let model = regressors.model();
    let mut found = Vec::new();
    for &effect in EFFECTS {
        let id = effect.meta().id;
        if TURNING_TORQUES.iter().all(|turning| turning.effect != id) || !is_told(effect, model, regressors.problem) {
            continue;
        }
        let known = |joint: usize| {
            model
                .effects
                .iter()
                .any(|known| known.effect.meta().id == id && known.location.joint_index() == Some(joint))
        };
        found.extend(
            (0..DOF)
                .filter(|&joint| !known(joint))
                .filter_map(|joint| best_turning_torque(effect, joint, regressors, projection)),
        );
    }
    found
}

fn best_turning_torque(
    effect: &'static dyn Effect,
    joint: usize,
    regressors: &Regressors<'_, '_>,
    projection: &Projection,
) -> Option<Candidate> {
    let largest_nm =
        values(regressors, Variable::Torque(joint)).iter().fold(0.0f64, |most, torque| most.max(torque.abs()));
    if largest_nm < SMALLEST_TORQUE_NM {
        return None;
    }
    let instances = |law: Option<SpringLaw>, share: f64| {
        let location = Location { reference: Some(share * largest_nm), law, ..Location::at_joint(joint) };
        with_companion(effect, location, regressors.model())
    };
    let explained = |law, share: f64| projection.gain(&columns_through(regressors, &instances(law, share))).explained;
    let laws: Vec<&Turning> = TURNING_TORQUES.iter().filter(|turning| turning.effect == effect.meta().id).collect();
    // Each law at each joint is a place that was looked at.
    let places = (DOF * laws.len()) as f64;
    let candidate = |law, share| Candidate { instances: instances(law, share), places, chosen_constants: 1 };
    let best_on_grid = |turning: &&Turning| {
        let &&Turning { law, low, high, factor, .. } = turning;
        let count = ((high / low).ln() / factor.ln()).ceil() as i32;
        (0..=count)
            .into_par_iter()
            .map(|step| (low * factor.powi(step)).min(high))
            .map(|share| (share, explained(law, share)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let on_grid: Vec<(&Turning, f64, f64)> =
        laws.iter().filter_map(|turning| best_on_grid(turning).map(|(share, gain)| (*turning, share, gain))).collect();
    let &(turning, share, most) = on_grid.iter().max_by(|a, b| a.2.total_cmp(&b.2))?;
    let coarse = candidate(turning.law, share);
    if evidence_against(&coarse, regressors, projection) > HOPELESS {
        return Some(coarse);
    }
    let narrowed_on = |(turning, best, _): &(&Turning, f64, f64)| {
        let &Turning { law, high, factor, .. } = *turning;
        let share = narrowed(best / factor, (best * factor).min(high), |share| explained(law, share));
        (law, share, explained(law, share))
    };
    let near = on_grid.iter().filter(|(_, _, gain)| *gain >= NEARLY * most);
    let (law, share, _) = near.map(narrowed_on).max_by(|a, b| a.2.total_cmp(&b.2))?;
    Some(candidate(law, share))
}

/// Joints that never bear more than this show no law of their torque, Nm.
const SMALLEST_TORQUE_NM: f64 = 1e-3;

/// The columns of effects that act through the levers, side by side.
pub fn columns_through(regressors: &Regressors<'_, '_>, instances: &[EffectInstance]) -> DMatrix<f64> {
    let blocks: Vec<DMatrix<f64>> = instances.iter().map(|instance| regressors.through(instance)).collect();
    super::regressors::side_by_side(&blocks, regressors.record_of.len())
}

/// Evidence against a candidate that acts through the levers, from its score step.
pub fn evidence_against(candidate: &Candidate, regressors: &Regressors<'_, '_>, projection: &Projection) -> f64 {
    let gain = projection.gain(&columns_through(regressors, &candidate.instances));
    evidence::of_candidate(candidate, &gain, projection.cost, projection.rows)
}

/// Where a function of one constant is largest, by the golden section (Kiefer 1953).
fn narrowed(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let (mut left, mut right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_left, mut at_right) = (value(left), value(right));
    for _ in 0..NARROWINGS {
        if at_left < at_right {
            (low, left, at_left) = (left, right, at_right);
            right = low + GOLDEN * (high - low);
            at_right = value(right);
        } else {
            (high, right, at_right) = (right, left, at_left);
            left = high - GOLDEN * (high - low);
            at_left = value(left);
        }
    }
    0.5 * (low + high)
}

/// The best order of each joint beyond what is free.
fn orders(regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Candidate> {
    let Some(effect) = of_place(Place::JointOrder) else { return Vec::new() };
    (0..DOF).filter_map(|joint| best_order(effect, joint, regressors, projection)).collect()
}

fn best_order(
    effect: &'static dyn Effect,
    joint: usize,
    regressors: &Regressors<'_, '_>,
    projection: &Projection,
) -> Option<Candidate> {
    let line = strongest_lines(effect, joint, 1, regressors, projection).pop()?;
    Some(if line.is_whole { line.whole } else { line.fraction })
}

/// Orders of the same joint that explain most in the place of a candidate, the strongest first, each as the whole number and
/// as the fraction that suits best; none for one without an order.
pub fn other_orders(
    candidate: &Candidate,
    most: usize,
    regressors: &Regressors<'_, '_>,
    projection: &Projection,
) -> Vec<Candidate> {
    let location = candidate.location();
    let (Some(order), Some(joint)) = (location.order, location.joint_index()) else { return Vec::new() };
    let lines = strongest_lines(candidate.effect(), joint, most + 1, regressors, projection);
    let both = lines.into_iter().flat_map(|line| [line.whole, line.fraction]);
    // A range of less than a turn does not resolve whole orders: the next ones may explain nearly as much.
    let next = [order.floor() - 1.0, order.floor(), order.ceil(), order.ceil() + 1.0];
    let next = next.into_iter().filter(|next| *next >= 1.0).map(|next| Candidate {
        instances: vec![of_order(candidate.effect(), joint, next)],
        places: candidate.places,
        chosen_constants: 0,
    });
    let apart = |found: &Candidate| found.location().order.is_some_and(|other| (other - order).abs() >= SAME_ORDER);
    both.chain(next).filter(apart).collect()
}

/// Orders between which that of a periodic candidate lies with 95 %, whole or not: those that explain no less than the best
/// one near it by more than the likelihood ratio allows (Wilks 1938). `None` for a candidate without an order.
pub fn order_interval(
    candidate: &Candidate,
    regressors: &Regressors<'_, '_>,
    projection: &Projection,
) -> Option<[f64; 2]> {
    /// Steps on a line's width to either side.
    const STEPS: i32 = 40;
    /// The 95 % point of chi squared with one degree of freedom.
    const CHI2_95: f64 = 3.841;
    let (order, joint) = (candidate.location().order?, candidate.location().joint_index()?);
    let width = std::f64::consts::TAU / range(&values(regressors, Variable::Position(joint)));
    let near: Vec<(f64, f64)> = (-STEPS..=STEPS)
        .into_par_iter()
        .map(|step| order + width * f64::from(step) / f64::from(STEPS))
        .filter(|order| *order > 0.0)
        .map(|order| {
            let columns = regressors.through(&of_order(candidate.effect(), joint, order));
            (order, projection.gain(&columns).explained)
        })
        .collect();
    let most = near.iter().map(|(_, explained)| *explained).fold(0.0, f64::max);
    let noise = (projection.cost - most).max(0.0) / (projection.rows as f64 - projection.free as f64).max(1.0);
    let agreeing = near.into_iter().filter(|(_, explained)| most - explained <= CHI2_95 * noise);
    let [low, high] =
        agreeing.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (order, _)| [low.min(order), high.max(order)]);
    let half_a_step = 0.5 * width / f64::from(STEPS);
    Some([(low - half_a_step).max(0.0), high + half_a_step])
}

fn of_order(effect: &'static dyn Effect, joint: usize, order: f64) -> EffectInstance {
    EffectInstance { effect, location: Location { order: Some(order), ..Location::at_joint(joint) } }
}

/// A line of a joint's spectrum, told in two ways.
struct Line {
    whole: Candidate,
    fraction: Candidate,
    /// True when the whole number is believed: it explains nearly as much, and nothing was chosen.
    is_whole: bool,
}

/// The lines of a joint that explain most, the strongest first.
fn strongest_lines(
    effect: &'static dyn Effect,
    joint: usize,
    most: usize,
    regressors: &Regressors<'_, '_>,
    projection: &Projection,
) -> Vec<Line> {
    let range = range(&values(regressors, Variable::Position(joint))) / std::f64::consts::TAU;
    if range < SMALLEST_RANGE {
        return Vec::new();
    }
    let explained = |order: f64| projection.gain(&regressors.through(&of_order(effect, joint, order))).explained;
    let step = 1.0 / (POINTS_ON_A_LINE * range);
    let mut asked: Vec<(f64, f64)> = worth_a_look(joint, step, regressors, projection)
        .into_par_iter()
        .map(|order| (order, explained(order)))
        .collect();
    asked.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut tops: Vec<(f64, f64)> = Vec::new();
    for (order, explained) in asked {
        if tops.len() < most && tops.iter().all(|(top, _)| (top - order).abs() >= 1.0 / range) {
            tops.push((order, explained));
        }
    }
    // Independent lines: two for each revolution of the range and whole order, on six joints.
    let places = DOF as f64 * (2.0 * HIGHEST_ORDER * range).max(1.0);
    let rows = projection.rows;
    let worth =
        |explained: f64, chosen: usize| evidence::penalised(explained, projection.cost, rows, 2 + chosen, places);
    let candidate = |order: f64, chosen_constants: usize| Candidate {
        instances: vec![of_order(effect, joint, order)],
        places,
        chosen_constants,
    };
    let line = |(top, on_grid): (f64, f64)| {
        if worth(on_grid, 1) > HOPELESS {
            return Line { whole: candidate(top.round(), 0), fraction: candidate(rounded(top), 1), is_whole: false };
        }
        let found = narrowed((top - step).max(LOWEST_ORDER), top + step, explained);
        let whole = found.round().max(1.0);
        let is_whole = worth(explained(whole), 0) <= worth(explained(found), 1);
        Line { whole: candidate(whole, 0), fraction: candidate(rounded(found), 1), is_whole }
    };
    tops.into_iter().map(line).collect()
}

/// Orders of a grid that are asked exactly: all low ones, where what is free takes most of a line away, and of the high ones
/// the strongest in the periodogram of the residuals as the joint's lever sees them.
fn worth_a_look(joint: usize, step: f64, regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<f64> {
    let angles = values(regressors, Variable::Position(joint));
    let (mut pull, mut weight) = (vec![0.0; angles.len()], vec![0.0; angles.len()]);
    for (row, &record) in regressors.record_of.iter().enumerate() {
        let lever = regressors.joints[(row, joint)];
        pull[record] += lever * projection.residuals[row];
        weight[record] += lever * lever;
    }
    let power = |turns: &[Complex<f64>]| {
        let (mut sine, mut cosine, mut ss, mut cc, mut sc) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for ((turn, pull), weight) in turns.iter().zip(&pull).zip(&weight) {
            sine += pull * turn.im;
            cosine += pull * turn.re;
            ss += weight * turn.im * turn.im;
            cc += weight * turn.re * turn.re;
            sc += weight * turn.im * turn.re;
        }
        let determinant = (ss * cc - sc * sc).max(f64::MIN_POSITIVE);
        (sine * sine * cc - 2.0 * sine * cosine * sc + cosine * cosine * ss) / determinant
    };
    let count = ((HIGHEST_ORDER - LOWEST_ORDER) / step) as usize;
    let (mut chosen, high): (Vec<f64>, Vec<f64>) =
        (0..count).map(|index| LOWEST_ORDER + step * index as f64).partition(|order| *order <= ALL_BELOW);
    let turned = |order: f64| angles.iter().map(|angle| Complex::cis(order * angle)).collect::<Vec<_>>();
    let further = turned(step);
    // A sine is turned on from order to order, and made anew now and then: rounding stays small.
    let powers = |orders: &[f64]| {
        let mut turns = orders.first().map_or_else(Vec::new, |first| turned(*first));
        let mut found = Vec::with_capacity(orders.len());
        for &order in orders {
            found.push((order, power(&turns)));
            turns.iter_mut().zip(&further).for_each(|(turn, further)| *turn *= further);
        }
        found
    };
    let mut high: Vec<(f64, f64)> = high.par_chunks(ORDERS_AT_ONCE).flat_map_iter(powers).collect();
    high.sort_by(|a, b| b.1.total_cmp(&a.1));
    chosen.extend(high.into_iter().take(STRONGEST).map(|(order, _)| order));
    chosen
}

/// The best moment of a step of each frame that has none yet.
fn moments(regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Candidate> {
    let Some(effect) = of_place(Place::FrameMoment) else { return Vec::new() };
    if !is_told(effect, regressors.model(), regressors.problem) {
        return Vec::new();
    }
    moments_of(effect, regressors, projection)
}

fn moments_of(effect: &'static dyn Effect, regressors: &Regressors<'_, '_>, projection: &Projection) -> Vec<Candidate> {
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
    found
}

/// A drift of a frame that levels off, in the time that suits the records best.
fn levelling_drift(frame: MovingFrame, regressors: &Regressors<'_, '_>, projection: &Projection) -> Option<Candidate> {
    let effect = of_place(Place::Frame)?;
    let whole_s = range(&values(regressors, Variable::Time));
    if whole_s <= 0.0 || !is_told(effect, regressors.model(), regressors.problem) {
        return None;
    }
    let instance = |part: f64| EffectInstance {
        effect,
        location: Location { frame: Some(frame), reference: Some(part * whole_s), ..Location::default() },
    };
    let explained = |part: f64| projection.gain(&regressors.through(&instance(part))).explained;
    let (shortest, longest, factor) = LEVELLING;
    let count = ((longest / shortest).ln() / factor.ln()).ceil() as i32;
    let (best, _) = (0..=count)
        .into_par_iter()
        .map(|step| shortest * factor.powi(step))
        .map(|part| (part, explained(part)))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    let candidate =
        |part| Candidate { instances: vec![instance(part)], places: FRAMES.len() as f64, chosen_constants: 1 };
    let coarse = candidate(best);
    if evidence_against(&coarse, regressors, projection) > HOPELESS {
        return Some(coarse);
    }
    Some(candidate(narrowed(best / factor, best * factor, explained)))
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

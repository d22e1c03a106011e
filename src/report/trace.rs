//! What a finding explains, record by record: the error without it and with it, against the variable that it follows.
//!
//! The error "without" is the partial residual: what the fit leaves plus the finding's own share, everything else as
//! fitted (Larsen and McCleary 1972). It shows the shape of the effect as the records have it, not as the model draws it.

use nalgebra::Vector3;
use serde::Serialize;

use crate::base::units::{deg_from_rad, mm_from_m};
use crate::diagnose::diagnosis::Unexplained;
use crate::diagnose::free::{Seat, Variable};
use crate::identify::estimate::Estimate;
use crate::identify::problem::{Record, expected_pose};
use crate::identify::state::{State, Station};
use crate::measure::observation::Observation;
use crate::model::arm::EffectInstance;
use crate::model::effect::{Follows, Location};
use crate::model::learner::Learner;
use crate::model::linkage::{actuators_from_numbers, numbers_from_actuators};

/// A cloud of points for a plot. Empty where the model cannot place the records.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Trace {
    /// What the error is drawn against, with its unit.
    pub against: String,
    /// What is drawn, with its unit.
    pub error: String,
    /// The points.
    pub points: Vec<TracePoint>,
}

/// A point of a trace.
#[derive(Clone, Debug, Serialize)]
pub struct TracePoint {
    /// The record's name.
    pub id: String,
    /// The variable.
    pub x: f64,
    /// The error without the finding.
    pub before: f64,
    /// The error with it.
    pub after: f64,
    /// The sense of approach, for effects that follow it: -1, 0, +1.
    pub sense: i8,
}

/// Points of a joint whose lever is below this share of the usual one show nothing of its angle.
const SHORT_LEVER: f64 = 0.3;

/// The trace of an effect that the fitted model holds.
pub fn trace(estimate: &Estimate<'_>, instance: &EffectInstance) -> Trace {
    let state = &estimate.fit.state;
    let Some(without) = state_without(state, instance) else { return Trace::default() };
    let meta = instance.effect.meta();
    // `None`: nothing single; then it is drawn against what the finding itself says of each coordinate.
    let variable = variable_of(meta.follows, &instance.location, &estimate.problem.records);
    let at_joint = meta.place.turns_its_joint().then(|| instance.location.joint_index()).flatten();
    let parts = parts(estimate, &without, at_joint);
    let senses = meta.needs.approach.then(|| instance.location.joint_index()).flatten();
    let mut points = match (at_joint, variable) {
        (Some(_), _) => angles(&parts),
        (None, None) => coordinates(&parts),
        (None, Some(_)) => along_movement(&parts),
    };
    for point in &mut points {
        let record = parts[point.record].record;
        if let Some(variable) = variable {
            point.x = value(variable, state, record.observation).unwrap_or(f64::NAN);
        }
        point.sense = senses.map_or(0, |joint| record.observation.conditions.approach[joint] as i8);
    }
    finished(&parts, points, variable, at_joint)
}

/// What is left at the seat of structure without a name, against each variable that it depends on.
pub fn unexplained_traces(estimate: &Estimate<'_>, unexplained: &Unexplained) -> Vec<Trace> {
    let Some(first) = unexplained.functions.first() else { return Vec::new() };
    let joint = match first.seat {
        Seat::Joint(joint) => Some(joint),
        Seat::Base | Seat::Tool | Seat::Tracker(_) => None,
    };
    let state = &estimate.fit.state;
    let parts = parts(estimate, state, joint);
    let trace = |variable: Variable| {
        let mut points = match joint {
            Some(_) => angles(&parts),
            None => lengths(&parts),
        };
        for point in &mut points {
            point.x = value(variable, state, parts[point.record].record.observation).unwrap_or(f64::NAN);
        }
        finished(&parts, points, Some(variable), joint)
    };
    first.variables.iter().copied().map(trace).collect()
}

fn finished(parts: &[Part<'_>], points: Vec<Point>, variable: Option<Variable>, joint: Option<usize>) -> Trace {
    Trace {
        against: words(variable),
        error: match joint {
            Some(joint) => format!("angle error of joint {}, mrad", joint + 1),
            None => "error, mm".into(),
        },
        points: points
            .into_iter()
            .map(|point| TracePoint {
                id: parts[point.record].record.observation.id.clone(),
                x: point.x,
                before: point.before,
                after: point.after,
                sense: point.sense,
            })
            .collect(),
    }
}

/// The state without one of its effects, or without the curve that a joint of many lines has in their place; `None` where it
/// holds neither.
fn state_without(state: &State, instance: &EffectInstance) -> Option<State> {
    let same = |other: &EffectInstance| {
        other.effect.meta().id == instance.effect.meta().id && other.location == instance.location
    };
    let mut without = state.clone();
    if let Some(index) = state.model.effects.iter().position(same) {
        without.model.parameters.effects.get_mut(index)?.fill(0.0);
        return Some(without);
    }
    let joint = instance.location.joint?;
    let Some(Learner::Curves(curves)) = &mut without.model.learner else { return None };
    let before = curves.curves.len();
    curves.curves.retain(|curve| curve.turns != joint);
    (curves.curves.len() < before).then_some(without)
}

fn variable_of(follows: Follows, at: &Location, records: &[Record<'_>]) -> Option<Variable> {
    let joint = at.joint_index().unwrap_or(0);
    let warm = records.iter().any(|record| record.observation.conditions.temperature_c.is_some());
    Some(match follows {
        Follows::OwnPosition => Variable::Position(joint),
        Follows::SourcePosition => Variable::Position(at.source_index().unwrap_or(joint)),
        Follows::OwnTorque => Variable::Torque(joint),
        Follows::OwnSpeed => Variable::Speed(joint),
        Follows::OwnAcceleration => Variable::Acceleration(joint),
        Follows::Warmth if warm => Variable::Temperature,
        Follows::Warmth | Follows::Time => Variable::Time,
        Follows::Several => return None,
    })
}

fn words(variable: Option<Variable>) -> String {
    let Some(variable) = variable else { return "what the finding says, per coordinate, mm".into() };
    match variable {
        Variable::Approach(joint) => format!("sense of approach of joint {}", joint + 1),
        Variable::Position(joint) => format!("joint {}, deg", joint + 1),
        Variable::Torque(joint) => format!("load torque of joint {}, Nm", joint + 1),
        Variable::Speed(joint) => format!("speed of joint {}, deg/s", joint + 1),
        Variable::Acceleration(joint) => format!("acceleration of joint {}, deg/s\u{b2}", joint + 1),
        Variable::Time => "time, s".into(),
        Variable::Temperature => "temperature, \u{b0}C".into(),
        Variable::Beam(_) => "direction of the beam, deg".into(),
    }
}

fn value(variable: Variable, state: &State, observation: &Observation) -> Option<f64> {
    let arm = state.model.prepared();
    let stand = arm.at(&observation.numbers_rad, &observation.conditions, None).ok()?;
    let value = variable.value(&arm, &stand, &observation.conditions)?;
    Some(if variable.is_angular() { deg_from_rad(value) } else { value })
}

/// What is known of a record, all in its station's frame, m.
struct Part<'a> {
    record: Record<'a>,
    /// Measured minus modelled.
    left: Vector3<f64>,
    /// With the finding minus without it.
    said: Vector3<f64>,
    /// Movement per radian of the finding's joint.
    lever: Vector3<f64>,
}

fn parts<'a>(estimate: &Estimate<'a>, without: &State, joint: Option<usize>) -> Vec<Part<'a>> {
    let state = &estimate.fit.state;
    let (with, bare) = (state.model.prepared(), without.model.prepared());
    let stations: Vec<_> = state.stations.iter().map(Station::pose).collect();
    let part = |record: &Record<'a>| {
        let station = stations.get(record.station)?;
        let here = expected_pose(&with, station, record.observation).ok()?.translation;
        let there = expected_pose(&bare, station, record.observation).ok()?.translation;
        let lever = match joint {
            Some(joint) => {
                const STEP_RAD: f64 = 1e-5;
                let mut turned = record.observation.clone();
                let robot = &state.model.robot;
                let mut drives_rad = actuators_from_numbers(robot, &turned.numbers_rad);
                drives_rad[joint] += STEP_RAD;
                turned.numbers_rad = numbers_from_actuators(robot, &drives_rad);
                (expected_pose(&with, station, &turned).ok()?.translation - here) / STEP_RAD
            }
            None => Vector3::zeros(),
        };
        Some(Part { record: *record, left: record.measured.position_m - here, said: here - there, lever })
    };
    estimate.problem.records.iter().filter_map(part).collect()
}

/// A point whose variable is still to come.
struct Point {
    record: usize,
    x: f64,
    before: f64,
    after: f64,
    sense: i8,
}

fn point(record: usize, x: f64, said: f64, left: f64) -> Point {
    Point { record, x, before: said + left, after: left, sense: 0 }
}

/// Errors as angles of the joint, mrad.
fn angles(parts: &[Part<'_>]) -> Vec<Point> {
    let usual = (parts.iter().map(|part| part.lever.norm_squared()).sum::<f64>() / parts.len().max(1) as f64).sqrt();
    parts
        .iter()
        .enumerate()
        .filter(|(_, part)| part.lever.norm() > SHORT_LEVER * usual)
        .map(|(index, part)| {
            let along = part.lever * (1e3 / part.lever.norm_squared());
            point(index, 0.0, along.dot(&part.said), along.dot(&part.left))
        })
        .collect()
}

/// What is left, as lengths, mm.
fn lengths(parts: &[Part<'_>]) -> Vec<Point> {
    let of_part = |(index, part): (usize, &Part<'_>)| point(index, 0.0, 0.0, mm_from_m(part.left.norm()));
    parts.iter().enumerate().map(of_part).collect()
}

/// Every coordinate against what the finding says of it, mm.
fn coordinates(parts: &[Part<'_>]) -> Vec<Point> {
    let of_part = |(index, part): (usize, &Part<'_>)| {
        let (said, left) = (part.said.map(mm_from_m), part.left.map(mm_from_m));
        [0, 1, 2].map(|axis| point(index, said[axis], said[axis], left[axis]))
    };
    parts.iter().enumerate().flat_map(of_part).collect()
}

/// Errors along the finding's own movement, mm; where it does not move, along its mean direction.
fn along_movement(parts: &[Part<'_>]) -> Vec<Point> {
    let mean = parts.iter().map(|part| part.said).sum::<Vector3<f64>>();
    parts
        .iter()
        .enumerate()
        .filter_map(|(index, part)| {
            let own = part.said.try_normalize(1e-12).or_else(|| mean.try_normalize(1e-12))?;
            // One sense throughout: a movement that turns back is drawn as negative.
            let direction = if own.dot(&mean) < 0.0 { -own } else { own };
            let along = |v: &Vector3<f64>| mm_from_m(direction.dot(v));
            Some(point(index, 0.0, along(&part.said), along(&part.left)))
        })
        .collect()
}

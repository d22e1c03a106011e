//! The program's own sequence of targets: which solution the controller takes at each, and from which side every joint
//! comes there.

use std::borrow::Cow;

use nalgebra::Vector6;

use crate::geometry::pose::{Pose, pose_difference};
use crate::kinematics::choose::Wish;
use crate::kinematics::controller::Controller;
use crate::model::robot::DOF;
use crate::program::target::{Configuration, PathKind, Program, TargetValue};

use super::class::{Class, class_by_value};
use super::setting::{Obstacle, Setting, Settings};

/// One arrival at a target.
#[derive(Clone, Debug)]
pub struct Visit {
    /// The target.
    pub target: usize,
    /// Which of its uses.
    pub one_use: usize,
    /// The tool, frame and load there.
    pub setting: usize,
    /// Joint numbers that the controller commands for the target as written, rad, or what is in the way.
    pub nominal_rad: Result<[f64; DOF], Obstacle>,
    /// The written target in its frame; identity for joint targets.
    pub written: Pose,
}

/// Turn, rad, below which a joint counts as not having moved (per metre of line, on a line).
const STILL_RAD: f64 = 1e-7;

/// Follows the program through its static moves, in the order in which they stand in the text.
pub fn follow(program: &Program, settings: &mut Settings<'_>, controller: &Controller) -> Vec<Visit> {
    let mut arrivals: Vec<(usize, usize)> = Vec::new();
    for (index, target) in program.targets.iter().enumerate() {
        let (class, _) = class_by_value(target);
        if class == Class::Corrected || class == Class::Joint {
            let moves = target.uses.iter().enumerate().filter(|(_, one)| one.computed.is_none());
            arrivals.extend(moves.map(|(one_use, _)| (index, one_use)));
        }
    }
    arrivals.sort_by_key(|&(target, one_use)| {
        let one = &program.targets[target].uses[one_use];
        (one.file, one.span.start, one.path == PathKind::ArcEnd, target)
    });

    let mut visits = Vec::with_capacity(arrivals.len());
    let mut previous: Option<[f64; DOF]> = None;
    for (target, one_use) in arrivals {
        let one = &program.targets[target].uses[one_use];
        let setting = settings.of(one);
        let here = settings.at(setting, &program.targets[target]);
        let (written, nominal_rad) = arrive(program, target, &here, controller, previous);
        previous = nominal_rad.as_ref().ok().copied().or(previous);
        visits.push(Visit { target, one_use, setting, nominal_rad, written });
    }
    visits
}

/// The sense in which each joint comes to each visit, when the arm stands at `numbers` there: -1, 0 (unknown), +1. A
/// joint that does not move keeps the sense that it had; visits without numbers are passed over.
pub fn senses(
    program: &Program,
    controller: &Controller,
    visits: &[Visit],
    numbers: impl Fn(usize) -> Option<[f64; DOF]>,
) -> Vec<[f64; DOF]> {
    let mut sense = [0.0; DOF];
    let mut previous: Option<[f64; DOF]> = None;
    let mut all = Vec::with_capacity(visits.len());
    for (index, visit) in visits.iter().enumerate() {
        if let Some(here) = numbers(index) {
            if let Some(last) = &previous {
                let path = program.targets[visit.target].uses[visit.one_use].path;
                let way = arriving(controller, path, last, &here);
                sense = std::array::from_fn(|joint| match way[joint].abs() < STILL_RAD {
                    true => sense[joint],
                    false => way[joint].signum(),
                });
            }
            previous = Some(here);
        }
        all.push(sense);
    }
    all
}

fn arrive(
    program: &Program,
    target: usize,
    setting: &Result<Cow<'_, Setting>, Obstacle>,
    controller: &Controller,
    previous: Option<[f64; DOF]>,
) -> (Pose, Result<[f64; DOF], Obstacle>) {
    let target = &program.targets[target];
    if let TargetValue::Joint(numbers) = &target.value {
        let numbers_rad = numbers.numbers_rad();
        let within = match controller.robot().limit_violation(&numbers_rad, LIMIT_SLACK_RAD) {
            None => Ok(numbers_rad),
            Some(violation) => Err(Obstacle::refused(violation.to_string())),
        };
        return (Pose::identity(), within);
    }
    let Some(written) = written_pose(program, &target.value) else {
        return (Pose::identity(), Err(Obstacle::refused("its numbers make no pose")));
    };
    let setting = match setting {
        Ok(setting) => setting,
        Err(obstacle) => return (written, Err(obstacle.clone())),
    };
    let flange = setting.nominal_flange(&written);
    let distance_m = flange.translation.norm();
    if distance_m.is_nan() || distance_m > FARTHEST_M {
        return (written, Err(Obstacle::refused("out of reach: its numbers are no place on earth")));
    }
    match controller.solve(&flange, &wish(&target.configuration), previous.as_ref()) {
        Ok(choice) => (written, Ok(choice.numbers_rad)),
        Err(error) => (written, Err(Obstacle::refused(error.to_string()))),
    }
}

/// Whatever stands farther away is a slip of the pen; squares of its numbers would leave what a double holds.
const FARTHEST_M: f64 = 1e7;

/// A joint target at its limit is written with rounded degrees.
const LIMIT_SLACK_RAD: f64 = 1e-4;

/// The pose that the text means, in its frame: for a displacement, of the displaced target.
pub fn written_pose(program: &Program, value: &TargetValue) -> Option<Pose> {
    match value {
        TargetValue::Cartesian(numbers) => numbers.pose(),
        TargetValue::Displaced(displacement) => {
            let TargetValue::Cartesian(base) = &program.targets.get(displacement.base)?.value else {
                return None;
            };
            Some(super::displaced::displaced(&base.pose()?, displacement))
        }
        TargetValue::Joint(_) | TargetValue::Counts | TargetValue::Unwritten => None,
    }
}

fn wish(configuration: &Configuration) -> Wish {
    let mut intervals_rad = [None; DOF];
    for &(joint, min_deg, max_deg) in &configuration.joint_intervals_deg {
        if let Some(interval) = intervals_rad.get_mut(joint) {
            *interval = Some((min_deg.to_radians(), max_deg.to_radians()));
        }
    }
    Wish {
        intervals_rad,
        rear: configuration.rear,
        elbow_down: configuration.elbow_down,
        wrist_negative: configuration.wrist_negative,
        near_rad: configuration.near_joints_deg.map(|joints| joints.map(f64::to_radians)),
        ..Wish::default()
    }
}

/// Which way the joints go as they arrive. Along a line that is their speed at the end of the line, not their way: a
/// joint can turn back on a line.
fn arriving(controller: &Controller, path: PathKind, last: &[f64; DOF], here: &[f64; DOF]) -> [f64; DOF] {
    let way: [f64; DOF] = std::array::from_fn(|joint| here[joint] - last[joint]);
    match path {
        PathKind::Linear | PathKind::ArcVia | PathKind::ArcEnd => speed_at_end(controller, last, here).unwrap_or(way),
        PathKind::Joint | PathKind::Other => way,
    }
}

/// Joint speeds with which a straight line arrives, per length of the line.
fn speed_at_end(controller: &Controller, last: &[f64; DOF], here: &[f64; DOF]) -> Option<[f64; DOF]> {
    let (from, to) = (controller.forward(last).ok()?, controller.forward(here).ok()?);
    let jacobian = controller.jacobian(here).ok()?;
    let (shift, turn) = pose_difference(&to, &from);
    let twist = Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z);
    let speed = jacobian.lu().solve(&twist)?;
    speed.iter().all(|s| s.is_finite()).then(|| speed.into())
}

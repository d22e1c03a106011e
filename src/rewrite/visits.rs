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

/// One arrival at a target. Large programs have millions of them: numbers of things are kept in four bytes.
#[derive(Clone, Debug)]
pub struct Visit {
    target: u32,
    one_use: u32,
    setting: u32,
    /// Joint numbers that the controller commands for the target as written, rad, or what is in the way.
    pub nominal_rad: Result<[f64; DOF], Box<Obstacle>>,
}

impl Visit {
    /// The target.
    pub fn target(&self) -> usize {
        self.target as usize
    }

    /// Which of its uses.
    pub fn one_use(&self) -> usize {
        self.one_use as usize
    }

    /// The tool, frame and load there.
    pub fn setting(&self) -> usize {
        self.setting as usize
    }

    /// The joint numbers, where there are any, rad.
    pub fn numbers_rad(&self) -> Option<[f64; DOF]> {
        self.nominal_rad.as_ref().ok().copied()
    }
}

/// The sense in which each joint comes to a visit: -1, 0 (unknown or both), +1.
pub type Senses = [i8; DOF];

/// Turn, rad, below which a joint counts as not having moved (per metre of line, on a line).
const STILL_RAD: f64 = 1e-7;

/// Follows the program through its static moves, in the order in which they stand in the text.
pub fn follow(program: &Program, settings: &mut Settings<'_>, controller: &Controller) -> Vec<Visit> {
    let mut arrivals: Vec<(u32, u32)> = Vec::new();
    for (index, target) in (0u32..).zip(&program.targets) {
        let (class, _) = class_by_value(target);
        if class == Class::Corrected || class == Class::Joint {
            let moves = (0u32..).zip(&target.uses).filter(|(_, one)| one.computed.is_none());
            arrivals.extend(moves.map(|(one_use, _)| (index, one_use)));
        }
    }
    arrivals.sort_by_key(|&(target, one_use)| {
        let one = &program.targets[target as usize].uses[one_use as usize];
        (one.file, one.span.start, one.path == PathKind::ArcEnd, target)
    });

    let mut visits = Vec::with_capacity(arrivals.len());
    let mut previous: Option<[f64; DOF]> = None;
    for (target, one_use) in arrivals {
        let one = &program.targets[target as usize].uses[one_use as usize];
        let setting = settings.of(one);
        let here = settings.at(setting, &program.targets[target as usize]);
        let nominal_rad = arrive(program, target as usize, &here, controller, previous).map_err(Box::new);
        previous = nominal_rad.as_ref().ok().copied().or(previous);
        visits.push(Visit { target, one_use, setting: setting as u32, nominal_rad });
    }
    visits
}

/// The sense in which each joint comes to each visit, when the arm stands at `numbers` there. A joint that does not move
/// keeps the sense that it had; visits without numbers are passed over.
pub fn senses(
    program: &Program,
    controller: &Controller,
    visits: &[Visit],
    numbers: impl Fn(&Visit) -> Option<[f64; DOF]>,
) -> Vec<Senses> {
    let mut sense = [0; DOF];
    let mut previous: Option<[f64; DOF]> = None;
    let mut all = Vec::with_capacity(visits.len());
    for visit in visits {
        if let Some(here) = numbers(visit) {
            if let Some(last) = &previous {
                let path = program.targets[visit.target()].uses[visit.one_use()].path;
                let way = arriving(controller, path, last, &here);
                sense = std::array::from_fn(|joint| match way[joint].abs() < STILL_RAD {
                    true => sense[joint],
                    false => way[joint].signum() as i8,
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
) -> Result<[f64; DOF], Obstacle> {
    let target = &program.targets[target];
    if let TargetValue::Joint(numbers) = &target.value {
        let numbers_rad = numbers.numbers_rad();
        return match controller.robot().limit_violation(&numbers_rad, LIMIT_SLACK_RAD) {
            None => Ok(numbers_rad),
            Some(violation) => Err(Obstacle::refused(violation.to_string())),
        };
    }
    let written = written_pose(program, &target.value).ok_or_else(|| Obstacle::refused("its numbers make no pose"))?;
    let flange = setting.as_ref().map_err(Obstacle::clone)?.nominal_flange(&written);
    let distance_m = flange.translation.norm();
    if distance_m.is_nan() || distance_m > FARTHEST_M {
        return Err(Obstacle::refused("out of reach: its numbers are no place on earth"));
    }
    let choice = controller.solve(&flange, &wish(&target.configuration), previous.as_ref());
    choice.map(|choice| choice.numbers_rad).map_err(|error| Obstacle::refused(error.to_string()))
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

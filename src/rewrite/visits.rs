//! The program's own sequence of targets: which solution the controller takes at each, and from which side every joint
//! comes there.

use nalgebra::Vector6;

use crate::geometry::pose::{Pose, pose_difference};
use crate::kinematics::choose::Wish;
use crate::kinematics::controller::Controller;
use crate::model::robot::DOF;
use crate::program::target::{Configuration, PathKind, Program, TargetValue};

use super::class::{Class, class_by_text};
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
    /// Sense in which each joint arrives: -1, 0 (unknown or both), +1.
    pub approach: [f64; DOF],
}

/// Turn, rad, below which a joint counts as not having moved.
const STILL_RAD: f64 = 1e-7;

/// Follows the program through its static moves, in the order in which they stand in the text.
pub fn follow(
    program: &Program,
    settings: &mut Settings<'_>,
    controller: &Controller,
    joint_targets: bool,
) -> Vec<Visit> {
    let mut arrivals: Vec<(usize, usize)> = Vec::new();
    for (index, target) in program.targets.iter().enumerate() {
        let (class, _) = class_by_text(target);
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
    let mut previous: Option<([f64; DOF], Pose)> = None;
    let mut approach = [0.0; DOF];
    for (target, one_use) in arrivals {
        let one = &program.targets[target].uses[one_use];
        let setting = settings.of(one);
        let resolved = settings.get(setting).clone();
        let before = previous.map(|(numbers, _)| numbers);
        let (written, nominal_rad) = arrive(program, target, &resolved, controller, before);
        if let (Ok(numbers), Ok(flange)) = (&nominal_rad, nominal_rad.as_ref().map(|q| controller.forward(q))) {
            let flange = flange.unwrap_or_else(|_| Pose::identity());
            if let Some((last, last_flange)) = &previous {
                approach = senses(controller, one.path, last, last_flange, numbers, &flange, &approach);
            }
            previous = Some((*numbers, flange));
        }
        let stands_still = class_by_text(&program.targets[target]).0 == Class::Joint && !joint_targets;
        let nominal_rad =
            if stands_still { Err(Obstacle { class: Class::Joint, reason: String::new() }) } else { nominal_rad };
        visits.push(Visit { target, one_use, setting, nominal_rad, written, approach });
    }
    visits
}

fn arrive(
    program: &Program,
    target: usize,
    setting: &Result<Setting, Obstacle>,
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
    let branches = controller.inverse(&flange);
    let choice =
        branches.and_then(|branches| controller.choose(&branches, &wish(&target.configuration), previous.as_ref()));
    match choice {
        Ok(choice) => (written, Ok(choice.numbers_rad)),
        Err(error) => (written, Err(Obstacle::refused(error.to_string()))),
    }
}

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
        TargetValue::Joint(_) | TargetValue::Unwritten => None,
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

/// The sense in which each joint arrives. Along a line it is that of the joint's speed at the end of the line, not of
/// its way: a joint can turn back on a line.
fn senses(
    controller: &Controller,
    path: PathKind,
    last: &[f64; DOF],
    last_flange: &Pose,
    numbers: &[f64; DOF],
    flange: &Pose,
    known: &[f64; DOF],
) -> [f64; DOF] {
    let way: [f64; DOF] = std::array::from_fn(|joint| numbers[joint] - last[joint]);
    let arriving = match path {
        PathKind::Linear | PathKind::ArcVia | PathKind::ArcEnd => {
            speed_at_end(controller, numbers, last_flange, flange).unwrap_or(way)
        }
        PathKind::Joint | PathKind::Other => way,
    };
    std::array::from_fn(|joint| if arriving[joint].abs() < STILL_RAD { known[joint] } else { arriving[joint].signum() })
}

/// Joint speeds with which a straight line arrives, per length of the line.
fn speed_at_end(controller: &Controller, numbers: &[f64; DOF], from: &Pose, to: &Pose) -> Option<[f64; DOF]> {
    let jacobian = controller.jacobian(numbers).ok()?;
    let (shift, turn) = pose_difference(to, from);
    let twist = Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z);
    let speed = jacobian.lu().solve(&twist)?;
    speed.iter().all(|s| s.is_finite()).then(|| speed.into())
}

//! Full turns of the joints: the same pose at numbers that differ by 360 degrees.

use std::f64::consts::{PI, TAU};

use crate::geometry::orientation::angle_near;
use crate::model::robot::{DOF, LOOP_DRIVEN, Robot};

/// Numbers this far outside a limit still count as inside, rad: a pose taught at a limit is written with few decimals.
pub const LIMIT_SLACK_RAD: f64 = 1e-4;
/// More turns than this of one joint are not tried: unlimited joints have no end of them.
const MOST_TURNS: f64 = 8.0;

/// Where full turns of the joints should come to lie.
#[derive(Clone, Copy, Debug)]
pub struct Preference {
    /// Numbers that should be near, rad.
    pub near_rad: [f64; DOF],
    /// Intervals that numbers should lie in, rad.
    pub intervals_rad: [Option<(f64, f64)>; DOF],
}

/// Turns joints by whole turns, one after the other in an order in which each number that another one counts in is
/// known before.
#[derive(Clone, Copy, Debug)]
pub struct TurnPlacer {
    order: [usize; DOF],
}

impl TurnPlacer {
    /// The order for this robot's couplings.
    pub fn new(robot: &Robot) -> Self {
        let mut order = [0; DOF];
        let mut placed = [false; DOF];
        for place in &mut order {
            let ready = |&joint: &usize| {
                let waits = robot.couplings.iter().any(|coupling| coupling.joint == joint && !placed[coupling.by]);
                !placed[joint] && !waits
            };
            // Displays that count in each other have no such order: then any joint that is left.
            let next = (0..DOF).find(ready).or_else(|| (0..DOF).find(|&joint| !placed[joint])).unwrap_or(0);
            placed[next] = true;
            *place = next;
        }
        Self { order }
    }

    /// Numbers for these actuator angles, each in the turn that lies inside the limits, inside its interval and near
    /// what is preferred, in this order of weight.
    pub fn place(&self, robot: &Robot, actuators_rad: &[f64; DOF], preference: &Preference) -> [f64; DOF] {
        let mut numbers = *actuators_rad;
        for &joint in &self.order {
            let number = own_number(robot, actuators_rad, &numbers, joint);
            let limits = &robot.joints[joint];
            let wanted = nearest_in(preference.near_rad[joint], limits.min_rad, limits.max_rad);
            let nearest = if (number - wanted).abs() <= PI { number } else { angle_near(number, wanted) };
            let looped = joint == LOOP_DRIVEN && robot.parallelogram.is_some();
            let allowed = nearest >= limits.min_rad && nearest <= limits.max_rad;
            if allowed && !looped && preference.intervals_rad[joint].is_none() {
                numbers[joint] = nearest;
                continue;
            }
            let mut best = (f64::INFINITY, number);
            let mut consider = |center: f64| {
                let nearest = angle_near(number, center);
                for candidate in [nearest, nearest - TAU, nearest + TAU] {
                    let cost = self.cost(robot, &numbers, joint, candidate, preference);
                    if cost < best.0 {
                        best = (cost, candidate);
                    }
                }
            };
            consider(wanted);
            if let Some((from, to)) = preference.intervals_rad[joint] {
                consider(nearest_in(wanted, from, to));
                if (to - from).is_finite() {
                    consider(0.5 * (from + to));
                }
            }
            numbers[joint] = best.1;
        }
        numbers
    }

    fn cost(&self, robot: &Robot, numbers: &[f64; DOF], joint: usize, candidate: f64, preference: &Preference) -> f64 {
        let limits = &robot.joints[joint];
        let mut forbidden = outside(candidate, limits.min_rad - LIMIT_SLACK_RAD, limits.max_rad + LIMIT_SLACK_RAD);
        if let (LOOP_DRIVEN, Some(rods)) = (joint, &robot.parallelogram) {
            let mut standing = *numbers;
            standing[joint] = candidate;
            let passive = robot.passive_rad(&standing);
            forbidden +=
                outside(passive, rods.passive_min_rad - LIMIT_SLACK_RAD, rods.passive_max_rad + LIMIT_SLACK_RAD);
        }
        let unwanted = preference.intervals_rad[joint].map_or(0.0, |(from, to)| outside(candidate, from, to));
        1e6 * forbidden + 1e3 * unwanted + (candidate - preference.near_rad[joint]).abs()
    }

    /// Calls `each` with every combination of full turns that the limits allow.
    pub fn each(&self, robot: &Robot, actuators_rad: &[f64; DOF], each: &mut impl FnMut([f64; DOF])) {
        self.each_from(robot, actuators_rad, 0, *actuators_rad, each);
    }

    fn each_from(
        &self,
        robot: &Robot,
        actuators_rad: &[f64; DOF],
        placed: usize,
        mut numbers: [f64; DOF],
        each: &mut impl FnMut([f64; DOF]),
    ) {
        let Some(&joint) = self.order.get(placed) else {
            if robot.limit_violation(&numbers, LIMIT_SLACK_RAD).is_none() {
                each(numbers);
            }
            return;
        };
        let limits = &robot.joints[joint];
        let number = own_number(robot, actuators_rad, &numbers, joint);
        let lowest = ((limits.min_rad - LIMIT_SLACK_RAD - number) / TAU).ceil().max(-MOST_TURNS);
        let highest = ((limits.max_rad + LIMIT_SLACK_RAD - number) / TAU).floor().min(MOST_TURNS);
        let mut turn = lowest;
        while turn <= highest {
            numbers[joint] = number + turn * TAU;
            self.each_from(robot, actuators_rad, placed + 1, numbers, each);
            turn += 1.0;
        }
    }
}

/// The number of one joint, given the numbers that count in it.
fn own_number(robot: &Robot, actuators_rad: &[f64; DOF], numbers: &[f64; DOF], joint: usize) -> f64 {
    let mut number = actuators_rad[joint];
    for coupling in robot.couplings.iter().filter(|coupling| coupling.joint == joint) {
        number -= numbers[coupling.by] * coupling.factor * robot.joints[joint].sign;
    }
    number
}

/// How far a number lies outside an interval.
pub fn outside(value: f64, from: f64, to: f64) -> f64 {
    (from - value).max(value - to).max(0.0)
}

/// The number inside an interval that is nearest to `value`; its lower end when it is inverted.
pub fn nearest_in(value: f64, from: f64, to: f64) -> f64 {
    value.min(to).max(from)
}

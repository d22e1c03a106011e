//! Where the arm stands or moves, record by record.

use std::sync::Arc;

use falsetarget::model::robot::{DOF, Robot};
use nalgebra::Vector3;

use crate::arm::{Arm, Shape};
use crate::dice::Dice;

/// The circumstances of one record as they really were.
#[derive(Clone, Debug)]
pub struct Moment {
    pub numbers: [f64; DOF],
    pub approach: [f64; DOF],
    /// State of friction's loop, -1 to 1.
    pub wound: [f64; DOF],
    pub time_s: f64,
    /// Of the recording, 0 to 1.
    pub fraction: f64,
    /// Warmer than at the start, K.
    pub warmer_k: f64,
    /// What is left of the way when the record is taken, rad.
    pub unsettled: [f64; DOF],
    pub motion: Option<Arc<Motion>>,
}

/// A motion: sines in every joint.
#[derive(Clone, Debug)]
pub struct Motion {
    middle: [f64; DOF],
    /// Amplitude rad, angular frequency rad/s, phase.
    waves: [[[f64; 3]; 3]; DOF],
}

impl Motion {
    pub fn draw(ranges: &[(f64, f64); DOF], speeds: &[f64; DOF], dice: &mut Dice) -> Self {
        let waves = std::array::from_fn(|joint| {
            let half = ranges[joint].1;
            std::array::from_fn(|wave| {
                let rate = dice.between(0.2, 0.5) * (wave + 1) as f64;
                let most = 0.3 * speeds[joint] / rate;
                [(0.3 * half).min(most) * dice.between(0.5, 1.0), rate, dice.angle()]
            })
        });
        Self { middle: std::array::from_fn(|joint| ranges[joint].0), waves }
    }

    fn sum(&self, time_s: f64, part: impl Fn(f64, f64, f64) -> f64) -> [f64; DOF] {
        std::array::from_fn(|joint| {
            self.waves[joint].iter().map(|&[size, rate, phase]| part(size, rate, rate * time_s + phase)).sum()
        })
    }

    pub fn numbers(&self, time_s: f64) -> [f64; DOF] {
        let swing = self.sum(time_s, |size, _, angle| size * angle.sin());
        std::array::from_fn(|joint| self.middle[joint] + swing[joint])
    }

    pub fn speeds(&self, time_s: f64) -> [f64; DOF] {
        self.sum(time_s, |size, rate, angle| size * rate * angle.cos())
    }

    pub fn accelerations(&self, time_s: f64) -> [f64; DOF] {
        self.sum(time_s, |size, rate, angle| -size * rate * rate * angle.sin())
    }
}

/// Middle and half range of each joint in which poses are taken, rad.
pub fn ranges(robot: &Robot, restricted: bool, dice: &mut Dice) -> [(f64, f64); DOF] {
    // Cobots turn twice; nobody measures them from below the floor.
    let most_deg: [(f64, f64); DOF] = if robot.joints[1].max_rad > 3.5 {
        [(0.0, 150.0), (-90.0, 70.0), (0.0, 130.0), (-90.0, 150.0), (0.0, 140.0), (0.0, 170.0)]
    } else {
        [(0.0, 150.0), (f64::NAN, 80.0), (f64::NAN, 80.0), (0.0, 160.0), (0.0, 110.0), (0.0, 170.0)]
    };
    std::array::from_fn(|joint| {
        let limits = &robot.joints[joint];
        let (own_middle, own_half) = (0.5 * (limits.max_rad + limits.min_rad), 0.5 * (limits.max_rad - limits.min_rad));
        let (middle, half) = (most_deg[joint].0.to_radians(), most_deg[joint].1.to_radians());
        let middle = if middle.is_nan() { own_middle } else { middle.clamp(limits.min_rad, limits.max_rad) };
        let half = half.min(0.9 * own_half);
        match restricted {
            true => (middle + 0.6 * half * dice.between(-1.0, 1.0), 0.3 * half),
            false => (middle, half),
        }
    })
}

/// True in a pose that an arm on a floor can take.
pub fn allowed(robot: &Robot, arm: &Arm, numbers: &[f64; DOF]) -> bool {
    if robot.limit_violation(numbers, 0.0).is_some() {
        return false;
    }
    let Some(stand) = arm.stand(&arm.drives(numbers), &Shape::default()) else { return false };
    let up = -arm.gravity.normalize();
    let above = |point: &Vector3<f64>| (point - stand.foot.translation.vector).dot(&up) > -0.05;
    above(&stand.point) && above(&stand.ends[5].translation.vector) && above(&stand.turning[4].translation.vector)
}

/// How poses follow on each other.
#[derive(Clone, Copy)]
pub struct Habits {
    /// From pose to pose without detour: the sense of approach is that of the last change.
    pub direct: bool,
    /// Way in which friction's loop turns over, rad.
    pub winding_rad: f64,
    /// Seconds from pose to pose.
    pub pause_s: f64,
    /// Final warm-up, K, and its time constant, s.
    pub warming: (f64, f64),
}

/// Random poses, one after the other.
pub fn poses(
    robot: &Robot,
    arm: &Arm,
    ranges: &[(f64, f64); DOF],
    count: usize,
    habits: Habits,
    dice: &mut Dice,
) -> Option<Vec<Moment>> {
    let mut moments: Vec<Moment> = Vec::with_capacity(count);
    let mut time_s = 0.0;
    for _ in 0..200 * count {
        if moments.len() == count {
            break;
        }
        let numbers = ranges.map(|(middle, half)| rounded_rad(middle + half * dice.between(-1.0, 1.0)));
        if !allowed(robot, arm, &numbers) {
            continue;
        }
        let before = moments.last();
        let moved: [f64; DOF] = std::array::from_fn(|joint| match (habits.direct, before) {
            (true, Some(before)) => numbers[joint] - before.numbers[joint],
            _ => dice.sign() * dice.between(0.08, 0.4),
        });
        let wound = std::array::from_fn(|joint| {
            // Dahl's closed form of a monotone move.
            let (sense, start) = (moved[joint].signum(), before.map_or(0.0, |before| before.wound[joint]));
            sense * (1.0 - (1.0 - sense * start) * (-moved[joint].abs() / habits.winding_rad).exp())
        });
        time_s += habits.pause_s * dice.between(0.9, 1.1);
        moments.push(Moment {
            numbers,
            approach: moved.map(f64::signum),
            wound,
            time_s,
            fraction: 0.0,
            warmer_k: habits.warming.0 * (1.0 - (-time_s / habits.warming.1).exp()),
            unsettled: [0.0; DOF],
            motion: None,
        });
    }
    let whole_s = moments.last()?.time_s;
    moments.iter_mut().for_each(|moment| moment.fraction = moment.time_s / whole_s);
    (moments.len() == count).then_some(moments)
}

/// Records along a motion.
pub fn along(motion: &Arc<Motion>, count: usize, step_s: f64, winding_rad: f64) -> Vec<Moment> {
    let mut wound = [0.0f64; DOF];
    let mut before = motion.numbers(-step_s);
    (0..count)
        .map(|index| {
            let time_s = step_s * index as f64;
            let numbers = motion.numbers(time_s);
            for joint in 0..DOF {
                let moved = numbers[joint] - before[joint];
                let sense = moved.signum();
                wound[joint] = sense * (1.0 - (1.0 - sense * wound[joint]) * (-moved.abs() / winding_rad).exp());
            }
            before = numbers;
            Moment {
                numbers,
                approach: motion.speeds(time_s).map(f64::signum),
                wound,
                time_s,
                fraction: index as f64 / (count - 1).max(1) as f64,
                warmer_k: 0.0,
                unsettled: [0.0; DOF],
                motion: Some(Arc::clone(motion)),
            }
        })
        .collect()
}

/// As a display shows it: five digits behind the point of a degree.
fn rounded_rad(angle: f64) -> f64 {
    ((angle.to_degrees() * 1e5).round() * 1e-5).to_radians()
}

//! What can be wrong with an arm, as closures of physics: each with a size that a trial sets.

use falsetarget::model::robot::DOF;
use nalgebra::Vector3;

use crate::dice::Dice;

/// A frame that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    Base,
    Tool,
}

/// The spring of a drive that is not straight.
#[derive(Clone, Copy, Debug)]
pub enum Spring {
    /// `tau = k x + k3 x^3`.
    Cubic,
    /// Softer below a knee, as in a harmonic drive's data sheet: this share of the largest torque.
    Knee(f64),
}

/// Something wrong, with everything but its size. Joints and links count from zero.
#[derive(Clone, Debug)]
pub enum Cause {
    /// Size in rad/Nm.
    Compliance { joint: usize },
    /// Size: what the bend of the spring adds at the largest torque, rad.
    Stiffening { joint: usize, spring: Spring, largest_nm: f64 },
    /// Size `1/EI`, 1/Nm^2.
    Beam { link: usize, twist_ratio: f64 },
    /// Size: the gap, rad.
    Backlash { joint: usize, held_nm: f64 },
    /// Size: half the loop, rad; the state comes from the history of motion.
    Windup { joint: usize },
    /// Size: amplitude, rad.
    Periodic { joint: usize, order: f64, phase: f64 },
    /// Size: relative.
    GearRatio { joint: usize },
    /// Size: factor.
    Coupling { joint: usize, source: usize },
    /// Size: amplitude of the tilt, rad.
    Wobble { joint: usize, order: f64, phases: [f64; 2], ratio: f64 },
    /// Size: rate of a spring between a radius and a height, N/m.
    Balancer { joint: usize, radius_m: f64, height_m: f64, rest_m: f64, start: f64 },
    /// Size: kg, at this place in the flange.
    Payload { at_m: Vector3<f64> },
    /// Size: rad about this level axis.
    Tilt { about: Vector3<f64> },
    /// Size: rad/Nm about x; the ratio is that of y.
    Foundation { ratio: f64 },
    /// Size: 1/K.
    Growth { link: usize },
    /// Size: m over the recording; turning in rad per m; 0 is a straight line in time, else it levels off.
    Drift { frame: Frame, shift: Vector3<f64>, turn: Vector3<f64>, levelling: f64 },
    /// Size: m.
    Step { frame: Frame, at: f64, shift: Vector3<f64>, turn: Vector3<f64> },
    /// Size: s.
    Clock,
    /// Size: s.
    Lag { joint: usize },
    /// Size: rad/Nm.
    Inertial { joint: usize },
    /// Outside the table: a joint's error is a product of functions of two other joints. Size: rad.
    Product { joint: usize, of: [usize; 2], phases: [f64; 2] },
    /// Outside the table: friction that depends on the joint's angle. Size: rad.
    FrictionByAngle { joint: usize, phase: f64 },
    /// Outside the table: a damaged place on a gear. Size: rad.
    Bump { joint: usize, at: f64, width: f64 },
    /// Outside the table: the tracker's encoder is off centre. Size: rad.
    TrackerAngle { phase: f64, order: f64, stands_m: Vector3<f64> },
}

/// Every kind that the contract names and that a standing arm shows.
pub const STATIC_KINDS: [&str; 16] = [
    "joint_compliance",
    "joint_stiffening",
    "link_flexibility",
    "backlash",
    "friction_windup",
    "joint_periodic",
    "gear_ratio",
    "joint_coupling",
    "axis_wobble",
    "gravity_compensator",
    "payload_error",
    "gravity_tilt",
    "base_compliance",
    "thermal_growth",
    "drift",
    "step_shift",
];

/// What takes motion to be seen, and play in motion.
pub const MOVING_KINDS: [&str; 4] = ["time_offset", "servo_lag", "inertial_deflection", "backlash"];

/// What has no name.
pub const OUTSIDE_KINDS: [&str; 4] = ["product", "friction_by_angle", "bump", "tracker_angle"];

/// What a draw has to know of the arm.
pub struct Setting<'a> {
    /// Largest torque of each joint over the poses, Nm.
    pub largest_nm: &'a [f64; DOF],
    /// Lengths of the links, m.
    pub lengths_m: &'a [f64; DOF],
    /// Middle and half range of each joint, rad.
    pub ranges: &'a [(f64, f64); DOF],
    /// Joints that the file knows to be soft.
    pub soft: &'a [bool; DOF],
    /// What the flange carries, and where it sits there.
    pub payload_kg: f64,
    pub payload_m: &'a Vector3<f64>,
}

impl Cause {
    /// Draws a cause of this kind.
    pub fn draw(kind: &str, setting: &Setting<'_>, dice: &mut Dice) -> Self {
        let any = |dice: &mut Dice| dice.below(DOF - 1);
        let soft: Vec<usize> = (0..DOF).filter(|&joint| setting.soft[joint]).collect();
        let long: Vec<usize> = (0..4).filter(|&link| setting.lengths_m[link] > 0.15 * reach(setting)).collect();
        match kind {
            "joint_compliance" => Self::Compliance { joint: *dice.pick(&soft) },
            "joint_stiffening" => {
                let joint = *dice.pick(&soft);
                let knee = Spring::Knee(dice.between(0.3, 0.6));
                let spring = *dice.pick(&[Spring::Cubic, knee]);
                Self::Stiffening { joint, spring, largest_nm: setting.largest_nm[joint] }
            }
            "link_flexibility" => Self::Beam { link: *dice.pick(&long), twist_ratio: dice.between(0.8, 1.6) },
            "backlash" => {
                let joint = any(dice);
                let most = setting.largest_nm.iter().fold(0.0f64, |a, &b| a.max(b));
                let held = dice.between(0.02, 0.05) * setting.largest_nm[joint];
                Self::Backlash { joint, held_nm: held.max(1e-3 * most) }
            }
            "friction_windup" => Self::Windup { joint: any(dice) },
            "joint_periodic" => {
                let fine = dice.between(4.0, 30.0);
                let orders = [1.0, 2.0, 3.0, fine.round(), (4.0 * fine).round() / 4.0];
                Self::Periodic { joint: any(dice), order: *dice.pick(&orders), phase: dice.angle() }
            }
            "gear_ratio" => Self::GearRatio { joint: any(dice) },
            "joint_coupling" => {
                let (joint, source) = *dice.pick(&[(4, 3), (4, 3), (5, 3), (5, 4), (3, 4), (2, 1), (1, 0), (4, 2)]);
                Self::Coupling { joint, source }
            }
            "axis_wobble" => {
                let order = *dice.pick(&[2.0, 2.0, 3.0]);
                let joint = dice.below(4);
                Self::Wobble { joint, order, phases: [dice.angle(), dice.angle()], ratio: dice.between(0.5, 1.5) }
            }
            "gravity_compensator" => {
                let size = reach(setting);
                let (radius_m, height_m) = (size * dice.between(0.05, 0.09), size * dice.between(0.2, 0.3));
                let rest_m = dice.between(0.5, 0.75) * height_m;
                Self::Balancer { joint: 1, radius_m, height_m, rest_m, start: dice.between(-0.4, 0.4) }
            }
            "payload_error" => {
                Self::Payload { at_m: setting.payload_m + dice.normals() * 0.3 * setting.payload_m.norm() }
            }
            "gravity_tilt" => {
                let heading = dice.angle();
                Self::Tilt { about: Vector3::new(heading.cos(), heading.sin(), 0.0) }
            }
            "base_compliance" => Self::Foundation { ratio: *dice.pick(&[1.0, 1.0, 0.6, 1.6]) },
            "thermal_growth" => Self::Growth { link: *dice.pick(&long) },
            "drift" => {
                let frame = *dice.pick(&[Frame::Base, Frame::Base, Frame::Tool]);
                let levelling = *dice.pick(&[0.0, 1.0]);
                Self::Drift { frame, shift: dice.direction(), turn: dice.normals() * 0.1, levelling }
            }
            "step_shift" => {
                let frame = *dice.pick(&[Frame::Base, Frame::Tool]);
                let at = dice.between(0.25, 0.75);
                Self::Step { frame, at, shift: dice.direction(), turn: dice.normals() * 0.1 }
            }
            "time_offset" => Self::Clock,
            "servo_lag" => Self::Lag { joint: dice.below(5) },
            "inertial_deflection" => Self::Inertial { joint: dice.below(4) },
            "product" => {
                let [joint, a, b] = *dice.pick(&[[4, 1, 3], [2, 1, 4], [3, 2, 4], [0, 1, 2], [1, 2, 3]]);
                Self::Product { joint, of: [a, b], phases: [dice.angle(), dice.angle()] }
            }
            "friction_by_angle" => Self::FrictionByAngle { joint: any(dice), phase: dice.angle() },
            "bump" => {
                let joint = any(dice);
                let (middle, half) = setting.ranges[joint];
                let at = middle + half * dice.between(-0.6, 0.6);
                Self::Bump { joint, at, width: dice.between(0.08, 0.16) * half }
            }
            "tracker_angle" => {
                let size = reach(setting);
                let stands_m = Vector3::new(dice.sign() * 1.3 * size, 1.3 * size * dice.sign(), 0.5 * size);
                Self::TrackerAngle { phase: dice.angle(), order: dice.between(8.0, 16.0), stands_m }
            }
            other => panic!("no such kind: {other}"),
        }
    }

    /// The joint that it sits at, if it sits at one.
    pub fn joint(&self) -> Option<usize> {
        match *self {
            Self::Compliance { joint }
            | Self::Stiffening { joint, .. }
            | Self::Backlash { joint, .. }
            | Self::Windup { joint }
            | Self::Periodic { joint, .. }
            | Self::GearRatio { joint }
            | Self::Coupling { joint, .. }
            | Self::Wobble { joint, .. }
            | Self::Balancer { joint, .. }
            | Self::Lag { joint }
            | Self::Inertial { joint }
            | Self::Product { joint, .. }
            | Self::FrictionByAngle { joint, .. }
            | Self::Bump { joint, .. } => Some(joint),
            _ => None,
        }
    }

    /// A usual size and the largest that physics and workshops know.
    pub fn sizes(&self, setting: &Setting<'_>) -> (f64, f64) {
        let tau = |joint: usize| setting.largest_nm[joint].max(1.0);
        match self {
            Self::Compliance { joint } => (5e-4 / tau(*joint), 6e-3 / tau(*joint)),
            Self::Stiffening { .. } => (1e-4, 3e-3),
            Self::Beam { .. } => {
                // A tip that sinks by a thousandth of the length under the largest torque.
                let one = 1e-3 / (setting.largest_nm.iter().fold(0.0f64, |a, &b| a.max(b)) * reach(setting));
                (0.1 * one, 3.0 * one)
            }
            Self::Backlash { .. } => (2e-4, 3e-3),
            Self::Windup { .. } => (1e-4, 1.5e-3),
            Self::Periodic { .. } => (2e-4, 3e-3),
            Self::GearRatio { .. } | Self::Coupling { .. } => (2e-4, 5e-3),
            Self::Wobble { .. } => (5e-5, 1e-3),
            Self::Balancer { radius_m, height_m, .. } => {
                let most = tau(1) / (radius_m * height_m);
                (0.1 * most, 6.0 * most)
            }
            Self::Payload { .. } => (0.1 * setting.payload_kg, setting.payload_kg),
            Self::Tilt { .. } => (1e-2, 0.2),
            Self::Foundation { .. } => (5e-5 / tau(1), 1.5e-3 / tau(1)),
            Self::Growth { .. } => (1.2e-5, 3.8e-5),
            Self::Drift { .. } | Self::Step { .. } => (1e-4, 2e-3),
            Self::Clock => (1e-3, 2e-2),
            Self::Lag { .. } => (1e-3, 4e-2),
            Self::Inertial { joint } => (1e-4 / tau(*joint), 6e-3 / tau(*joint)),
            Self::Product { .. } | Self::FrictionByAngle { .. } | Self::Bump { .. } => (2e-4, 5e-3),
            Self::TrackerAngle { .. } => (1e-5, 5e-4),
        }
    }
}

/// How far the arm reaches, m.
pub fn reach(setting: &Setting<'_>) -> f64 {
    setting.lengths_m.iter().sum()
}

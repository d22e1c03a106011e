//! The nominal robot: what its controller believes. Metres, radians, kilograms, seconds.

use nalgebra::Vector3;

use crate::geometry::pose::Pose;

/// Number of robot axes. Palletisers with four and arms with seven are refused when a robot file is read.
pub const DOF: usize = 6;

/// How a row of four Denavit-Hartenberg numbers makes a transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// `A = Rz(theta) Tz(d) Tx(a) Rx(alpha)` (Denavit and Hartenberg 1955).
    Standard,
    /// `A = Rx(alpha) Tx(a) Rz(theta) Tz(d)` (Craig 1986).
    Modified,
}

/// One joint with its Denavit-Hartenberg row.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The controller's name for it.
    pub name: String,
    /// Constant part of the angle, rad.
    pub theta_rad: f64,
    /// Offset along the joint axis, m.
    pub d_m: f64,
    /// Length of the common normal, m.
    pub a_m: f64,
    /// Twist, rad.
    pub alpha_rad: f64,
    /// +1 or -1: the controller's sense of the angle against the row's.
    pub sign: f64,
    /// Lower limit of the controller's number, rad.
    pub min_rad: f64,
    /// Upper limit of the controller's number, rad.
    pub max_rad: f64,
    /// Highest speed, rad/s, if known.
    pub max_speed_rad_s: Option<f64>,
}

/// The closed loop P-Q-R-S beside the upper arm that lets motor 3 sit at the shoulder.
///
/// P is joint 2's axis; the crank P-Q is turned by actuator 3, the coupler Q-R is the rod, the rocker S-R is rigid
/// with the forearm, the arm P-S is link 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// Length P-Q, m.
    pub crank_m: f64,
    /// Length Q-R, m.
    pub coupler_m: f64,
    /// Length S-R, m.
    pub rocker_m: f64,
    /// Length P-S, m.
    pub arm_m: f64,
    /// Angle of the crank at the zero of its actuator, rad.
    pub crank_offset_rad: f64,
    /// Lower bound of `q3 - q2`, rad.
    pub passive_min_rad: f64,
    /// Upper bound of `q3 - q2`, rad.
    pub passive_max_rad: f64,
}

/// The joint the parallelogram drives (index from zero), and the one it turns around.
pub const LOOP_DRIVEN: usize = 2;
/// See [`LOOP_DRIVEN`].
pub const LOOP_AROUND: usize = 1;

/// A joint whose displayed number does not count its own turn alone: `theta = sign q + factor q_by + theta_0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// The joint so defined, from zero.
    pub joint: usize,
    /// The joint that enters it, from zero.
    pub by: usize,
    /// With which factor.
    pub factor: f64,
}

/// A mass with its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass, m: of a link in its frame after the row, of a payload in the flange.
    pub center_of_mass_m: Vector3<f64>,
}

impl Mass {
    /// No mass.
    pub const NONE: Mass = Mass { mass_kg: 0.0, center_of_mass_m: Vector3::new(0.0, 0.0, 0.0) };
}

/// A robot as a robot file describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: String,
    /// What the rows mean.
    pub convention: Convention,
    /// The joints from the base outwards.
    pub joints: [Joint; DOF],
    /// The closed loop, if it has one.
    pub parallelogram: Option<Parallelogram>,
    /// Joints whose number counts another joint's turn.
    pub couplings: Vec<Coupling>,
    /// Link masses; without them there is no gravity model.
    pub links: Option<[Mass; DOF]>,
    /// `measuring_T_base`, if known beforehand.
    pub base: Option<Pose>,
    /// `flange_T_tool` of the measured point, if known beforehand.
    pub tool: Option<Pose>,
    /// What the flange carries.
    pub payload: Mass,
    /// Gravity in the robot base, m/s^2.
    pub gravity_m_s2: Vector3<f64>,
    /// Compliances known beforehand, rad/Nm at the actuators.
    pub compliance_rad_per_nm: [f64; DOF],
}

impl Robot {
    /// `measuring_T_base`, identity where the file has none.
    pub fn base_or_identity(&self) -> Pose {
        self.base.unwrap_or_else(Pose::identity)
    }

    /// `flange_T_tool` of the robot's own tool, identity where the file has none.
    pub fn tool_or_identity(&self) -> Pose {
        self.tool.unwrap_or_else(Pose::identity)
    }

    /// The first joint whose number lies outside its limits by more than `slack_rad`, or the passive joint of the
    /// parallelogram.
    pub fn limit_violation(&self, joints_rad: &[f64; DOF], slack_rad: f64) -> Option<LimitViolation> {
        for (joint, (&value, limits)) in joints_rad.iter().zip(&self.joints).enumerate() {
            if value < limits.min_rad - slack_rad || value > limits.max_rad + slack_rad {
                let (min_rad, max_rad) = (limits.min_rad, limits.max_rad);
                return Some(LimitViolation { joint: Some(joint), value_rad: value, min_rad, max_rad });
            }
        }
        let parallelogram = self.parallelogram.as_ref()?;
        let passive = self.passive_rad(joints_rad);
        let (min_rad, max_rad) = (parallelogram.passive_min_rad, parallelogram.passive_max_rad);
        let outside = passive < min_rad - slack_rad || passive > max_rad + slack_rad;
        outside.then_some(LimitViolation { joint: None, value_rad: passive, min_rad, max_rad })
    }

    /// The angle of the parallelogram that its limits bound: `q3 - q2`, each in the row's sense.
    pub fn passive_rad(&self, joints_rad: &[f64; DOF]) -> f64 {
        let signed = |joint: usize| self.joints[joint].sign * joints_rad[joint];
        signed(LOOP_DRIVEN) - signed(LOOP_AROUND)
    }

    /// True when the axes of `joint` and of the next one are nominally parallel: the case in which the
    /// Denavit-Hartenberg parameters have a jump and Hayati's beta takes the place of d.
    pub fn parallel_to_next(&self, joint: usize) -> bool {
        let twist = match self.convention {
            Convention::Standard => self.joints[joint].alpha_rad,
            Convention::Modified => match self.joints.get(joint + 1) {
                Some(next) => next.alpha_rad,
                None => return false,
            },
        };
        joint + 1 < DOF && twist.sin().abs() < 1e-3
    }
}

/// A joint number outside its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitViolation {
    /// Which joint, from zero; `None` for the passive joint of the parallelogram.
    pub joint: Option<usize>,
    /// The number.
    pub value_rad: f64,
    /// Its lower limit.
    pub min_rad: f64,
    /// Its upper limit.
    pub max_rad: f64,
}

impl std::fmt::Display for LimitViolation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.joint {
            Some(joint) => write!(f, "joint {}", joint + 1)?,
            None => write!(f, "the parallelogram's passive joint")?,
        }
        let [value, min, max] = [self.value_rad, self.min_rad, self.max_rad].map(f64::to_degrees);
        write!(f, " would stand at {value:.3} deg, outside {min:.3} to {max:.3} deg")
    }
}

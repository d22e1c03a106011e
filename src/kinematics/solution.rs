//! What inverse kinematics gives back.

use crate::geometry::pose::Pose;
use crate::model::robot::{DOF, LimitViolation};

use super::posture::{Posture, Singularity};

/// One way to stand in a pose, before full turns of the joints are thought of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Actuator angles, rad; each may be turned by whole turns.
    pub actuators_rad: [f64; DOF],
    /// How the arm stands.
    pub posture: Posture,
    /// How near it is to where postures meet.
    pub singularity: Singularity,
}

impl From<Solution> for Stance {
    fn from(Solution { actuators_rad, posture, singularity, .. }: Solution) -> Self {
        Self { actuators_rad, posture, singularity }
    }
}

/// One way to stand in a pose, up to full turns of the joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Actuator angles, rad; each may be turned by whole turns.
    pub actuators_rad: [f64; DOF],
    /// The controller's numbers, rad, in the turn that lies inside the limits and nearest to the home position.
    pub numbers_rad: [f64; DOF],
    /// How the arm stands.
    pub posture: Posture,
    /// How near it is to where postures meet.
    pub singularity: Singularity,
    /// True when the limits allow these numbers; false when no turn of them is allowed.
    pub within_limits: bool,
}

/// Most solutions that a six-joint arm has: the degree of the general problem (Raghavan and Roth 1990).
pub const MOST_BRANCHES: usize = 16;

/// All ways to stand in a pose, up to full turns; kept without allocation.
#[derive(Clone, Copy, Debug)]
pub struct Branches<S = Solution> {
    /// The pose that they all stand in.
    pub base_t_flange: Pose,
    places: [Option<S>; MOST_BRANCHES],
    count: usize,
}

impl<S: Copy> Branches<S> {
    /// None yet.
    pub(super) fn none(base_t_flange: &Pose) -> Self {
        Self { base_t_flange: *base_t_flange, places: [None; MOST_BRANCHES], count: 0 }
    }

    /// Adds one; beyond [`MOST_BRANCHES`] (a continuum at a singular pose) further ones are left out.
    pub(super) fn push(&mut self, solution: S) {
        if let Some(place) = self.places.get_mut(self.count) {
            *place = Some(solution);
            self.count += 1;
        }
    }

    /// The same branches, each as `convert` makes it.
    pub(super) fn map<T: Copy>(&self, convert: impl Fn(&S) -> T) -> Branches<T> {
        let places = self.places.each_ref().map(|place| place.as_ref().map(&convert));
        Branches { base_t_flange: self.base_t_flange, places, count: self.count }
    }

    /// Every solution, also those that the joint limits forbid.
    pub fn iter(&self) -> impl Iterator<Item = &S> {
        self.places.iter().take(self.count).flatten()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// Why a pose has no solution.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoSolution {
    /// The pose holds a number that is not finite.
    #[error("the pose is not finite")]
    NotFinite,
    /// The position cannot be reached.
    #[error("out of reach by {:.3} mm", .by_m * 1e3)]
    OutOfReach {
        /// By how much, m: exact for arms in closed form, else the distance of the nearest pose that was found.
        by_m: f64,
    },
    /// The position can be reached, but not with this orientation.
    #[error("the wrist cannot turn to this orientation: {:.3} deg are missing", .by_rad.to_degrees())]
    OrientationOutOfReach {
        /// By how much, rad.
        by_rad: f64,
    },
    /// The pose can be reached, but the rods of the parallelogram do not allow it.
    #[error("the parallelogram cannot close in this pose")]
    LoopOpen,
    /// The pose can be reached only with a joint outside its limits: the one that is least outside in the best case.
    #[error("{} would stand at {:.3} deg, outside {:.3} to {:.3} deg", joint_name(.0), .0.value_rad.to_degrees(),
        .0.min_rad.to_degrees(), .0.max_rad.to_degrees())]
    JointLimit(LimitViolation),
}

fn joint_name(violation: &LimitViolation) -> String {
    match violation.joint {
        Some(joint) => format!("joint {}", joint + 1),
        None => "the passive joint of the parallelogram".into(),
    }
}

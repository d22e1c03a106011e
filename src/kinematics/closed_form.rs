//! Inverse kinematics in closed form for the two families that nearly all industrial arms belong to.
//!
//! Both have axes 2 and 3 parallel. Either axes 4, 5 and 6 meet in a point (spherical wrist), or axis 4 is parallel to
//! 2 and 3 and axes 5 and 6 meet (Universal Robots and its kin). In both the wrist centre gives the turn of axis 1,
//! after which position and orientation fall apart: a two-link arm in a plane, and three turns that make a rotation.
//! Lengths and angles between the axes are otherwise free.
//!
//! # Source
//! Pieper 1968 (the separation); Elias and Wen 2022, "IK-Geo: Unified robot inverse kinematics using subproblem
//! decomposition", sections on spherical wrists with two parallel axes and on three parallel with two intersecting
//! axes (the subproblems). Other than there, each turn is found in the frame that the turns before it leave.

use nalgebra::Vector3;

use crate::geometry::pose::Pose;
use crate::model::robot::DOF;

use super::planar::Planar;
use super::skeleton::Skeleton;
use super::turn::{Circle, CircleFrame, Turn};
use super::wrist::{Pin, Wrist, WristSolution};

/// Positions nearer to a limit of reach than this are reached, m: rounding only.
const SLACK_M: f64 = 1e-11;
/// A wrist centre this near to axis 1 leaves its turn free, m.
const ON_AXIS_ONE_M: f64 = 1e-9;

/// The row angles that are given where the pose leaves them free, and from when on it does.
#[derive(Clone, Copy, Debug)]
pub struct Freedom {
    /// Row 1, for a wrist centre on axis 1, rad.
    pub swing_rad: f64,
    /// Row [`ClosedForm::free_row`], for a straight wrist, rad.
    pub wrist_rad: f64,
    /// A wrist that is bent by less counts as straight, rad.
    pub straight_below_rad: f64,
}

/// One solution as row angles, with what its posture is read from.
#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// Row angles, -pi to pi.
    pub theta_rad: [f64; DOF],
    /// From axis 1 to the wrist centre, turned back to row angle zero, m.
    pub swung: Vector3<f64>,
    /// Sine of the bend between lower and upper arm about axis 2.
    pub bend_sin: f64,
    /// Sine of the angle between the axes that coincide at a straight wrist.
    pub opening_sin: f64,
    /// What the pose is missed by, m and rad together.
    pub misfit: f64,
}

/// Why there is no root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shortage {
    /// The position is out of reach by so many metres.
    Position(f64),
    /// The wrist cannot be bent far enough by so many radians.
    Orientation(f64),
}

/// Up to eight roots.
#[derive(Clone, Copy, Debug)]
pub struct Roots {
    /// The roots found.
    pub found: [Option<Root>; 8],
    count: usize,
}

impl Roots {
    fn push(&mut self, root: Root) {
        if let Some(place) = self.found.get_mut(self.count) {
            *place = Some(root);
            self.count += 1;
        }
    }
}

/// An arm of one of the two families.
#[derive(Clone, Copy, Debug)]
pub struct ClosedForm {
    skeleton: Skeleton,
    swing: CircleFrame,
    /// How far the wrist centre lies beside the plane through axis 1, along axis 2, m.
    side_m: f64,
    plane: Planar,
    wrist: Wrist,
    family: Family,
    center_in_flange: Vector3<f64>,
    /// How far the arm is from the family that it is taken for, m or rad: zero but for rounding where it belongs to it.
    pub misfit: f64,
}

#[derive(Clone, Copy, Debug)]
enum Family {
    SphericalWrist,
    /// Axis 4 parallel to 2 and 3, with its sense and the vector from a point on axis 4 to the wrist centre.
    ThreeParallel {
        fourth_sense: f64,
        forearm: Vector3<f64>,
    },
}

impl ClosedForm {
    /// The nearest arm with a spherical wrist; `None` where axes that must cross are parallel or a link has no length.
    pub fn spherical_wrist(skeleton: &Skeleton) -> Option<Self> {
        let misfit = skeleton.center_from_axis(3);
        let [_, second, _, fourth, fifth, sixth] = skeleton.directions;
        let wrist = Wrist::new(fourth, fifth, sixth)?;
        let carried = skeleton.wrist_center;
        Self::of(skeleton, Family::SphericalWrist, wrist, &second, &carried, misfit)
    }

    /// The nearest arm with axes 2, 3 and 4 parallel and axes 5 and 6 that meet; `None` as above.
    pub fn three_parallel(skeleton: &Skeleton) -> Option<Self> {
        let misfit = skeleton.crossing_sin(1, 3);
        let [_, second, _, _, fifth, sixth] = skeleton.directions;
        let wrist = Wrist::new(second, fifth, sixth)?;
        let carried = skeleton.points[3];
        let forearm = skeleton.wrist_center - carried;
        let family = Family::ThreeParallel { fourth_sense: skeleton.sense(3), forearm };
        Self::of(skeleton, family, wrist, &second, &carried, misfit)
    }

    fn of(
        skeleton: &Skeleton,
        family: Family,
        wrist: Wrist,
        second: &Vector3<f64>,
        carried: &Vector3<f64>,
        misfit: f64,
    ) -> Option<Self> {
        let [base, shoulder, elbow, ..] = skeleton.points;
        let center = skeleton.wrist_center;
        Some(Self {
            skeleton: *skeleton,
            swing: CircleFrame::new(skeleton.directions[0], *second)?,
            side_m: second.dot(&(center - base)),
            plane: Planar::new(second, skeleton.sense(2), shoulder, &elbow, carried)?,
            wrist,
            family,
            center_in_flange: skeleton.flange.inverse().transform_point(&center),
            misfit: misfit.max(skeleton.crossing_sin(1, 2)).max(skeleton.center_from_axis(5)),
        })
    }

    /// The row whose angle is free when the wrist is straight, from zero.
    pub fn free_row(&self) -> usize {
        match self.family {
            Family::SphericalWrist => 3,
            Family::ThreeParallel { .. } => 5,
        }
    }

    /// All row angles that bring the flange to `base_t_flange`.
    ///
    /// # Errors
    /// The smallest [`Shortage`] when there are none.
    pub fn solve(&self, base_t_flange: &Pose, freedom: &Freedom) -> Result<Roots, Shortage> {
        let mut roots = Roots { found: [None; 8], count: 0 };
        let first_axis = &self.skeleton.directions[0];
        let center = base_t_flange.transform_point(&self.center_in_flange) - self.skeleton.points[0];
        let (swings, given) = match self.swing.solve(&center, self.side_m, ON_AXIS_ONE_M, SLACK_M) {
            Circle::Two(swings) => (swings, 2),
            Circle::Free => ([Turn::by(freedom.swing_rad); 2], 1),
            Circle::Short(by_m) => return Err(Shortage::Position(by_m)),
        };
        let turned = base_t_flange.rotation * self.skeleton.flange.rotation.transpose();
        let mut shortage = None;
        for swing in swings.into_iter().take(given) {
            let back = swing.back();
            let swung = Swung {
                angle_rad: swing.angle_rad(),
                center: back.rotate(first_axis, &center),
                rotation: back.matrix(first_axis) * turned,
            };
            let outcome = match self.family {
                Family::SphericalWrist => self.arm_then_wrist(&swung, freedom, &mut roots),
                Family::ThreeParallel { fourth_sense, forearm } => {
                    self.wrist_then_arm(&swung, freedom, fourth_sense, &forearm, &mut roots)
                }
            };
            shortage = smaller(shortage, outcome.err());
        }
        match (roots.count, shortage) {
            (0, Some(shortage)) => Err(shortage),
            _ => Ok(roots),
        }
    }

    fn arm_then_wrist(&self, swung: &Swung, freedom: &Freedom, roots: &mut Roots) -> Result<(), Shortage> {
        let second_axis = &self.skeleton.directions[1];
        let point = self.plane.coordinates(&(swung.center + self.skeleton.points[0]));
        let pin = Pin::First(Turn::by(freedom.wrist_rad));
        let mut outcome = Ok(());
        for arm in self.plane.solve(&point, SLACK_M).map_err(Shortage::Position)? {
            let raised = arm.second.then(arm.third.seen(self.plane.third_sense));
            let left = raised.back().matrix(second_axis) * swung.rotation;
            let arm_rad = [arm.second.angle_rad(), arm.third.angle_rad()];
            match self.wrist.solve(&left, pin, freedom.straight_below_rad) {
                Ok(wrists) => {
                    for wrist in wrists.into_iter().flatten() {
                        roots.push(swung.root(arm_rad, wrist.angles_rad[0], arm.bend_sin, &wrist));
                    }
                }
                Err(by_rad) => outcome = Err(Shortage::Orientation(by_rad)),
            }
        }
        outcome
    }

    fn wrist_then_arm(
        &self,
        swung: &Swung,
        freedom: &Freedom,
        fourth_sense: f64,
        forearm: &Vector3<f64>,
        roots: &mut Roots,
    ) -> Result<(), Shortage> {
        let second_axis = &self.skeleton.directions[1];
        let pin = Pin::Last(Turn::by(freedom.wrist_rad));
        let wrists =
            self.wrist.solve(&swung.rotation, pin, freedom.straight_below_rad).map_err(Shortage::Orientation)?;
        let mut outcome = Ok(());
        let center = swung.center + self.skeleton.points[0];
        for mut wrist in wrists.into_iter().flatten() {
            let mut raised = wrist.first;
            if wrist.opening_sin < freedom.straight_below_rad {
                // The forearm may turn with the hand held still, but not everywhere.
                let (to_center, arm) = (self.plane.coordinates(&center), self.plane.components(forearm));
                raised = self.plane.turn_into_reach(&to_center, &arm, raised).unwrap_or(raised);
                wrist = self.wrist.with_first(&swung.rotation, raised, wrist.opening_sin);
            }
            let carried = center - raised.rotate(second_axis, forearm);
            match self.plane.solve(&self.plane.coordinates(&carried), SLACK_M) {
                Ok(arms) => {
                    for arm in arms {
                        let before = arm.second.then(arm.third.seen(self.plane.third_sense));
                        let fourth = raised.then(before.back()).seen(fourth_sense);
                        let arm_rad = [arm.second.angle_rad(), arm.third.angle_rad()];
                        roots.push(swung.root(arm_rad, fourth.angle_rad(), arm.bend_sin, &wrist));
                    }
                }
                Err(by_m) => {
                    let least_m = match outcome {
                        Err(Shortage::Position(other_m)) => other_m.min(by_m),
                        _ => by_m,
                    };
                    outcome = Err(Shortage::Position(least_m));
                }
            }
        }
        outcome
    }
}

/// The target seen from the arm once axis 1 is turned.
struct Swung {
    angle_rad: f64,
    center: Vector3<f64>,
    rotation: nalgebra::Matrix3<f64>,
}

impl Swung {
    fn root(&self, arm_rad: [f64; 2], fourth_rad: f64, bend_sin: f64, wrist: &WristSolution) -> Root {
        let [second, third] = arm_rad;
        let [_, fifth, sixth] = wrist.angles_rad;
        Root {
            theta_rad: [self.angle_rad, second, third, fourth_rad, fifth, sixth],
            swung: self.center,
            bend_sin,
            opening_sin: wrist.opening_sin,
            misfit: wrist.misfit_rad,
        }
    }
}

/// The smaller of two shortages; lengths count before angles, for a position out of reach is never in reach.
fn smaller(one: Option<Shortage>, other: Option<Shortage>) -> Option<Shortage> {
    match (one, other) {
        (Some(Shortage::Position(a)), Some(Shortage::Position(b))) => Some(Shortage::Position(a.min(b))),
        (Some(Shortage::Orientation(a)), Some(Shortage::Orientation(b))) => Some(Shortage::Orientation(a.min(b))),
        (Some(Shortage::Orientation(a)), _) | (_, Some(Shortage::Orientation(a))) => Some(Shortage::Orientation(a)),
        (one, other) => one.or(other),
    }
}

//! The nominal robot as its controller computes it.

use nalgebra::{Matrix6, Vector3};

use crate::geometry::pose::Pose;
use crate::model::chain::{Chain, Rows};
use crate::model::effect::Response;
use crate::model::jacobian::jacobian_from_chain;
use crate::model::linkage::{LoopErrors, LoopOpen, RowAngles, actuators_from_numbers, driven_actuator, row_angles};
use crate::model::parameters::Parameters;
use crate::model::robot::{DOF, LOOP_AROUND, LOOP_DRIVEN, Robot};

use super::closed_form::{ClosedForm, Freedom, Root, Shortage};
use super::numeric::follow;
use super::posture::PostureFrame;
use super::skeleton::Skeleton;
use super::solution::{Branches, NoSolution, Solution, Stance};
use super::turns::{LIMIT_SLACK_RAD, Preference, TurnPlacer, nearest_in};

/// How a robot's inverse kinematics is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Axes 2 and 3 parallel, 4, 5 and 6 meet in a point: closed form.
    SphericalWrist,
    /// Axes 2, 3 and 4 parallel, 5 and 6 meet: closed form.
    ThreeParallel,
    /// Anything else: iteration.
    General,
}

impl std::fmt::Display for Family {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Family::SphericalWrist => "closed form, spherical wrist",
            Family::ThreeParallel => "closed form, three parallel axes",
            Family::General => "iteration",
        })
    }
}

/// Misfit of the axes, m or rad, up to which an arm belongs to a family: rounding of a robot file's numbers.
const EXACT: f64 = 1e-9;
/// Misfit up to which the closed form of the nearest arm of a family finds all branches for the iteration.
pub(super) const NEARLY: f64 = 0.02;
/// Pose error, m and rad together, of a closed form's root that is still polished.
const POLISH_ABOVE: f64 = 1e-11;
/// A wrist bent by less is straight, rad: below it the turns of axes 4 and 6 are rounding.
pub const STRAIGHT_RAD: f64 = 1e-7;

/// Nominal forward and inverse kinematics of one robot: no errors, no effects, rods of the nominal lengths.
#[derive(Clone, Debug)]
pub struct Controller {
    pub(super) robot: Robot,
    pub(super) rows: Rows<f64>,
    pub(super) still: Response<f64>,
    family: Family,
    exact: Option<ClosedForm>,
    pub(super) nearly: [Option<ClosedForm>; 2],
    pub(super) frame: PostureFrame,
    /// The axis that axis 6 is parallel to when the wrist is straight, from zero.
    pub(super) wrist_axis: usize,
    pub(super) center_in_fourth: Vector3<f64>,
    placer: TurnPlacer,
    home_rad: [f64; DOF],
    pub(super) size_m: f64,
}

const NO_ERRORS: LoopErrors<f64> = LoopErrors { crank_m: 0.0, coupler_m: 0.0, arm_m: 0.0 };

impl Controller {
    /// Reads the family off the axes.
    pub fn new(robot: &Robot) -> Self {
        let rows = Rows::new(robot, &Parameters::zero());
        let still = Response::none();
        let at_zero_rows = rows.at(&[0.0; DOF], &still);
        let skeleton = Skeleton::of(&at_zero_rows);
        let nearly = [ClosedForm::spherical_wrist(&skeleton), ClosedForm::three_parallel(&skeleton)];
        let families = [Family::SphericalWrist, Family::ThreeParallel];
        let fits = |limit: f64| nearly.iter().position(|form| form.is_some_and(|form| form.misfit < limit));
        let exact = fits(EXACT);
        let wrist_axis = if fits(NEARLY) == Some(1) { 1 } else { 3 };
        let center_in_fourth = at_zero_rows.frames[3].inverse().transform_point(&skeleton.wrist_center);
        let theta_at_zero = match row_angles(robot, &[0.0; DOF], &NO_ERRORS) {
            Ok(angles) => angles.theta_rad,
            Err(LoopOpen) => std::array::from_fn(|row| robot.joints[row].theta_rad),
        };
        let center_at_zero = rows.at(&theta_at_zero, &still).frames[3].transform_point(&center_in_fourth);
        let frame = PostureFrame::new(robot, &skeleton, &theta_at_zero, &center_at_zero, wrist_axis);
        let home_rad = std::array::from_fn(|joint| {
            let limits = &robot.joints[joint];
            let middle = 0.5 * (limits.min_rad + limits.max_rad);
            let nearest = nearest_in(0.0, limits.min_rad, limits.max_rad);
            if nearest == 0.0 || !middle.is_finite() { nearest } else { middle }
        });
        Self {
            robot: robot.clone(),
            rows,
            still,
            family: exact.map_or(Family::General, |index| families[index]),
            exact: exact.and_then(|index| nearly[index]),
            nearly,
            frame,
            wrist_axis,
            center_in_fourth,
            placer: TurnPlacer::new(robot),
            home_rad,
            size_m: skeleton.size_m.max(1e-3),
        }
    }

    /// The robot that it controls.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// How its inverse kinematics is solved.
    pub fn family(&self) -> Family {
        self.family
    }

    /// Zero, or the middle of the limits of a joint that cannot stand at zero, rad.
    pub fn home_rad(&self) -> &[f64; DOF] {
        &self.home_rad
    }

    /// Sum of the distances between the axes, m.
    pub fn size_m(&self) -> f64 {
        self.size_m
    }

    /// `base_T_flange` at these numbers, whatever the limits say.
    ///
    /// # Errors
    /// [`LoopOpen`] when the rods of the parallelogram cannot meet.
    pub fn forward(&self, numbers_rad: &[f64; DOF]) -> Result<Pose, LoopOpen> {
        Ok(self.chain(numbers_rad)?.0.flange())
    }

    /// The chain at these numbers, and its row angles.
    ///
    /// # Errors
    /// As [`Controller::forward`].
    pub fn chain(&self, numbers_rad: &[f64; DOF]) -> Result<(Chain<f64>, RowAngles<f64>), LoopOpen> {
        let actuators = actuators_from_numbers(&self.robot, numbers_rad);
        let angles = row_angles(&self.robot, &actuators, &NO_ERRORS)?;
        Ok((self.rows.at(&angles.theta_rad, &self.still), angles))
    }

    /// [`jacobian_from_chain`] of the nominal chain.
    ///
    /// # Errors
    /// As [`Controller::forward`].
    pub fn jacobian(&self, numbers_rad: &[f64; DOF]) -> Result<Matrix6<f64>, LoopOpen> {
        let (chain, angles) = self.chain(numbers_rad)?;
        Ok(jacobian_from_chain(&self.robot, &chain, &angles))
    }

    /// All ways to bring the flange to `base_t_flange`, also those that the joint limits forbid.
    ///
    /// Where the pose leaves a turn free (straight wrist, wrist centre on axis 1) the home position decides it;
    /// [`Controller::choose`] decides it by the wish. [`Controller::each_turn`] gives the full turns of a solution.
    ///
    /// # Errors
    /// [`NoSolution`], except its joint limits, which only a choice can meet.
    ///
    /// # Numerics
    /// Closed form to rounding (better than 1e-11 m and rad); iteration to 1e-10. No allocation.
    ///
    /// # Verification
    /// `tests/kinematics`: random numbers come back to 1e-8 and every solution stands in the pose to 1e-10, for
    /// built-in and random arms; rs-opw-kinematics has no solution that is not among these.
    pub fn inverse(&self, base_t_flange: &Pose) -> Result<Branches, NoSolution> {
        let freedom = self.freedom(&self.home_rad, STRAIGHT_RAD);
        let stances = self.inverse_with(base_t_flange, &freedom, None)?;
        Ok(stances.map(|stance| self.solution(stance)))
    }

    /// Calls `each` with every combination of full turns of a solution that the limits allow.
    pub fn each_turn(&self, solution: &Solution, mut each: impl FnMut([f64; DOF])) {
        self.placer.each(&self.robot, &solution.actuators_rad, &mut each);
    }

    /// The free turns of a singular pose taken from `numbers_rad`.
    pub(super) fn freedom(&self, numbers_rad: &[f64; DOF], straight_below_rad: f64) -> Freedom {
        let actuators = actuators_from_numbers(&self.robot, numbers_rad);
        let theta = |row: usize| actuators[row] * self.robot.joints[row].sign + self.robot.joints[row].theta_rad;
        Freedom { swing_rad: theta(0), wrist_rad: theta(self.free_row()), straight_below_rad }
    }

    /// The row whose turn a straight wrist leaves free, from zero.
    pub(super) fn free_row(&self) -> usize {
        self.exact.map_or(3, |form| form.free_row())
    }

    /// [`Controller::inverse`] with the free turns given, and for the iteration numbers to start from.
    pub(super) fn inverse_with(
        &self,
        base_t_flange: &Pose,
        freedom: &Freedom,
        near_rad: Option<&[f64; DOF]>,
    ) -> Result<Branches<Stance>, NoSolution> {
        let finite = base_t_flange.translation.iter().chain(base_t_flange.rotation.iter()).all(|x| x.is_finite());
        if !finite {
            return Err(NoSolution::NotFinite);
        }
        let mut branches = Branches::none(base_t_flange);
        match &self.exact {
            Some(form) => {
                let roots = form.solve(base_t_flange, freedom).map_err(|shortage| match shortage {
                    Shortage::Position(by_m) => NoSolution::OutOfReach { by_m },
                    Shortage::Orientation(by_rad) => NoSolution::OrientationOutOfReach { by_rad },
                })?;
                for root in roots.found.iter().flatten() {
                    self.push_root(base_t_flange, root, freedom, &mut branches);
                }
            }
            None => self.iterate(base_t_flange, freedom, near_rad, &mut branches)?,
        }
        if branches.is_empty() { Err(NoSolution::LoopOpen) } else { Ok(branches) }
    }

    fn push_root(&self, base_t_flange: &Pose, root: &Root, freedom: &Freedom, branches: &mut Branches<Stance>) {
        let mut theta = root.theta_rad;
        if root.misfit > POLISH_ABOVE && root.opening_sin > freedom.straight_below_rad {
            theta = follow(&self.rows, &self.still, base_t_flange, &theta, self.size_m).theta_rad;
        }
        let (posture, singularity) = self.frame.read(&root.swung, root.bend_sin, theta[4], root.opening_sin);
        if let Ok(actuators_rad) = self.actuators(&theta) {
            branches.push(Stance { actuators_rad, posture, singularity });
        }
    }

    fn solution(&self, stance: &Stance) -> Solution {
        let Stance { actuators_rad, posture, singularity } = *stance;
        let preference = Preference { near_rad: self.home_rad, intervals_rad: [None; DOF] };
        let numbers_rad = self.place(&actuators_rad, &preference);
        let within_limits = self.robot.limit_violation(&numbers_rad, LIMIT_SLACK_RAD).is_none();
        Solution { actuators_rad, numbers_rad, posture, singularity, within_limits }
    }

    /// Numbers of these actuator angles in the preferred turns.
    pub(super) fn place(&self, actuators_rad: &[f64; DOF], preference: &Preference) -> [f64; DOF] {
        self.placer.place(&self.robot, actuators_rad, preference)
    }

    pub(super) fn actuators(&self, theta_rad: &[f64; DOF]) -> Result<[f64; DOF], LoopOpen> {
        let mut actuators: [f64; DOF] = std::array::from_fn(|row| {
            let joint = &self.robot.joints[row];
            (theta_rad[row] - joint.theta_rad) * joint.sign
        });
        if self.robot.parallelogram.is_some() {
            actuators[LOOP_DRIVEN] = driven_actuator(&self.robot, theta_rad[LOOP_AROUND], theta_rad[LOOP_DRIVEN])?;
        }
        Ok(actuators)
    }
}

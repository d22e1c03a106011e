//! Newton's method on the full model of the real arm, in joint numbers, for all six coordinates of the pose.
//!
//! The matrix is the geometric Jacobian of the real chain. What compliance adds to it is not needed: a given pose fixes
//! the torques, so that the deflection there is known and the command leads it by just that. So steps and rounds of
//! equilibrium are one: each step corrects the pose, and the command by what the deflection has changed since. What
//! gears and network add changes the derivative by less than a hundredth, so that each step leaves less than a
//! hundredth of the error.

use nalgebra::{Matrix6, Vector6};

use crate::geometry::pose::{Pose, pose_difference};
use crate::model::arm::{ArmError, ArmModel, ArmState, PreparedArm};
use crate::model::chain::displacement_pose;
use crate::model::conditions::Conditions;
use crate::model::effect::Response;
use crate::model::jacobian::jacobian_from_chain as flange_jacobian;
use crate::model::linkage::numbers_from_actuators;
use crate::model::robot::{DOF, LimitViolation, Robot};

/// Remaining error at which a pose counts as reached: 0.05 um and 0.05 urad, a twentieth of what is promised.
const REACHED: f64 = 5e-8;
/// Change of the links' and axes' deflection, m and rad, that counts as none.
const SETTLED: f64 = 1e-9;
/// Steps after which the search is given up.
const MOST_STEPS: usize = 30;
/// Largest turn of a joint between the nominal solution and the corrected one, rad. Corrections are milliradians; a
/// tenth of a radian means that the search has run off through a singularity.
const FARTHEST_RAD: f64 = 0.1;
/// Smallest over largest singular value of the Jacobian (lengths in metres) below which steps are damped.
const NEARLY_SINGULAR: f64 = 2e-3;

/// The real arm, ready to be asked for many poses.
pub struct RealArm<'a> {
    model: &'a ArmModel,
    prepared: PreparedArm<'a, f64>,
    base_error: Pose,
}

/// What the program means: where the flange of the real arm shall be.
#[derive(Clone, Copy, Debug)]
pub struct MeantPose<'a> {
    /// `base_T_flange`, in the nominal robot base.
    pub base_t_flange: Pose,
    /// The circumstances: approach, load.
    pub conditions: &'a Conditions,
}

/// A command that makes the real arm arrive.
#[derive(Clone, Debug)]
pub struct Correction {
    /// Joint numbers to command, rad.
    pub numbers_rad: [f64; DOF],
    /// Steps taken; zero when the nominal solution was right already.
    pub iterations: usize,
    /// Where the flange of the real arm stands at the nominal command, in the nominal robot base.
    pub nominal_lands: Pose,
    /// How far the nominal command would have missed, m.
    pub missed_by_m: f64,
    /// How far it would have missed in orientation, rad.
    pub missed_by_rad: f64,
    /// What the model leaves after correction, m.
    pub left_m: f64,
    /// What it leaves in orientation, rad.
    pub left_rad: f64,
}

/// Why no command makes the real arm arrive.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InversionError {
    /// The model has no pose there.
    #[error(transparent)]
    Arm(#[from] ArmError),
    /// The arm stands in or next to a singularity: some direction of the error cannot be driven.
    #[error("singular pose: after {iterations} steps {left_m:.1e} m and {left_rad:.1e} rad remain")]
    Singular {
        /// Steps taken.
        iterations: usize,
        /// Remaining position error, m.
        left_m: f64,
        /// Remaining orientation error, rad.
        left_rad: f64,
    },
    /// The corrected command lies outside a joint's limits.
    #[error("after correction {0}")]
    Limit(LimitViolation),
}

impl<'a> RealArm<'a> {
    /// Prepares a model.
    pub fn new(model: &'a ArmModel) -> Self {
        // A base that was only found from the recording is the base; one that was known beforehand has an error.
        let base_error = displacement_pose(&model.parameters.base);
        Self { model, prepared: model.prepared(), base_error }
    }

    /// The nominal robot.
    pub fn robot(&self) -> &Robot {
        &self.model.robot
    }

    /// `flange_T_tool` of the point that the recordings measured, as calibration found it.
    pub fn measured_tool(&self) -> Pose {
        self.prepared.flange_t_tool()
    }

    /// The real `base_T_flange` at these joint numbers, in the nominal robot base.
    ///
    /// # Errors
    /// [`ArmError`] when the model has no pose there.
    pub fn flange(&self, numbers_rad: &[f64; DOF], conditions: &Conditions) -> Result<Pose, ArmError> {
        Ok(self.base_error * self.prepared.at(numbers_rad, conditions, None)?.base_t_flange)
    }

    /// The joint numbers that make the real flange stand where it is meant to, found from `nominal_rad`.
    ///
    /// # Errors
    /// [`InversionError`] when a singularity, a limit or the model itself is in the way.
    pub fn command(&self, meant: &MeantPose<'_>, nominal_rad: &[f64; DOF]) -> Result<Correction, InversionError> {
        let target = self.base_error.inverse() * meant.base_t_flange;
        let mut numbers_rad = *nominal_rad;
        let mut state = self.prepared.at(&numbers_rad, meant.conditions, None)?;
        let nominal_lands = self.base_error * state.base_t_flange;
        let mut error = remaining(&target, &state);
        let (missed_by_m, missed_by_rad) = norms(&error);
        let mut jacobian = self.jacobian(&state);
        let first_handedness = handedness(&jacobian);
        let (mut iterations, mut bends_by) = (0, 0.0);
        while !reached(&error) || bends_by > SETTLED {
            let (left_m, left_rad) = norms(&error);
            let stuck = InversionError::Singular { iterations, left_m, left_rad };
            if iterations == MOST_STEPS {
                return Err(stuck);
            }
            let step = step(&jacobian, &error).ok_or(stuck.clone())?;
            for (number, turn) in numbers_rad.iter_mut().zip(&step) {
                *number += turn;
            }
            let ran_off = numbers_rad.iter().zip(nominal_rad).any(|(a, b)| (a - b).abs() > FARTHEST_RAD);
            if ran_off {
                return Err(stuck);
            }
            let assumed = state.response;
            state = self.prepared.round(&numbers_rad, meant.conditions, &assumed)?;
            jacobian = self.jacobian(&state);
            error = remaining(&target, &state) - jacobian * self.further(&state.response, &assumed);
            bends_by = state.response.largest_change_of_shape(&assumed);
            iterations += 1;
        }
        let (left_m, left_rad) = norms(&error);
        if iterations > 0 {
            if handedness(&jacobian) != first_handedness {
                return Err(InversionError::Singular { iterations, left_m, left_rad });
            }
            if let Some(violation) = self.robot().limit_violation(&numbers_rad, 0.0) {
                return Err(InversionError::Limit(violation));
            }
        }
        Ok(Correction { numbers_rad, iterations, nominal_lands, missed_by_m, missed_by_rad, left_m, left_rad })
    }

    fn jacobian(&self, state: &ArmState<f64>) -> Matrix6<f64> {
        flange_jacobian(self.robot(), &state.chain, &state.angles)
    }

    /// How much further the drives deflect than was assumed, as joint numbers, rad.
    fn further(&self, response: &Response<f64>, assumed: &Response<f64>) -> Vector6<f64> {
        let turns = std::array::from_fn(|joint| response.actuators_rad[joint] - assumed.actuators_rad[joint]);
        numbers_from_actuators(self.robot(), &turns).into()
    }
}

/// The sign of the Jacobian's determinant: it changes where two branches of the inverse meet.
fn handedness(jacobian: &Matrix6<f64>) -> bool {
    jacobian.determinant() > 0.0
}

fn remaining(target: &Pose, state: &ArmState<f64>) -> Vector6<f64> {
    let (shift, turn) = pose_difference(target, &state.base_t_flange);
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

fn norms(error: &Vector6<f64>) -> (f64, f64) {
    (error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm())
}

fn reached(error: &Vector6<f64>) -> bool {
    let (shift_m, turn_rad) = norms(error);
    shift_m <= REACHED && turn_rad <= REACHED
}

/// One step: Newton's, or a damped one (Wampler 1986; Nakamura and Hanafusa 1986) next to a singularity.
fn step(jacobian: &Matrix6<f64>, error: &Vector6<f64>) -> Option<Vector6<f64>> {
    const SMALL_STEP_RAD: f64 = 0.02;
    if let Some(step) = jacobian.lu().solve(error)
        && step.amax() < SMALL_STEP_RAD
    {
        return Some(step);
    }
    let svd = jacobian.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    let largest = svd.singular_values.max();
    let damping = NEARLY_SINGULAR * largest;
    let along = u.transpose() * error;
    let scaled = Vector6::from_fn(|row, _| {
        let value = svd.singular_values[row];
        let damped = if value < damping { damping } else { 0.0 };
        along[row] * value / (value * value + damped * damped).max(f64::MIN_POSITIVE)
    });
    let step = v_t.transpose() * scaled;
    step.iter().all(|turn| turn.is_finite()).then_some(step)
}

//! The real arm: nominal robot, errors, effects and what was learned together, at static equilibrium.

use crate::geometry::pose::Pose;

use super::chain::{Chain, Rows, displacement_pose};
use super::effect::{Effect, Location, ModelScalar, Response};
use super::learner::{Learner, ReadyLearner};
use super::linkage::{LoopErrors, LoopOpen, RowAngles};
use super::parameters::Parameters;
use super::robot::{DOF, LOOP_AROUND, Robot};
use super::statics::{Statics, largest_torque_nm};

/// An effect at its place. Its parameters stand in [`Parameters::effects`] at the same index.
#[derive(Clone, Copy)]
pub struct EffectInstance {
    /// Which effect.
    pub effect: &'static dyn Effect,
    /// Where.
    pub location: Location,
}

impl std::fmt::Debug for EffectInstance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} at {}", self.effect.meta().id, self.location)
    }
}

/// A model of the real arm.
#[derive(Clone, Debug)]
pub struct ArmModel {
    /// What its controller believes.
    pub robot: Robot,
    /// `measuring_T_base` from which the base error counts: the robot file's, or as found from a recording.
    pub measuring_t_base: Pose,
    /// `flange_T_tool` of the measured point from which the tool error counts.
    pub flange_t_tool: Pose,
    /// Geometry errors and the parameters of the effects.
    pub parameters: Parameters<f64>,
    /// The effects, joint compliances of the robot file first.
    pub effects: Vec<EffectInstance>,
    /// What is learned on top.
    pub learner: Option<Learner>,
}

impl ArmModel {
    /// The model that a robot file alone gives: no geometry error, only the compliances that it states.
    pub fn nominal(robot: Robot) -> Self {
        let mut parameters = Parameters::zero();
        let mut effects = Vec::new();
        for (joint, &compliance) in robot.compliance_rad_per_nm.iter().enumerate() {
            effects
                .push(EffectInstance { effect: super::effect::JOINT_COMPLIANCE, location: Location::at_joint(joint) });
            parameters.effects.push(vec![compliance]);
        }
        Self {
            measuring_t_base: robot.base_or_identity(),
            flange_t_tool: robot.tool_or_identity(),
            robot,
            parameters,
            effects,
            learner: None,
        }
    }

    /// The model of what the controller believes: no effects, no errors.
    pub fn controller(robot: Robot) -> Self {
        let parameters = Parameters::zero();
        Self {
            measuring_t_base: robot.base_or_identity(),
            flange_t_tool: robot.tool_or_identity(),
            robot,
            parameters,
            effects: Vec::new(),
            learner: None,
        }
    }

    /// True when some effect that is on, or the learner, asks in which sense a joint arrives.
    pub fn depends_on_approach(&self) -> bool {
        let by_effect = self.effects.iter().zip(&self.parameters.effects).any(|(instance, values)| {
            instance.effect.meta().needs.approach && values.iter().any(|&value| value != 0.0)
        });
        by_effect || self.learner.as_ref().is_some_and(Learner::depends_on_approach)
    }

    /// The model with its parameters over the scalar `T`, ready to be evaluated many times.
    pub fn prepare<T: ModelScalar>(&self, parameters: Parameters<T>) -> PreparedArm<'_, T> {
        let loop_errors = LoopErrors {
            crank_m: parameters.crank_m,
            coupler_m: parameters.coupler_m,
            arm_m: arm_length_error(&self.robot, &parameters),
        };
        let largest_torque_nm = std::array::from_fn(|joint| largest_torque_nm(&self.robot, joint));
        let rows = Rows::new(&self.robot, &parameters);
        let learner = self.learner.as_ref().map(Learner::ready);
        PreparedArm { rows, loop_errors, largest_torque_nm, learner, model: self, parameters }
    }

    /// [`ArmModel::prepare`] with the model's own parameters.
    pub fn prepared(&self) -> PreparedArm<'_, f64> {
        self.prepare(self.parameters.clone())
    }
}

/// The loop's arm P-S is link 2: its length error is that of the row which carries the distance from axis 2 to 3.
fn arm_length_error<T: ModelScalar>(robot: &Robot, parameters: &Parameters<T>) -> T {
    let row = match robot.convention {
        super::robot::Convention::Standard => LOOP_AROUND,
        super::robot::Convention::Modified => LOOP_AROUND + 1,
    };
    parameters.rows[row].a_m
}

/// An [`ArmModel`] with the constant parts of its rows worked out.
pub struct PreparedArm<'a, T: ModelScalar> {
    pub(super) model: &'a ArmModel,
    pub(super) parameters: Parameters<T>,
    pub(super) rows: Rows<T>,
    pub(super) loop_errors: LoopErrors<T>,
    pub(super) largest_torque_nm: [f64; DOF],
    pub(super) learner: Option<ReadyLearner<'a>>,
}

/// The arm in one pose.
#[derive(Clone, Debug)]
pub struct ArmState<T: ModelScalar> {
    /// `base_T_flange` of the real arm.
    pub base_t_flange: Pose<T>,
    /// The chain.
    pub chain: Chain<T>,
    /// Row angles and how the driven one follows.
    pub angles: RowAngles<T>,
    /// Actuator angles as commanded.
    pub actuators_rad: [T; DOF],
    /// What the effects add under the loads of this pose.
    pub response: Response<T>,
    /// Loads in this pose.
    pub statics: Statics<T>,
}

/// Why the model has no pose for these joint numbers.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ArmError {
    /// The parallelogram is torn.
    #[error(transparent)]
    Loop(#[from] LoopOpen),
    /// Deflection and torque do not settle: the arm is softer than it is heavy.
    #[error("the arm finds no equilibrium: its deflection still changes by {change_rad:.1e} rad")]
    NoEquilibrium {
        /// Change in the last round, rad.
        change_rad: f64,
    },
}

impl<T: ModelScalar> PreparedArm<'_, T> {
    /// The model that was prepared.
    pub fn model(&self) -> &ArmModel {
        self.model
    }

    /// `measuring_T_base` with its error.
    pub fn measuring_t_base(&self) -> Pose<T> {
        Pose::constant(&self.model.measuring_t_base) * displacement_pose(&self.parameters.base)
    }

    /// `flange_T_tool` of the measured point with its error.
    pub fn flange_t_tool(&self) -> Pose<T> {
        Pose::constant(&self.model.flange_t_tool) * displacement_pose(&self.parameters.tool)
    }

    /// `measuring_T_tool`: where a tracker sees the measured point, and how the tool stands there.
    pub fn measured(&self, state: &ArmState<T>) -> Pose<T> {
        self.measuring_t_base() * state.base_t_flange * self.flange_t_tool() * displacement_pose(&state.response.tool)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::real::{DUAL_WIDTH, Dual, Real, derivatives, seeded};
    use crate::model::conditions::Conditions;
    use crate::model::fixture;
    use crate::model::parameters::{ParameterId, Rod, RowQuantity};

    const POSE: [f64; DOF] = [0.4, -0.3, 0.2, 1.1, -0.7, 2.0];

    fn soft_arm() -> ArmModel {
        let mut robot = fixture::looped_with_masses();
        robot.compliance_rad_per_nm = [1e-8, 4.3e-8, 9e-8, 2.5e-7, 2.8e-7, 1e-7];
        let mut model = ArmModel::nominal(robot);
        model.parameters.coupler_m = 3e-4;
        model.parameters.rows[1].a_m = -2e-4;
        model
    }

    /// Potential energy of all masses at these joint numbers, by plain summation, J.
    fn energy(model: &ArmModel, numbers: &[f64; DOF]) -> f64 {
        let state = model.prepared().at(numbers, &Conditions::default(), None).expect("a pose");
        let robot = &model.robot;
        let links = robot.links.expect("masses");
        let mut energy = 0.0;
        for (link, frame) in links.iter().zip(&state.chain.frames) {
            energy -= link.mass_kg * robot.gravity_m_s2.dot(&frame.transform_point(&link.center_of_mass_m));
        }
        let payload = state.base_t_flange.transform_point(&robot.payload.center_of_mass_m);
        energy - robot.payload.mass_kg * robot.gravity_m_s2.dot(&payload)
    }

    #[test]
    fn actuator_torque_is_minus_the_slope_of_potential_energy() {
        let mut model = soft_arm();
        model.effects.clear();
        model.parameters.effects.clear();
        let state = model.prepared().at(&POSE, &Conditions::default(), None).expect("a pose");
        for joint in 0..DOF {
            let step = 1e-6;
            let (mut up, mut down) = (POSE, POSE);
            up[joint] += step;
            down[joint] -= step;
            let slope = (energy(&model, &up) - energy(&model, &down)) / (2.0 * step);
            let torque = state.statics.actuator_torque_nm[joint];
            assert!((torque + slope).abs() < 1e-4, "joint {joint}: {torque} against {}", -slope);
        }
    }

    #[test]
    fn the_deflected_arm_is_at_equilibrium() {
        let model = soft_arm();
        let state = model.prepared().at(&POSE, &Conditions::default(), None).expect("a pose");
        for joint in 0..DOF {
            let spring = state.response.actuators_rad[joint] / model.robot.compliance_rad_per_nm[joint];
            let torque = state.statics.actuator_torque_nm[joint];
            assert!((spring - torque).abs() < 1e-3, "joint {joint}: {spring} against {torque}");
        }
        assert!(state.response.actuators_rad[1].abs() > 1e-4);
    }

    #[test]
    fn an_ideal_parallelogram_subtracts_the_arm_angle() {
        let robot = fixture::looped_with_masses();
        let looped = ArmModel::controller(robot.clone());
        let mut open = robot;
        open.parallelogram = None;
        let open = ArmModel::controller(open);
        let with_loop = looped.prepared().at(&POSE, &Conditions::default(), None).expect("a pose");
        let mut numbers = POSE;
        numbers[2] -= POSE[1];
        let without = open.prepared().at(&numbers, &Conditions::default(), None).expect("a pose");
        let difference = with_loop.base_t_flange.translation - without.base_t_flange.translation;
        assert!(difference.norm() < 1e-12);
    }

    #[test]
    fn dual_numbers_give_the_central_differences() {
        let mut model = soft_arm();
        model.robot.tool = None;
        let ids = [
            ParameterId::Row(0, RowQuantity::Offset),
            ParameterId::Row(1, RowQuantity::A),
            ParameterId::Row(2, RowQuantity::Alpha),
            ParameterId::Row(1, RowQuantity::Beta),
            ParameterId::Row(3, RowQuantity::D),
            ParameterId::Loop(Rod::Crank),
            ParameterId::Effect(1, 0),
            // An effect that is off has a derivative all the same: diagnosis lives on it.
            ParameterId::Effect(5, 0),
        ];
        model.parameters.effects[5][0] = 0.0;
        let mut dual = model.parameters.map(Dual::constant);
        for (slot, &id) in ids.iter().enumerate() {
            let number = dual.get_mut(id).expect("a parameter");
            *number = seeded(number.value(), slot);
        }
        assert_eq!(ids.len(), DUAL_WIDTH);
        let prepared = model.prepare(dual);
        let state = prepared.at(&POSE.map(Dual::constant), &Conditions::default(), None).expect("a pose");
        let point = prepared.measured(&state).translation;
        for (slot, &id) in ids.iter().enumerate() {
            let step = if matches!(id, ParameterId::Effect(..)) { 1e-9 } else { 1e-6 };
            let at = |shift: f64| {
                let mut parameters = model.parameters.clone();
                *parameters.get_mut(id).expect("a parameter") += shift;
                let prepared = model.prepare(parameters);
                let state = prepared.at(&POSE, &Conditions::default(), None).expect("a pose");
                prepared.measured(&state).translation
            };
            let central = (at(step) - at(-step)) / (2.0 * step);
            for axis in 0..3 {
                let exact = derivatives(&point[axis])[slot];
                let tolerance = 1e-6 * central.norm().max(1.0);
                assert!((exact - central[axis]).abs() < tolerance, "{id:?}: {exact} against {}", central[axis]);
            }
        }
    }
}

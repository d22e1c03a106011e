//! Static equilibrium: deflection depends on torque, and torque on the deflected pose.

use super::arm::{ArmError, ArmState, PreparedArm};
use super::chain::Chain;
use super::conditions::Conditions;
use super::effect::{Context, ModelScalar, Response, Setting};
use super::learner::ReadyLearner;
use super::linkage::{RowAngles, actuators_from_numbers, row_angles};
use super::network::Output;
use super::robot::DOF;
use super::statics::{Load, Statics};

/// Change of the deflection, rad, below which the equilibrium counts as reached: 0.3 nm at 3 m.
const EQUILIBRIUM_RAD: f64 = 1e-10;
/// Rounds after which an equilibrium that still moves is called unstable. Compliances contract by 1e-3 a round.
const EQUILIBRIUM_ROUNDS: usize = 40;

/// What stays as it is while the arm settles.
struct Stand<'a, T: ModelScalar> {
    conditions: &'a Conditions,
    commanded: [T; DOF],
    load: Load<T>,
}

impl<T: ModelScalar> PreparedArm<'_, T> {
    /// The arm at these joint numbers, at equilibrium: rounds of deflection and torque until neither changes.
    ///
    /// `start` is a guess of what the effects add (from a pose near by).
    ///
    /// # Errors
    /// [`ArmError`] when the loop is torn or no equilibrium exists.
    pub fn at(
        &self,
        numbers_rad: &[T; DOF],
        conditions: &Conditions,
        start: Option<&Response<T>>,
    ) -> Result<ArmState<T>, ArmError> {
        let stand = self.stand(numbers_rad, conditions);
        let mut assumed = start.copied().unwrap_or_else(Response::none);
        let mut change_rad = f64::INFINITY;
        let mut settled = 0;
        for _ in 0..EQUILIBRIUM_ROUNDS {
            let mut state = self.deflected(&stand, &assumed)?;
            change_rad = state.response.largest_change(&assumed);
            settled = if change_rad < EQUILIBRIUM_RAD { settled + 1 } else { 0 };
            if settled > T::ROUNDS_FOR_DERIVATIVES {
                self.add_learned_shift(&stand, &mut state);
                return Ok(state);
            }
            assumed = state.response;
        }
        Err(ArmError::NoEquilibrium { change_rad })
    }

    /// One round: the arm at these joint numbers, deflected as `assumed`. [`ArmState::response`] is how it then
    /// responds; at equilibrium the two are the same.
    ///
    /// # Errors
    /// [`ArmError`] when the loop is torn.
    pub fn round(
        &self,
        numbers_rad: &[T; DOF],
        conditions: &Conditions,
        assumed: &Response<T>,
    ) -> Result<ArmState<T>, ArmError> {
        let stand = self.stand(numbers_rad, conditions);
        let mut state = self.deflected(&stand, assumed)?;
        self.add_learned_shift(&stand, &mut state);
        Ok(state)
    }

    fn stand<'c>(&self, numbers_rad: &[T; DOF], conditions: &'c Conditions) -> Stand<'c, T> {
        let robot = &self.model.robot;
        let commanded = actuators_from_numbers(robot, numbers_rad);
        let mut load = Load::declared(robot, conditions.payload.as_ref());
        let setting = Setting { robot, conditions, actuators_rad: &commanded };
        for (instance, parameters) in self.model.effects.iter().zip(&self.parameters.effects) {
            T::load(instance.effect, &instance.location, parameters, &setting, &mut load);
        }
        Stand { conditions, commanded, load }
    }

    fn deflected(&self, stand: &Stand<'_, T>, assumed: &Response<T>) -> Result<ArmState<T>, ArmError> {
        let robot = &self.model.robot;
        let standing: [T; DOF] = std::array::from_fn(|joint| {
            stand.commanded[joint] + self.parameters.rows[joint].offset_rad + assumed.actuators_rad[joint]
        });
        let angles = row_angles(robot, &standing, &self.loop_errors)?;
        let chain = self.rows.at(&angles.theta_rad, assumed);
        let statics = Statics::of(robot, &chain, &angles, &stand.load);
        let response = self.respond(stand, &chain, &angles, &statics);
        let base_t_flange = chain.flange();
        Ok(ArmState { base_t_flange, chain, angles, actuators_rad: stand.commanded, response, statics })
    }

    fn respond(
        &self,
        stand: &Stand<'_, T>,
        chain: &Chain<T>,
        angles: &RowAngles<T>,
        statics: &Statics<T>,
    ) -> Response<T> {
        let context = Context {
            robot: &self.model.robot,
            largest_torque_nm: &self.largest_torque_nm,
            conditions: stand.conditions,
            actuators_rad: &stand.commanded,
            angles,
            chain,
            statics,
            load: &stand.load,
        };
        let mut response = Response::none();
        for (instance, parameters) in self.model.effects.iter().zip(&self.parameters.effects) {
            T::respond(instance.effect, &instance.location, parameters, &context, &mut response);
        }
        if let Some(learner) = self.learner_for(Output::Actuators) {
            let learned = learner.outputs(&stand.commanded, &statics.actuator_torque_nm, stand.conditions);
            for (joint, angle) in learned.into_iter().enumerate() {
                response.turn(joint, angle);
            }
        }
        response
    }

    fn add_learned_shift(&self, stand: &Stand<'_, T>, state: &mut ArmState<T>) {
        if let Some(learner) = self.learner_for(Output::Position) {
            let learned = learner.outputs(&stand.commanded, &state.statics.actuator_torque_nm, stand.conditions);
            for (coordinate, shift) in state.base_t_flange.translation.iter_mut().zip(learned) {
                *coordinate += shift;
            }
        }
    }

    fn learner_for(&self, output: Output) -> Option<&ReadyLearner<'_>> {
        self.learner.as_ref().filter(|learner| learner.output() == output)
    }
}

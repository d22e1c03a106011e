//! Static equilibrium: deflection depends on torque, and torque on the deflected pose.

use crate::geometry::pose::Pose;

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

/// Change of derivatives, in parts of themselves, below which they count as settled: what a round changes less than this.
const SLOPES_SETTLED: f64 = 1e-6;

/// What stays as it is while the arm settles.
struct Stand<'a, T: ModelScalar> {
    conditions: &'a Conditions,
    load: Load<T>,
}

/// What a round changed.
struct Change {
    /// Of the deflection, rad or m.
    value: f64,
    /// Of its derivatives, in parts of themselves; zero for plain numbers.
    slopes: f64,
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
        let mut state = self.unsettled(numbers_rad, start);
        let stand = self.stand(&state, conditions);
        let mut last = Change { value: f64::INFINITY, slopes: 1.0 };
        for _ in 0..EQUILIBRIUM_ROUNDS {
            let change = self.settle(&stand, &mut state)?;
            // Each round contracts as the one before did: what the next one would change counts, not what this one has.
            let next_slopes = change.slopes * (change.slopes / last.slopes).min(1.0);
            if change.value < EQUILIBRIUM_RAD && (change.slopes == 0.0 || next_slopes < SLOPES_SETTLED) {
                self.add_learned_shift(&stand, &mut state);
                return Ok(state);
            }
            last = change;
        }
        Err(ArmError::NoEquilibrium { change_rad: last.value })
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
        let mut state = self.unsettled(numbers_rad, Some(assumed));
        let stand = self.stand(&state, conditions);
        self.settle(&stand, &mut state)?;
        self.add_learned_shift(&stand, &mut state);
        Ok(state)
    }

    /// An arm that has its commands and what its effects are assumed to add, and nothing else yet.
    fn unsettled(&self, numbers_rad: &[T; DOF], assumed: Option<&Response<T>>) -> ArmState<T> {
        ArmState {
            base_t_flange: Pose::identity(),
            chain: Chain::at_rest(),
            angles: RowAngles::none(),
            actuators_rad: actuators_from_numbers(&self.model.robot, numbers_rad),
            response: assumed.copied().unwrap_or_else(Response::none),
            statics: Statics::none(),
        }
    }

    fn stand<'c>(&self, state: &ArmState<T>, conditions: &'c Conditions) -> Stand<'c, T> {
        let robot = &self.model.robot;
        let mut load = Load::declared(robot, conditions.payload.as_ref());
        let setting = Setting { robot, conditions, actuators_rad: &state.actuators_rad };
        for (instance, parameters) in self.model.effects.iter().zip(&self.parameters.effects) {
            T::load(instance.effect, &instance.location, parameters, &setting, &mut load);
        }
        Stand { conditions, load }
    }

    /// Deflects the arm as it responds now, in place (an arm of dual numbers has seventeen kilobytes), and finds how it
    /// responds then.
    fn settle(&self, stand: &Stand<'_, T>, state: &mut ArmState<T>) -> Result<Change, ArmError> {
        let robot = &self.model.robot;
        let standing: [T; DOF] = std::array::from_fn(|joint| {
            state.actuators_rad[joint] + self.parameters.rows[joint].offset_rad + state.response.actuators_rad[joint]
        });
        state.angles = row_angles(robot, &standing, &self.loop_errors)?;
        self.rows.place(&state.angles.theta_rad, &state.response, &mut state.chain);
        state.statics.weigh(robot, &state.chain, &state.angles, &stand.load);
        state.base_t_flange = state.chain.flange();
        let mut next = Response::none();
        self.respond(stand, state, &mut next);
        let change = Change {
            value: next.largest_change(&state.response),
            slopes: T::change_of_slopes(&next, &state.response, &state.base_t_flange.translation),
        };
        state.response = next;
        Ok(change)
    }

    fn respond(&self, stand: &Stand<'_, T>, state: &ArmState<T>, response: &mut Response<T>) {
        let context = Context {
            robot: &self.model.robot,
            largest_torque_nm: &self.largest_torque_nm,
            conditions: stand.conditions,
            actuators_rad: &state.actuators_rad,
            angles: &state.angles,
            chain: &state.chain,
            statics: &state.statics,
            load: &stand.load,
        };
        for (instance, parameters) in self.model.effects.iter().zip(&self.parameters.effects) {
            T::respond(instance.effect, &instance.location, parameters, &context, response);
        }
        if let Some(learner) = self.learner_for(Output::Actuators) {
            let learned = learner.outputs(&state.actuators_rad, &state.statics.actuator_torque_nm, stand.conditions);
            for (joint, angle) in learned.into_iter().enumerate() {
                response.turn(joint, angle);
            }
        }
    }

    fn add_learned_shift(&self, stand: &Stand<'_, T>, state: &mut ArmState<T>) {
        if let Some(learner) = self.learner_for(Output::Position) {
            let learned = learner.outputs(&state.actuators_rad, &state.statics.actuator_torque_nm, stand.conditions);
            for (coordinate, shift) in state.base_t_flange.translation.iter_mut().zip(learned) {
                *coordinate += shift;
            }
        }
    }

    fn learner_for(&self, output: Output) -> Option<&ReadyLearner<'_>> {
        self.learner.as_ref().filter(|learner| learner.output() == output)
    }
}

//! What was learned of the errors that no named effect explains, one kind a file: [`network`](super::network),
//! [`curves`](super::curves).

use crate::geometry::real::Real;

use super::conditions::Conditions;
use super::curves::JointCurves;
use super::network::{Feature, Output, ResidualNetwork};
use super::ready_network::ReadyNetwork;
use super::robot::DOF;

/// A learned correction on top of the physics.
#[derive(Clone, Debug, PartialEq)]
pub enum Learner {
    /// Tangent hyperbolicus units on joints and loads.
    Network(ResidualNetwork),
    /// Sums of smooth functions of one variable each, turning one actuator each.
    Curves(JointCurves),
}

impl From<ResidualNetwork> for Learner {
    fn from(network: ResidualNetwork) -> Self {
        Learner::Network(network)
    }
}

impl From<JointCurves> for Learner {
    fn from(curves: JointCurves) -> Self {
        Learner::Curves(curves)
    }
}

impl Learner {
    /// What its numbers are added to.
    pub fn output(&self) -> Output {
        match self {
            Learner::Network(network) => network.output,
            Learner::Curves(_) => Output::Actuators,
        }
    }

    /// True when it asks in which sense a joint arrives.
    pub fn depends_on_approach(&self) -> bool {
        match self {
            Learner::Network(network) => network.features.iter().any(|feature| matches!(feature, Feature::Approach(_))),
            Learner::Curves(curves) => curves.curves.iter().any(|curve| curve.sense_of.is_some()),
        }
    }

    /// Standard uncertainty of what each actuator is turned by, rad; zero where the learner does not know it.
    pub fn sigma_rad(
        &self,
        actuators_rad: &[f64; DOF],
        actuator_torque_nm: &[f64; DOF],
        conditions: &Conditions,
    ) -> [f64; DOF] {
        match self {
            Learner::Network(network) => network.sigma_rad(actuators_rad, actuator_torque_nm, conditions),
            Learner::Curves(curves) => curves.sigma_rad(actuators_rad, actuator_torque_nm, conditions),
        }
    }

    /// Multiplies its uncertainty. A network that does not know it stays without.
    pub fn scale_sigma(&mut self, factor: f64) {
        match self {
            Learner::Network(network) => {
                if let Some(sureness) = &mut network.sureness {
                    sureness.factor *= factor;
                }
            }
            Learner::Curves(curves) => {
                for sigma in curves.curves.iter_mut().flat_map(|curve| &mut curve.sigma_rad) {
                    // As short in a file as the curves are.
                    *sigma = (*sigma * factor * 1e11).round() / 1e11;
                }
            }
        }
    }

    /// Laid out for many evaluations.
    pub fn ready(&self) -> ReadyLearner<'_> {
        match self {
            Learner::Network(network) => ReadyLearner::Network(network.ready()),
            Learner::Curves(curves) => ReadyLearner::Curves(curves),
        }
    }
}

/// A [`Learner`] ready to be evaluated.
#[derive(Clone, Debug)]
pub enum ReadyLearner<'a> {
    /// See [`Learner::Network`].
    Network(ReadyNetwork),
    /// See [`Learner::Curves`].
    Curves(&'a JointCurves),
}

impl ReadyLearner<'_> {
    /// What its numbers are added to.
    pub fn output(&self) -> Output {
        match self {
            ReadyLearner::Network(network) => network.output,
            ReadyLearner::Curves(_) => Output::Actuators,
        }
    }

    /// The outputs (the first [`Output::count`] of the array) at these actuator angles and loads.
    pub fn outputs<T: Real>(
        &self,
        actuators_rad: &[T; DOF],
        actuator_torque_nm: &[T; DOF],
        conditions: &Conditions,
    ) -> [T; DOF] {
        match self {
            ReadyLearner::Network(network) => network.outputs(actuators_rad, actuator_torque_nm, conditions),
            ReadyLearner::Curves(curves) => curves.outputs(actuators_rad, actuator_torque_nm, conditions),
        }
    }
}

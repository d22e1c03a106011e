//! A small feed-forward network on what the physics leaves.

use serde::{Deserialize, Serialize};

use crate::geometry::real::Real;

use super::conditions::Conditions;
use super::ready_network::ReadyNetwork;
use super::robot::DOF;

/// One input of the network. Joints count from one, as in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature {
    /// Actuator angle, rad.
    Angle(usize),
    /// Its sine.
    Sine(usize),
    /// Its cosine.
    Cosine(usize),
    /// Load torque, Nm.
    Torque(usize),
    /// Sense of the last approach.
    Approach(usize),
}

/// What the numbers that come out are added to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Output {
    /// Six actuator angles, rad.
    Actuators,
    /// x, y, z of the flange in the robot base, m.
    Position,
}

/// One hidden layer of hyperbolic tangents: `y = W2 tanh(W1 (x - shift) / scale + b1) + b2`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layers {
    /// W1, a row for each hidden unit.
    pub hidden_weights: Vec<Vec<f64>>,
    /// b1.
    pub hidden_biases: Vec<f64>,
    /// W2, a row for each output.
    pub output_weights: Vec<Vec<f64>>,
    /// b2.
    pub output_biases: Vec<f64>,
}

/// A bag of networks whose outputs are averaged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResidualNetwork {
    /// The inputs, in order.
    pub features: Vec<Feature>,
    /// What is subtracted from each input.
    pub shift: Vec<f64>,
    /// By what each input is then divided.
    pub scale: Vec<f64>,
    /// What comes out.
    pub output: Output,
    /// The members of the bag.
    pub members: Vec<Layers>,
}

/// What is wrong with the shapes of a network.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the network's {what} has {found} entries where {expected} belong")]
pub struct ShapeError {
    /// Which array.
    pub what: &'static str,
    /// Its length.
    pub found: usize,
    /// The length that fits.
    pub expected: usize,
}

impl Output {
    /// How many numbers come out.
    pub fn count(self) -> usize {
        match self {
            Output::Actuators => DOF,
            Output::Position => 3,
        }
    }
}

impl ResidualNetwork {
    /// Checks that all arrays fit together.
    ///
    /// # Errors
    /// [`ShapeError`] with the first that does not.
    pub fn check(&self) -> Result<(), ShapeError> {
        let inputs = self.features.len();
        let fits = |what, found, expected| {
            if found == expected { Ok(()) } else { Err(ShapeError { what, found, expected }) }
        };
        fits("shift", self.shift.len(), inputs)?;
        fits("scale", self.scale.len(), inputs)?;
        for member in &self.members {
            let hidden = member.hidden_biases.len();
            fits("hidden_weights", member.hidden_weights.len(), hidden)?;
            fits("output_weights", member.output_weights.len(), self.output.count())?;
            fits("output_biases", member.output_biases.len(), self.output.count())?;
            for row in &member.hidden_weights {
                fits("hidden_weights row", row.len(), inputs)?;
            }
            for row in &member.output_weights {
                fits("output_weights row", row.len(), hidden)?;
            }
        }
        Ok(())
    }

    /// The network laid out for many evaluations.
    pub fn ready(&self) -> ReadyNetwork {
        ReadyNetwork::new(self)
    }
}

impl Feature {
    /// Its value; `turns` are sine and cosine of the angles.
    pub(super) fn value<T: Real>(
        self,
        angles: &[T; DOF],
        turns: &[(T, T); DOF],
        torques: &[T; DOF],
        conditions: &Conditions,
    ) -> T {
        let joint = |from_one: usize| from_one.clamp(1, DOF) - 1;
        match self {
            Feature::Angle(at) => angles[joint(at)],
            Feature::Sine(at) => turns[joint(at)].0,
            Feature::Cosine(at) => turns[joint(at)].1,
            Feature::Torque(at) => torques[joint(at)],
            Feature::Approach(at) => T::constant(conditions.approach[joint(at)]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn network() -> ResidualNetwork {
        let layers = Layers {
            hidden_weights: vec![vec![0.5, -0.25], vec![1.0, 2.0]],
            hidden_biases: vec![0.1, -0.2],
            output_weights: vec![vec![1.0, 0.0], vec![0.0, 1.0], vec![2.0, -1.0]],
            output_biases: vec![0.0, 0.0, 0.5],
        };
        ResidualNetwork {
            features: vec![Feature::Sine(1), Feature::Angle(2)],
            shift: vec![0.0, 1.0],
            scale: vec![1.0, 2.0],
            output: Output::Position,
            members: vec![layers.clone(), layers],
        }
    }

    #[test]
    fn the_output_is_the_formula_worked_by_hand() {
        let network = network();
        assert_eq!(network.check(), Ok(()));
        let out = network.ready().outputs(&[0.3, 0.8, 0.0, 0.0, 0.0, 0.0], &[0.0; DOF], &Conditions::default());
        let (x0, x1) = (0.3f64.sin(), (0.8 - 1.0) / 2.0);
        let (h0, h1) = ((0.5 * x0 - 0.25 * x1 + 0.1).tanh(), (x0 + 2.0 * x1 - 0.2).tanh());
        for (found, expected) in out.iter().zip([h0, h1, 2.0 * h0 - h1 + 0.5]) {
            assert!((found - expected).abs() < 1e-15);
        }
    }

    #[test]
    fn shapes_that_do_not_fit_are_told() {
        let mut broken = network();
        broken.members[1].output_weights[2].pop();
        assert_eq!(broken.check(), Err(ShapeError { what: "output_weights row", found: 1, expected: 2 }));
    }
}

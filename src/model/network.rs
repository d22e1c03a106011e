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
    /// Sine of the sum of two actuator angles: how a serial forearm stands to gravity.
    SineOfSum(usize, usize),
    /// Its cosine.
    CosineOfSum(usize, usize),
    /// Sine of the first actuator angle less the second: how far a parallelogram is folded.
    SineOfDifference(usize, usize),
    /// Its cosine.
    CosineOfDifference(usize, usize),
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
    /// Where it learned; absent: it holds everywhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measured: Option<Box<MeasuredBox>>,
    /// How sure it is; absent: it does not know.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sureness: Option<Box<Sureness>>,
}

/// The actuator angles of the records that a network learned from. Beyond them it goes to nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredBox {
    /// Smallest of each, rad.
    pub min_rad: [f64; DOF],
    /// Largest of each, rad.
    pub max_rad: [f64; DOF],
}

/// Standard uncertainty of a network of actuator errors: `factor sqrt(spread^2 + evidence^2)` of each output, with the
/// standard deviation of the members at the pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sureness {
    /// What the evidence leaves of each output, root mean square over the records, rad.
    pub evidence_rad: [f64; DOF],
    /// By what held-out records say that both together are too small or too large.
    pub factor: f64,
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

    /// Standard uncertainty of each output at a pose, rad; zero where the network does not know it.
    pub fn sigma_rad(
        &self,
        actuators_rad: &[f64; DOF],
        actuator_torque_nm: &[f64; DOF],
        conditions: &Conditions,
    ) -> [f64; DOF] {
        let Some(sureness) = &self.sureness else { return [0.0; DOF] };
        let alone = |member: &Layers| Self { members: vec![member.clone()], ..self.clone() }.ready();
        let outputs: Vec<[f64; DOF]> = self
            .members
            .iter()
            .map(|member| alone(member).outputs(actuators_rad, actuator_torque_nm, conditions))
            .collect();
        let count = outputs.len().max(1) as f64;
        std::array::from_fn(|output| {
            let mean = outputs.iter().map(|one| one[output]).sum::<f64>() / count;
            let spread = outputs.iter().map(|one| (one[output] - mean).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
            sureness.factor * (spread + sureness.evidence_rad[output].powi(2)).sqrt()
        })
    }

    /// The network laid out for many evaluations.
    pub fn ready(&self) -> ReadyNetwork {
        ReadyNetwork::new(self)
    }
}

/// Beyond the measured box, over this part of its width, a network goes to nothing.
const FADES: f64 = 0.12;

impl MeasuredBox {
    /// One within the box, zero far from it, smooth in between: a product over the actuators.
    pub(super) fn share<T: Real>(&self, actuators_rad: &[T; DOF]) -> T {
        let mut share = T::one();
        for (angle, (min, max)) in actuators_rad.iter().zip(self.min_rad.iter().zip(&self.max_rad)) {
            let fades = FADES * (max - min).max(f64::MIN_POSITIVE);
            let beyond = if angle.value() > *max { *angle - T::constant(*max) } else { T::constant(*min) - *angle };
            if beyond.value() >= fades {
                return T::zero();
            }
            if beyond.value() > 0.0 {
                let part = beyond / T::constant(fades);
                share *= T::one() - part * part * (T::constant(3.0) - part * T::constant(2.0));
            }
        }
        share
    }
}

impl Feature {
    /// Its value; `turns` are sine and cosine of the angles.
    pub fn value<T: Real>(
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
            Feature::SineOfSum(one, other) => {
                let ((s, c), (so, co)) = (turns[joint(one)], turns[joint(other)]);
                s * co + c * so
            }
            Feature::CosineOfSum(one, other) => {
                let ((s, c), (so, co)) = (turns[joint(one)], turns[joint(other)]);
                c * co - s * so
            }
            Feature::SineOfDifference(one, other) => {
                let ((s, c), (so, co)) = (turns[joint(one)], turns[joint(other)]);
                s * co - c * so
            }
            Feature::CosineOfDifference(one, other) => {
                let ((s, c), (so, co)) = (turns[joint(one)], turns[joint(other)]);
                c * co + s * so
            }
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
            measured: None,
            sureness: None,
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
    fn beyond_the_measured_box_it_goes_to_nothing_and_members_that_differ_make_it_unsure() {
        let measured = MeasuredBox { min_rad: [-1.0; DOF], max_rad: [1.0; DOF] };
        let mut network = ResidualNetwork { measured: Some(Box::new(measured)), ..network() };
        let at = |network: &ResidualNetwork, angle: f64| {
            network.ready().outputs(&[angle, 0.8, 0.0, 0.0, 0.0, 0.0], &[0.0; DOF], &Conditions::default())[2]
        };
        assert_eq!(at(&network, 0.9), at(&ResidualNetwork { measured: None, ..network.clone() }, 0.9));
        assert!(at(&network, 1.1).abs() < 0.9 * at(&network, 1.0).abs() && at(&network, 1.1) != 0.0);
        assert_eq!((at(&network, 1.25), at(&network, -1.25)), (0.0, 0.0));
        network.sureness = Some(Box::new(Sureness { evidence_rad: [3e-4; DOF], factor: 2.0 }));
        let sigma = |network: &ResidualNetwork| network.sigma_rad(&[0.1; DOF], &[0.0; DOF], &Conditions::default())[1];
        assert!((sigma(&network) - 6e-4).abs() < 1e-12);
        network.members[1].output_biases[1] += 8e-4;
        // Two members 8e-4 apart: a variance of 32e-8 beside 9e-8.
        assert!((sigma(&network) - 2.0 * 41e-8f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn shapes_that_do_not_fit_are_told() {
        let mut broken = network();
        broken.members[1].output_weights[2].pop();
        assert_eq!(broken.check(), Err(ShapeError { what: "output_weights row", found: 1, expected: 2 }));
    }
}

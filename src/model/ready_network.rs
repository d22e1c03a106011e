//! The network laid out for evaluation: the members of a bag side by side, their hidden units in blocks that a
//! processor adds up together.

use crate::geometry::real::Real;

use super::conditions::Conditions;
use super::network::{Feature, Layers, MeasuredBox, Output, ResidualNetwork};
use super::robot::DOF;

/// Hidden units in a block.
const WIDTH: usize = 8;

/// A [`ResidualNetwork`] ready to be evaluated.
#[derive(Clone, Debug)]
pub struct ReadyNetwork {
    /// What its numbers are added to.
    pub output: Output,
    features: Vec<ScaledFeature>,
    /// Mean of the members' output biases.
    biases: [f64; DOF],
    blocks: Vec<Block>,
    measured: Option<Box<MeasuredBox>>,
}

#[derive(Clone, Copy, Debug)]
struct ScaledFeature {
    feature: Feature,
    shift: f64,
    scale: f64,
}

/// Some hidden units, with zeros where there are fewer than [`WIDTH`].
#[derive(Clone, Debug)]
struct Block {
    biases: [f64; WIDTH],
    /// Weights by input.
    inputs: Vec<[f64; WIDTH]>,
    /// Weights by output, each divided by the number of members.
    outputs: [[f64; WIDTH]; DOF],
}

impl ReadyNetwork {
    /// Lays out a network whose shapes fit ([`ResidualNetwork::check`]); what does not fit counts as zero.
    pub fn new(network: &ResidualNetwork) -> Self {
        let scaled = network.features.iter().zip(network.shift.iter().zip(&network.scale));
        let features: Vec<ScaledFeature> =
            scaled.map(|(&feature, (&shift, &scale))| ScaledFeature { feature, shift, scale }).collect();
        let share = 1.0 / network.members.len().max(1) as f64;
        let mut biases = [0.0; DOF];
        let mut blocks = Vec::new();
        for member in &network.members {
            for (sum, bias) in biases.iter_mut().zip(&member.output_biases) {
                *sum += bias * share;
            }
            let starts = (0..member.hidden_biases.len()).step_by(WIDTH);
            blocks.extend(starts.map(|first| Block::new(member, first, features.len(), share)));
        }
        Self { output: network.output, features, biases, blocks, measured: network.measured.clone() }
    }

    /// The outputs (the first [`Output::count`] of the array) at these actuator angles and loads.
    pub fn outputs<T: Real>(
        &self,
        actuators_rad: &[T; DOF],
        actuator_torque_nm: &[T; DOF],
        conditions: &Conditions,
    ) -> [T; DOF] {
        let turns = actuators_rad.map(|angle| num_dual::DualNum::sin_cos(&angle));
        let scaled = |one: &ScaledFeature| {
            let raw = one.feature.value(actuators_rad, &turns, actuator_torque_nm, conditions);
            (raw - T::constant(one.shift)) / T::constant(one.scale)
        };
        let inputs: Vec<T> = self.features.iter().map(scaled).collect();
        let mut out = self.biases.map(T::constant);
        for block in &self.blocks {
            let hidden = block.activations(&inputs);
            for (number, weights) in out.iter_mut().zip(&block.outputs).take(self.output.count()) {
                for (unit, &weight) in hidden.iter().zip(weights) {
                    *number += *unit * T::constant(weight);
                }
            }
        }
        if let Some(measured) = &self.measured {
            let share = measured.share(actuators_rad);
            out.iter_mut().for_each(|number| *number *= share);
        }
        out
    }
}

impl Block {
    fn new(member: &Layers, first: usize, inputs: usize, share: f64) -> Self {
        let weight = |rows: &[Vec<f64>], row: usize, column: usize| {
            rows.get(row).and_then(|row| row.get(column)).copied().unwrap_or(0.0)
        };
        let unit = |place: usize| first + place;
        Self {
            biases: std::array::from_fn(|place| member.hidden_biases.get(unit(place)).copied().unwrap_or(0.0)),
            inputs: (0..inputs)
                .map(|input| std::array::from_fn(|place| weight(&member.hidden_weights, unit(place), input)))
                .collect(),
            outputs: std::array::from_fn(|output| {
                std::array::from_fn(|place| weight(&member.output_weights, output, unit(place)) * share)
            }),
        }
    }

    fn activations<T: Real>(&self, inputs: &[T]) -> [T; WIDTH] {
        let mut sums = self.biases.map(T::constant);
        for (input, weights) in inputs.iter().zip(&self.inputs) {
            for (sum, &weight) in sums.iter_mut().zip(weights) {
                *sum += *input * T::constant(weight);
            }
        }
        sums.map(hyperbolic_tangent)
    }
}

/// Exact to rounding of one (small arguments lose relative, not absolute accuracy) at a quarter of the price of the
/// library's, and without overflow.
fn hyperbolic_tangent<T: Real>(x: T) -> T {
    let negative = x.value() < 0.0;
    let minus_size = if negative { x } else { -x };
    let decay = num_dual::DualNum::exp(&(minus_size + minus_size));
    let size = (T::one() - decay) / (T::one() + decay);
    if negative { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_activation_is_the_hyperbolic_tangent_with_its_slope() {
        use crate::geometry::real::{derivatives, seeded};
        for x in [-800.0, -3.0, -1e-9, 0.0, 1e-9, 0.4, 20.0, 800.0] {
            let found = hyperbolic_tangent(seeded(x, 0));
            assert!((found.value() - f64::tanh(x)).abs() < 1e-15, "{x}");
            let slope = 1.0 - f64::tanh(x).powi(2);
            assert!((derivatives(&found)[0] - slope).abs() < 1e-15, "{x}");
        }
    }
}

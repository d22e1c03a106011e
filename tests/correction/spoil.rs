//! Arms with random errors.

use falsetarget::model::arm::{ArmModel, EffectInstance};
use falsetarget::model::effect::{Location, by_id};
use falsetarget::model::network::{Feature, Layers, Output, ResidualNetwork};
use falsetarget::model::robot::{DOF, Robot};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// A random error of every kind that a calibration finds, of the size that it finds.
pub fn spoil(robot: Robot, random: &mut ChaCha8Rng) -> ArmModel {
    let mut model = ArmModel::nominal(robot);
    let mut any = |size: f64| random.random_range(-size..size);
    for row in &mut model.parameters.rows {
        row.offset_rad = any(1e-3);
        row.d_m = any(5e-4);
        row.a_m = any(5e-4);
        row.alpha_rad = any(5e-4);
        row.beta_rad = any(3e-4);
    }
    model.parameters.base = [any(5e-4), any(5e-4), any(5e-4), any(2e-4), any(2e-4), any(2e-4)];
    if model.robot.parallelogram.is_some() {
        model.parameters.crank_m = any(3e-4);
        model.parameters.coupler_m = any(3e-4);
    }
    let heavy = if model.robot.links.is_some_and(|links| links[1].mass_kg > 50.0) { 3e-7 } else { 1e-5 };
    for compliance in &mut model.parameters.effects {
        compliance[0] = any(heavy).abs();
    }
    model.learner = Some(network(random).into());
    model
}

/// Gives joint 1 of an arm free play.
pub fn loosen(model: &mut ArmModel, random: &mut ChaCha8Rng) {
    let backlash = by_id("backlash").expect("in the registry");
    model.effects.push(EffectInstance { effect: backlash, location: Location::at_joint(0) });
    model.parameters.effects.push(vec![random.random_range(0.0..2e-4)]);
}

/// A network whose corrections are a tenth of a milliradian.
fn network(random: &mut ChaCha8Rng) -> ResidualNetwork {
    let features: Vec<Feature> = (1..=DOF).flat_map(|joint| [Feature::Sine(joint), Feature::Cosine(joint)]).collect();
    let (inputs, hidden) = (features.len(), 8);
    let mut row =
        |length: usize, size: f64| -> Vec<f64> { (0..length).map(|_| random.random_range(-size..size)).collect() };
    let layers = Layers {
        hidden_weights: (0..hidden).map(|_| row(inputs, 1.0)).collect(),
        hidden_biases: row(hidden, 1.0),
        output_weights: (0..DOF).map(|_| row(hidden, 3e-5)).collect(),
        output_biases: row(DOF, 3e-5),
    };
    let (shift, scale) = (vec![0.0; inputs], vec![1.0; inputs]);
    ResidualNetwork {
        features,
        shift,
        scale,
        output: Output::Actuators,
        members: vec![layers],
        measured: None,
        sureness: None,
    }
}

//! The network of the paper (Nguyen, Le and Kang 2019): six joint angles in, one hidden layer, three Cartesian errors out,
//! trained by back-propagation. Kept as the measure of what a plain network does; the default learner does better.

use nalgebra::{DMatrix, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;
use crate::model::linkage::actuators_from_numbers;
use crate::model::network::{Feature, Layers, Output, ResidualNetwork};
use crate::model::robot::DOF;

/// Hidden units. The paper shows its number in a figure that is not in the text.
const HIDDEN: usize = 12;
/// Passes over the records.
const EPOCHS: usize = 4000;
/// Step along the gradient of the mean square, and what is kept of the step before (Rumelhart, Hinton and Williams 1986).
const RATE: f64 = 0.05;
/// See [`RATE`].
const MOMENTUM: f64 = 0.9;

/// A network on the residuals that a state leaves on the records of a problem.
///
/// Inputs and outputs are standardised; weights start uniform within one over the root of the number of inputs; all
/// records go into every step.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn train(problem: &Problem<'_>, state: &State, seed: u64) -> Result<ResidualNetwork, NoPose> {
    let residuals = problem.residuals(state)?;
    let prepared = state.model.prepared();
    let base_r_measuring = prepared.measuring_t_base().rotation.transpose();
    let robot = &state.model.robot;
    let count = problem.records.len();
    let mut inputs = DMatrix::zeros(DOF, count);
    let mut targets = DMatrix::zeros(3, count);
    for (index, (record, first)) in problem.records.iter().zip(problem.first_rows()).enumerate() {
        for (row, angle) in actuators_from_numbers(robot, &record.observation.numbers_rad).iter().enumerate() {
            inputs[(row, index)] = *angle;
        }
        let station = state.stations.get(record.station).map(|station| station.pose().rotation.transpose());
        let missing: Vector3<f64> = -residuals.fixed_rows::<3>(first);
        targets.set_column(index, &(base_r_measuring * station.map_or(missing, |turn| turn * missing)));
    }
    let (shift, scale) = standardise(&mut inputs);
    let (mean, size) = standardise(&mut targets);
    let mut layers = back_propagate(&inputs, &targets, seed);
    for (output, (mean, size)) in mean.iter().zip(&size).enumerate() {
        for weight in &mut layers.output_weights[output] {
            *weight *= size;
        }
        layers.output_biases[output] = layers.output_biases[output] * size + mean;
    }
    let features = (1..=DOF).map(Feature::Angle).collect();
    Ok(ResidualNetwork { features, shift, scale, output: Output::Position, members: vec![layers] })
}

/// Subtracts the mean of each row and divides by its spread.
fn standardise(rows: &mut DMatrix<f64>) -> (Vec<f64>, Vec<f64>) {
    rows.row_iter_mut()
        .map(|mut row| {
            let mean = row.mean();
            let spread = row.variance().sqrt();
            let spread = if spread > 0.0 { spread } else { 1.0 };
            row.apply(|number| *number = (*number - mean) / spread);
            (mean, spread)
        })
        .unzip()
}

/// The hidden layer's activations: `tanh(W1 x + b1)`, with a last row of ones for the biases of the next layer.
fn hidden(first: &DMatrix<f64>, inputs: &DMatrix<f64>) -> DMatrix<f64> {
    let mut activation = (first * inputs).map(f64::tanh);
    let rows = activation.nrows();
    activation = activation.insert_row(rows, 1.0);
    activation
}

fn back_propagate(inputs: &DMatrix<f64>, targets: &DMatrix<f64>, seed: u64) -> Layers {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let inputs = inputs.clone().insert_row(inputs.nrows(), 1.0);
    let mut draw = |rows: usize, columns: usize| {
        let width = 1.0 / (columns as f64).sqrt();
        DMatrix::from_fn(rows, columns, |_, _| random.random_range(-width..width))
    };
    let mut first = draw(HIDDEN, inputs.nrows());
    let mut second = draw(targets.nrows(), HIDDEN + 1);
    let (mut step_first, mut step_second) = (first.scale(0.0), second.scale(0.0));
    let share = RATE / inputs.ncols().max(1) as f64;
    for _ in 0..EPOCHS {
        let activation = hidden(&first, &inputs);
        let error = &second * &activation - targets;
        let slope_second = &error * activation.transpose();
        let units = activation.rows(0, HIDDEN);
        let back = second.columns(0, HIDDEN).transpose() * &error;
        let slope_first = back.zip_map(&units, |back, unit| back * (1.0 - unit * unit)) * inputs.transpose();
        step_first = step_first * MOMENTUM - slope_first * share;
        step_second = step_second * MOMENTUM - slope_second * share;
        first += &step_first;
        second += &step_second;
    }
    let split = |matrix: &DMatrix<f64>| -> (Vec<Vec<f64>>, Vec<f64>) {
        let last = matrix.ncols() - 1;
        matrix.row_iter().map(|row| (row.columns(0, last).iter().copied().collect::<Vec<f64>>(), row[last])).unzip()
    };
    let ((hidden_weights, hidden_biases), (output_weights, output_biases)) = (split(&first), split(&second));
    Layers { hidden_weights, hidden_biases, output_weights, output_biases }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn back_propagation_learns_a_smooth_function() {
        let inputs = DMatrix::from_fn(2, 150, |row, column| ((column * (3 + 4 * row)) as f64 * 0.37).sin());
        let targets = DMatrix::from_fn(1, 150, |_, column| (1.5 * inputs[(0, column)]).sin() * inputs[(1, column)]);
        let layers = back_propagate(&inputs, &targets, 1);
        let again = back_propagate(&inputs, &targets, 1);
        assert_eq!(layers, again);
        let left: f64 = (0..150)
            .map(|column| {
                let sum: f64 = layers
                    .hidden_weights
                    .iter()
                    .zip(&layers.hidden_biases)
                    .zip(&layers.output_weights[0])
                    .map(|((weights, bias), out)| {
                        out * (weights[0] * inputs[(0, column)] + weights[1] * inputs[(1, column)] + bias).tanh()
                    })
                    .sum();
                (sum + layers.output_biases[0] - targets[(0, column)]).powi(2)
            })
            .sum();
        assert!(left < 0.05 * targets.norm_squared(), "{left} of {}", targets.norm_squared());
    }
}

//! The network of the paper (Nguyen, Le and Kang 2019): six joint angles in, one hidden layer, three Cartesian errors out,
//! trained by back-propagation. Kept as the measure of what a plain network does; the default learner does better.

use nalgebra::{DMatrix, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;
use crate::model::linkage::actuators_from_numbers;
use crate::model::network::{Feature, Layers, Output, ResidualNetwork};
use crate::model::robot::DOF;

/// Hidden units of a member. The paper shows its number in a figure that is not in the text.
const HIDDEN: usize = 12;
/// Members of the committee.
const MEMBERS: usize = 10;
/// Passes over the records, at most.
const EPOCHS: usize = 4000;
/// Passes without a better network after which a member's training ends.
const PATIENCE: usize = 1000;
/// Step along the gradient of the mean square, and what is kept of the step before (Rumelhart, Hinton and Williams 1986).
const RATE: f64 = 0.05;
/// See [`RATE`].
const MOMENTUM: f64 = 0.9;

/// A network on the residuals that a state leaves on the records of a problem.
///
/// Inputs and outputs are standardised; weights start uniform within one over the root of the number of inputs. Training
/// stops early (Prechelt 1998), where the mean square of records that it does not see is least; so that none is lost to
/// that, ten networks each leave out another tenth, and their mean is the network (a committee after Krogh and Vedelsby
/// 1995; side by side, its members are one hidden layer).
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
    let mut members = committee(&inputs, &targets, seed);
    for layers in &mut members {
        for (output, (mean, size)) in mean.iter().zip(&size).enumerate() {
            for weight in &mut layers.output_weights[output] {
                *weight *= size;
            }
            layers.output_biases[output] = layers.output_biases[output] * size + mean;
        }
    }
    let features = (1..=DOF).map(Feature::Angle).collect();
    Ok(ResidualNetwork { features, shift, scale, output: Output::Position, members, measured: None, sureness: None })
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

/// Inputs and outputs of some records.
struct Lesson {
    /// With a last row of ones for the biases.
    inputs: DMatrix<f64>,
    targets: DMatrix<f64>,
}

/// Each member stops by a tenth of the records that it does not learn from.
fn committee(inputs: &DMatrix<f64>, targets: &DMatrix<f64>, seed: u64) -> Vec<Layers> {
    let count = inputs.ncols();
    let mut order: Vec<usize> = (0..count).collect();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for index in (1..count).rev() {
        order.swap(index, random.random_range(0..=index));
    }
    let inputs = inputs.clone().insert_row(inputs.nrows(), 1.0);
    let lesson = |of: &[usize]| Lesson { inputs: inputs.select_columns(of), targets: targets.select_columns(of) };
    (0..MEMBERS.min(count))
        .into_par_iter()
        .map(|member| {
            let part = |held: bool| -> Vec<usize> {
                let places = (0..count).filter(|place| (place % MEMBERS == member) == held);
                places.map(|place| order[place]).collect()
            };
            back_propagate(&lesson(&part(false)), &lesson(&part(true)), seed.wrapping_add(1 + member as u64))
        })
        .collect()
}

/// Learns from `taught` until `kept_back` is met no better.
fn back_propagate(taught: &Lesson, kept_back: &Lesson, seed: u64) -> Layers {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let Lesson { inputs, targets } = taught;
    let mut draw = |rows: usize, columns: usize| {
        let width = 1.0 / (columns as f64).sqrt();
        DMatrix::from_fn(rows, columns, |_, _| random.random_range(-width..width))
    };
    let mut first = draw(HIDDEN, inputs.nrows());
    let mut second = draw(targets.nrows(), HIDDEN + 1);
    let (mut step_first, mut step_second) = (first.scale(0.0), second.scale(0.0));
    let share = RATE / inputs.ncols().max(1) as f64;
    let mut best = (f64::INFINITY, 0, first.clone(), second.clone());
    for epoch in 0..EPOCHS {
        let missed = (&second * hidden(&first, &kept_back.inputs) - &kept_back.targets).norm_squared();
        if missed < best.0 {
            best = (missed, epoch, first.clone(), second.clone());
        } else if epoch > best.1 + PATIENCE {
            break;
        }
        let activation = hidden(&first, inputs);
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
    let (_, _, first, second) = best;
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

    /// What a committee leaves of a target, sum of squares.
    fn left(members: &[Layers], inputs: &DMatrix<f64>, targets: &DMatrix<f64>) -> f64 {
        let output = |layers: &Layers, x: &[f64]| -> f64 {
            let unit = |(weights, bias): (&Vec<f64>, &f64)| -> f64 {
                (weights.iter().zip(x).map(|(weight, x)| weight * x).sum::<f64>() + bias).tanh()
            };
            let units = layers.hidden_weights.iter().zip(&layers.hidden_biases).map(unit);
            units.zip(&layers.output_weights[0]).map(|(unit, weight)| unit * weight).sum::<f64>()
                + layers.output_biases[0]
        };
        let column = |column: usize| -> f64 {
            let x: Vec<f64> = inputs.column(column).iter().copied().collect();
            let mean = members.iter().map(|layers| output(layers, &x)).sum::<f64>() / members.len() as f64;
            (mean - targets[(0, column)]).powi(2)
        };
        (0..inputs.ncols()).map(column).sum()
    }

    #[test]
    fn a_smooth_function_is_learned_and_holds_on_fresh_points() {
        let points = |from: usize, count: usize| {
            let inputs =
                DMatrix::from_fn(2, count, |row, column| (((column + from) * (3 + 4 * row)) as f64 * 0.37).sin());
            let targets =
                DMatrix::from_fn(1, count, |_, column| (1.5 * inputs[(0, column)]).sin() * inputs[(1, column)]);
            (inputs, targets)
        };
        let (inputs, targets) = points(0, 150);
        let members = committee(&inputs, &targets, 1);
        assert_eq!(members, committee(&inputs, &targets, 1));
        let (fresh_inputs, fresh_targets) = points(1000, 80);
        let rest = left(&members, &fresh_inputs, &fresh_targets) / fresh_targets.norm_squared();
        assert!(rest < 0.1, "{rest}");
    }

    #[test]
    fn noise_is_hardly_followed() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let inputs = DMatrix::from_fn(6, 150, |_, _| random.random_range(-1.7..1.7));
        let targets = DMatrix::from_fn(1, 150, |_, _| random.random_range(-1.7..1.7));
        let members = committee(&inputs, &targets, 1);
        let fresh_inputs = DMatrix::from_fn(6, 300, |_, _| random.random_range(-1.7..1.7));
        // Its own size on fresh points, where zero would be right. Trained to the end, 123 weights on 150 points make a
        // network as large as the noise.
        let size = left(&members, &fresh_inputs, &DMatrix::zeros(1, 300)) / 300.0;
        assert!(size < 0.2, "{size} of a variance of one");
    }
}

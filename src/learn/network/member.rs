//! One network of joint errors: tangent hyperbolicus units, trained by L-BFGS on residuals from which geometry is
//! projected out, its weights held by variances that the evidence gives (MacKay 1992).

use std::cell::RefCell;

use argmin::core::{CostFunction, Executor, Gradient, State as _};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::learn::cholesky;

use super::beside::Beside;
use super::lesson::Lesson;

/// Hidden units.
pub const HIDDEN: usize = 8;
/// Steps of L-BFGS between two looks at the evidence.
const STEPS: u64 = 60;
/// Looks at the evidence.
const LOOKS: usize = 4;
/// Descents where it need not be asked.
const STAGES_HELD: usize = 3;
/// Limits of a precision: outside, a weight is free, or off.
const PRECISIONS: [f64; 2] = [1e-2, 1e6];

/// Weights of a network without output biases, which are zero offsets of joints and belong to geometry.
#[derive(Clone, Debug)]
pub struct Member {
    /// Hidden weights, then hidden biases as a last column: units x (inputs + 1).
    pub first: DMatrix<f64>,
    /// Output weights: outputs x units.
    pub second: DMatrix<f64>,
}

/// What holds the weights: inverse prior variances, one for each input, the hidden biases, and each output; and the noise.
#[derive(Clone, Debug)]
pub struct Held {
    /// Of each input's weights, the biases last.
    pub inputs: DVector<f64>,
    /// Of each output's weights.
    pub outputs: DVector<f64>,
    /// Noise variance of a row.
    pub noise: f64,
}

impl Held {
    /// Before the evidence was asked.
    pub fn start(lesson: &Lesson) -> Self {
        let noise = lesson.missing.norm_squared() / lesson.missing.len().max(1) as f64;
        Self {
            inputs: DVector::from_element(lesson.inputs.nrows() + 1, lesson.inputs.nrows() as f64),
            outputs: DVector::from_element(lesson.levers.ncols(), 10.0),
            noise: 0.5 * noise.min(1.0),
        }
    }
}

impl Member {
    /// Random weights of the size that the prior has.
    fn draw(held: &Held, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut number = |precision: f64| random.random_range(-1.7..1.7) / precision.sqrt();
        let first = DMatrix::from_fn(HIDDEN, held.inputs.len(), |_, input| number(held.inputs[input]));
        let second = DMatrix::from_fn(held.outputs.len(), HIDDEN, |output, _| number(held.outputs[output]));
        Self { first, second }
    }

    fn flat(&self) -> DVector<f64> {
        DVector::from_iterator(
            self.first.len() + self.second.len(),
            self.first.iter().chain(self.second.iter()).copied(),
        )
    }

    fn from_flat(weights: &DVector<f64>, inputs: usize, outputs: usize) -> Self {
        let split = HIDDEN * inputs;
        Self {
            first: DMatrix::from_column_slice(HIDDEN, inputs, &weights.as_slice()[..split]),
            second: DMatrix::from_column_slice(outputs, HIDDEN, &weights.as_slice()[split..]),
        }
    }

    /// Activations of the hidden units, a column for each record.
    fn hidden(&self, inputs: &DMatrix<f64>) -> DMatrix<f64> {
        let biases = self.first.ncols() - 1;
        let mut sums = self.first.columns(0, biases) * inputs;
        for mut column in sums.column_iter_mut() {
            column += self.first.column(biases);
        }
        sums.map(f64::tanh)
    }

    /// Outputs, a column for each record.
    pub fn outputs(&self, inputs: &DMatrix<f64>) -> DMatrix<f64> {
        &self.second * self.hidden(inputs)
    }

    /// Trains from random weights, the evidence asked in between for the variances.
    pub fn train(lesson: &Lesson, seed: u64) -> Option<(Self, Held, Evidenced)> {
        let mut held = Held::start(lesson);
        let mut member = Self::draw(&held, seed).descend(lesson, &held)?;
        for _ in 1..LOOKS {
            held = Evidenced::of(&member, lesson, &held)?.held;
            member = member.descend(lesson, &held)?;
        }
        let evidenced = Evidenced::of(&member, lesson, &held)?;
        Some((member, held, evidenced))
    }

    /// Trains from the same random weights with variances that are known.
    pub fn train_held(lesson: &Lesson, held: &Held, seed: u64) -> Option<Self> {
        let mut member = Self::draw(&Held::start(lesson), seed);
        for _ in 0..STAGES_HELD {
            member = member.descend(lesson, held)?;
        }
        Some(member)
    }

    fn descend(&self, lesson: &Lesson, held: &Held) -> Option<Self> {
        let (inputs, outputs) = (held.inputs.len(), held.outputs.len());
        let beside = Beside::new(&lesson.geometry, held.noise)?;
        let problem = Descent { lesson, held, beside: &beside, last: RefCell::new(None) };
        let solver = LBFGS::new(MoreThuenteLineSearch::new(), 10).with_tolerance_cost(1e-3).ok()?;
        let run = Executor::new(problem, solver).configure(|state| state.param(self.flat()).max_iters(STEPS)).run();
        // A line search that finds no better point ends the run with an error: the weights stand.
        let best = run.ok().and_then(|result| result.state().get_best_param().cloned());
        Some(best.map_or_else(|| self.clone(), |best| Self::from_flat(&best, inputs, outputs)))
    }

    /// Slopes of one record's outputs by all weights: outputs x weights, in the order of [`Member::flat`].
    fn slopes(&self, input: &[f64], hidden: &[f64]) -> DMatrix<f64> {
        let (outputs, inputs) = (self.second.nrows(), self.first.ncols());
        let mut slopes = DMatrix::zeros(outputs, self.first.len() + self.second.len());
        for output in 0..outputs {
            for unit in 0..HIDDEN {
                let back = self.second[(output, unit)] * (1.0 - hidden[unit] * hidden[unit]);
                for place in 0..inputs {
                    slopes[(output, place * HIDDEN + unit)] = back * input.get(place).copied().unwrap_or(1.0);
                }
                slopes[(output, self.first.len() + unit * outputs + output)] = hidden[unit];
            }
        }
        slopes
    }
}

/// What the evidence says at trained weights.
#[derive(Clone, Debug)]
pub struct Evidenced {
    /// Better variances.
    pub held: Held,
    /// Numbers that the records determined, of the weights alone.
    pub determined: f64,
    /// Variance of each output, mean over the records.
    pub variance: DVector<f64>,
    /// Mean over the rows of the variance that the weights leave of what they move, geometry following, in units of the whitened
    /// rows.
    pub moved_variance: f64,
}

impl Evidenced {
    /// MacKay's update from a Gaussian about the weights (the Hessian that of Gauss and Newton).
    fn of(member: &Member, lesson: &Lesson, held: &Held) -> Option<Self> {
        let beside = Beside::new(&lesson.geometry, held.noise)?;
        let hidden = member.hidden(&lesson.inputs);
        let weights = member.flat();
        let slopes: Vec<DMatrix<f64>> = (0..lesson.inputs.ncols())
            .map(|record| member.slopes(lesson.inputs.column(record).as_slice(), hidden.column(record).as_slice()))
            .collect();
        let mut jacobian = DMatrix::zeros(lesson.missing.len(), weights.len());
        for (row, &record) in lesson.record_of.iter().enumerate() {
            jacobian.row_mut(row).copy_from(&(lesson.levers.row(row) * &slopes[record]));
        }
        let mut hessian = beside.inner(&jacobian) / held.noise;
        let precision = precisions(held);
        for (index, precision) in precision.iter().enumerate() {
            hessian[(index, index)] += precision;
        }
        // H with H' H the covariance.
        let root = cholesky::inverse_lower(&cholesky::factor(hessian)?);
        let told: Vec<f64> = precision
            .iter()
            .enumerate()
            .map(|(index, precision)| 1.0 - precision * root.column(index).norm_squared())
            .collect();
        let determined: f64 = told.iter().sum();
        let group = |indices: &mut dyn Iterator<Item = usize>| -> f64 {
            let (told, square) = indices.fold((0.0, 0.0), |(sum, square), index| {
                (sum + told[index].max(0.0), square + weights[index] * weights[index])
            });
            // A weak prior of one determined number of unit size keeps the answer finite.
            ((told + 1.0) / (square + 1.0 / PRECISIONS[1].sqrt())).clamp(PRECISIONS[0], PRECISIONS[1])
        };
        let (inputs, outputs) = (held.inputs.len(), held.outputs.len());
        let left = &lesson.missing - lesson.moved(&member.outputs(&lesson.inputs));
        let freedom = (left.len() as f64 - beside.determined() - determined).max(1.0);
        let better = Held {
            inputs: DVector::from_fn(inputs, |input, _| group(&mut (input * HIDDEN..(input + 1) * HIDDEN))),
            outputs: DVector::from_fn(outputs, |output, _| {
                group(&mut (0..HIDDEN).map(|unit| inputs * HIDDEN + unit * outputs + output))
            }),
            noise: left.dot(&beside.apply(&left)) / freedom,
        };
        let mut variance = DVector::zeros(outputs);
        for slopes in &slopes {
            let spread = &root * slopes.transpose();
            variance += DVector::from_iterator(outputs, spread.column_iter().map(|column| column.norm_squared()));
        }
        // An offset of an output is nearly unknown, and geometry undoes it: what counts is what stays when geometry has followed.
        let moved = &root * beside.apply_to_all(&jacobian).transpose();
        Some(Self {
            held: better,
            determined,
            variance: variance / slopes.len().max(1) as f64,
            moved_variance: moved.norm_squared() / left.len().max(1) as f64,
        })
    }
}

/// The precision of every weight, in the order of [`Member::flat`].
fn precisions(held: &Held) -> DVector<f64> {
    let first = held.inputs.iter().flat_map(|&precision| std::iter::repeat_n(precision, HIDDEN));
    let second = (0..HIDDEN).flat_map(|_| held.outputs.iter().copied());
    DVector::from_iterator(HIDDEN * (held.inputs.len() + held.outputs.len()), first.chain(second))
}

/// A point, the value there, and the gradient.
type Evaluated = (DVector<f64>, f64, DVector<f64>);

/// Half the misfit beside geometry over the noise, and half the weights' squares over their variances.
struct Descent<'a> {
    lesson: &'a Lesson,
    held: &'a Held,
    beside: &'a Beside,
    /// The last point with its value and gradient: the solver asks for the two one after the other.
    last: RefCell<Option<Evaluated>>,
}

impl Descent<'_> {
    fn at(&self, point: &DVector<f64>) -> (f64, DVector<f64>) {
        if let Some((known, value, gradient)) = &*self.last.borrow()
            && known == point
        {
            return (*value, gradient.clone());
        }
        let (value, gradient) = self.evaluate(point);
        *self.last.borrow_mut() = Some((point.clone(), value, gradient.clone()));
        (value, gradient)
    }

    fn evaluate(&self, point: &DVector<f64>) -> (f64, DVector<f64>) {
        let Self { lesson, held, .. } = self;
        let member = Member::from_flat(point, held.inputs.len(), held.outputs.len());
        let hidden = member.hidden(&lesson.inputs);
        let left = &lesson.missing - lesson.moved(&(&member.second * &hidden));
        let weighted = self.beside.apply(&left) / held.noise;
        let mut back = DMatrix::zeros(held.outputs.len(), lesson.inputs.ncols());
        for (row, &record) in lesson.record_of.iter().enumerate() {
            for output in 0..held.outputs.len() {
                back[(output, record)] -= lesson.levers[(row, output)] * weighted[row];
            }
        }
        let slope_second = &back * hidden.transpose();
        let through = (member.second.transpose() * &back).zip_map(&hidden, |back, unit| back * (1.0 - unit * unit));
        let slope_inputs = &through * lesson.inputs.transpose();
        let slope_first = slope_inputs.insert_column(held.inputs.len() - 1, 0.0);
        let mut slope = Member { first: slope_first, second: slope_second };
        slope.first.set_column(held.inputs.len() - 1, &through.column_sum());
        let held_back = precisions(held).component_mul(point);
        let value = 0.5 * (left.dot(&weighted) + held_back.dot(point));
        (value, slope.flat() + held_back)
    }
}

impl CostFunction for Descent<'_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, point: &DVector<f64>) -> Result<f64, argmin::core::Error> {
        Ok(self.at(point).0)
    }
}

impl Gradient for Descent<'_> {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, point: &DVector<f64>) -> Result<DVector<f64>, argmin::core::Error> {
        Ok(self.at(point).1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two actuators with levers that turn with the pose, geometry of three numbers, a smooth error.
    fn lesson(records: usize, noise: f64, error: impl Fn(f64, f64) -> [f64; 2]) -> Lesson {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut number = || random.random_range(-1.7..1.7);
        let inputs = DMatrix::from_fn(2, records, |_, _| number());
        let record_of: Vec<usize> = (0..3 * records).map(|row| row / 3).collect();
        let levers = DMatrix::from_fn(3 * records, 2, |_, _| number());
        let geometry = DMatrix::from_fn(3 * records, 3, |_, _| 5.0 * number());
        let outputs =
            DMatrix::from_fn(2, records, |output, record| error(inputs[(0, record)], inputs[(1, record)])[output]);
        let noise = DVector::from_fn(3 * records, |_, _| noise * number());
        let mut lesson = Lesson { inputs, levers, geometry, missing: noise, record_of };
        lesson.missing += lesson.moved(&outputs) + &lesson.geometry * DVector::from_vec(vec![0.7, -1.2, 0.4]);
        lesson
    }

    #[test]
    fn the_gradient_is_the_slope() {
        let lesson = lesson(20, 0.1, |x, y| [x, y]);
        let held = Held::start(&lesson);
        let beside = Beside::new(&lesson.geometry, held.noise).expect("finite");
        let descent = Descent { lesson: &lesson, held: &held, beside: &beside, last: RefCell::new(None) };
        let point = Member::draw(&held, 3).flat();
        let gradient = descent.evaluate(&point).1;
        for index in 0..point.len() {
            let value = |step: f64| {
                let mut moved = point.clone();
                moved[index] += step;
                descent.evaluate(&moved).0
            };
            let slope = (value(1e-5) - value(-1e-5)) / 2e-5;
            assert!(
                (gradient[index] - slope).abs() < 1e-5 * (1.0 + slope.abs()),
                "{index}: {} {slope}",
                gradient[index]
            );
        }
    }

    #[test]
    fn joint_errors_are_learned_through_the_levers_beside_geometry() {
        let error = |x: f64, y: f64| [(1.2 * x).sin() * y, 0.5 * (x - y).cos()];
        let lesson = lesson(200, 0.05, error);
        let (member, held, evidenced) = Member::train(&lesson, 1).expect("trained");
        let learned = member.outputs(&lesson.inputs);
        let missed: f64 = (0..200)
            .map(|record| {
                (learned[(0, record)] - error(lesson.inputs[(0, record)], lesson.inputs[(1, record)])[0]).powi(2)
            })
            .sum();
        assert!((missed / 200.0).sqrt() < 0.1, "{}", (missed / 200.0).sqrt());
        assert!(held.noise < 0.02 && evidenced.determined > 10.0, "{held:?} {}", evidenced.determined);
    }

    #[test]
    fn noise_is_hardly_followed() {
        let lesson = lesson(200, 1.0, |_, _| [0.0, 0.0]);
        let (member, ..) = Member::train(&lesson, 1).expect("trained");
        let size = member.outputs(&lesson.inputs).norm_squared() / 400.0;
        assert!(size < 0.05, "{size} beside noise of 1");
    }
}

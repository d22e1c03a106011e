//! The iteration: Gauss and Newton's steps on the nonlinear model, damped after Levenberg and Marquardt where needed.

use nalgebra::{DMatrix, DVector};

use super::linear::Factor;
use super::problem::{NoPose, Problem};
use super::state::State;
use super::unknown::{Unknown, UnknownId};

/// Steps that change the estimate by less than this part of its standard uncertainty end the iteration: what a further
/// step would change is smaller still.
const SMALL_STEP: f64 = 1e-3;
/// Steps that lower the cost by less than this part of what one degree of freedom leaves, ...
const SLOW: f64 = 1e-2;
/// ... so many of them one after the other, end it too: all of them together are no evidence of anything.
const SLOW_STEPS: usize = 3;
/// Largest number of Jacobians.
const MOST_STEPS: usize = 40;
/// Damping at which a step is called hopeless.
const LARGEST_DAMPING: f64 = 1e8;

/// The first damping that is tried.
const LEAST_DAMPING: f64 = 1e-4;
/// Factor of the damping after a step that led too far.
const BRINK: f64 = 1e3;

/// Why the iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Termination {
    /// The last step was small against the uncertainty of the estimate.
    Converged,
    /// Steps go on, but the cost hardly falls any more: a valley along which the records say nothing.
    Valley,
    /// No step lowers the cost any more, though the gradient says one should: rounding.
    Stalled,
    /// The number of steps ran out.
    OutOfSteps,
}

/// A fitted state with what belongs to it.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The estimate.
    pub state: State,
    /// What was free.
    pub unknowns: Vec<Unknown>,
    /// Residuals at the estimate, m and rad, not whitened (see [`Problem::residuals`]).
    pub residuals: DVector<f64>,
    /// Derivatives at the estimate, whitened, without record weights; a column for each unknown.
    pub whitened_jacobian: DMatrix<f64>,
    /// `H` with `H H'` the covariance of the unknowns, priors included, for the sigmas that the records state.
    pub covariance_root: DMatrix<f64>,
    /// Weighted sum of squares of whitened residuals and prior terms.
    pub cost: f64,
    /// Why it ended.
    pub termination: Termination,
}

impl Fit {
    /// Covariance of the unknowns for the sigmas that the records state.
    pub fn covariance(&self) -> DMatrix<f64> {
        &self.covariance_root * self.covariance_root.transpose()
    }

    /// For each station: true when its frame was free.
    pub fn own_frames(&self) -> Vec<bool> {
        let mut own = vec![false; self.state.stations.len()];
        for unknown in &self.unknowns {
            if let UnknownId::Station { station, .. } = unknown.id {
                own[station] = true;
            }
        }
        own
    }

    /// Numbers that the data determined, as against those that the priors did: the trace of the hat matrix,
    /// `p - sum(C_ii / prior_i^2)`.
    pub fn effective_parameters(&self) -> f64 {
        let from_priors: f64 = self
            .unknowns
            .iter()
            .enumerate()
            .map(|(index, unknown)| self.covariance_root.row(index).norm_squared() / unknown.prior.sigma.powi(2))
            .sum();
        self.unknowns.len() as f64 - from_priors
    }
}

/// Minimises `sum w |r / sigma|^2 + sum ((x - mean) / prior)^2` over `unknowns`, from `start`.
///
/// # Arguments
/// * `weights` - one a record (empty: all one)
///
/// # Errors
/// [`NoPose`] when the model cannot place a record at the start. Steps to where it cannot are shortened.
///
/// # Numerics
/// QR of the whitened, column-scaled Jacobian with the priors as further rows; damped by doubling until the cost falls.
pub fn solve(problem: &Problem<'_>, start: State, unknowns: &[Unknown], weights: &[f64]) -> Result<Fit, NoPose> {
    let whitening = problem.whitening();
    let roots = row_weights(problem, weights);
    let mut state = start;
    let mut residuals = problem.residuals(&state)?;
    let mut cost = cost_of(&residuals, &whitening, &roots, &state, unknowns);
    let mut damping = 0.0f64;
    let mut slow_steps = 0;
    let mut before: Option<(State, DVector<f64>, f64)> = None;
    for _ in 0..MOST_STEPS {
        let mut jacobian = match (problem.jacobian(&state, unknowns), before.take()) {
            (Ok(jacobian), _) => jacobian,
            (Err(error), None) => return Err(error),
            // The step led to the brink, where the arm still stands and its derivatives settle no more: a shorter one.
            (Err(_), Some(back)) => {
                (state, residuals, cost) = back;
                damping = BRINK * damping.max(LEAST_DAMPING);
                problem.jacobian(&state, unknowns)?
            }
        };
        scale_rows(&mut jacobian, &whitening);
        let (stacked, right) = normal_rows(&jacobian, &residuals, &whitening, &roots, &state, unknowns);
        let factor = Factor::new(stacked, &right);
        let accepted = loop {
            let step = factor.solve(damping);
            // Its length in standard uncertainties: |R D x|, the change of the whitened fit.
            let scaled = DVector::from_iterator(step.len(), step.iter().zip(&factor.scale).map(|(x, s)| x * s));
            let length = (&factor.r * &scaled).norm();
            // Where stated sigmas are too small, the spread of the residuals themselves says what is certain.
            let small = SMALL_STEP * (cost / residuals.len().max(1) as f64).sqrt().max(1.0);
            let mut next = state.clone();
            for (unknown, change) in unknowns.iter().zip(step.iter()) {
                next.add(unknown.id, *change);
            }
            if let Ok(next_residuals) = problem.residuals(&next) {
                let next_cost = cost_of(&next_residuals, &whitening, &roots, &next, unknowns);
                if next_cost <= cost || length < small {
                    break Some((next, next_residuals, next_cost, length < small));
                }
            }
            damping = if damping == 0.0 { LEAST_DAMPING } else { damping * 8.0 };
            if damping > LARGEST_DAMPING {
                break None;
            }
        };
        let ended = match accepted {
            Some((next, next_residuals, next_cost, small)) => {
                let is_slow = cost - next_cost < SLOW * cost / residuals.len().max(1) as f64;
                slow_steps = if is_slow { slow_steps + 1 } else { 0 };
                before = Some((state, residuals, cost));
                (state, residuals, cost) = (next, next_residuals, next_cost);
                damping = if damping < LEAST_DAMPING { 0.0 } else { damping * 0.1 };
                match small {
                    true => Some(Termination::Converged),
                    false => (slow_steps == SLOW_STEPS).then_some(Termination::Valley),
                }
            }
            None => Some(Termination::Stalled),
        };
        if let Some(termination) = ended {
            return Ok(finish(state, unknowns, residuals, jacobian, &factor, cost, termination));
        }
    }
    let mut jacobian = problem.jacobian(&state, unknowns)?;
    scale_rows(&mut jacobian, &whitening);
    let (stacked, right) = normal_rows(&jacobian, &residuals, &whitening, &roots, &state, unknowns);
    let factor = Factor::new(stacked, &right);
    Ok(finish(state, unknowns, residuals, jacobian, &factor, cost, Termination::OutOfSteps))
}

fn finish(
    state: State,
    unknowns: &[Unknown],
    residuals: DVector<f64>,
    whitened_jacobian: DMatrix<f64>,
    factor: &Factor,
    cost: f64,
    termination: Termination,
) -> Fit {
    let covariance_root = factor.inverse_root();
    Fit { state, unknowns: unknowns.to_vec(), residuals, whitened_jacobian, covariance_root, cost, termination }
}

/// One undamped step on the linear problem whose Jacobian (`plain`, not whitened) is given: the step, the covariance root
/// and the Jacobian whitened with the records' sigmas.
pub fn linear_step(
    problem: &Problem<'_>,
    state: &State,
    unknowns: &[Unknown],
    residuals: &DVector<f64>,
    plain: &DMatrix<f64>,
) -> (DVector<f64>, DMatrix<f64>, DMatrix<f64>) {
    let whitening = problem.whitening();
    let roots = row_weights(problem, &[]);
    let mut jacobian = plain.clone();
    scale_rows(&mut jacobian, &whitening);
    let (stacked, right) = normal_rows(&jacobian, residuals, &whitening, &roots, state, unknowns);
    let factor = Factor::new(stacked, &right);
    (factor.solve(0.0), factor.inverse_root(), jacobian)
}

/// Square root of each row's weight.
fn row_weights(problem: &Problem<'_>, weights: &[f64]) -> DVector<f64> {
    let per_row = problem.records.iter().enumerate().flat_map(|(index, record)| {
        let root = weights.get(index).copied().unwrap_or(1.0).sqrt();
        std::iter::repeat_n(root, record.measured.numbers())
    });
    DVector::from_iterator(problem.rows(), per_row)
}

fn scale_rows(matrix: &mut DMatrix<f64>, by: &DVector<f64>) {
    for mut column in matrix.column_iter_mut() {
        column.component_mul_assign(by);
    }
}

fn deviation(state: &State, unknown: &Unknown) -> f64 {
    (state.get(unknown.id).unwrap_or(0.0) - unknown.prior.mean) / unknown.prior.sigma
}

fn cost_of(
    residuals: &DVector<f64>,
    whitening: &DVector<f64>,
    roots: &DVector<f64>,
    state: &State,
    unknowns: &[Unknown],
) -> f64 {
    let data: f64 = residuals
        .iter()
        .zip(whitening.iter().zip(roots.iter()))
        .map(|(residual, (whitening, root))| (residual * whitening * root).powi(2))
        .sum();
    data + unknowns.iter().map(|unknown| deviation(state, unknown).powi(2)).sum::<f64>()
}

/// The rows of the linearised problem: whitened and weighted data, then priors.
fn normal_rows(
    whitened_jacobian: &DMatrix<f64>,
    residuals: &DVector<f64>,
    whitening: &DVector<f64>,
    roots: &DVector<f64>,
    state: &State,
    unknowns: &[Unknown],
) -> (DMatrix<f64>, DVector<f64>) {
    let (rows, columns) = whitened_jacobian.shape();
    let mut stacked = DMatrix::zeros(rows + columns, columns);
    let mut data = stacked.rows_mut(0, rows);
    data.copy_from(whitened_jacobian);
    for mut column in data.column_iter_mut() {
        column.component_mul_assign(roots);
    }
    let mut right = DVector::zeros(rows + columns);
    for row in 0..rows {
        right[row] = -residuals[row] * whitening[row] * roots[row];
    }
    for (index, unknown) in unknowns.iter().enumerate() {
        stacked[(rows + index, index)] = 1.0 / unknown.prior.sigma;
        right[rows + index] = -deviation(state, unknown);
    }
    (stacked, right)
}

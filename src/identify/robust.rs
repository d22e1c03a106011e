//! Gross errors: a fit that they cannot pull, then a test of every record against the rest.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::linear::Factor;
use super::problem::{NoPose, Problem};
use super::solve::Fit;
use super::state::State;
use super::unknown::Unknown;

/// Median of a chi variable with three degrees of freedom: the typical length of a unit normal error in space.
const CHI3_MEDIAN: f64 = 1.538_172;
/// Whitened length beyond which Huber's loss turns linear.
const HUBER: f64 = 2.0;
/// Whitened length at which Tukey's biweight reaches zero.
const TUKEY: f64 = 7.0;
/// Rounds of reweighting between two Jacobians; the first ones with Huber's convex loss.
const REWEIGHTINGS: usize = 30;
/// Rounds of Huber's loss.
const CONVEX: usize = 8;
/// Jacobians of the robust fit.
const LINEARISATIONS: usize = 6;

/// False alarms that a recording without gross errors may raise, on average.
const FALSE_ALARMS: f64 = 0.01;
/// What is left unmodelled has longer tails than noise: the limit is this much wider than the normal one. A record
/// that is wrong by less than that pulls hardly more than a good one.
const TAIL: f64 = 1.6;

/// A state that gross errors do not pull, by iteratively reweighted least squares (Huber 1964, then Tukey's biweight;
/// Holland and Welsch 1977), the weight of a record by the length of its position residual.
///
/// The noise is the spread of the residuals themselves, over their median.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record at the start.
pub fn fit(problem: &Problem<'_>, start: State, unknowns: &[Unknown]) -> Result<State, NoPose> {
    let mut state = start;
    let freedom_loss = {
        let rows = problem.rows() as f64;
        (rows / (rows - unknowns.len() as f64).max(0.3 * rows)).sqrt()
    };
    for linearisation in 0..LINEARISATIONS {
        let residuals = problem.residuals(&state)?;
        let jacobian = problem.jacobian(&state, unknowns)?;
        let mut step = DVector::zeros(unknowns.len());
        let mut scale = f64::INFINITY;
        for round in 0..REWEIGHTINGS {
            let now = &residuals + &jacobian * &step;
            let lengths = lengths_of(problem, &now);
            let next_scale = median(&lengths) / CHI3_MEDIAN * if round == 0 { 1.0 } else { freedom_loss };
            let convex = linearisation == 0 && round < CONVEX;
            let weights: Vec<f64> =
                lengths.iter().map(|length| weight_of(length / next_scale.max(f64::MIN_POSITIVE), convex)).collect();
            let next = weighted_step(problem, &state, unknowns, &residuals, &jacobian, &weights, next_scale);
            let change = (&jacobian * (&next - &step)).norm() / (problem.rows() as f64).sqrt();
            step = next;
            let settled = change < 1e-3 * next_scale && (next_scale / scale - 1.0).abs() < 1e-3;
            scale = next_scale;
            if settled && !convex {
                break;
            }
        }
        let moved = (&jacobian * &step).norm() / (problem.rows() as f64).sqrt();
        let mut part = 1.0;
        loop {
            let mut next = state.clone();
            for (unknown, change) in unknowns.iter().zip(step.iter()) {
                next.add(unknown.id, part * change);
            }
            // A step to where the model has no pose is shortened; at worst the fit stays where it is.
            if problem.residuals(&next).is_ok() || part < 1e-3 {
                state = next;
                break;
            }
            part *= 0.5;
        }
        if moved < 0.02 * scale {
            break;
        }
    }
    Ok(state)
}

fn weight_of(length: f64, convex: bool) -> f64 {
    if convex {
        return if length <= HUBER { 1.0 } else { HUBER / length };
    }
    let part = length / TUKEY;
    if part >= 1.0 { 0.0 } else { (1.0 - part * part).powi(2) }
}

fn weighted_step(
    problem: &Problem<'_>,
    state: &State,
    unknowns: &[Unknown],
    residuals: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    weights: &[f64],
    scale: f64,
) -> DVector<f64> {
    let (rows, columns) = jacobian.shape();
    let mut stacked = DMatrix::zeros(rows + columns, columns);
    let mut right = DVector::zeros(rows + columns);
    for ((record, first), weight) in problem.records.iter().zip(problem.first_rows()).zip(weights) {
        for row in 0..record.measured.numbers() {
            // Positions weigh by the spread that is found, orientations by the one that is stated.
            let sigma = if row < 3 { scale.max(f64::MIN_POSITIVE) } else { record.sigma_rad };
            let by = weight.sqrt() / sigma;
            stacked.row_mut(first + row).copy_from(&(jacobian.row(first + row) * by));
            right[first + row] = -residuals[first + row] * by;
        }
    }
    for (index, unknown) in unknowns.iter().enumerate() {
        let now = state.get(unknown.id).unwrap_or(0.0);
        stacked[(rows + index, index)] = 1.0 / unknown.prior.sigma;
        right[rows + index] = (unknown.prior.mean - now) / unknown.prior.sigma;
    }
    Factor::new(stacked, &right).solve(0.0)
}

/// Length of each record's position residual, m.
pub fn lengths_of(problem: &Problem<'_>, residuals: &DVector<f64>) -> Vec<f64> {
    problem.first_rows().into_iter().map(|first| residuals.fixed_rows::<3>(first).norm()).collect()
}

/// The median; zero of nothing.
pub fn median(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => 0.0,
        count if count % 2 == 1 => sorted[count / 2],
        count => 0.5 * (sorted[count / 2 - 1] + sorted[count / 2]),
    }
}

/// Robust standard deviation per axis of position residuals, m, from the median of their lengths.
pub fn spread_m(lengths_m: &[f64]) -> f64 {
    median(lengths_m) / CHI3_MEDIAN
}

/// Deviation of each record from what the rest says of it, in standard deviations per axis of such a deviation.
///
/// `problem` may hold records that were not in the fit (`in_fit`): for those the variance is `sigma^2 (1 + h)`, for the
/// others `sigma^2 (1 - h)`, h the mean leverage of the record's coordinates (Cook and Weisberg 1982).
pub fn deviations(
    problem: &Problem<'_>,
    fit: &Fit,
    residuals: &DVector<f64>,
    whitened_jacobian: &DMatrix<f64>,
    in_fit: &[bool],
) -> Vec<f64> {
    let spread = whitened_jacobian * &fit.covariance_root;
    problem
        .first_rows()
        .into_iter()
        .zip(problem.records.iter().zip(in_fit))
        .map(|(first, (record, &inside))| {
            let leverage = spread.fixed_rows::<3>(first).norm_squared() / 3.0;
            let variance = if inside { (1.0 - leverage).max(0.05) } else { 1.0 + leverage };
            residuals.fixed_rows::<3>(first).norm() / (record.sigma_m * variance.sqrt())
        })
        .collect()
}

/// Deviation beyond which one record among `records` is a gross error.
pub fn limit(records: usize) -> f64 {
    let chi_squared = ChiSquared::new(3.0).map(|chi| chi.inverse_cdf(1.0 - FALSE_ALARMS / records.max(1) as f64));
    TAIL * chi_squared.map_or(5.0, f64::sqrt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_length_of_a_normal_error_is_the_constant() {
        let chi = ChiSquared::new(3.0).expect("a distribution");
        assert!((chi.inverse_cdf(0.5).sqrt() - CHI3_MEDIAN).abs() < 1e-5);
        assert!(limit(240) > 7.0 && limit(240) < 9.0, "{}", limit(240));
    }

    #[test]
    fn weights_fall_with_the_deviation() {
        assert_eq!(weight_of(0.0, false), 1.0);
        assert_eq!(weight_of(10.0, false), 0.0);
        assert_eq!(weight_of(1.0, true), 1.0);
        assert!(weight_of(10.0, true) < 0.25);
    }
}

//! Bayesian linear regression with a variance for each group of weights, chosen by the evidence.

use std::cell::RefCell;

use argmin::core::{CostFunction, Executor, Gradient, State as _};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;
use nalgebra::{DMatrix, DVector};

use super::cholesky;

/// Sums over the rows of a regression: all that it needs to know of them. Sums of disjoint rows add up.
#[derive(Clone, Debug)]
pub struct Moments {
    /// `A'A`.
    pub gram: DMatrix<f64>,
    /// `A'y`.
    pub right: DVector<f64>,
    /// `y'y`.
    pub square: f64,
    /// Number of rows.
    pub rows: f64,
}

impl Moments {
    /// Of a design `a` and observations `y`.
    pub fn of(a: &DMatrix<f64>, y: &DVector<f64>) -> Self {
        let transposed = a.transpose();
        Self { gram: &transposed * a, right: &transposed * y, square: y.norm_squared(), rows: y.len() as f64 }
    }

    /// No rows.
    pub fn none(columns: usize) -> Self {
        Self { gram: DMatrix::zeros(columns, columns), right: DVector::zeros(columns), square: 0.0, rows: 0.0 }
    }

    /// Adds other rows.
    pub fn add(&mut self, other: &Moments) {
        self.gram += &other.gram;
        self.right += &other.right;
        self.square += other.square;
        self.rows += other.rows;
    }
}

/// Which weights share a variance.
#[derive(Clone, Debug, PartialEq)]
pub struct Groups {
    /// Group of each column; `None`: its prior variance is 1 and not learned.
    pub of: Vec<Option<usize>>,
    /// Number of groups.
    pub count: usize,
    /// Groups that are bands next to each other: their variances are alike unless the data say otherwise.
    pub neighbours: Vec<(usize, usize)>,
}

/// Variances: the prior of each group, and the noise of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Variances {
    /// Prior variance of the weights of each group.
    pub groups: Vec<f64>,
    /// Noise variance of a row.
    pub noise: f64,
}

/// The weights after the data.
#[derive(Clone, Debug)]
pub struct Posterior {
    /// Their mean.
    pub mean: DVector<f64>,
    /// `H` with `H' H` their covariance.
    pub root: DMatrix<f64>,
    /// Log evidence of the data.
    pub log_evidence: f64,
    /// Numbers that the data determined: MacKay's gamma.
    pub determined: f64,
}

/// Hyperparameters may wander this many e-folds from where they start before the prior on them tells.
const WANDER: f64 = 10.0;
/// Variances of neighbouring bands differ by about this many e-folds.
const STEP_OF_BANDS: f64 = 1.5;
/// Gain of log evidence in a step that counts as none.
const SETTLED: f64 = 1e-3;

/// The variances that make the data most probable (type II maximum likelihood; MacKay 1992), each with a wide
/// log-normal prior about its start so that the answer is always finite.
///
/// The evidence and its gradient come from one Cholesky factor of `I + S G S / noise`, `S` the prior standard
/// deviations; the maximum is found with L-BFGS in the logarithms.
///
/// # Arguments
/// * `origin` - where the prior of each variance lies
/// * `start` - where the search starts, for at most `steps` steps
pub fn maximise(moments: &Moments, groups: &Groups, origin: &Variances, start: &Variances, steps: u64) -> Variances {
    let logarithms = |of: &Variances| -> Vec<f64> { of.groups.iter().chain([&of.noise]).map(|one| one.ln()).collect() };
    let (origin, first) = (logarithms(origin), DVector::from_vec(logarithms(start)));
    let mut problem = Evidence { moments, groups, origin: &origin, scale: 1.0, last: RefCell::new(None) };
    // The first step goes down the gradient as it is: scaled, it is one e-fold long.
    problem.scale = 1.0 / problem.at(&first).1.norm().max(1.0);
    *problem.last.borrow_mut() = None;
    let settled = SETTLED * problem.scale;
    let solver = LBFGS::new(MoreThuenteLineSearch::new(), 12).with_tolerance_cost(settled);
    let Ok(solver) = solver.and_then(|solver| solver.with_tolerance_grad(settled)) else { return start.clone() };
    let run = Executor::new(problem, solver).configure(|state| state.param(first).max_iters(steps)).run();
    // A line search that finds no better point ends the run with an error and the start stands.
    match run.ok().and_then(|result| result.state().get_best_param().cloned()) {
        Some(best) => variances(best.as_slice()),
        None => start.clone(),
    }
}

fn variances(logarithms: &[f64]) -> Variances {
    let (groups, noise) = logarithms.split_at(logarithms.len().saturating_sub(1));
    Variances {
        groups: groups.iter().map(|logarithm| logarithm.exp()).collect(),
        noise: noise.first().map_or(1.0, |logarithm| logarithm.exp()),
    }
}

/// The weights under given variances; `None` where numbers are not finite.
pub fn posterior(moments: &Moments, groups: &Groups, variances: &Variances) -> Option<Posterior> {
    let solved = solve(moments, groups, variances)?;
    let inverse = cholesky::inverse_lower(&solved.factor);
    let determined = solved.scale.len() as f64 - inverse.norm_squared();
    let mut root = inverse;
    for (mut column, scale) in root.column_iter_mut().zip(solved.scale.iter()) {
        column *= *scale;
    }
    Some(Posterior { mean: solved.mean, root, log_evidence: solved.log_evidence, determined })
}

struct Solved {
    scale: DVector<f64>,
    factor: DMatrix<f64>,
    mean: DVector<f64>,
    log_evidence: f64,
}

fn solve(moments: &Moments, groups: &Groups, variances: &Variances) -> Option<Solved> {
    let noise = variances.noise;
    let scale = DVector::from_iterator(
        groups.of.len(),
        groups.of.iter().map(|group| group.map_or(1.0, |group| variances.groups[group].sqrt())),
    );
    let mut scaled = moments.gram.clone();
    for (mut column, &size) in scaled.column_iter_mut().zip(scale.iter()) {
        column.component_mul_assign(&scale);
        column *= size / noise;
    }
    for index in 0..scale.len() {
        scaled[(index, index)] += 1.0;
    }
    let factor = cholesky::factor(scaled)?;
    let right = moments.right.component_mul(&scale) / noise;
    let mean = cholesky::solve(&factor, &right).component_mul(&scale);
    let quadratic = (moments.square - moments.right.dot(&mean)) / noise;
    let log_determinant = 2.0 * factor.diagonal().iter().map(|entry| entry.ln()).sum::<f64>();
    let log_evidence = -0.5 * (moments.rows * (2.0 * std::f64::consts::PI * noise).ln() + log_determinant + quadratic);
    log_evidence.is_finite().then_some(Solved { scale, factor, mean, log_evidence })
}

/// A point, the value there, and the gradient.
type Evaluated = (DVector<f64>, f64, DVector<f64>);

/// Minus the log evidence over the logarithms of the variances.
struct Evidence<'a> {
    moments: &'a Moments,
    groups: &'a Groups,
    origin: &'a [f64],
    /// Factor on the value.
    scale: f64,
    /// The last point with its value and gradient: the solver asks for the two one after the other.
    last: RefCell<Option<Evaluated>>,
}

impl Evidence<'_> {
    fn at(&self, point: &DVector<f64>) -> (f64, DVector<f64>) {
        if let Some((known, value, gradient)) = &*self.last.borrow()
            && known == point
        {
            return (*value, gradient.clone());
        }
        let (value, gradient) = self
            .evaluate(point)
            .map(|(value, gradient)| (value * self.scale, gradient * self.scale))
            // A point out of all range: worse than any, and the line search turns back.
            .unwrap_or_else(|| (f64::MAX.sqrt(), DVector::zeros(point.len())));
        *self.last.borrow_mut() = Some((point.clone(), value, gradient.clone()));
        (value, gradient)
    }

    fn evaluate(&self, point: &DVector<f64>) -> Option<(f64, DVector<f64>)> {
        let variances = variances(point.as_slice());
        let solved = solve(self.moments, self.groups, &variances)?;
        let inverse = cholesky::inverse_lower(&solved.factor);
        let mut gradient = DVector::zeros(point.len());
        let mut determined = 0.0;
        for (column, group) in self.groups.of.iter().enumerate() {
            let known = 1.0 - inverse.column(column).norm_squared();
            determined += known;
            if let Some(group) = group {
                let standard = solved.mean[column] / solved.scale[column];
                gradient[*group] -= 0.5 * (standard * standard - known);
            }
        }
        let moments = self.moments;
        let misfit =
            moments.square - 2.0 * moments.right.dot(&solved.mean) + solved.mean.dot(&(&moments.gram * &solved.mean));
        let noise = self.groups.count;
        gradient[noise] -= 0.5 * (determined - moments.rows + misfit / variances.noise);
        let mut value = -solved.log_evidence;
        for (index, (now, origin)) in point.iter().zip(self.origin).enumerate() {
            let away = (now - origin) / WANDER;
            value += 0.5 * away * away;
            gradient[index] += away / WANDER;
        }
        for &(one, other) in &self.groups.neighbours {
            let apart = (point[other] - point[one]) / STEP_OF_BANDS;
            value += 0.5 * apart * apart;
            gradient[other] += apart / STEP_OF_BANDS;
            gradient[one] -= apart / STEP_OF_BANDS;
        }
        Some((value, gradient))
    }
}

impl CostFunction for Evidence<'_> {
    type Param = DVector<f64>;
    type Output = f64;

    fn cost(&self, point: &DVector<f64>) -> Result<f64, argmin::core::Error> {
        Ok(self.at(point).0)
    }
}

impl Gradient for Evidence<'_> {
    type Param = DVector<f64>;
    type Gradient = DVector<f64>;

    fn gradient(&self, point: &DVector<f64>) -> Result<DVector<f64>, argmin::core::Error> {
        Ok(self.at(point).1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    fn sample(rows: usize) -> (DMatrix<f64>, DVector<f64>, Groups) {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let a = DMatrix::from_fn(rows, 45, |_, _| normal());
        // Fifteen unlearned columns of variance 1, fifteen of 0.04, fifteen that do nothing; noise variance 0.25.
        let weights = DVector::from_fn(45, |index, _| [1.0, 0.2, 0.0][index / 15] * normal());
        let y = &a * weights + DVector::from_fn(rows, |_, _| 0.5 * normal());
        let of = (0..45).map(|index| [None, Some(0), Some(1)][index / 15]).collect();
        (a, y, Groups { of, count: 2, neighbours: vec![(0, 1)] })
    }

    #[test]
    fn the_evidence_is_the_density_of_the_data() {
        let (a, y, groups) = sample(20);
        let variances = Variances { groups: vec![0.3, 0.02], noise: 0.5 };
        let found = posterior(&Moments::of(&a, &y), &groups, &variances).expect("finite");
        let prior = DVector::from_fn(45, |index, _| [1.0, 0.3, 0.02][index / 15]);
        let covariance = &a * DMatrix::from_diagonal(&prior) * a.transpose() + DMatrix::identity(20, 20) * 0.5;
        let cholesky = covariance.clone().cholesky().expect("positive definite");
        let solution = cholesky.solve(&y);
        let expected =
            -0.5 * (20.0 * (2.0 * std::f64::consts::PI).ln() + covariance.determinant().ln() + y.dot(&solution));
        assert!((found.log_evidence - expected).abs() < 1e-9);
        let mean = DMatrix::from_diagonal(&prior) * a.transpose() * solution;
        assert!((found.mean - mean).amax() < 1e-10);
        let spread = DMatrix::from_diagonal(&prior)
            - DMatrix::from_diagonal(&prior) * a.transpose() * cholesky.solve(&(&a * DMatrix::from_diagonal(&prior)));
        assert!((found.root.transpose() * &found.root - spread).amax() < 1e-10);
    }

    #[test]
    fn the_gradient_is_the_slope() {
        let (a, y, groups) = sample(60);
        let moments = Moments::of(&a, &y);
        let origin = [0.0, -1.0, -2.0];
        let evidence =
            Evidence { moments: &moments, groups: &groups, origin: &origin, scale: 1.0, last: RefCell::new(None) };
        let point = DVector::from_vec(vec![-1.5, -2.5, -0.5]);
        let (_, gradient) = evidence.evaluate(&point).expect("finite");
        for index in 0..3 {
            let value = |step: f64| {
                let mut moved = point.clone();
                moved[index] += step;
                evidence.evaluate(&moved).expect("finite").0
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
    fn variances_that_were_put_in_come_out() {
        let (a, y, groups) = sample(400);
        let start = Variances { groups: vec![0.3, 0.3], noise: 1.0 };
        let found = maximise(&Moments::of(&a, &y), &groups, &start, &start, 60);
        assert!((found.noise / 0.25 - 1.0).abs() < 0.2, "{found:?}");
        assert!((found.groups[0] / 0.04).ln().abs() < 0.9, "{found:?}");
        assert!(found.groups[1] < 2e-3, "{found:?}");
    }
}

//! The fit together with the size of what it leaves.

use nalgebra::{DMatrix, DVector};

use super::problem::{NoPose, Problem};
use super::solve::{Fit, linear_step, solve};
use super::state::State;
use super::unknown::Unknown;

/// Where an unknown noise starts, m per metre of reach: far below any real one, so that the priors do not hold the
/// first fit back.
pub const START_PER_REACH: f64 = 1e-5;
/// Where an unknown noise of orientations starts, rad.
pub const START_RAD: f64 = 1e-5;

/// A fit whose noise level is its own.
#[derive(Clone, Debug)]
pub struct Estimate<'a> {
    /// The records of the fit, with the sigmas that it used in the end.
    pub problem: Problem<'a>,
    /// The fit, whitened with those sigmas.
    pub fit: Fit,
    /// What the fit leaves.
    pub spread: Spread,
    /// By what the sigmas of positions were multiplied to get there.
    pub scale: f64,
}

/// Size of what a fit leaves: noise and all that is not modelled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Standard deviation per axis of the position residuals, corrected for what the fit took, m.
    pub sigma_m: f64,
    /// The same for orientations, rad; `None` where none were measured.
    pub sigma_rad: Option<f64>,
    /// Degrees of freedom of `sigma_m`: coordinates less the parameters that the data determined.
    pub freedom: f64,
}

/// Changes of the noise level below this part end the iteration.
const SETTLED: f64 = 5e-3;
/// Rounds of fit and noise level in turn.
const ROUNDS: usize = 8;
/// Rounds of noise level and linear correction between two fits: no Jacobian is made there.
const LINEAR_ROUNDS: usize = 12;

/// Fits and finds the noise level in turn until both stand: restricted maximum likelihood for the variance, given the
/// priors (Harville 1977).
///
/// Stated sigmas (`stated` true) are lower bounds: where residuals are larger, all are scaled up alike, so that
/// physics that is left out makes the estimate lean on the priors as noise of the same size would. Sigmas that are not
/// stated are scaled up or down.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record at the start.
pub fn estimate<'a>(
    mut problem: Problem<'a>,
    start: State,
    unknowns: &[Unknown],
    stated: bool,
) -> Result<Estimate<'a>, NoPose> {
    let base: Vec<(f64, f64)> = problem.records.iter().map(|record| (record.sigma_m, record.sigma_rad)).collect();
    let least = if stated { 1.0 } else { 0.0 };
    let mut scale = Scale { position: 1.0, rotation: 1.0 };
    let mut state = start;
    let mut round = 0;
    loop {
        round += 1;
        scale.apply(&mut problem, &base);
        let fit = solve(&problem, state, unknowns, &[])?;
        let next =
            scale.corrected(&left_over(&problem, &fit.residuals, &fit.whitened_jacobian, &fit.covariance_root), least);
        if next.is_near(scale) || round == ROUNDS || next.position <= 0.0 {
            let rotated = problem.records.iter().any(|record| record.measured.rotation.is_some());
            let spread = Spread {
                sigma_m: root_mean_square(problem.records.iter().map(|record| record.sigma_m)),
                sigma_rad: rotated.then(|| root_mean_square(problem.records.iter().map(|record| record.sigma_rad))),
                freedom: left_over(&problem, &fit.residuals, &fit.whitened_jacobian, &fit.covariance_root)
                    .position
                    .freedom,
            };
            return Ok(Estimate { problem, fit, spread, scale: scale.position });
        }
        (scale, state) = correct_linearly(&mut problem, &base, fit, (scale, next), least)?;
    }
}

/// Noise level and estimate in turn on the linear problem at a fit: the next fit then starts nearly right.
fn correct_linearly(
    problem: &mut Problem<'_>,
    base: &[(f64, f64)],
    fit: Fit,
    (whitened_with, mut scale): (Scale, Scale),
    least: f64,
) -> Result<(Scale, State), NoPose> {
    let Fit { mut state, unknowns, mut residuals, whitened_jacobian, .. } = fit;
    whitened_with.apply(problem, base);
    let whitening = problem.whitening();
    let mut plain = whitened_jacobian;
    for mut column in plain.column_iter_mut() {
        column.component_div_assign(&whitening);
    }
    for _ in 0..LINEAR_ROUNDS {
        scale.apply(problem, base);
        let (step, covariance_root, jacobian) = linear_step(problem, &state, &unknowns, &residuals, &plain);
        for (unknown, change) in unknowns.iter().zip(step.iter()) {
            state.add(unknown.id, *change);
        }
        residuals = problem.residuals(&state)?;
        let next = scale.corrected(&left_over(problem, &residuals, &jacobian, &covariance_root), least);
        let settled = next.is_near(scale);
        if next.position <= 0.0 {
            break;
        }
        scale = next;
        if settled {
            break;
        }
    }
    Ok((scale, state))
}

/// By what sigmas are multiplied.
#[derive(Clone, Copy, Debug)]
struct Scale {
    position: f64,
    rotation: f64,
}

impl Scale {
    fn apply(self, problem: &mut Problem<'_>, base: &[(f64, f64)]) {
        for (record, (sigma_m, sigma_rad)) in problem.records.iter_mut().zip(base) {
            (record.sigma_m, record.sigma_rad) = (sigma_m * self.position, sigma_rad * self.rotation);
        }
    }

    fn corrected(self, left: &LeftOver, least: f64) -> Self {
        Self {
            position: (self.position * left.position.ratio()).max(least),
            rotation: left.rotation.map_or(self.rotation, |left| (self.rotation * left.ratio()).max(least)),
        }
    }

    fn is_near(self, other: Self) -> bool {
        let near = |a: f64, b: f64| (a / b - 1.0).abs() <= SETTLED;
        near(self.position, other.position) && near(self.rotation, other.rotation)
    }
}

/// Root of the mean square; zero of nothing.
pub fn root_mean_square(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0usize), |(sum, count), number| (sum + number * number, count + 1));
    (sum / count.max(1) as f64).sqrt()
}

/// Sum of squares and degrees of freedom of one kind of rows.
#[derive(Clone, Copy, Debug, Default)]
struct Left {
    squares: f64,
    freedom: f64,
}

impl Left {
    /// By how much the sigmas are too small.
    fn ratio(self) -> f64 {
        (self.squares / self.freedom.max(1.0)).sqrt()
    }
}

struct LeftOver {
    position: Left,
    rotation: Option<Left>,
}

fn left_over(
    problem: &Problem<'_>,
    residuals: &DVector<f64>,
    whitened_jacobian: &DMatrix<f64>,
    covariance_root: &DMatrix<f64>,
) -> LeftOver {
    let whitening = problem.whitening();
    let spread = whitened_jacobian * covariance_root;
    let (mut position, mut rotation) = (Left::default(), None);
    for (record, first) in problem.records.iter().zip(problem.first_rows()) {
        for row in 0..record.measured.numbers() {
            let square = (residuals[first + row] * whitening[first + row]).powi(2);
            let freedom = 1.0 - spread.row(first + row).norm_squared();
            let left = if row < 3 { &mut position } else { rotation.get_or_insert_with(Left::default) };
            left.squares += square;
            left.freedom += freedom;
        }
    }
    LeftOver { position, rotation }
}

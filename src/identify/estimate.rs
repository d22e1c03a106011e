//! The fit together with the size of what it leaves.

use super::problem::{NoPose, Problem};
use super::solve::{Fit, solve};
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
const ROUNDS: usize = 12;

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
    let (mut by_position, mut by_rotation) = (1.0f64, 1.0f64);
    let mut state = start;
    let mut round = 0;
    loop {
        round += 1;
        for (record, (sigma_m, sigma_rad)) in problem.records.iter_mut().zip(&base) {
            (record.sigma_m, record.sigma_rad) = (sigma_m * by_position, sigma_rad * by_rotation);
        }
        let fit = solve(&problem, state, unknowns, &[])?;
        let left = left_over(&problem, &fit);
        let least = if stated { 1.0 } else { 0.0 };
        let next_position = (by_position * left.position.ratio()).max(least);
        let next_rotation = left.rotation.map_or(by_rotation, |left| (by_rotation * left.ratio()).max(least));
        let moved = |next: f64, now: f64| (next / now - 1.0).abs() > SETTLED;
        let settled = !moved(next_position, by_position) && !moved(next_rotation, by_rotation);
        if settled || round == ROUNDS || next_position <= 0.0 {
            let spread = Spread {
                sigma_m: root_mean_square(problem.records.iter().map(|record| record.sigma_m)),
                sigma_rad: left
                    .rotation
                    .map(|_| root_mean_square(problem.records.iter().map(|record| record.sigma_rad))),
                freedom: left.position.freedom,
            };
            return Ok(Estimate { problem, fit, spread, scale: by_position });
        }
        (by_position, by_rotation) = (next_position, next_rotation);
        state = fit.state;
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

fn left_over(problem: &Problem<'_>, fit: &Fit) -> LeftOver {
    let whitening = problem.whitening();
    let spread = &fit.whitened_jacobian * &fit.covariance_root;
    let (mut position, mut rotation) = (Left::default(), None);
    for (record, first) in problem.records.iter().zip(problem.first_rows()) {
        for row in 0..record.measured.numbers() {
            let square = (fit.residuals[first + row] * whitening[first + row]).powi(2);
            let freedom = 1.0 - spread.row(first + row).norm_squared();
            let left = if row < 3 { &mut position } else { rotation.get_or_insert_with(Left::default) };
            left.squares += square;
            left.freedom += freedom;
        }
    }
    LeftOver { position, rotation }
}

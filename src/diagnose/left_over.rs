//! What a finished diagnosis leaves, told apart into noise and what would come again.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::identify::estimate::{Spread, root_mean_square};
use crate::identify::problem::NoPose;
use crate::measure::observation::Observation;
use crate::measure::repeats::repeatability;

use super::baseline::Baseline;
use super::found::Found;
use super::regressors::Regressors;

/// Standard deviations per axis, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOver {
    /// Scatter without structure.
    pub noise_sigma_m: f64,
    /// Degrees of freedom that it was told from.
    noise_freedom: f64,
    /// What depends on pose, approach or time and has no name.
    pub structure_sigma_m: f64,
}

impl LeftOver {
    /// What a fit leaves beyond the noise, m; zero where that may be chance.
    pub fn beyond_noise_m(&self, spread: &Spread) -> f64 {
        let ratio = (spread.sigma_m / self.noise_sigma_m.max(f64::MIN_POSITIVE)).powi(2);
        let fisher = FisherSnedecor::new(spread.freedom.max(1.0), self.noise_freedom);
        let limit = fisher.map_or(1.0, |fisher| fisher.inverse_cdf(1.0 - FALSE_ALARM));
        if ratio > limit { self.excess_m(spread) } else { 0.0 }
    }

    fn excess_m(&self, spread: &Spread) -> f64 {
        (spread.sigma_m.powi(2) - self.noise_sigma_m.powi(2)).max(0.0).sqrt()
    }
}

/// Degrees of freedom that repeats need to be asked.
const ENOUGH_REPEATS: usize = 15;
/// Probability with which white residuals would be called larger than the noise.
const FALSE_ALARM: f64 = 0.01;

/// Noise as the recording states it; else as its repeated poses show it (those that came the same way); else what stays
/// when everything found, named or not, is taken out.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn left_over(found: &Found<'_>, base: &Baseline<'_>) -> Result<LeftOver, NoPose> {
    let estimate = &found.fitted.estimate;
    let spread = estimate.spread;
    let observations: Vec<&Observation> = estimate.problem.records.iter().map(|record| record.observation).collect();
    let repeats = repeatability(&observations).same_approach;
    let (noise_sigma_m, noise_freedom) = if base.stated {
        (root_mean_square(estimate.problem.records.iter().map(|record| record.sigma_m)) / estimate.scale, 1e6)
    } else if let Some(pure) = repeats.filter(|pure| pure.freedom >= ENOUGH_REPEATS && pure.sigma_m > 0.0) {
        (pure.sigma_m, pure.freedom as f64)
    } else {
        (without_structure_m(found)?, 1e6)
    };
    let left = LeftOver { noise_sigma_m, noise_freedom, structure_sigma_m: 0.0 };
    let structure_sigma_m = if found.free.is_empty() { left.beyond_noise_m(&spread) } else { left.excess_m(&spread) };
    Ok(LeftOver { structure_sigma_m, ..left })
}

fn without_structure_m(found: &Found<'_>) -> Result<f64, NoPose> {
    let estimate = &found.fitted.estimate;
    if found.free.is_empty() {
        return Ok(estimate.spread.sigma_m);
    }
    let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
    let (without, with) = (found.fitted.projection(None), found.projection(&regressors, None));
    Ok(estimate.spread.sigma_m * (with.cost / without.cost).sqrt())
}

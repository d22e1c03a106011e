//! What the delivered model leaves, told apart into noise and the unexplained.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::measure::observation::Observation;
use crate::measure::repeats::{PureError, Repeatability, repeatability};

use super::calibrate::Outcome;
use super::estimate::root_mean_square;
use super::problem::NoPose;
use super::structure::{Composition, composition};

/// What is left, standard deviations per axis, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Left {
    /// All of it.
    pub sigma_m: f64,
    /// Noise of the measurement.
    pub noise_sigma_m: f64,
    /// What the arm does and the model does not.
    pub unexplained_sigma_m: f64,
    /// How the two were told apart.
    pub told_by: ToldBy,
    /// Scatter of repeated poses.
    pub repeatability: Repeatability,
}

/// What told noise from the unexplained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToldBy {
    /// The recording states its noise.
    Stated,
    /// Repeated poses.
    Repeats,
    /// Structure in the residuals.
    Structure,
}

impl ToldBy {
    /// The word in reports.
    pub fn word(self) -> &'static str {
        match self {
            ToldBy::Stated => "stated",
            ToldBy::Repeats => "repeats",
            ToldBy::Structure => "structure",
        }
    }
}

/// Degrees of freedom that repeats need to be asked.
const ENOUGH_REPEATS: usize = 15;
/// Noise per axis that a laser tracker has at most, m. Its limit of permissible error is 15 um and 6 um a metre (ISO
/// 10360-10), 75 um at ten metres; a standard deviation of half of that is plenty, this leaves room for the reflector.
const MOST_NOISE_M: f64 = 5e-5;
/// Probability with which white residuals would be called larger than the noise.
const FALSE_ALARM: f64 = 0.01;

/// Tells noise from the unexplained: by the noise that the recording states; else by its repeated poses (whatever the
/// way they were approached: what depends on the approach is unexplained as long as no effect explains it, so those of
/// the same approach are asked first); else by structure in the residuals, and by what a tracker can be guilty of.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn left(outcome: &Outcome<'_>) -> Result<Left, NoPose> {
    let delivered = &outcome.delivered;
    let sigma_m = delivered.spread.sigma_m;
    let observations: Vec<&Observation> =
        outcome.fitted.iter().map(|&index| outcome.entries[index].observation).collect();
    let repeatability = repeatability(&observations);
    let told = |noise_sigma_m: f64, noise_freedom: f64, told_by: ToldBy| {
        let excess = sigma_m.powi(2) - noise_sigma_m.powi(2);
        let ratio = (sigma_m / noise_sigma_m).powi(2);
        let unexplained_sigma_m = match significant(ratio, delivered.spread.freedom, noise_freedom) && excess > 0.0 {
            true => excess.sqrt(),
            false => 0.0,
        };
        Left { sigma_m, noise_sigma_m, unexplained_sigma_m, told_by, repeatability }
    };
    if outcome.sigma_stated {
        let stated = root_mean_square(delivered.problem.records.iter().map(|record| record.sigma_m)) / delivered.scale;
        // Stated sigmas are taken at their word: as if known for ever.
        return Ok(told(stated, 1e6, ToldBy::Stated));
    }
    let asked = |pure: Option<PureError>| pure.filter(|pure| pure.freedom >= ENOUGH_REPEATS && pure.sigma_m > 0.0);
    if let Some(pure) = asked(repeatability.same_approach) {
        return Ok(told(pure.sigma_m, pure.freedom as f64, ToldBy::Repeats));
    }
    let composition = composition(delivered)?;
    let Composition { mut noise_sigma_m, mut unexplained_sigma_m } = composition;
    // Where some structure is seen, more of it may hide in what looks like noise. What is more than a tracker's is the
    // arm's. Where none is seen the tracker may be a worse one.
    if unexplained_sigma_m > 0.0 && noise_sigma_m > MOST_NOISE_M {
        noise_sigma_m = MOST_NOISE_M;
        unexplained_sigma_m = (sigma_m.powi(2) - noise_sigma_m.powi(2)).max(unexplained_sigma_m.powi(2)).sqrt();
    }
    Ok(Left { sigma_m, noise_sigma_m, unexplained_sigma_m, told_by: ToldBy::Structure, repeatability })
}

/// F test of a ratio of variances: the lack of fit against pure error.
fn significant(ratio: f64, freedom: f64, noise_freedom: f64) -> bool {
    let fisher = FisherSnedecor::new(freedom.max(1.0), noise_freedom.max(1.0));
    fisher.is_ok_and(|fisher| ratio > fisher.inverse_cdf(1.0 - FALSE_ALARM))
}

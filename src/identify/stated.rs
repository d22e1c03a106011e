//! How far the compliances that a robot file states are to be trusted, learned from the recording itself.
//!
//! A file states what a data sheet or an earlier calibration said: right to a per cent or wrong by half, and nobody has written
//! down which. Where the records bear out all of a file's numbers, each of them is worth more than what these records say of
//! it alone, and everything else is known better for it. So the relative errors of the stated numbers are taken for draws from
//! one normal distribution whose width the records tell (empirical Bayes: Efron and Morris 1973; the width averaged over its
//! posterior, so that three numbers that happen to agree are not taken for proof).
//!
//! And where the records contradict a stated compliance outright, its prior holds nothing back any more.

use nalgebra::{DMatrix, DVector};

use crate::model::effect::JOINT_COMPLIANCE;
use crate::model::parameters::ParameterId;

use super::estimate::Estimate;
use super::problem::NoPose;
use super::solve::solve;
use super::state::State;
use super::unknown::{Prior, Unknown, UnknownId};

/// Relative widths that are thought of, by equal factors: nobody states a compliance to better than a per cent, and what is
/// wrong by half is not known.
const WIDTHS: (f64, f64) = (0.01, 0.5);
/// How many.
const WIDTHS_TRIED: usize = 24;

/// Standard deviations of its prior by which an estimate contradicts it.
const CONTRADICTS: f64 = 3.0;

/// The unknowns with the priors of those compliances widened that an estimate contradicts; `None` where it contradicts none.
///
/// A normal prior grows ever stronger the further off an estimate is. A drive whose spring is bent may be stated by its stiff
/// part and be ten times as soft below the bend: held back like that, its true law cannot be fitted.
pub fn doubting(unknowns: &[Unknown], estimate: &Estimate<'_>) -> Option<Vec<Unknown>> {
    let state = &estimate.fit.state;
    let doubted: Vec<Unknown> = unknowns
        .iter()
        .map(|unknown| match state.get(unknown.id) {
            Some(value) if is_stated(unknown, state) => Unknown { prior: borne_out(unknown.prior, value), ..*unknown },
            _ => *unknown,
        })
        .collect();
    (doubted != unknowns).then_some(doubted)
}

/// A prior that does not contradict an estimate: as it is, or as wide as the estimate is away.
fn borne_out(prior: Prior, value: f64) -> Prior {
    let away = (value - prior.mean).abs();
    if away > CONTRADICTS * prior.sigma { Prior { sigma: away, ..prior } } else { prior }
}

/// The estimate with the stated compliances trusted as far as its records bear them out.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn trusting<'a>(estimate: &Estimate<'a>) -> Result<Estimate<'a>, NoPose> {
    trusted(estimate).map_or_else(|| Ok(estimate.clone()), |unknowns| refitted(estimate, &unknowns))
}

/// The estimate with other priors, its noise level kept.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn refitted<'a>(estimate: &Estimate<'a>, unknowns: &[Unknown]) -> Result<Estimate<'a>, NoPose> {
    let fit = solve(&estimate.problem, estimate.fit.state.clone(), unknowns, &[])?;
    Ok(Estimate { fit, ..estimate.clone() })
}

/// The unknowns with the priors of stated compliances as wide as the records say; `None` where none is stated.
fn trusted(estimate: &Estimate<'_>) -> Option<Vec<Unknown>> {
    let fit = &estimate.fit;
    let stated: Vec<usize> = (0..fit.unknowns.len()).filter(|&at| is_stated(&fit.unknowns[at], &fit.state)).collect();
    if stated.is_empty() {
        return None;
    }
    let mean = |at: &usize| fit.unknowns[*at].prior.mean;
    let errors = stated.iter().map(|at| fit.state.get(fit.unknowns[*at].id).unwrap_or(0.0) / mean(at) - 1.0);
    let errors = DVector::from_iterator(stated.len(), errors);
    let covariance = fit.covariance();
    let own = DMatrix::from_fn(stated.len(), stated.len(), |i, j| {
        covariance[(stated[i], stated[j])] / (mean(&stated[i]) * mean(&stated[j]))
    });
    let width = width(&errors, &own);
    let mut unknowns = fit.unknowns.clone();
    for at in stated {
        let Prior { mean, sigma } = unknowns[at].prior;
        unknowns[at].prior.sigma = sigma.min(width * mean);
    }
    Some(unknowns)
}

/// True for a compliance of which the file knows something.
fn is_stated(unknown: &Unknown, state: &State) -> bool {
    let UnknownId::Model(ParameterId::Effect(effect, _)) = unknown.id else { return false };
    let id = state.model.effects.get(effect).map(|instance| instance.effect.meta().id);
    id == Some(JOINT_COMPLIANCE.meta().id) && unknown.prior.mean > 0.0
}

/// Root of the expected square of the width of relative errors that were found with covariance `own`: every order of
/// magnitude of the width is as likely as any other beforehand.
fn width(errors: &DVector<f64>, own: &DMatrix<f64>) -> f64 {
    let (least, most) = WIDTHS;
    let widths: Vec<f64> =
        (0..WIDTHS_TRIED).map(|step| least * (most / least).powf(step as f64 / (WIDTHS_TRIED - 1) as f64)).collect();
    let evidence = |width: &f64| {
        let mut spread = own.clone();
        for at in 0..errors.len() {
            spread[(at, at)] += width * width;
        }
        let Some(factor) = spread.cholesky() else { return f64::NEG_INFINITY };
        let log_root: f64 = factor.l_dirty().diagonal().iter().map(|root| root.ln()).sum();
        -0.5 * errors.dot(&factor.solve(errors)) - log_root
    };
    let evidences: Vec<f64> = widths.iter().map(evidence).collect();
    let best = evidences.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let weights: Vec<f64> = evidences.iter().map(|evidence| (evidence - best).exp()).collect();
    let squares: f64 = widths.iter().zip(&weights).map(|(width, weight)| width * width * weight).sum();
    (squares / weights.iter().sum::<f64>()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn width_of(errors: &[f64], sigma: f64) -> f64 {
        let own = DMatrix::from_diagonal_element(errors.len(), errors.len(), sigma * sigma);
        width(&DVector::from_column_slice(errors), &own)
    }

    #[test]
    fn a_prior_that_is_contradicted_is_widened() {
        let prior = Prior { mean: 1.1e-4, sigma: 5.5e-5 };
        assert_eq!(borne_out(prior, 2.0e-4), prior);
        let widened = borne_out(prior, 1.27e-3);
        assert!(widened.mean == prior.mean && (widened.sigma - 1.16e-3).abs() < 1e-12);
    }

    #[test]
    fn numbers_that_are_borne_out_are_trusted_and_wrong_ones_are_not() {
        let borne_out = width_of(&[0.004, -0.006, 0.009, -0.002], 0.008);
        assert!(borne_out < 0.04, "{borne_out}");
        let wrong = width_of(&[0.3, -0.22, 0.004, -0.28], 0.008);
        assert!((0.2..0.4).contains(&wrong), "{wrong}");
        // Numbers of which the records say nothing leave the width open.
        assert!(width_of(&[0.0, 0.0], 2.0) > 0.15);
        // One number that fits is no proof.
        assert!(width_of(&[0.001], 0.008) > 2.0 * borne_out);
    }
}

//! How much a gain in fit is worth, given how much was looked at.

use nalgebra::DVector;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::model::arm::EffectInstance;
use crate::model::effect::EFFECTS;

use super::candidate::Candidate;
use super::projection::Gain;

/// A gain below this part of the remaining sum of squares is no finding, however certain: the error would fall by half
/// a per cent.
pub const SMALLEST_PART: f64 = 0.01;
/// Differences of [`penalised`] below this do not decide between rivals (Kass and Raftery 1995: 6 is strong).
pub const DECIDES: f64 = 6.0;
/// Evidence so far against a suspect that neither what else is found between two fits nor a better constant turns it.
pub const HOPELESS: f64 = 15.0;

/// Twice the logarithm of the evidence against a cause, after Schwarz (1978), plus the price of having looked at
/// `looked_at` causes: negative values speak for it.
///
/// `N ln(1 - gain/cost) + k ln N + 2 ln M`, N coordinates, k numbers fitted.
pub fn penalised(explained: f64, cost: f64, rows: usize, fitted: usize, looked_at: f64) -> f64 {
    let rows = rows as f64;
    let left = (1.0 - explained / cost).max(1e-12);
    rows * left.ln() + fitted as f64 * rows.ln() + 2.0 * looked_at.ln()
}

/// Every kind of cause is as likely as any other, and so is every place within a kind.
pub fn looked_at(places: f64) -> f64 {
    (EFFECTS.len() as f64 + 1.0) * places.max(1.0)
}

/// What a candidate that was taken in costs for its numbers and for having been looked for among others, on the scale of
/// [`penalised`].
pub fn price(candidate: &Candidate, rows: f64) -> f64 {
    let numbers: usize = candidate.instances.iter().map(|one| one.effect.meta().parameters.len()).sum();
    (numbers + candidate.chosen_constants) as f64 * rows.ln() + 2.0 * looked_at(candidate.places).ln()
}

/// Evidence for a candidate from its score step.
pub fn of_candidate(candidate: &Candidate, gain: &Gain, cost: f64, rows: usize) -> f64 {
    let fitted = gain.rank + candidate.chosen_constants;
    penalised(gain.explained, cost, rows, fitted, looked_at(candidate.places))
}

/// Probability of a gain at least as large by chance, all that was looked at counted (Bonferroni).
pub fn p_value(explained: f64, rank: usize, cost: f64, freedom: f64, looked_at: f64) -> f64 {
    if rank == 0 || explained <= 0.0 {
        return 1.0;
    }
    let left = (cost - explained).max(f64::MIN_POSITIVE);
    let below = freedom - rank as f64;
    let ratio = (explained / rank as f64) / (left / below.max(1.0));
    let tail = FisherSnedecor::new(rank as f64, below.max(1.0)).map_or(1.0, |fisher| fisher.sf(ratio));
    (tail * looked_at).clamp(0.0, 1.0)
}

/// Probability, all that was looked at counted, below which a line of a joint is one.
const CERTAIN: f64 = 1e-6;

/// False for a line that was chosen among thousands and might be one of the noise's own: what is left is never quite normal, and
/// with few records Schwarz's criterion alone asks for little. True for whatever is no line.
pub fn is_certain(candidate: &Candidate, gain: &Gain, cost: f64, freedom: f64) -> bool {
    let is_line = candidate.location().order.is_some();
    !is_line || p_value(gain.explained, gain.rank, cost, freedom, looked_at(candidate.places)) < CERTAIN
}

/// Bound on the probability of evidence at least as strong where nothing is there: the likelihood ratio of nothing against
/// something that the evidence stands for (everything that was looked at counted in it).
pub fn p_value_of_evidence(evidence: f64) -> f64 {
    (0.5 * evidence).exp().min(1.0)
}

/// Standard uncertainties by which a value may lie beyond what physics makes believable.
const BEYOND_SIGMAS: f64 = 2.5;

/// By how much fitted numbers speak against a cause, on the scale of [`penalised`]; `None` where they rule it out.
///
/// Inside the believable range nothing does. Beyond it doubt grows with the square of the number of doublings: what is
/// usual is known to a factor, so a size is as doubtful as it is far out in proportion. A sign that the physics does not
/// have (a spring that gives way upwards) rules a cause out. A number that a recording hardly shows may stand anywhere
/// within its uncertainty, so `sigmas` decides there. So do numbers that no such device has together.
pub fn doubt(instances: &[EffectInstance], values: &DVector<f64>, sigmas: &DVector<f64>) -> Option<f64> {
    let mut first = 0;
    for instance in instances {
        let own = first..first + instance.effect.meta().parameters.len();
        if !instance.effect.is_believable(&values.as_slice()[own.clone()], &sigmas.as_slice()[own.clone()]) {
            return None;
        }
        first = own.end;
    }
    let metas = instances.iter().flat_map(|instance| instance.effect.meta().parameters);
    let mut all = 0.0;
    for (meta, (value, sigma)) in metas.zip(values.iter().zip(sigmas.iter())) {
        let (low, high) = meta.plausible;
        let slack = BEYOND_SIGMAS * sigma;
        let impossible = |bound: f64, beyond: f64| bound == 0.0 && beyond > slack;
        if !value.is_finite() || impossible(low, -value) || impossible(high, *value) {
            return None;
        }
        let bound = if *value < 0.0 { low.abs() } else { high.abs() };
        let least = (value.abs() - slack).max(0.0);
        if bound > 0.0 && least > bound {
            all += (least / bound).log2().powi(2);
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_f_distribution_of_tables() {
        // F(0.95; 1, 10) = 4.9646: a gain of 4.9646 parts in 14.9646 with 11 degrees of freedom before.
        let p = p_value(4.9646, 1, 14.9646, 11.0, 1.0);
        assert!((p - 0.05).abs() < 1e-4, "{p}");
        assert!((p_value(4.9646, 1, 14.9646, 11.0, 3.0) - 0.15).abs() < 3e-4);
    }

    #[test]
    fn an_unusual_size_is_doubted_and_a_wrong_sign_is_impossible() {
        let effect = *EFFECTS.iter().find(|effect| effect.meta().id == "backlash").expect("an effect");
        let instances = [EffectInstance { effect, location: crate::model::effect::Location::at_joint(0) }];
        let at = |value: f64| doubt(&instances, &DVector::from_element(1, value), &DVector::from_element(1, 1e-6));
        let high = effect.meta().parameters[0].plausible.1;
        assert_eq!(at(0.5 * high), Some(0.0));
        assert!((at(4.0 * high + 2.5e-6).expect("a doubt") - 4.0).abs() < 1e-6);
        assert_eq!(at(-1e-5), None);
        assert_eq!(at(-1e-6), Some(0.0));
    }

    #[test]
    fn noise_does_not_pay_for_a_number() {
        // One number explains of noise its share, 1/N of the whole.
        assert!(penalised(1.0, 720.0, 720, 1, 1.0) > 5.0);
        assert!(penalised(40.0, 720.0, 720, 1, 20.0) < 0.0);
    }
}

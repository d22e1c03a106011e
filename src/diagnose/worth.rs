//! Whether named physics is worth having where a learner could have told the same.
//!
//! Lines of a spectrum can stand for any curve, and a search that has seen a record flatters the cause that it chose for it:
//! held-out figures do not show that, because only the cause's numbers are held out and not its choice. The largest of M
//! chance gains is about 2 ln M (in noise variances; Foster and George 1994): that much is taken off for every cause.

use crate::identify::estimate::Estimate;
use crate::identify::problem::NoPose;
use crate::learn::choose::{Candidate, Rivals, learn};
use crate::learn::learned::Learned;
use crate::learn::subject::Subject;

use super::evidence::looked_at;
use super::fitted::{Fitted, Ground};

/// False when held-out records are nearer to a model that leaves everything beyond the ground to the learner.
///
/// # Errors
/// [`NoPose`] when a model cannot place a record.
pub fn names_are_worth_having(ground: &Ground<'_>, found: &Fitted<'_>, seed: u64) -> Result<bool, NoPose> {
    let unnamed = ground.fit(&[])?.estimate;
    // Curves are what could have told the same; a network would take longer and tell less.
    let learned = |estimate: &Estimate<'_>| {
        let own = (&estimate.fit.state, &estimate.fit.unknowns[..]);
        learn(&estimate.problem, own, &Subject::Everything, Rivals::Curves, seed)
    };
    let (unnamed, named) = (learned(&unnamed)?, learned(&found.estimate)?);
    let (Some(unnamed), Some(named)) = (chosen(&unnamed), chosen(&named)) else { return Ok(true) };
    let coordinates = 3.0 * ground.problem.records.len() as f64;
    let gain = coordinates * ((unnamed.heldout_rms_mm / named.heldout_rms_mm).powi(2) - 1.0);
    let flattery: f64 = found.terms.iter().map(|term| 2.0 * looked_at(term.places).ln()).sum();
    Ok(gain > flattery)
}

fn chosen(learned: &Learned) -> Option<&Candidate> {
    learned.candidates.get(learned.chosen)
}

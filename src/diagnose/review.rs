//! Every found cause looked at again beside the others: what speaks for it, and what could stand in its place.

use crate::identify::problem::NoPose;

use super::candidate::Candidate;
use super::evidence::DECIDES;
use super::found::{CLEARLY_MORE, Found};
use super::projection::Gain;
use super::rank::{Cause, Ranked, Suspect, rank, searched, suspects};
use super::regressors::Regressors;
use super::scan::{SAME_ORDER, order_interval, other_orders};

/// What is known of a named cause, all others modelled.
#[derive(Clone, Debug)]
pub struct Review {
    /// Evidence against it (see [`super::evidence::penalised`]): negative speaks for it.
    pub evidence: f64,
    /// What it explains.
    pub gain: Gain,
    /// Sum of squares without it.
    pub cost: f64,
    /// Degrees of freedom without it.
    pub freedom: f64,
    /// The strongest other cause in its place.
    pub better: Option<Other>,
    /// Named causes that these records cannot tell from it.
    pub rivals: Vec<Candidate>,
    /// Between which orders a periodic error's lies.
    pub order_95: Option<[f64; 2]>,
}

/// Another cause in the place of a found one.
#[derive(Clone, Debug)]
pub struct Other {
    /// Which.
    pub cause: Cause,
    /// Evidence against it.
    pub evidence: f64,
}

/// Causes for which rivals are looked for: the strongest.
const MOST_SEARCHED: usize = 8;
/// Rivals that are told of one cause.
const MOST_RIVALS: usize = 4;

/// True for what is the same answer as `own`: constants that a search chose make no other one, but for an order, which
/// another wheel of the gear has.
fn is_same_answer(candidate: &Candidate, own: &Candidate) -> bool {
    let (there, here) = (candidate.location(), own.location());
    let same_place = candidate.id() == own.id() && there.joint == here.joint;
    match (there.order, here.order) {
        (Some(a), Some(b)) => same_place && (a - b).abs() < SAME_ORDER,
        _ => candidate.same_as(own) || same_place && candidate.chosen_constants > 0,
    }
}

/// Reviews every named cause.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn review(found: &Found<'_>) -> Result<Vec<Review>, NoPose> {
    let fitted = &found.fitted;
    if fitted.terms.is_empty() {
        return Ok(Vec::new());
    }
    let estimate = &fitted.estimate;
    let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
    let standing = suspects(&regressors)?;
    let mut strongest: Vec<usize> = (0..fitted.terms.len()).collect();
    strongest.sort_by(|&a, &b| fitted.worth_of(b).0.total_cmp(&fitted.worth_of(a).0));
    strongest.truncate(MOST_SEARCHED);
    let of_term = |term: usize| {
        let own = &fitted.terms[term];
        let (evidence, projection) = found.evidence_of(&regressors, term);
        let gain = projection.gain(&fitted.columns_of(term));
        let asked = strongest.contains(&term);
        let mut fine = Vec::new();
        if asked {
            fine = searched(&regressors, &projection);
            let orders = other_orders(own, MOST_RIVALS, &regressors, &projection);
            fine.extend(orders.into_iter().map(|order| Suspect::through(order, &regressors)));
        }
        let coarse: &[Suspect] = if asked { &standing } else { &[] };
        let all: Vec<&Suspect> = fine.iter().chain(coarse).collect();
        let ranked = rank(&all, &projection);
        let known = |candidate: &Candidate| fitted.terms.iter().any(|known| known.same_as(candidate));
        let better = ranked.iter().find(|other| match &other.suspect.cause {
            Cause::Named(candidate) => !known(candidate),
            Cause::Free(_) => other.gain.explained > CLEARLY_MORE * gain.explained,
        });
        // A law with more numbers pays for them when a name is chosen. Whether the records speak against it is another question:
        // for that they cost what they gain by chance (Akaike 1974).
        let left =
            |gain: &Gain| projection.rows as f64 * (projection.cost - gain.explained).max(f64::MIN_POSITIVE).ln();
        let misfit = |gain: &Gain| left(gain) + 2.0 * gain.rank as f64;
        let limit = misfit(&gain) + DECIDES;
        let stands = |other: &&Ranked<'_>| other.evidence < evidence + DECIDES || misfit(&other.gain) < limit;
        let mut rivals: Vec<Candidate> = Vec::new();
        for other in ranked.iter().take_while(|other| other.evidence < 0.0).filter(stands) {
            let Some(candidate) = other.suspect.candidate() else { continue };
            let others = fitted.terms.iter().enumerate().filter(|(other, _)| *other != term).map(|(_, other)| other);
            let told = others.chain(&rivals).any(|known| known.same_as(candidate)) || is_same_answer(candidate, own);
            if !told && rivals.len() < MOST_RIVALS {
                rivals.push(candidate.clone());
            }
        }
        Review {
            evidence,
            cost: projection.cost,
            freedom: (projection.rows as f64 - projection.free as f64).max(1.0),
            gain,
            better: better.map(|other| Other { cause: other.suspect.cause.clone(), evidence: other.evidence }),
            rivals,
            order_95: order_interval(own, &regressors, &projection),
        }
    };
    Ok((0..fitted.terms.len()).map(of_term).collect())
}

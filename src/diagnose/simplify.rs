//! Causes that only mend the law of another one, and are not needed once that law is fitted without them.
//!
//! The constant of a law (a knee, a moment, a levelling time) was searched for beside everything that was found by then. A
//! cause that was found first, and wrongly, keeps such a constant from its place, and then looks necessary. So each is
//! taken out in turn, the constants of the others are searched for again, and where that is as good, it stays out. In the same
//! way a spring that was found together with its bend is straight where the bend explains next to nothing.

use crate::identify::problem::NoPose;
use crate::model::effect::Place;

use super::candidate::Candidate;
use super::evidence::price;
use super::fitted::Ground;
use super::found::Found;

/// Takes out every cause whose neighbours, their constants searched for again, make it needless.
pub fn simplify<'a>(found: &mut Found<'a>, ground: &Ground<'a>) {
    let mut term = 0;
    while term < found.fitted.terms.len() {
        // Without which the arm does not stand is needed.
        let straight = straightened(found, ground, term).ok().flatten();
        match straight.or_else(|| without(found, ground, term).ok().flatten()) {
            Some(simpler) => {
                *found = simpler;
                term = 0;
            }
            None => term += 1,
        }
    }
}

/// What was found with a straight spring in the place of a bent one that came with its straight part, where the bend alone
/// explains no more than the error of a law may be.
fn straightened<'a>(found: &Found<'a>, ground: &Ground<'a>, term: usize) -> Result<Option<Found<'a>>, NoPose> {
    let fitted = &found.fitted;
    let cause = &fitted.terms[term];
    let [_, straight @ ..] = &cause.instances[..] else { return Ok(None) };
    if straight.is_empty() {
        return Ok(None);
    }
    let mut terms = fitted.terms.clone();
    terms[term] = Candidate { instances: straight.to_vec(), chosen_constants: 0, ..cause.clone() };
    let (fit, _) = ground.fit_like(fitted, &terms)?;
    let cost = fitted.estimate.fit.cost;
    let rows = fit.residuals.len() as f64;
    let is_idle = rows * (fit.cost / cost).ln() < price(cause, rows) - price(&terms[term], rows);
    if !is_idle && fit.cost - cost > found.least(&fitted.projection(None)) {
        return Ok(None);
    }
    Ok(Some(Found { fitted: ground.refit(fitted, &terms, &[])?, ..found.clone() }))
}

/// What was found without one cause, where that is no worse.
fn without<'a>(found: &Found<'a>, ground: &Ground<'a>, term: usize) -> Result<Option<Found<'a>>, NoPose> {
    let fitted = &found.fitted;
    let cause = &fitted.terms[term];
    let others = fitted.terms.iter().enumerate().filter(|(index, _)| *index != term);
    if !others.clone().any(|(_, other)| has_a_searched_law(other) && is_near(other, cause)) {
        return Ok(None);
    }
    let terms: Vec<Candidate> = others.map(|(_, other)| other.clone()).collect();
    let mut simpler = Found { fitted: ground.refit(fitted, &terms, &[])?, ..found.clone() };
    simpler.tune(ground)?;
    let (fit, _) = ground.fit_like(fitted, &simpler.fitted.terms)?;
    let rows = fit.residuals.len() as f64;
    let worse = rows * (fit.cost / fitted.estimate.fit.cost).ln();
    Ok((worse < price(cause, rows)).then_some(simpler))
}

/// True for a cause whose law has a constant that was searched for.
fn has_a_searched_law(candidate: &Candidate) -> bool {
    let place = candidate.effect().meta().place;
    matches!(place, Place::Frame | Place::FrameMoment)
        || (matches!(place, Place::Joint | Place::JointLaw) && candidate.chosen_constants > 0)
}

/// True when two causes act at the same joint or frame.
fn is_near(one: &Candidate, other: &Candidate) -> bool {
    let (one, other) = (one.location(), other.location());
    (one.joint.is_some() && one.joint == other.joint) || (one.frame.is_some() && one.frame == other.frame)
}

//! The causes of one place told again, all others kept.
//!
//! A search takes in one cause after the other. Two wrong ones can hold each other up (the orders 3 and 4 of a joint that
//! stand for 6), and one can stand for two that are weaker one by one; no exchange of one for one finds that out. So what was
//! found at one place is taken out together, and the records are told what they show from there, to first order, each time
//! with another beginning. Where such a story is clearly better than what stood there, it is fitted, and the search goes on
//! from it; it stays when the whole of it is clearly better than the whole of what was found before.

use rand_chacha::ChaCha8Rng;

use crate::identify::problem::NoPose;
use crate::model::effect::Location;

use super::candidate::Candidate;
use super::check::holds;
use super::evidence::DECIDES;
use super::fitted::Ground;
use super::found::{Found, joined};
use super::projection::Projection;
use super::rank::{Suspect, rank, searched, suspects};
use super::regressors::Regressors;
use super::story::{Story, told_from};
use super::walk::Walk;

/// Names with which a story is begun.
const BEGINNINGS: usize = 3;
/// Causes of a story beyond those that stood in its place.
const FURTHER: usize = 2;

/// A better account of one of the places, with all that follows from it; `None` where there is none, and where something was
/// found that has no name.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn retell<'a>(found: &Found<'a>, ground: &Ground<'a>, walk: &mut Walk) -> Result<Option<Found<'a>>, NoPose> {
    if found.fitted.terms.is_empty() || !found.free.is_empty() {
        return Ok(None);
    }
    let estimate = &found.fitted.estimate;
    let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
    let mut standing = suspects(&regressors)?;
    standing.retain(|suspect| suspect.candidate().is_some());
    for place in places(&found.fitted.terms) {
        let Some(story) = better_story(found, &place, &standing, &regressors) else { continue };
        // A way that ends where the arm does not stand is none.
        if let Ok(Some(other)) = told_again(found, &place, &story, ground, walk) {
            return Ok(Some(other));
        }
    }
    Ok(None)
}

/// Which terms sit at the same joint, link or frame.
fn places(terms: &[Candidate]) -> Vec<Vec<usize>> {
    let seat = |term: &Candidate| {
        let &Location { joint, link, frame, payload, base, clock, .. } = term.location();
        (joint, link, frame, payload, base, clock)
    };
    let mut places: Vec<Vec<usize>> = Vec::new();
    for (index, term) in terms.iter().enumerate() {
        match places.iter_mut().find(|place| seat(&terms[place[0]]) == seat(term)) {
            Some(place) => place.push(index),
            None => places.push(vec![index]),
        }
    }
    places
}

/// A story, to first order, that is clearly better than the causes of a place.
fn better_story(
    found: &Found<'_>,
    place: &[usize],
    standing: &[Suspect],
    regressors: &Regressors<'_, '_>,
) -> Option<Story> {
    let fitted = &found.fitted;
    let projection = fitted.projection_without(place);
    let own: Vec<Suspect> =
        place.iter().map(|&term| Suspect::named(fitted.terms[term].clone(), fitted.columns_of(term))).collect();
    let before = evidence_of(&own, &projection);
    let fine = searched(regressors, &projection);
    let all: Vec<&Suspect> = own.iter().chain(&fine).chain(standing).collect();
    let (most, least) = (place.len() + FURTHER, |projection: &Projection| found.least(projection));
    let stories = rank(&all, &projection)
        .into_iter()
        .take(BEGINNINGS)
        .map(|first| told_from(&first, &all, None, &projection, (most, &least)));
    // What only adds to the causes of a place has been looked for and refused.
    let keeps = |story: &Story, one: &Candidate| {
        story.causes.iter().filter_map(Suspect::candidate).any(|told| told.same_as(one))
    };
    let is_another = |story: &Story| !own.iter().filter_map(Suspect::candidate).all(|one| keeps(story, one));
    stories
        .filter(is_another)
        .min_by(|a, b| a.evidence.total_cmp(&b.evidence))
        .filter(|story| story.evidence < before - DECIDES)
}

/// Evidence, summed up, of causes taken in one after the other.
fn evidence_of(causes: &[Suspect], projection: &Projection) -> f64 {
    let mut projection = projection.clone();
    let mut total = 0.0;
    for cause in causes {
        total += cause.evidence(&projection.gain(&cause.columns), &projection);
        projection = cause.beside(&projection);
    }
    total
}

/// What a search finds that goes on from a story, where that is clearly better.
fn told_again<'a>(
    found: &Found<'a>,
    place: &[usize],
    story: &Story,
    ground: &Ground<'a>,
    walk: &mut Walk,
) -> Result<Option<Found<'a>>, NoPose> {
    let kept = found.fitted.terms.iter().enumerate().filter(|(index, _)| !place.contains(index));
    let kept: Vec<Candidate> = kept.map(|(_, term)| term.clone()).collect();
    let told = story.causes.iter().filter_map(Suspect::candidate);
    let terms = told.fold(kept, |terms, cause| joined(&terms, cause));
    let fitted = ground.refit(&found.fitted, &terms, &[])?;
    let mut other = Found { fitted, reviews: Vec::new(), ..found.clone() };
    other.tune(ground)?;
    other.drop_idle(ground)?;
    if !other.add_what_is_new(ground, walk)? {
        return Ok(None);
    }
    let better = other.names() != found.names() && found.against(&other, ground)? < -DECIDES;
    Ok((better && all_hold(&other, found, &mut walk.random)?).then_some(other))
}

/// True when every cause that is new stands up to what is asked of one that a search takes in.
fn all_hold(other: &Found<'_>, before: &Found<'_>, random: &mut ChaCha8Rng) -> Result<bool, NoPose> {
    let fitted = &other.fitted;
    let regressors = Regressors::new(&fitted.estimate.problem, &fitted.estimate.fit.state)?;
    for (term, candidate) in fitted.terms.iter().enumerate() {
        if before.fitted.terms.iter().any(|known| known.same_as(candidate)) {
            continue;
        }
        let projection = other.projection(&regressors, Some(term));
        let suspect = Suspect::named(candidate.clone(), fitted.columns_of(term));
        let is_large = projection.gain(&suspect.columns).explained > other.least(&projection);
        if !is_large || !holds(&fitted.estimate.problem, &other.blocks, &suspect, &projection, random) {
            return Ok(false);
        }
    }
    Ok(true)
}

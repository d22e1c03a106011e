//! Which causes are missing: found in turn, refitted together, every one tested again after each.

use rand_chacha::ChaCha8Rng;

use crate::identify::problem::NoPose;
use crate::identify::solve::Termination;
use crate::measure::recording::Kind;

use super::candidate::Candidate;
use super::evidence::{DECIDES, HOPELESS};
use super::fitted::{Fitted, Ground};
use super::found::{Found, joined};
use super::free::FreeFunction;
use super::hold_out::Blocks;
use super::projection::Projection;
use super::rank::{Cause, Ranked, Suspect, rank, searched, suspects};
use super::regressors::Regressors;
use super::retell::retell;
use super::review::review;
use super::scan;
use super::simplify::simplify;
use super::story::names_tell_it;
use super::tracker::tracker;
use super::walk::Walk;

/// Rounds of taking in and refitting.
const MOST_ROUNDS: usize = 40;
/// Causes that one diagnosis finds at most.
const MOST_CAUSES: usize = 24;
/// Records that are searched at most: what shows in these is decided, and motion sampled quicker repeats itself.
pub const MOST_SEARCHED: usize = 800;
/// Times that what was found at a place is told anew.
const MOST_RETOLD: usize = 4;
/// Exchanges of one cause for a better one.
const MOST_EXCHANGES: usize = 4;
/// A cause that takes away more than this part of what is left moves everything else: the rest is looked at again only
/// when all is refitted. Smaller ones are taken in on the linear problem, several between two fits.
const LARGE: f64 = 0.1;
/// A constant of a place is changed when the whole fit gains this much by it, on the scale of [`super::evidence::penalised`].
const BETTER_CONSTANT: f64 = 2.0;

/// Looks for what is missing.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn search<'a>(ground: &Ground<'a>, kind: Kind, seed: u64) -> Result<Found<'a>, NoPose> {
    search_from(ground, ground.fit(&[])?, kind, seed)
}

/// Looks for what is missing, from a fit of the ground without any cause. In a large recording it is looked for in a part of
/// the records, and what is found is fitted to all.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn search_from<'a>(ground: &Ground<'a>, bare: Fitted<'a>, kind: Kind, seed: u64) -> Result<Found<'a>, NoPose> {
    let Some(thinned) = ground.thinned(MOST_SEARCHED) else { return search_in(ground, bare, kind, seed) };
    let mut found = search_in(&thinned, thinned.fit(&[])?, kind, seed)?;
    let terms = found.fitted.terms.clone();
    found.fitted = if terms.is_empty() { bare } else { ground.refit(&found.fitted, &terms, &[])? };
    found.blocks = Blocks::new(&ground.problem, kind, seed);
    Ok(found)
}

/// Looks for what is missing in all records of a ground.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn search_in<'a>(ground: &Ground<'a>, bare: Fitted<'a>, kind: Kind, seed: u64) -> Result<Found<'a>, NoPose> {
    let blocks = Blocks::new(&ground.problem, kind, seed);
    let mut walk = Walk::new(seed);
    let bare_m2 = bare.estimate.fit.cost * bare.estimate.spread.sigma_m.powi(2);
    let mut found = Found {
        fitted: bare,
        free: Vec::new(),
        names_only: false,
        impossible: Vec::new(),
        blocks,
        bare_m2,
        reviews: Vec::new(),
    };
    let mut exchanges = 0;
    let mut before: Option<Found<'a>> = None;
    loop {
        found.add_all(ground, &mut walk)?;
        // A way that ends where the arm does not stand is none.
        if let Ok(Some(named)) = found.in_names_alone(ground, &mut walk) {
            found = named;
        }
        simplify(&mut found, ground);
        for _ in 0..MOST_RETOLD {
            let Some(better) = retell(&found, ground, &mut walk)? else { break };
            found = better;
        }
        found.reviews = review(&found)?;
        // An exchange is a try: what came of it stays where the whole is no worse.
        if let Some(before) = before.filter(|before| !before.against(&found, ground).is_ok_and(|worse| worse <= 0.0)) {
            return Ok(before);
        }
        let other = if exchanges < MOST_EXCHANGES { found.exchanged(ground, &walk) } else { None };
        let Some(other) = other else { return Ok(found) };
        exchanges += 1;
        before = Some(std::mem::replace(&mut found, other));
    }
}

impl<'a> Found<'a> {
    /// Takes in what the residuals show until they show nothing more.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn add_all(&mut self, ground: &Ground<'a>, walk: &mut Walk) -> Result<(), NoPose> {
        self.add_until(ground, walk, |_, _| false)
    }

    /// [`Found::add_all`] as long as it leads to where no search has been; false where it does not.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn add_what_is_new(&mut self, ground: &Ground<'a>, walk: &mut Walk) -> Result<bool, NoPose> {
        let mut is_new = true;
        self.add_until(ground, walk, |walk, names| {
            is_new = !walk.has_been_at(names);
            !is_new
        })?;
        Ok(is_new)
    }

    fn add_until(
        &mut self,
        ground: &Ground<'a>,
        walk: &mut Walk,
        mut ends: impl FnMut(&Walk, &[String]) -> bool,
    ) -> Result<(), NoPose> {
        let mut seen: Vec<Vec<String>> = Vec::new();
        let mut best = self.clone();
        loop {
            // What looks worth taking in at first order may be idle once refitted, and look worth it again.
            let now = self.names();
            if seen.contains(&now) || seen.len() > MOST_ROUNDS || ends(walk, &now) {
                break;
            }
            seen.push(now);
            if self.fitted.terms.len() + self.free.len() >= MOST_CAUSES || !self.add_some(ground, &mut walk.random)? {
                break;
            }
            self.tune(ground)?;
            self.drop_idle(ground)?;
            if self.free.is_empty() && self.score() < best.score() {
                best = self.clone();
            }
        }
        seen.into_iter().for_each(|names| walk.remember(names));
        // A fit that ends where nothing is believable any more takes with it what was found before.
        if self.free.is_empty() && best.score() < self.score() - DECIDES {
            *self = Self { impossible: std::mem::take(&mut self.impossible), ..best };
        }
        Ok(())
    }

    /// What was found told again without what has no name, where names alone tell it as well: a function that was taken in
    /// early may stand in the place of names that the rest has made visible since.
    fn in_names_alone(&self, ground: &Ground<'a>, walk: &mut Walk) -> Result<Option<Self>, NoPose> {
        if self.free.is_empty() || self.free.iter().any(FreeFunction::is_of_own_position) {
            return Ok(None);
        }
        let mut named = Self { free: Vec::new(), names_only: true, ..self.clone() };
        named.add_all(ground, walk)?;
        named.names_only = false;
        Ok((self.against(&named, ground)? <= 0.0).then_some(named))
    }

    /// Takes in what the residuals show; false when they show nothing more.
    fn add_some(&mut self, ground: &Ground<'a>, random: &mut ChaCha8Rng) -> Result<bool, NoPose> {
        let estimate = self.fitted.estimate.clone();
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let mut standing = suspects(&regressors)?;
        let mut projection = self.projection(&regressors, None);
        let (mut named, mut fresh, mut grown) = (Vec::<Candidate>::new(), Vec::new(), false);
        while self.fitted.terms.len() + named.len() + self.free.len() < MOST_CAUSES {
            let mut fine = searched(&regressors, &projection);
            fine.extend((!self.names_only).then(|| tracker(&regressors, &projection)).flatten());
            let taken = |suspect: &Suspect| {
                let Some(candidate) = suspect.candidate() else { return true };
                !named.iter().chain(&self.impossible).any(|known| known.same_as(candidate))
            };
            let all: Vec<&Suspect> = fine.iter().chain(&standing).filter(|suspect| taken(suspect)).collect();
            let names_tell = |function: &Ranked<'_>, named: &[&Ranked<'_>]| {
                names_tell_it(function, named, &standing, &regressors, &projection)
            };
            let Some((suspect, part)) = self.next(ground, &all, &projection, (named.is_empty(), &names_tell), random)
            else {
                break;
            };
            projection = suspect.beside(&projection);
            match suspect.cause {
                Cause::Free(function) => self.free.push(function),
                Cause::Named(candidate) => {
                    named.push(candidate);
                    fresh.push(suspect.columns.clone());
                }
            }
            grown = true;
            if part > LARGE {
                break;
            }
            if fresh.len() == 1 {
                standing = not_hopeless(standing, &projection);
            }
        }
        if !named.is_empty() {
            let all = named.iter().fold(self.fitted.terms.clone(), |terms, one| joined(&terms, one));
            let first = joined(&self.fitted.terms, &named[0]);
            // A cause with which the arm does not stand, or that runs away, is none; where several came, it may be any of them.
            let fitted = settled(ground.refit(&self.fitted, &all, &fresh))
                .or_else(|| settled(ground.refit(&self.fitted, &first, &[])));
            match fitted {
                Some(fitted) => self.fitted = fitted,
                None => {
                    self.impossible.push(named.swap_remove(0));
                    return self.add_some(ground, random);
                }
            }
        }
        Ok(grown)
    }

    /// Searches the constants of the places again, now that everything else is fitted beside them.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn tune(&mut self, ground: &Ground<'a>) -> Result<(), NoPose> {
        let estimate = self.fitted.estimate.clone();
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let mut terms = self.fitted.terms.clone();
        let mut changed = false;
        for (term, candidate) in self.fitted.terms.iter().enumerate() {
            let projection = self.projection(&regressors, Some(term));
            let Some(tuned) = scan::tuned(candidate, &regressors, &projection) else { continue };
            let now = scan::evidence_against(candidate, &regressors, &projection);
            let then = scan::evidence_against(&tuned, &regressors, &projection);
            if then < now - BETTER_CONSTANT {
                terms[term] = tuned;
                changed = true;
            }
        }
        if changed {
            let Ok(fitted) = ground.refit(&self.fitted, &terms, &[]) else { return Ok(()) };
            if fitted.estimate.spread.sigma_m <= self.fitted.estimate.spread.sigma_m {
                self.fitted = fitted;
            }
        }
        Ok(())
    }
}

/// A fit that came to an end where the arm stands and can be asked what moves it.
fn settled<'a>(fitted: Result<Fitted<'a>, NoPose>) -> Option<Fitted<'a>> {
    fitted.ok().filter(|Fitted { estimate, .. }| {
        estimate.fit.termination != Termination::OutOfSteps
            && Regressors::new(&estimate.problem, &estimate.fit.state).is_ok()
    })
}

/// The suspects that may still have a case in this look at the residuals; the next look asks all of them again.
fn not_hopeless(standing: Vec<Suspect>, projection: &Projection) -> Vec<Suspect> {
    let all: Vec<&Suspect> = standing.iter().collect();
    let ranked = rank(&all, projection);
    ranked.into_iter().filter(|ranked| ranked.evidence < HOPELESS).map(|ranked| ranked.suspect.clone()).collect()
}

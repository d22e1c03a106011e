//! Which causes are missing: found in turn, refitted together, every one tested again after each.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::identify::problem::NoPose;
use crate::measure::recording::Kind;
use crate::model::effect::Location;

use super::candidate::Candidate;
use super::check::holds;
use super::evidence::{self, DECIDES, SMALLEST_PART};
use super::fitted::{Fitted, Ground};
use super::free::{FreeFunction, Seat};
use super::hold_out::Blocks;
use super::projection::{Gain, Projection};
use super::rank::{Cause, Ranked, Suspect, rank, searched, suspects};
use super::regressors::Regressors;
use super::review::{Review, review};
use super::scan;
use super::simplify::simplify;
use super::story::names_tell_it;

/// Rounds of taking in and refitting.
const MOST_ROUNDS: usize = 40;
/// Causes that one diagnosis finds at most.
const MOST_CAUSES: usize = 24;
/// Records that are searched at most: what shows in these is decided, and motion sampled quicker repeats itself.
pub const MOST_SEARCHED: usize = 800;
/// Suspects tried in one round before giving up.
const TRIES: usize = 6;
/// Suspects whose full nonlinear fits are compared.
const CONTENDERS: usize = 3;
/// Exchanges of one cause for a better one.
const MOST_EXCHANGES: usize = 4;
/// By how much a cause without a name must explain more than the best one with a name.
pub const CLEARLY_MORE: f64 = 1.15;
/// Part of what a nameless function explains that a name of the same meaning must explain to be told instead.
const MOSTLY: f64 = 0.6;
/// Differences of evidence between full fits that count as none.
const EQUAL: f64 = 0.05;
/// A cause that takes away more than this part of what is left moves everything else: the rest is looked at again only
/// when all is refitted. Smaller ones are taken in on the linear problem, several between two fits.
const LARGE: f64 = 0.1;
/// No law is exact: what a further cause explains must be more than this part of what is explained already, seven per cent
/// of its amplitude, not to be the error of the laws that were named.
const LAW_ERROR: f64 = 0.005;
/// Evidence so far against a suspect that what else is found between two fits does not turn it.
const HOPELESS: f64 = 15.0;
/// A constant of a place is changed when the whole fit gains this much by it, on the scale of [`evidence::penalised`].
const BETTER_CONSTANT: f64 = 2.0;

/// Says with which of some names a story begins that makes a nameless function needless: see [`names_tell_it`].
type NamesTell<'s> = dyn Fn(&Ranked<'_>, &[&Ranked<'_>]) -> Option<usize> + 's;

/// What a search has found.
#[derive(Clone)]
pub struct Found<'a> {
    /// The named causes with the fit.
    pub fitted: Fitted<'a>,
    /// Unnamed ones: linear only, in no model.
    pub free: Vec<FreeFunction>,
    /// True where none without a name are looked for.
    pub names_only: bool,
    /// The blocks of held-out figures.
    pub blocks: Blocks,
    /// Sum of squares without any cause over the records searched, m^2.
    pub bare_m2: f64,
    /// What speaks for each named cause, and what could stand in its place.
    pub reviews: Vec<Review>,
}

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
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let bare_m2 = bare.estimate.fit.cost * bare.estimate.spread.sigma_m.powi(2);
    let mut found = Found { fitted: bare, free: Vec::new(), names_only: false, blocks, bare_m2, reviews: Vec::new() };
    let mut exchanges = 0;
    loop {
        found.add_all(ground, &mut random)?;
        if let Some(named) = found.in_names_alone(ground, &mut random)? {
            found = named;
        }
        simplify(&mut found, ground)?;
        found.reviews = review(&found)?;
        if exchanges == MOST_EXCHANGES || !found.exchange_one(ground)? {
            return Ok(found);
        }
        exchanges += 1;
        found.tune(ground)?;
        found.drop_idle(ground)?;
    }
}

impl<'a> Found<'a> {
    /// What is left beyond everything found, but for one named cause.
    pub fn projection(&self, regressors: &Regressors<'_, '_>, without: Option<usize>) -> Projection {
        let projection = self.fitted.projection(without);
        self.free.iter().fold(projection, |projection, free| projection.with(&free.columns(regressors)))
    }

    /// The causes by name and place, in no order: constants of places count by their whole numbers.
    fn names(&self) -> Vec<String> {
        let named = self.fitted.terms.iter().map(|term| {
            let place = Location {
                order: term.location().order.map(f64::round),
                at_s: term.location().at_s.map(f64::round),
                reference: None,
                ..*term.location()
            };
            format!("{} {place:?}", term.id())
        });
        let free = self.free.iter().map(|function| format!("{:?} {:?}", function.seat, function.variables));
        let mut names: Vec<String> = named.chain(free).collect();
        names.sort_unstable();
        names
    }

    /// Takes in what the residuals show until they show nothing more.
    fn add_all(&mut self, ground: &Ground<'a>, random: &mut ChaCha8Rng) -> Result<(), NoPose> {
        let mut seen = vec![self.names()];
        while self.fitted.terms.len() + self.free.len() < MOST_CAUSES && self.add_some(ground, random)? {
            self.tune(ground)?;
            self.drop_idle(ground)?;
            // What looks worth taking in at first order may be idle once refitted, and look worth it again.
            let now = self.names();
            if seen.contains(&now) || seen.len() > MOST_ROUNDS {
                break;
            }
            seen.push(now);
        }
        Ok(())
    }

    /// What was found told again without what has no name, where names alone tell it as well: a function that was taken in
    /// early may stand in the place of names that the rest has made visible since.
    fn in_names_alone(&self, ground: &Ground<'a>, random: &mut ChaCha8Rng) -> Result<Option<Self>, NoPose> {
        if self.free.is_empty() || self.free.iter().any(FreeFunction::is_of_own_position) {
            return Ok(None);
        }
        let mut named = Self { free: Vec::new(), names_only: true, ..self.clone() };
        named.add_all(ground, random)?;
        named.names_only = false;
        let (fit, _) = ground.fit_like(&self.fitted, &named.fitted.terms)?;
        let (rows, cost) = (fit.residuals.len() as f64, self.fitted.estimate.fit.cost);
        let price = |found: &Self| found.fitted.terms.iter().map(|term| evidence::price(term, rows)).sum::<f64>();
        let without_names = rows * (fit.cost / cost).ln() + price(&named) - price(self);
        Ok((without_names <= self.evidence_of_free()?).then_some(named))
    }

    /// Evidence, summed up, of what has no name, beyond the names.
    fn evidence_of_free(&self) -> Result<f64, NoPose> {
        let estimate = &self.fitted.estimate;
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let looked_at = evidence::looked_at(super::free::free_functions(&regressors).len() as f64);
        let mut projection = self.fitted.projection(None);
        let mut total = 0.0;
        for function in &self.free {
            let columns = function.columns(&regressors);
            total += projection.smooth_gain(&columns, looked_at).1;
            projection = projection.with(&columns);
        }
        Ok(total)
    }

    /// Takes in what the residuals show; false when they show nothing more.
    fn add_some(&mut self, ground: &Ground<'a>, random: &mut ChaCha8Rng) -> Result<bool, NoPose> {
        let estimate = self.fitted.estimate.clone();
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let mut standing = suspects(&regressors)?;
        let mut projection = self.projection(&regressors, None);
        let (mut named, mut fresh, mut grown) = (Vec::<Candidate>::new(), Vec::new(), false);
        while self.fitted.terms.len() + named.len() + self.free.len() < MOST_CAUSES {
            let fine = searched(&regressors, &projection);
            let taken = |suspect: &Suspect| {
                let Some(candidate) = suspect.candidate() else { return true };
                !named.iter().any(|known| known.same_as(candidate))
            };
            let all: Vec<&Suspect> = fine.iter().chain(&standing).filter(|suspect| taken(suspect)).collect();
            let names_tell = |function: &Ranked<'_>, named: &[&Ranked<'_>]| {
                names_tell_it(function, named, &standing, &regressors, &projection)
            };
            let Some((suspect, part)) = self.next(ground, &all, &projection, (named.is_empty(), &names_tell), random)
            else {
                break;
            };
            match suspect.cause {
                Cause::Free(function) => self.free.push(function),
                Cause::Named(candidate) => {
                    named.push(candidate);
                    fresh.push(suspect.columns.clone());
                }
            }
            grown = true;
            projection = projection.with(&suspect.columns);
            if part > LARGE {
                break;
            }
            if fresh.len() == 1 {
                standing = not_hopeless(standing, &projection);
            }
        }
        if !named.is_empty() {
            let terms = named.iter().fold(self.fitted.terms.clone(), |terms, one| joined(&terms, one));
            self.fitted = ground.refit(&self.fitted, &terms, &fresh)?;
        }
        Ok(grown)
    }

    /// The cause that holds best, with the part of the remaining squares that it explains.
    fn next(
        &self,
        ground: &Ground<'a>,
        all: &[&Suspect],
        projection: &Projection,
        (fresh, names_tell): (bool, &NamesTell<'_>),
        random: &mut ChaCha8Rng,
    ) -> Option<(Suspect, f64)> {
        let ranked = rank(all, projection);
        let named_m2 = self.bare_m2 - projection.cost * self.fitted.estimate.spread.sigma_m.powi(2);
        let named = named_m2.max(0.0) / self.fitted.estimate.spread.sigma_m.powi(2);
        let least = (SMALLEST_PART * projection.cost).max(LAW_ERROR * named);
        let sound = |ranked: &&Ranked<'_>| ranked.evidence < -DECIDES && ranked.gain.explained > least;
        let named: Vec<&Ranked<'_>> =
            ranked.iter().filter(sound).filter(|ranked| ranked.suspect.candidate().is_some()).collect();
        let best_named = named.iter().map(|ranked| ranked.gain.explained).fold(0.0, f64::max);
        // A name whose law is only nearly right is still the name of what is by definition the same.
        let has_a_name = |function: &FreeFunction, explained: f64| {
            let mut candidates = named.iter().filter_map(|ranked| Some((ranked.suspect.candidate()?, ranked)));
            candidates.any(|(candidate, ranked)| {
                function.is_what_means(candidate.id(), candidate.location())
                    && ranked.gain.explained > MOSTLY * explained
            })
        };
        let mut worth: Vec<&Ranked<'_>> = ranked
            .iter()
            .filter(sound)
            .filter(|ranked| match &ranked.suspect.cause {
                Cause::Free(function) => {
                    !self.names_only
                        && ranked.gain.explained > CLEARLY_MORE * best_named.max(self.named_at(function))
                        && !has_a_name(function, ranked.gain.explained)
                }
                Cause::Named(_) => true,
            })
            .take(TRIES)
            .collect();
        let in_question = |ranked: &&Ranked<'_>| match &ranked.suspect.cause {
            Cause::Free(function) => !function.is_of_own_position(),
            Cause::Named(_) => false,
        };
        if let Some(first) =
            worth.first().copied().filter(in_question).and_then(|function| names_tell(function, &named))
        {
            worth = vec![named[first]];
        }
        let mut refused: Vec<usize> = Vec::new();
        for _ in 0..worth.len() {
            let first = (0..worth.len()).find(|index| !refused.contains(index))?;
            let contenders: Vec<usize> = (first..worth.len())
                .filter(|index| !refused.contains(index))
                .filter(|&index| worth[index].evidence < worth[first].evidence + DECIDES)
                .take(CONTENDERS)
                .collect();
            let chosen = match contenders[..] {
                [only] => Some(only),
                _ => self.best_of(ground, &worth, &contenders, projection, fresh),
            };
            let Some(chosen) = chosen else {
                refused.extend(contenders);
                continue;
            };
            let suspect = worth[chosen].suspect;
            if holds(&self.fitted.estimate.problem, &self.blocks, &suspect.columns, projection, random) {
                return Some((suspect.clone(), worth[chosen].gain.explained / projection.cost));
            }
            refused.push(chosen);
        }
        None
    }

    /// Part that must be left over by the named causes at a seat, as [`CLEARLY_MORE`] has it: a law that is right to
    /// within a few per cent is the right law.
    fn named_at(&self, function: &FreeFunction) -> f64 {
        let here = |term: &usize| match function.seat {
            Seat::Joint(joint) => self.fitted.terms[*term].location().joint_index() == Some(joint),
            Seat::Base | Seat::Tool => self.fitted.terms[*term].location().frame.is_some(),
        };
        let explained = (0..self.fitted.terms.len())
            .filter(here)
            .map(|term| self.fitted.projection(Some(term)).gain(&self.fitted.columns_of(term)).explained);
        (CLEARLY_MORE - 1.0) / CLEARLY_MORE * explained.sum::<f64>()
    }

    /// The contender whose full fit has the strongest evidence; `None` when none has believable numbers.
    fn best_of(
        &self,
        ground: &Ground<'a>,
        worth: &[&Ranked<'_>],
        contenders: &[usize],
        projection: &Projection,
        fresh: bool,
    ) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        for &index in contenders {
            let evidence = match &worth[index].suspect.cause {
                // With further causes in the projection the full fit is another problem: the score step decides alone.
                Cause::Named(candidate) if fresh && self.free.is_empty() => {
                    let terms = joined(&self.fitted.terms, candidate);
                    self.full_evidence(ground, &terms, worth[index], projection)
                }
                _ => Some(worth[index].evidence),
            };
            let Some(evidence) = evidence else { continue };
            if evidence < 0.0 && best.is_none_or(|(least, _)| evidence < least - EQUAL) {
                best = Some((evidence, index));
            }
        }
        best.map(|(_, index)| index)
    }

    /// Evidence from the nonlinear refit of everything; `None` when it ends with numbers that nobody believes, or
    /// where the arm finds no pose.
    fn full_evidence(
        &self,
        ground: &Ground<'a>,
        terms: &[Candidate],
        ranked: &Ranked<'_>,
        projection: &Projection,
    ) -> Option<f64> {
        let (fit, spans) = ground.fit_like(&self.fitted, terms).ok()?;
        let mut doubt = 0.0;
        for (term, span) in terms.iter().zip(&spans) {
            let values = span.clone().map(|index| fit.state.get(fit.unknowns[index].id).unwrap_or(0.0));
            let sigmas = span.clone().map(|index| fit.covariance_root.row(index).norm());
            let (values, sigmas) = (values.collect::<Vec<_>>().into(), sigmas.collect::<Vec<_>>().into());
            doubt += evidence::doubt(&term.instances, &values, &sigmas)?;
        }
        let mut gain = ranked.gain.clone();
        gain.explained = self.fitted.estimate.fit.cost - fit.cost;
        Some(ranked.suspect.evidence(&gain, projection) + doubt)
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
            let now = projection.gain(&scan::columns_through(&regressors, &candidate.instances));
            let then = projection.gain(&scan::columns_through(&regressors, &tuned.instances));
            let (evidence_now, evidence_then) = (
                evidence::of_candidate(candidate, &now, projection.cost, projection.rows),
                evidence::of_candidate(&tuned, &then, projection.cost, projection.rows),
            );
            if evidence_then < evidence_now - BETTER_CONSTANT {
                terms[term] = tuned;
                changed = true;
            }
        }
        if changed {
            let fitted = ground.refit(&self.fitted, &terms, &[])?;
            if fitted.estimate.spread.sigma_m <= self.fitted.estimate.spread.sigma_m {
                self.fitted = fitted;
            }
        }
        Ok(())
    }

    /// Takes out every cause that the others have made idle.
    fn drop_idle(&mut self, ground: &Ground<'a>) -> Result<(), NoPose> {
        loop {
            let estimate = self.fitted.estimate.clone();
            let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
            self.drop_idle_free(&regressors);
            let idle = |term: usize| {
                let evidence = match self.free.is_empty() {
                    true => self.quick_evidence(term),
                    false => self.evidence_of(&regressors, term).0,
                };
                (evidence >= 0.0).then_some((term, evidence))
            };
            let idlest = (0..self.fitted.terms.len()).filter_map(idle).max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((term, _)) = idlest else { return Ok(()) };
            let mut terms = self.fitted.terms.clone();
            terms.remove(term);
            self.fitted = ground.refit(&self.fitted, &terms, &[])?;
        }
    }

    /// The same for unnamed causes: a name found later may have made them idle.
    fn drop_idle_free(&mut self, regressors: &Regressors<'_, '_>) {
        let looked_at = evidence::looked_at(super::free::free_functions(regressors).len() as f64);
        let mut index = 0;
        while index < self.free.len() {
            let others = self.free.iter().enumerate().filter(|(other, _)| *other != index);
            let projection = others
                .fold(self.fitted.projection(None), |projection, (_, free)| projection.with(&free.columns(regressors)));
            let (gain, evidence) = projection.smooth_gain(&self.free[index].columns(regressors), looked_at);
            let named = self.named_at(&self.free[index]);
            if evidence >= 0.0 || gain.explained <= CLEARLY_MORE * named {
                self.free.remove(index);
            } else {
                index += 1;
            }
        }
    }

    /// Evidence against a found cause given all others, from the fit itself.
    fn quick_evidence(&self, term: usize) -> f64 {
        let candidate = &self.fitted.terms[term];
        let (values, sigmas) = self.fitted.values_of(term);
        let doubt = evidence::doubt(&candidate.instances, &values, &sigmas).unwrap_or(f64::INFINITY);
        let (explained, rank) = self.fitted.worth_of(term);
        let fit = &self.fitted.estimate.fit;
        let gain = Gain { explained, rank, values, sigmas };
        evidence::of_candidate(candidate, &gain, fit.cost + explained, fit.residuals.len()) + doubt
    }

    /// Evidence against a found cause given all others, and the projection without it.
    pub fn evidence_of(&self, regressors: &Regressors<'_, '_>, term: usize) -> (f64, Projection) {
        let projection = self.projection(regressors, Some(term));
        let gain = projection.gain(&self.fitted.columns_of(term));
        let candidate = &self.fitted.terms[term];
        let doubt = evidence::doubt(&candidate.instances, &gain.values, &gain.sigmas).unwrap_or(f64::INFINITY);
        let evidence = evidence::of_candidate(candidate, &gain, projection.cost, projection.rows);
        (evidence + doubt, projection)
    }

    /// Exchanges one cause for a suspect that explains more in its place.
    fn exchange_one(&mut self, ground: &Ground<'a>) -> Result<bool, NoPose> {
        for term in 0..self.fitted.terms.len() {
            let review = &self.reviews[term];
            let Some(better) = review.better.clone().filter(|better| better.evidence < review.evidence - DECIDES)
            else {
                continue;
            };
            let mut terms = self.fitted.terms.clone();
            terms.remove(term);
            match better.cause {
                Cause::Free(function) => {
                    self.free.push(function);
                    self.fitted = ground.refit(&self.fitted, &terms, &[])?;
                }
                Cause::Named(candidate) => {
                    let with = joined(&terms, &candidate);
                    let (fit, _) = ground.fit_like(&self.fitted, &with)?;
                    if fit.cost > self.fitted.estimate.fit.cost {
                        continue;
                    }
                    self.fitted = ground.refit(&self.fitted, &with, &[])?;
                }
            }
            return Ok(true);
        }
        Ok(false)
    }
}

/// The suspects that may still have a case in this look at the residuals; the next look asks all of them again.
fn not_hopeless(standing: Vec<Suspect>, projection: &Projection) -> Vec<Suspect> {
    let all: Vec<&Suspect> = standing.iter().collect();
    let ranked = rank(&all, projection);
    ranked.into_iter().filter(|ranked| ranked.evidence < HOPELESS).map(|ranked| ranked.suspect.clone()).collect()
}

/// The causes with a further one. A bent spring takes in the straight one that was found at its joint before.
fn joined(terms: &[Candidate], candidate: &Candidate) -> Vec<Candidate> {
    let mut candidate = candidate.clone();
    let mut all = Vec::with_capacity(terms.len() + 1);
    for term in terms {
        let taken_in = candidate.id() == "joint_stiffening"
            && term.id() == "joint_compliance"
            && term.location().joint == candidate.location().joint;
        if taken_in {
            let known = |instance: &crate::model::arm::EffectInstance| instance.effect.meta().id == "joint_compliance";
            let straight = term.instances.iter().filter(|_| !candidate.instances.iter().any(known)).copied();
            let straight: Vec<_> = straight.collect();
            candidate.instances.extend(straight);
        } else {
            all.push(term.clone());
        }
    }
    all.push(candidate);
    all
}

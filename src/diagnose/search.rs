//! Which causes are missing: found in turn, refitted together, every one tested again after each.

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use crate::identify::problem::NoPose;
use crate::measure::recording::Kind;

use super::candidate::Candidate;
use super::evidence::{self, DECIDES, SMALLEST_PART};
use super::fitted::{Fitted, Ground};
use super::free::{FreeFunction, Seat, free_functions};
use super::hold_out::{Blocks, fall_in_errors};
use super::projection::Projection;
use super::rank::{Cause, Ranked, Suspect, rank, searched, suspects};
use super::regressors::Regressors;

/// Causes that one diagnosis finds at most.
const MOST_CAUSES: usize = 16;
/// Suspects tried in one round before giving up.
const TRIES: usize = 6;
/// Suspects whose full nonlinear fits are compared.
const CONTENDERS: usize = 3;
/// Exchanges of one cause for a better one.
const MOST_EXCHANGES: usize = 4;
/// By how much a cause without a name must explain more than the best one with a name.
const CLEARLY_MORE: f64 = 1.15;
/// Differences of evidence between full fits that count as none.
const EQUAL: f64 = 0.05;
/// Shuffles of the records.
const SHUFFLES: usize = 99;
/// Part of the shuffles that may explain as much.
const BY_CHANCE: f64 = 0.02;
/// Standard errors by which held-out residuals must fall.
const SURE_FALL: f64 = 1.0;

/// What a search has found.
pub struct Found<'a> {
    /// The named causes with the fit.
    pub fitted: Fitted<'a>,
    /// Unnamed ones: linear only, in no model.
    pub free: Vec<FreeFunction>,
    /// The blocks of held-out figures.
    pub blocks: Blocks,
}

/// A contender by its place in the ranking, with the named causes that it makes; `None` for one without a name.
type Choice = (usize, Option<Vec<Candidate>>);

/// Looks for what is missing.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn search<'a>(ground: &Ground<'a>, kind: Kind, seed: u64) -> Result<Found<'a>, NoPose> {
    let blocks = Blocks::new(&ground.problem, kind, seed);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut found = Found { fitted: ground.fit(&[])?, free: Vec::new(), blocks };
    let mut exchanges = 0;
    loop {
        while found.fitted.terms.len() + found.free.len() < MOST_CAUSES {
            if !found.add_one(ground, &mut random)? {
                break;
            }
            found.drop_idle(ground)?;
        }
        if exchanges == MOST_EXCHANGES || !found.exchange_one(ground)? {
            return Ok(found);
        }
        exchanges += 1;
        found.drop_idle(ground)?;
    }
}

impl<'a> Found<'a> {
    /// What is left beyond everything found, but for one named cause.
    pub fn projection(&self, without: Option<usize>) -> Result<Projection, NoPose> {
        let projection = self.fitted.projection(without);
        if self.free.is_empty() {
            return Ok(projection);
        }
        let fit = &self.fitted.estimate;
        let regressors = Regressors::new(&fit.problem, &fit.fit.state)?;
        Ok(self.free.iter().fold(projection, |projection, free| projection.with(&free.columns(&regressors))))
    }

    fn add_one(&mut self, ground: &Ground<'a>, random: &mut ChaCha8Rng) -> Result<bool, NoPose> {
        let estimate = self.fitted.estimate.clone();
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let projection = self.projection(None)?;
        let mut all = suspects(&regressors)?;
        all.extend(searched(&regressors, &projection));
        let ranked = rank(&all, &projection);
        let sound =
            |ranked: &&Ranked<'_>| ranked.evidence < 0.0 && ranked.gain.explained > SMALLEST_PART * projection.cost;
        let named = ranked.iter().filter(sound).filter(|ranked| ranked.suspect.candidate().is_some());
        let best_named = named.map(|ranked| ranked.gain.explained).fold(0.0, f64::max);
        let worth: Vec<&Ranked<'_>> = ranked
            .iter()
            .filter(sound)
            .filter(|ranked| match &ranked.suspect.cause {
                Cause::Free(function) => ranked.gain.explained > CLEARLY_MORE * best_named.max(self.named_at(function)),
                Cause::Named(_) => true,
            })
            .take(TRIES)
            .collect();
        let mut refused: Vec<usize> = Vec::new();
        for _ in 0..worth.len() {
            let Some(first) = (0..worth.len()).find(|index| !refused.contains(index)) else { break };
            let contenders: Vec<usize> = (first..worth.len())
                .filter(|index| !refused.contains(index))
                .filter(|&index| worth[index].evidence < worth[first].evidence + DECIDES)
                .take(CONTENDERS)
                .collect();
            let chosen = self.best_of(ground, &worth, &contenders, &projection)?;
            let Some((chosen, terms)) = chosen else {
                refused.extend(contenders);
                continue;
            };
            let suspect = worth[chosen].suspect;
            if !self.holds(suspect, &projection, random) {
                refused.push(chosen);
                continue;
            }
            match (&suspect.cause, terms) {
                (Cause::Free(function), _) => self.free.push(function.clone()),
                (Cause::Named(_), Some(terms)) => self.fitted = ground.fit(&terms)?,
                (Cause::Named(_), None) => {}
            }
            return Ok(true);
        }
        Ok(false)
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
    ) -> Result<Option<Choice>, NoPose> {
        let mut best: Option<(f64, usize, Option<Vec<Candidate>>)> = None;
        for &index in contenders {
            let suspect = worth[index].suspect;
            let (evidence, terms) = match &suspect.cause {
                Cause::Free(_) => (worth[index].evidence, None),
                Cause::Named(candidate) => {
                    let terms = joined(&self.fitted.terms, candidate);
                    match self.full_evidence(ground, &terms, worth[index], projection) {
                        Some(evidence) => (evidence, Some(terms)),
                        None => continue,
                    }
                }
            };
            if evidence < 0.0 && best.as_ref().is_none_or(|(least, ..)| evidence < *least - EQUAL) {
                best = Some((evidence, index, terms));
            }
        }
        Ok(best.map(|(_, index, terms)| (index, terms)))
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
        let believable = terms.iter().zip(&spans).all(|(term, span)| {
            let values = span.clone().map(|index| fit.state.get(fit.unknowns[index].id).unwrap_or(0.0));
            let sigmas = span.clone().map(|index| fit.covariance_root.row(index).norm());
            let (values, sigmas) = (values.collect::<Vec<_>>().into(), sigmas.collect::<Vec<_>>().into());
            evidence::is_plausible(&term.instances, &values, &sigmas)
        });
        // With unnamed causes in the projection the full fit is another problem: the score step decides alone.
        if !self.free.is_empty() {
            return believable.then_some(ranked.evidence);
        }
        let mut gain = ranked.gain.clone();
        gain.explained = self.fitted.estimate.fit.cost - fit.cost;
        believable.then(|| ranked.suspect.evidence(&gain, projection))
    }

    /// Held-out records improve, and shuffled ones do not.
    fn holds(&self, suspect: &Suspect, projection: &Projection, random: &mut ChaCha8Rng) -> bool {
        let before = self.fitted.held_out_m2(&self.blocks, None, &[]);
        let after = self.fitted.held_out_m2(&self.blocks, None, &[&suspect.columns]);
        if fall_in_errors(&before, &after) < SURE_FALL {
            return false;
        }
        self.shuffled(suspect, projection, random) <= BY_CHANCE
    }

    /// Part of the shuffles of residuals over records that explain as much (Freedman and Lane 1983).
    fn shuffled(&self, suspect: &Suspect, projection: &Projection, random: &mut ChaCha8Rng) -> f64 {
        let problem = &self.fitted.estimate.problem;
        let firsts = problem.first_rows();
        let true_gain = projection.gain(&suspect.columns).explained;
        let mut order: Vec<usize> = (0..firsts.len()).collect();
        let mut as_good = 0;
        for _ in 0..SHUFFLES {
            order.shuffle(random);
            let mut shuffled = projection.residuals.clone();
            for (to, &from) in order.iter().enumerate() {
                let rows = problem.records[to].measured.numbers().min(problem.records[from].measured.numbers());
                for row in 0..rows {
                    shuffled[firsts[to] + row] = projection.residuals[firsts[from] + row];
                }
            }
            // Shuffled residuals are no longer orthogonal to what is free: projected again.
            let shuffled = projection.projected(&shuffled);
            if projection.gain_of(&suspect.columns, &shuffled).explained >= true_gain {
                as_good += 1;
            }
        }
        f64::from(as_good + 1) / (SHUFFLES + 1) as f64
    }

    /// Takes out every cause that the others have made idle.
    fn drop_idle(&mut self, ground: &Ground<'a>) -> Result<(), NoPose> {
        loop {
            let mut idlest: Option<(usize, f64)> = None;
            for term in 0..self.fitted.terms.len() {
                let evidence = self.evidence_of(term)?.0;
                if evidence >= 0.0 && idlest.is_none_or(|(_, most)| evidence > most) {
                    idlest = Some((term, evidence));
                }
            }
            let Some((term, _)) = idlest else { return self.drop_idle_free() };
            let mut terms = self.fitted.terms.clone();
            terms.remove(term);
            self.fitted = ground.fit(&terms)?;
        }
    }

    /// The same for unnamed causes: a name found later may have made them idle.
    fn drop_idle_free(&mut self) -> Result<(), NoPose> {
        if self.free.is_empty() {
            return Ok(());
        }
        let estimate = self.fitted.estimate.clone();
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let looked_at = evidence::looked_at(free_functions(&regressors).len() as f64);
        let mut index = 0;
        while index < self.free.len() {
            let others = self.free.iter().enumerate().filter(|(other, _)| *other != index);
            let projection = others.fold(self.fitted.projection(None), |projection, (_, free)| {
                projection.with(&free.columns(&regressors))
            });
            let gain = projection.gain(&self.free[index].columns(&regressors));
            let evidence = evidence::penalised(gain.explained, projection.cost, projection.rows, gain.rank, looked_at);
            if evidence >= 0.0 {
                self.free.remove(index);
            } else {
                index += 1;
            }
        }
        Ok(())
    }

    /// Evidence against a found cause given all others, and the projection without it.
    pub fn evidence_of(&self, term: usize) -> Result<(f64, Projection), NoPose> {
        let projection = self.projection(Some(term))?;
        let gain = projection.gain(&self.fitted.columns_of(term));
        let candidate = &self.fitted.terms[term];
        let evidence = evidence::of_candidate(candidate, &gain, projection.cost, projection.rows);
        Ok((evidence, projection))
    }

    /// Exchanges one cause for a suspect that explains more in its place.
    fn exchange_one(&mut self, ground: &Ground<'a>) -> Result<bool, NoPose> {
        let estimate = self.fitted.estimate.clone();
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let standing = suspects(&regressors)?;
        for term in 0..self.fitted.terms.len() {
            let (evidence, projection) = self.evidence_of(term)?;
            let mut all = standing.clone();
            all.extend(searched(&regressors, &projection));
            let ranked = rank(&all, &projection);
            let own = projection.gain(&self.fitted.columns_of(term)).explained;
            let better = ranked.iter().find(|ranked| match &ranked.suspect.cause {
                Cause::Named(candidate) => !candidate.same_as(&self.fitted.terms[term]),
                Cause::Free(_) => ranked.gain.explained > CLEARLY_MORE * own,
            });
            let Some(better) = better.filter(|better| better.evidence < evidence - DECIDES) else { continue };
            let mut terms = self.fitted.terms.clone();
            terms.remove(term);
            match &better.suspect.cause {
                Cause::Free(function) => self.free.push(function.clone()),
                Cause::Named(candidate) => {
                    let with = joined(&terms, candidate);
                    let (fit, _) = ground.fit_like(&self.fitted, &with)?;
                    if fit.cost > self.fitted.estimate.fit.cost {
                        continue;
                    }
                    terms = with;
                }
            }
            self.fitted = ground.fit(&terms)?;
            return Ok(true);
        }
        Ok(false)
    }
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
            candidate.instances.extend(term.instances.iter().copied());
        } else {
            all.push(term.clone());
        }
    }
    all.push(candidate);
    all
}

//! Which suspect is taken in next.

use rand_chacha::ChaCha8Rng;

use crate::model::effect::Place;

use super::candidate::Candidate;
use super::check::holds;
use super::evidence::{self, DECIDES, SMALLEST_PART};
use super::fitted::Ground;
use super::found::{CLEARLY_MORE, Found, joined};
use super::free::FreeFunction;
use super::projection::Projection;
use super::rank::{Cause, Ranked, Suspect, rank};

/// Suspects tried in one round before giving up.
const TRIES: usize = 6;
/// Suspects whose full nonlinear fits are compared.
const CONTENDERS: usize = 3;
/// Part of what a nameless function explains that a name of the same meaning must explain to be told instead.
const MOSTLY: f64 = 0.6;
/// Differences of evidence between full fits that count as none.
const EQUAL: f64 = 0.05;
/// No law is exact: what a further cause explains must be more than this part of what is explained already, seven per cent
/// of its amplitude, not to be the error of the laws that were named.
const LAW_ERROR: f64 = 0.005;

/// Says with which of some names a story begins that makes a nameless function needless: see [`super::story::names_tell_it`].
pub type NamesTell<'s> = dyn Fn(&Ranked<'_>, &[&Ranked<'_>]) -> Option<usize> + 's;

impl<'a> Found<'a> {
    /// The cause that holds best, with the part of the remaining squares that it explains.
    pub fn next(
        &self,
        ground: &Ground<'a>,
        all: &[&Suspect],
        projection: &Projection,
        (fresh, names_tell): (bool, &NamesTell<'_>),
        random: &mut ChaCha8Rng,
    ) -> Option<(Suspect, f64)> {
        let ranked = rank(all, projection);
        let least = self.least(projection);
        let freedom = projection.rows as f64 - projection.free as f64;
        let is_certain = |ranked: &Ranked<'_>| {
            let candidate = ranked.suspect.candidate();
            candidate.is_none_or(|one| evidence::is_certain(one, &ranked.gain, projection.cost, freedom))
        };
        let sound =
            |ranked: &&Ranked<'_>| ranked.evidence < -DECIDES && ranked.gain.explained > least && is_certain(ranked);
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
        let told = worth.first().copied().filter(in_question).and_then(|function| names_tell(function, &named));
        if let Some(name) = told.map(|first| named[first]) {
            if self.stands_up(name.suspect, projection, random) {
                return Some((name.suspect.clone(), name.gain.explained / projection.cost));
            }
            worth.retain(|ranked| !std::ptr::eq(*ranked, name));
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
            if self.stands_up(suspect, projection, random) {
                return Some((suspect.clone(), worth[chosen].gain.explained / projection.cost));
            }
            refused.push(chosen);
        }
        None
    }

    /// True for a suspect that held-out records and a shuffle bear out.
    fn stands_up(&self, suspect: &Suspect, projection: &Projection, random: &mut ChaCha8Rng) -> bool {
        holds(&self.fitted.estimate.problem, &self.blocks, suspect, projection, random)
    }

    /// Squares, whitened, that a further cause must explain to be one.
    pub fn least(&self, projection: &Projection) -> f64 {
        (SMALLEST_PART * projection.cost).max(LAW_ERROR * self.told_by_laws(projection))
    }

    /// Squares, whitened, that laws have explained so far: all but those of a frame that moved once, which has no law that
    /// could be nearly right.
    fn told_by_laws(&self, projection: &Projection) -> f64 {
        let all = self.bare_m2 / self.fitted.estimate.spread.sigma_m.powi(2) - projection.cost;
        let has_no_law = |candidate: &Candidate| candidate.effect().meta().place == Place::FrameMoment;
        let terms = self.fitted.terms.iter().enumerate().filter(|(_, candidate)| has_no_law(candidate));
        (all - terms.map(|(term, _)| self.fitted.worth_of(term).0).sum::<f64>()).max(0.0)
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
}

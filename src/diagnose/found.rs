//! What a search has found so far: the fit of its names, the functions without one, and what speaks for each.

use crate::identify::problem::NoPose;
use crate::model::effect::Location;

use super::candidate::Candidate;
use super::evidence;
use super::fitted::{Fitted, Ground};
use super::free::{FreeFunction, Seat, free_functions};
use super::hold_out::Blocks;
use super::projection::{Gain, Projection};
use super::regressors::Regressors;
use super::review::Review;

/// By how much a cause without a name must explain more than the best one with a name.
pub const CLEARLY_MORE: f64 = 1.15;

/// What a search has found.
#[derive(Clone)]
pub struct Found<'a> {
    /// The named causes with the fit.
    pub fitted: Fitted<'a>,
    /// Unnamed ones: linear only, in no model.
    pub free: Vec<FreeFunction>,
    /// True where none without a name are looked for.
    pub names_only: bool,
    /// Causes with which the arm would not stand.
    pub impossible: Vec<Candidate>,
    /// The blocks of held-out figures.
    pub blocks: Blocks,
    /// Sum of squares without any cause over the records searched, m^2.
    pub bare_m2: f64,
    /// What speaks for each named cause, and what could stand in its place.
    pub reviews: Vec<Review>,
}

impl<'a> Found<'a> {
    /// What is left beyond everything found, but for one named cause.
    pub fn projection(&self, regressors: &Regressors<'_, '_>, without: Option<usize>) -> Projection {
        let projection = self.fitted.projection(without);
        self.free.iter().fold(projection, |projection, free| projection.with_smooth(&free.columns(regressors)))
    }

    /// The causes by name and place, in no order: constants of places count by their whole numbers.
    pub fn names(&self) -> Vec<String> {
        let named = self.fitted.terms.iter().map(|term| {
            let place = Location {
                order: term.location().order.map(f64::round),
                at_s: term.location().at_s.map(f64::round),
                ..term.location().bare()
            };
            format!("{} {place:?}", term.id())
        });
        let free = self.free.iter().map(|function| format!("{:?} {:?}", function.seat, function.variables));
        let mut names: Vec<String> = named.chain(free).collect();
        names.sort_unstable();
        names
    }

    /// Part that must be left over by the named causes at a seat, as [`CLEARLY_MORE`] has it: a law that is right to
    /// within a few per cent is the right law.
    pub fn named_at(&self, function: &FreeFunction) -> f64 {
        let here = |term: &usize| match function.seat {
            Seat::Joint(joint) => self.fitted.terms[*term].location().joint_index() == Some(joint),
            Seat::Base | Seat::Tool => self.fitted.terms[*term].location().frame.is_some(),
            Seat::Tracker(_) => false,
        };
        let explained = (0..self.fitted.terms.len())
            .filter(here)
            .map(|term| self.fitted.projection(Some(term)).gain(&self.fitted.columns_of(term)).explained);
        (CLEARLY_MORE - 1.0) / CLEARLY_MORE * explained.sum::<f64>()
    }

    /// What a found cause explains given all others, from the fit itself.
    pub fn gain_of(&self, term: usize) -> Gain {
        let (explained, rank) = self.fitted.worth_of(term);
        let (values, sigmas) = self.fitted.values_of(term);
        Gain { explained, rank, values, sigmas }
    }

    /// Evidence against a found cause that explains so much.
    pub fn quick_evidence(&self, term: usize, gain: &Gain) -> f64 {
        let candidate = &self.fitted.terms[term];
        let doubt = evidence::doubt(&candidate.instances, &gain.values, &gain.sigmas).unwrap_or(f64::INFINITY);
        let fit = &self.fitted.estimate.fit;
        evidence::of_candidate(candidate, gain, fit.cost + gain.explained, fit.residuals.len()) + doubt
    }

    /// False for a found line that explains so much and might be one of the noise's own.
    pub fn is_certain(&self, term: usize, gain: &Gain) -> bool {
        let fit = &self.fitted.estimate.fit;
        let freedom = fit.residuals.len() as f64 - fit.unknowns.len() as f64;
        evidence::is_certain(&self.fitted.terms[term], gain, fit.cost + gain.explained, freedom)
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

    /// What the named causes leave, with what they cost, on the scale of [`evidence::penalised`] but for a constant.
    pub fn score(&self) -> f64 {
        let estimate = &self.fitted.estimate;
        let rows = estimate.fit.residuals.len() as f64;
        let left_m2 = estimate.fit.cost * estimate.spread.sigma_m.powi(2);
        rows * left_m2.max(f64::MIN_POSITIVE).ln() + self.price(rows)
    }

    /// What the named causes cost.
    fn price(&self, rows: f64) -> f64 {
        self.fitted.terms.iter().map(|term| evidence::price(term, rows)).sum()
    }

    /// Evidence for what another search has found in the same records in place of this: negative where that is better.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn against(&self, other: &Found<'a>, ground: &Ground<'a>) -> Result<f64, NoPose> {
        let (fit, _) = ground.fit_like(&self.fitted, &other.fitted.terms)?;
        let rows = fit.residuals.len() as f64;
        let names = rows * (fit.cost / self.fitted.estimate.fit.cost).ln() + other.price(rows) - self.price(rows);
        Ok(names + other.evidence_of_free()? - self.evidence_of_free()?)
    }

    /// Evidence, summed up, of what has no name, beyond the names.
    fn evidence_of_free(&self) -> Result<f64, NoPose> {
        let estimate = &self.fitted.estimate;
        let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
        let looked_at = evidence::looked_at(free_functions(&regressors).len() as f64);
        let mut projection = self.fitted.projection(None);
        let mut total = 0.0;
        for function in &self.free {
            let columns = function.columns(&regressors);
            total += projection.smooth_gain(&columns, looked_at).1;
            projection = projection.with_smooth(&columns);
        }
        Ok(total)
    }
}

/// The causes with a further one. A bent spring takes in the straight one that was found at its joint before.
pub fn joined(terms: &[Candidate], candidate: &Candidate) -> Vec<Candidate> {
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

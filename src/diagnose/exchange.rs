//! One cause of what was found exchanged for a suspect that explains clearly more in its place.

use crate::identify::problem::NoPose;

use super::evidence::DECIDES;
use super::fitted::Ground;
use super::found::{Found, joined};
use super::rank::Cause;
use super::walk::Walk;

impl<'a> Found<'a> {
    /// One cause exchanged for a suspect that explains more in its place, where that leads to causes that have not stood
    /// together before.
    pub fn exchanged(&self, ground: &Ground<'a>, walk: &Walk) -> Option<Self> {
        (0..self.fitted.terms.len()).find_map(|term| {
            // A cause with which the arm does not stand is none.
            let mut other = self.with_better(term, ground).ok().flatten()?;
            other.tune(ground).ok()?;
            other.drop_idle(ground).ok()?;
            (!walk.has_been_at(&other.names())).then_some(other)
        })
    }

    /// A cause exchanged for the suspect that explains clearly more in its place; `None` where none does.
    fn with_better(&self, term: usize, ground: &Ground<'a>) -> Result<Option<Self>, NoPose> {
        let review = &self.reviews[term];
        let better = review.better.clone().filter(|better| better.evidence < review.evidence - DECIDES);
        let Some(better) = better else { return Ok(None) };
        let mut other = self.clone();
        let mut terms = self.fitted.terms.clone();
        terms.remove(term);
        match better.cause {
            Cause::Free(function) => other.free.push(function),
            Cause::Named(candidate) => {
                terms = joined(&terms, &candidate);
                let (fit, _) = ground.fit_like(&self.fitted, &terms)?;
                if fit.cost > self.fitted.estimate.fit.cost {
                    return Ok(None);
                }
            }
        }
        other.fitted = ground.refit(&self.fitted, &terms, &[])?;
        Ok(Some(other))
    }
}

//! What later causes have made idle goes.

use crate::identify::problem::NoPose;

use super::evidence;
use super::fitted::Ground;
use super::found::{CLEARLY_MORE, Found};
use super::free::free_functions;
use super::regressors::Regressors;

impl<'a> Found<'a> {
    /// Takes out every cause that the others have made idle.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn drop_idle(&mut self, ground: &Ground<'a>) -> Result<(), NoPose> {
        loop {
            let estimate = self.fitted.estimate.clone();
            let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
            self.drop_idle_free(&regressors);
            let idle = |term: usize| {
                let gain = self.gain_of(term);
                let evidence = match self.free.is_empty() {
                    true => self.quick_evidence(term, &gain),
                    false => self.evidence_of(&regressors, term).0,
                };
                (evidence >= 0.0 || !self.is_certain(term, &gain)).then_some((term, evidence))
            };
            let idlest = (0..self.fitted.terms.len()).filter_map(idle).max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((term, _)) = idlest else { return Ok(()) };
            let mut terms = self.fitted.terms.clone();
            terms.remove(term);
            let Ok(fitted) = ground.refit(&self.fitted, &terms, &[]) else { return Ok(()) };
            self.fitted = fitted;
        }
    }

    /// The same for unnamed causes: a name found later may have made them idle.
    fn drop_idle_free(&mut self, regressors: &Regressors<'_, '_>) {
        let looked_at = evidence::looked_at(free_functions(regressors).len() as f64);
        let mut index = 0;
        while index < self.free.len() {
            let others = self.free.iter().enumerate().filter(|(other, _)| *other != index);
            let projection = others.fold(self.fitted.projection(None), |projection, (_, free)| {
                projection.with_smooth(&free.columns(regressors))
            });
            let (gain, evidence) = projection.smooth_gain(&self.free[index].columns(regressors), looked_at);
            let named = self.named_at(&self.free[index]);
            if evidence >= 0.0 || gain.explained <= CLEARLY_MORE * named {
                self.free.remove(index);
            } else {
                index += 1;
            }
        }
    }
}

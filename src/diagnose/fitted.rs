//! A hypothesis fitted: the model as given plus named causes, all refitted together.

use std::ops::Range;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::identify::estimate::{Estimate, estimate};
use crate::identify::linear::Factor;
use crate::identify::prior::unknown_of;
use crate::identify::problem::{NoPose, Problem};
use crate::identify::solve::{Fit, solve};
use crate::identify::state::State;
use crate::identify::unknown::{Prior, Unknown, UnknownId};
use crate::model::arm::EffectInstance;
use crate::model::parameters::ParameterId;

use super::candidate::Candidate;
use super::projection::Projection;
use super::regressors::{extend, side_by_side};
use super::ripple::{FreeNumbers, Ripple};

/// What does not change during a search.
#[derive(Clone, Debug)]
pub struct Ground<'a> {
    /// The records, gross errors left out.
    pub problem: Problem<'a>,
    /// True when they state their sigma.
    pub stated: bool,
    /// The refitted model as given.
    pub state: State,
    /// What is free in it.
    pub unknowns: Vec<Unknown>,
    /// The curves that its state holds, if any.
    pub ripple: Option<Arc<Ripple>>,
}

/// Named causes fitted together with everything that was free before.
#[derive(Clone, Debug)]
pub struct Fitted<'a> {
    /// The fit.
    pub estimate: Estimate<'a>,
    /// The named causes.
    pub terms: Vec<Candidate>,
    /// Columns of each in the fit's unknowns.
    pub spans: Vec<Range<usize>>,
    /// The curves that its state holds, if any.
    pub ripple: Option<Arc<Ripple>>,
}

impl<'a> Ground<'a> {
    /// Fits these causes, the noise level with them.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn fit(&self, terms: &[Candidate]) -> Result<Fitted<'a>, NoPose> {
        let (state, unknowns, spans) = self.with(terms);
        let estimate = estimate(self.problem.clone(), state, &unknowns, self.stated)?;
        Ok(Fitted { estimate, terms: terms.to_vec(), spans, ripple: self.ripple.clone() })
    }

    /// Fits these causes, the noise level with them, from where another fit stands.
    ///
    /// # Arguments
    /// * `fresh` - whitened columns of the causes that are new, which then stand at the end of `terms`: the fit starts from
    ///   the solution of the linear problem. Empty: it starts with the new ones at zero.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn refit(&self, from: &Fitted<'a>, terms: &[Candidate], fresh: &[DMatrix<f64>]) -> Result<Fitted<'a>, NoPose> {
        let (mut state, unknowns, spans) = self.with(terms);
        take_over(&mut state, from, terms, &spans, &unknowns);
        let nearer = linear_start(&state, from, &unknowns, fresh);
        if nearer.as_ref().is_some_and(|nearer| self.problem.residuals(nearer).is_ok()) {
            state = nearer.unwrap_or(state);
        }
        // Stated sigmas are lower bounds, so those stay what they are; a level that is found starts where it was found.
        let problem = if self.stated { self.problem.clone() } else { self.problem_like(from) };
        let mut estimate = estimate(problem, state, &unknowns, self.stated)?;
        if !self.stated {
            estimate.scale *= from.estimate.scale;
        }
        Ok(Fitted { estimate, terms: terms.to_vec(), spans, ripple: self.ripple.clone() })
    }

    /// The records with the noise level that another fit has found.
    fn problem_like(&self, fitted: &Fitted<'_>) -> Problem<'a> {
        let mut problem = self.problem.clone();
        for record in &mut problem.records {
            record.sigma_m *= fitted.estimate.scale;
            record.sigma_rad = fitted.estimate.spread.sigma_rad.unwrap_or(record.sigma_rad);
        }
        problem
    }

    /// Every so many of the records, no more than `most`; `None` when there are no more anyway.
    #[must_use]
    pub fn thinned(&self, most: usize) -> Option<Self> {
        let records = self.problem.records.len();
        let stride = records.div_ceil(most.max(1));
        let kept: Vec<usize> = (0..records).step_by(stride.max(1)).collect();
        (stride > 1).then(|| Self { problem: self.problem.subset(&kept), ..self.clone() })
    }

    /// Fits these causes with the sigmas of another fit, from where that stands, to compare the two.
    ///
    /// # Errors
    /// [`NoPose`] as above.
    pub fn fit_like(&self, like: &Fitted<'a>, terms: &[Candidate]) -> Result<(Fit, Vec<Range<usize>>), NoPose> {
        let (mut state, unknowns, spans) = self.with(terms);
        take_over(&mut state, like, terms, &spans, &unknowns);
        Ok((solve(&like.estimate.problem, state, &unknowns, &[])?, spans))
    }

    fn with(&self, terms: &[Candidate]) -> (State, Vec<Unknown>, Vec<Range<usize>>) {
        let mut state = self.state.clone();
        let mut unknowns = self.unknowns.clone();
        let mut spans = Vec::new();
        let torque = self.problem.largest_torque_nm(&state);
        for term in terms {
            let ids = extend(&mut state.model, &term.instances);
            spans.push(unknowns.len()..unknowns.len() + ids.len());
            unknowns.extend(ids.into_iter().map(|id| {
                let usual = unknown_of(id, &state.model, &torque);
                Unknown { id: UnknownId::Model(id), prior: wide(usual.prior, id, &state) }
            }));
        }
        (state, unknowns, spans)
    }
}

/// Starts a fit where another one ended: everything that is free in both, and the causes that both have.
fn take_over(state: &mut State, from: &Fitted<'_>, terms: &[Candidate], spans: &[Range<usize>], unknowns: &[Unknown]) {
    let fit = &from.estimate.fit;
    let mut copy = |to: UnknownId, value: Option<f64>| {
        if let (Some(value), Some(now)) = (value, state.get(to)) {
            state.add(to, value - now);
        }
    };
    let common = spans.first().map_or(unknowns.len(), |span| span.start);
    for unknown in &unknowns[..common] {
        copy(unknown.id, fit.state.get(unknown.id));
    }
    for (term, span) in terms.iter().zip(spans) {
        let before = from.terms.iter().zip(&from.spans).find(|(known, _)| known.same_as(term));
        let Some((_, old)) = before.filter(|(_, old)| old.len() == span.len()) else { continue };
        for (to, index) in span.clone().zip(old.clone()) {
            copy(unknowns[to].id, fit.state.get(fit.unknowns[index].id));
        }
    }
}

/// Where the linear problem has its solution, when `fresh` are the columns of all unknowns that `from` did not have.
fn linear_start(state: &State, from: &Fitted<'_>, unknowns: &[Unknown], fresh: &[DMatrix<f64>]) -> Option<State> {
    let known = &from.estimate.fit.whitened_jacobian;
    let fresh = side_by_side(fresh, known.nrows());
    if fresh.ncols() == 0 || known.ncols() + fresh.ncols() != unknowns.len() {
        return None;
    }
    let (rows, columns) = (known.nrows(), unknowns.len());
    let mut stacked = DMatrix::zeros(rows + columns, columns);
    stacked.view_mut((0, 0), known.shape()).copy_from(known);
    stacked.view_mut((0, known.ncols()), fresh.shape()).copy_from(&fresh);
    let mut right = DVector::zeros(rows + columns);
    right.rows_mut(0, rows).copy_from(&-from.residuals());
    for (index, Unknown { id, prior }) in unknowns.iter().enumerate() {
        stacked[(rows + index, index)] = 1.0 / prior.sigma;
        right[rows + index] = (prior.mean - state.get(*id).unwrap_or(0.0)) / prior.sigma;
    }
    let step = Factor::new(stacked, &right).solve(0.0);
    let mut nearer = state.clone();
    for (unknown, change) in unknowns.iter().zip(step.iter()) {
        nearer.add(unknown.id, *change);
    }
    Some(nearer)
}

/// A diagnosis must not hold a missing cause to its usual size: half of all that is believable.
fn wide(usual: Prior, id: ParameterId, state: &State) -> Prior {
    let ParameterId::Effect(effect, parameter) = id else { return usual };
    let instance: Option<&EffectInstance> = state.model.effects.get(effect);
    let believable = instance.and_then(|instance| instance.effect.meta().parameters.get(parameter));
    let half = believable.map_or(0.0, |meta| 0.5 * meta.plausible.0.abs().max(meta.plausible.1.abs()));
    Prior { sigma: usual.sigma.max(half), ..usual }
}

impl<'a> Fitted<'a> {
    /// A fit without any cause.
    pub fn bare(estimate: Estimate<'a>) -> Self {
        Self { estimate, terms: Vec::new(), spans: Vec::new(), ripple: None }
    }
}

impl Fitted<'_> {
    /// Whitened residuals.
    pub fn residuals(&self) -> DVector<f64> {
        self.estimate.fit.residuals.component_mul(&self.estimate.problem.whitening())
    }

    /// The fit's columns without those of some terms, and the residuals that taking them out leaves (to first order).
    fn without(&self, terms: &[usize]) -> (FreeNumbers, DVector<f64>) {
        let fit = &self.estimate.fit;
        let spans = || terms.iter().filter_map(|term| self.spans.get(*term).cloned());
        let kept: Vec<usize> =
            (0..fit.unknowns.len()).filter(|index| !spans().any(|span| span.contains(index))).collect();
        let mut residuals = self.residuals();
        for index in spans().flatten() {
            let value = fit.state.get(fit.unknowns[index].id).unwrap_or(0.0);
            residuals.axpy(-value, &fit.whitened_jacobian.column(index), 1.0);
        }
        let sigmas = kept.iter().map(|&index| fit.unknowns[index].prior.sigma).collect();
        let deviations = kept
            .iter()
            .map(|&index| {
                let unknown = &fit.unknowns[index];
                (fit.state.get(unknown.id).unwrap_or(0.0) - unknown.prior.mean) / unknown.prior.sigma
            })
            .collect();
        (FreeNumbers { columns: fit.whitened_jacobian.select_columns(&kept), sigmas, deviations }, residuals)
    }

    /// What is left when everything free is projected out: all, or all but a term.
    pub fn projection(&self, without: Option<usize>) -> Projection {
        self.projection_without(without.as_slice())
    }

    /// What is left when everything free but some terms is projected out.
    pub fn projection_without(&self, terms: &[usize]) -> Projection {
        let (free, residuals) = self.free_without(terms);
        Projection::new(&free.columns, &free.sigmas, &residuals, &free.deviations)
    }

    /// Everything that is free but some terms, with the whitened residuals that taking those out leaves.
    pub fn free_without(&self, terms: &[usize]) -> (FreeNumbers, DVector<f64>) {
        let (mut free, residuals) = self.without(terms);
        if let Some(ripple) = &self.ripple {
            ripple.add_to(&mut free, &self.estimate.problem.whitening(), None);
        }
        (free, residuals)
    }

    /// The same with the curve of one joint taken out, which moved the coordinates by `said_m`.
    pub fn projection_without_ripple_of(&self, joint: usize, said_m: &DVector<f64>) -> Projection {
        let whitening = self.estimate.problem.whitening();
        let (mut free, residuals) = self.without(&[]);
        if let Some(ripple) = &self.ripple {
            ripple.add_to(&mut free, &whitening, Some(joint));
        }
        let residuals = residuals - said_m.component_mul(&whitening);
        Projection::new(&free.columns, &free.sigmas, &residuals, &free.deviations)
    }

    /// The columns of a term.
    pub fn columns_of(&self, term: usize) -> DMatrix<f64> {
        let span = self.spans[term].clone();
        self.estimate.fit.whitened_jacobian.columns(span.start, span.len()).into_owned()
    }

    /// The fitted numbers of a term with their standard uncertainties.
    pub fn values_of(&self, term: usize) -> (DVector<f64>, DVector<f64>) {
        let fit = &self.estimate.fit;
        let span = self.spans[term].clone();
        let values = span.clone().map(|index| fit.state.get(fit.unknowns[index].id).unwrap_or(0.0));
        let sigmas = span.clone().map(|index| fit.covariance_root.row(index).norm());
        (DVector::from_iterator(span.len(), values), DVector::from_iterator(span.len(), sigmas))
    }

    /// What taking a term out would add to the cost, to first order: `x' C^-1 x` with its numbers x and their covariance C
    /// (Wald 1943; exact for a linear problem), and how many of its numbers the fit determines.
    pub fn worth_of(&self, term: usize) -> (f64, usize) {
        let root = self.estimate.fit.covariance_root.rows(self.spans[term].start, self.spans[term].len()).into_owned();
        let sizes: Vec<f64> = root.row_iter().map(|row| row.norm().max(f64::MIN_POSITIVE)).collect();
        let (values, _) = self.values_of(term);
        let correlation = &root * root.transpose();
        let correlation =
            DMatrix::from_fn(sizes.len(), sizes.len(), |i, j| correlation[(i, j)] / (sizes[i] * sizes[j]));
        let scaled = DVector::from_iterator(sizes.len(), values.iter().zip(&sizes).map(|(value, size)| value / size));
        let eigen = nalgebra::SymmetricEigen::new(correlation);
        let parts = eigen.eigenvectors.tr_mul(&scaled);
        let kept: Vec<usize> = (0..sizes.len()).filter(|&k| eigen.eigenvalues[k] > ROUNDING).collect();
        (kept.iter().map(|&k| parts[k] * parts[k] / eigen.eigenvalues[k]).sum(), kept.len())
    }
}

/// Eigenvalues of a correlation below this are rounding.
const ROUNDING: f64 = 1e-12;

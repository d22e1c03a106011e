//! Joints whose error repeats in so many lines that a list of them is no description of it: one curve of the joint's own
//! angle each. An encoder's or a gear's error has as many lines as its parts have marks, teeth and flaws; a search finds the
//! strongest of them one by one and leaves the rest, which together may be more.
//!
//! The curves are a Gaussian process by bands of frequency, as the learner has it ([`crate::learn::term`]), of the joint's own
//! angle alone: whatever it is made of, it turns that joint, repeats with it, and knows neither load nor approach. That is
//! what `joint_periodic` means.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;
use crate::identify::unknown::Unknown;
use crate::learn::additive::{Fitted as Regressed, Regression};
use crate::learn::calibration::{beside_learner, calibrate_uncertainty};
use crate::learn::learned::error_of_terms_m2;
use crate::learn::samples::Samples;
use crate::learn::term::{Term, own_angles};

use super::evidence;
use super::fitted::{Fitted, Ground};
use super::projection::Projection;
use super::spectrum::{Spectrum, spectrum};

/// Times that a curve's strongest line must repeat over the measured range to be called periodic ...
const FEWEST_REPEATS: f64 = 3.0;
/// ... and part of its squares that may be in one eighth of the range.
const MOST_IN_ONE_PLACE: f64 = 0.5;
/// A wave that cannot move all records together by this many standard deviations is left out of projections.
const NO_MOVEMENT: f64 = 0.3;
/// Parts in which the rows of a regression are summed up side by side.
const PARTS: usize = 10;

/// The curves of a fit, free beside everything else in its projections.
#[derive(Clone, Debug)]
pub struct Ripple {
    /// One for each joint that has a curve.
    pub joints: Vec<JointRipple>,
}

/// The curve of one joint, as a sum of waves.
#[derive(Clone, Debug)]
pub struct JointRipple {
    /// The joint, from zero.
    pub joint: usize,
    /// Root mean square of the curve over the records, rad, with its standard uncertainty.
    pub rms_rad: [f64; 2],
    /// Its strongest line, and whether it is everywhere.
    pub spectrum: Spectrum,
    /// Movement of each coordinate by a unit of each wave, m/rad.
    columns_m: DMatrix<f64>,
    /// Prior of each wave's weight, rad.
    sigmas: Vec<f64>,
    /// The weights, rad.
    weights: DVector<f64>,
}

/// What a fit has free: whitened columns, prior standard deviations, and how far each number is from its prior's mean in them.
pub struct FreeNumbers {
    /// Whitened columns.
    pub columns: DMatrix<f64>,
    /// Standard deviations of the priors.
    pub sigmas: Vec<f64>,
    /// Deviations from the priors' means, in those.
    pub deviations: Vec<f64>,
}

impl Ripple {
    /// Adds the waves of every joint but one to what is free.
    pub fn add_to(&self, free: &mut FreeNumbers, whitening: &DVector<f64>, without: Option<usize>) {
        for one in self.joints.iter().filter(|one| Some(one.joint) != without) {
            let columns = one.whitened(whitening);
            let telling =
                (0..columns.ncols()).filter(|&wave| columns.column(wave).norm() * one.sigmas[wave] > NO_MOVEMENT);
            let telling: Vec<usize> = telling.collect();
            let first = free.columns.ncols();
            free.columns.resize_horizontally_mut(first + telling.len(), 0.0);
            for (place, &wave) in telling.iter().enumerate() {
                free.columns.set_column(first + place, &columns.column(wave));
                free.sigmas.push(one.sigmas[wave]);
                free.deviations.push(one.weights[wave] / one.sigmas[wave]);
            }
        }
    }
}

impl JointRipple {
    /// True where the curve is seen to repeat and is not at one place, as a damaged tooth is.
    pub fn is_periodic(&self) -> bool {
        self.spectrum.repeats >= FEWEST_REPEATS && self.spectrum.in_one_place < MOST_IN_ONE_PLACE
    }

    fn whitened(&self, whitening: &DVector<f64>) -> DMatrix<f64> {
        let mut columns = self.columns_m.clone();
        for mut column in columns.column_iter_mut() {
            column.component_mul_assign(whitening);
        }
        columns
    }

    /// What the curve explains beside everything else, and the evidence against it.
    pub fn gain(&self, fitted: &Fitted<'_>) -> (f64, f64, Projection) {
        let whitening = fitted.estimate.problem.whitening();
        let projection = fitted.projection_without_ripple_of(self.joint, &(self.columns_m.clone() * &self.weights));
        let mut columns = self.whitened(&whitening);
        for (mut column, sigma) in columns.column_iter_mut().zip(&self.sigmas) {
            column *= *sigma;
        }
        let looked_at = evidence::looked_at(crate::model::robot::DOF as f64);
        let (gain, evidence) = projection.smooth_gain(&columns, looked_at);
        (gain.explained, evidence, projection)
    }
}

/// A ground whose state holds curves of these joints.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn curved<'a>(ground: &Ground<'a>, joints: &[usize]) -> Result<Option<Ground<'a>>, NoPose> {
    let learned = learned(&ground.problem, &ground.state, &ground.unknowns, joints)?;
    Ok(learned.map(|Learned { state, ripple, .. }| Ground { state, ripple: Some(Arc::new(ripple)), ..ground.clone() }))
}

/// A fit with its curves learned beside its causes.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn relearned<'a>(fitted: &Fitted<'a>, joints: &[usize]) -> Result<Option<Fitted<'a>>, NoPose> {
    let before = &fitted.estimate;
    let Some(learned) = learned(&before.problem, &before.fit.state, &before.fit.unknowns, joints)? else {
        return Ok(None);
    };
    let noise = (learned.noise_scale, learned.freedom);
    let estimate = beside_learner(before.problem.clone(), learned.state, before, noise)?;
    Ok(Some(Fitted { estimate, ripple: Some(Arc::new(learned.ripple)), ..fitted.clone() }))
}

/// Curves with the state that holds them.
struct Learned {
    state: State,
    ripple: Ripple,
    /// Factor on the records' sigmas that gives the noise which the curves leave.
    noise_scale: f64,
    /// Degrees of freedom behind that.
    freedom: f64,
}

/// Learns curves of these joints beside all that is free; `None` where there is nothing to learn.
fn learned(
    problem: &Problem<'_>,
    state: &State,
    unknowns: &[Unknown],
    joints: &[usize],
) -> Result<Option<Learned>, NoPose> {
    let mut plain = state.clone();
    plain.model.learner = None;
    let samples = Samples::new(problem, &plain, unknowns)?;
    let mut terms = own_angles(&samples);
    terms.retain(|term| joints.contains(&term.turns));
    if terms.is_empty() {
        return Ok(None);
    }
    let parts: Vec<usize> = (0..samples.count()).map(|record| record % PARTS).collect();
    let regression = Regression::new(&samples, &plain, unknowns, terms, &parts);
    let Some(fitted) = regression.fit() else { return Ok(None) };
    let Some(curves) = regression.curves(&fitted) else { return Ok(None) };
    let mut moved = plain.clone();
    regression.move_geometry(&fitted, unknowns, &mut moved);
    moved.model.learner = Some(curves.into());
    let sigmas_m: Vec<f64> = problem.records.iter().map(|record| record.sigma_m).collect();
    calibrate_uncertainty(problem, &mut moved, error_of_terms_m2(&regression, &fitted, &sigmas_m))?;
    Ok(Some(Learned {
        state: moved,
        ripple: ripple(&regression, &fitted, &problem.whitening()),
        noise_scale: fitted.variances.noise.sqrt(),
        freedom: (samples.missing.len() as f64 - fitted.posterior.determined).max(1.0),
    }))
}

fn ripple(regression: &Regression<'_>, fitted: &Regressed, whitening: &DVector<f64>) -> Ripple {
    let everything: Vec<usize> = (0..regression.samples.count()).collect();
    let (design, _) = regression.rows(&everything);
    let sigmas = regression.prior_sigmas(fitted);
    let mut first = regression.geometry;
    let of_term = |term: &Term| {
        let span = first..first + term.columns;
        first = span.end;
        let mut columns_m = design.columns(span.start, term.columns).into_owned();
        for mut column in columns_m.column_iter_mut() {
            column.component_div_assign(whitening);
        }
        let weights = fitted.posterior.mean.rows(span.start, term.columns).into_owned();
        let root = fitted.posterior.root.columns(span.start, term.columns).into_owned();
        let at: Vec<f64> = everything.iter().map(|&record| term.input(regression.samples, record).0).collect();
        JointRipple {
            joint: term.turns,
            rms_rad: size_over_records(term, &at, &weights, &root),
            spectrum: spectrum(term, &at, &weights, &root),
            columns_m,
            sigmas: sigmas[span].to_vec(),
            weights,
        }
    };
    Ripple { joints: regression.terms.iter().map(of_term).collect() }
}

/// Root mean square of a sum of waves at these angles, its mean taken off, with its standard uncertainty (to first order).
fn size_over_records(term: &Term, at: &[f64], weights: &DVector<f64>, root: &DMatrix<f64>) -> [f64; 2] {
    let mut waves = DMatrix::zeros(at.len(), term.columns);
    let mut row = vec![0.0; term.columns];
    for (index, &x) in at.iter().enumerate() {
        term.waves_at(x, &mut row);
        waves.row_mut(index).copy_from_slice(&row);
    }
    for mut column in waves.column_iter_mut() {
        let mean = column.mean();
        column.add_scalar_mut(-mean);
    }
    let values = &waves * weights;
    let count = at.len().max(1) as f64;
    let rms = (values.norm_squared() / count).sqrt();
    let gradient = waves.tr_mul(&values) / (count * rms.max(f64::MIN_POSITIVE));
    [rms, (root * gradient).norm()]
}

//! The learner of joint errors: geometry and functions of one variable each, in one Bayesian regression.
//!
//! Geometry is free along with the functions, under the prior that identification had: a function that looks like a
//! zero offset or a length must not fight the offset that absorbed it.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::state::State;
use crate::identify::unknown::Unknown;
use crate::model::curves::{Curve, JointCurves};

use super::evidence::{Groups, Moments, Posterior, Variances, maximise, posterior};
use super::samples::Samples;
use super::term::Term;

/// Steps towards the best variances from all records ...
const STEPS: u64 = 60;
/// ... and from there towards those of a fold, whose records are mostly the same.
const STEPS_OF_FOLD: u64 = 15;

/// Leverage beyond which a row is its own only witness.
const MOST_LEVERAGE: f64 = 0.95;

/// A regression of the residuals on geometry and terms, its rows summed up by fold.
#[derive(Clone, Debug)]
pub struct Regression {
    /// The terms; their sines follow the columns of geometry.
    pub terms: Vec<Term>,
    /// Number of columns of geometry.
    pub geometry: usize,
    /// Prior mean of the geometry, in units of its prior.
    prior_mean: DVector<f64>,
    groups: Groups,
    design: DMatrix<f64>,
    missing: DVector<f64>,
    /// Rows of each record.
    rows: Vec<usize>,
    fold_of: Vec<usize>,
    folds: Vec<Moments>,
}

/// What a regression found.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The variances.
    pub variances: Variances,
    /// The weights.
    pub posterior: Posterior,
}

impl Regression {
    /// Sets the regression up.
    ///
    /// # Arguments
    /// * `unknowns` - those of [`Samples::new`]; with `state` they say where the prior's mean lies
    /// * `fold_of` - fold of each record
    pub fn new(
        samples: &Samples<'_>,
        state: &State,
        unknowns: &[Unknown],
        terms: Vec<Term>,
        fold_of: &[usize],
    ) -> Self {
        let geometry = samples.geometry.ncols();
        let columns = geometry + terms.iter().map(|term| term.sines).sum::<usize>();
        let mut design = DMatrix::zeros(samples.missing.len(), columns);
        design.columns_mut(0, geometry).copy_from(&samples.geometry);
        let mut of = vec![None; geometry];
        let mut first = geometry;
        let (mut count, mut neighbours) = (0, Vec::new());
        for term in &terms {
            fill(&mut design, first, term, samples);
            of.extend((0..term.sines).map(|sine| Some(count + term.band_of(sine))));
            first += term.sines;
            neighbours.extend((1..term.bands.len()).map(|band| (count + band - 1, count + band)));
            count += term.bands.len();
        }
        let prior_mean = DVector::from_iterator(
            geometry,
            unknowns.iter().map(|unknown| {
                (unknown.prior.mean - state.get(unknown.id).unwrap_or(unknown.prior.mean)) / unknown.prior.sigma
            }),
        );
        let missing = &samples.missing - &samples.geometry * &prior_mean;
        let fold_count = fold_of.iter().max().map_or(0, |largest| largest + 1);
        let folds = (0..fold_count)
            .into_par_iter()
            .map(|fold| {
                let rows: Vec<usize> = (0..samples.count())
                    .filter(|&record| fold_of[record] == fold)
                    .flat_map(|record| samples.rows_of(record))
                    .collect();
                Moments::of(&design.select_rows(&rows), &missing.select_rows(&rows))
            })
            .collect();
        Self {
            terms,
            geometry,
            prior_mean,
            groups: Groups { of, count, neighbours },
            design,
            missing,
            rows: samples.rows.clone(),
            fold_of: fold_of.to_vec(),
            folds,
        }
    }

    fn moments_without(&self, fold: Option<usize>) -> Moments {
        let mut total = Moments::none(self.design.ncols());
        for (index, moments) in self.folds.iter().enumerate() {
            if Some(index) != fold {
                total.add(moments, 1.0);
            }
        }
        total
    }

    /// Variances and weights from all records. `None` where numbers are not finite.
    pub fn fit(&self) -> Option<Fitted> {
        let moments = self.moments_without(None);
        self.fit_from(&moments, &self.start(&moments), STEPS)
    }

    fn fit_from(&self, moments: &Moments, start: &Variances, steps: u64) -> Option<Fitted> {
        let variances = maximise(moments, &self.groups, start, steps);
        let posterior = posterior(moments, &self.groups, &variances)?;
        Some(Fitted { variances, posterior })
    }

    /// Every group explains a tenth of what geometry leaves, the rest is noise.
    fn start(&self, moments: &Moments) -> Variances {
        let free = self.geometry.min(moments.gram.ncols());
        let bare = Moments {
            gram: moments.gram.view((0, 0), (free, free)).into_owned(),
            right: moments.right.rows(0, free).into_owned(),
            ..moments.clone()
        };
        let groups = Groups { of: vec![None; free], count: 0, neighbours: vec![] };
        let unit = Variances { groups: vec![], noise: 1.0 };
        let explained = posterior(&bare, &groups, &unit).map_or(0.0, |found| bare.right.dot(&found.mean));
        let left = ((moments.square - explained) / moments.rows).max(1e-12 * moments.square / moments.rows);
        let mut size = vec![0.0; self.groups.count];
        for (column, group) in self.groups.of.iter().enumerate() {
            if let Some(group) = group {
                size[*group] += moments.gram[(column, column)] / moments.rows;
            }
        }
        let share = 0.1 * left;
        Variances { groups: size.iter().map(|&size| share / size.max(f64::MIN_POSITIVE)).collect(), noise: 0.5 * left }
    }

    /// Whitened residuals of every record, each from a regression that did not see its fold. `start`: the variances from
    /// all records, from where each fold looks for its own.
    pub fn held_out(&self, start: &Variances) -> Option<Vec<DVector<f64>>> {
        let parts: Option<Vec<_>> = (0..self.folds.len())
            .into_par_iter()
            .map(|fold| {
                let fitted = self.fit_from(&self.moments_without(Some(fold)), start, STEPS_OF_FOLD)?;
                Some(self.left_of_fold(fold, &fitted.posterior.mean))
            })
            .collect();
        let mut all = vec![DVector::zeros(0); self.fold_of.len()];
        for (record, left) in parts?.into_iter().flatten() {
            all[record] = left;
        }
        Some(all)
    }

    /// What the weights leave of every record of a fold.
    fn left_of_fold(&self, fold: usize, mean: &DVector<f64>) -> Vec<(usize, DVector<f64>)> {
        (0..self.fold_of.len())
            .filter(|&record| self.fold_of[record] == fold)
            .map(|record| {
                let (first, count) = (self.rows[record], self.rows[record + 1] - self.rows[record]);
                (record, self.missing.rows(first, count) - self.design.rows(first, count) * mean)
            })
            .collect()
    }

    /// Variance of what a regression without a row would predict for it, whitened: `v / (1 - v/noise)` with `v` that of
    /// the regression with it.
    pub fn predicted_variance(&self, fitted: &Fitted) -> DVector<f64> {
        let spread = &self.design * fitted.posterior.root.transpose();
        let noise = fitted.variances.noise;
        let rows = spread.row_iter().map(|row| {
            let variance = row.norm_squared();
            variance / (1.0 - (variance / noise).min(MOST_LEVERAGE))
        });
        DVector::from_iterator(self.design.nrows(), rows)
    }

    /// Moves the geometry of `state` to where the regression has it.
    pub fn move_geometry(&self, fitted: &Fitted, unknowns: &[Unknown], state: &mut State) {
        for (index, unknown) in unknowns.iter().enumerate() {
            let change = self.prior_mean[index] + fitted.posterior.mean[index];
            state.add(unknown.id, change * unknown.prior.sigma);
        }
    }

    /// The terms as curves, with the uncertainty that they have beside a given geometry. `None` where numbers are not
    /// finite.
    pub fn curves(&self, fitted: &Fitted) -> Option<JointCurves> {
        let learned = self.design.ncols() - self.geometry;
        let moments = self.moments_without(None);
        let beside = Moments {
            gram: moments.gram.view((self.geometry, self.geometry), (learned, learned)).into_owned(),
            right: moments.right.rows(self.geometry, learned).into_owned(),
            ..moments
        };
        let groups = Groups { of: self.groups.of[self.geometry..].to_vec(), ..self.groups.clone() };
        let root = posterior(&beside, &groups, &fitted.variances)?.root;
        let mut first = 0;
        let curves = self
            .terms
            .iter()
            .map(|term| {
                let weights = fitted.posterior.mean.rows(self.geometry + first, term.sines).into_owned();
                let root = root.columns(first, term.sines).into_owned();
                first += term.sines;
                curve(term, &weights, &root)
            })
            .collect();
        Some(JointCurves { curves })
    }
}

fn fill(design: &mut DMatrix<f64>, first: usize, term: &Term, samples: &Samples<'_>) {
    let mut sines = vec![0.0; term.sines];
    for record in 0..samples.count() {
        let (x, sense) = term.input(samples, record);
        if sense == 0.0 {
            continue;
        }
        term.sines_at(x, &mut sines);
        for row in samples.rows_of(record) {
            let lever = samples.levers[(row, term.turns)] * sense;
            for (sine, &value) in sines.iter().enumerate() {
                design[(row, first + sine)] = lever * value;
            }
        }
    }
}

/// Samples of the uncertainty along a curve.
const SIGMA_POINTS: usize = 25;

/// A sum of sines as a spline. Sampled sines are cubic splines up to a factor, `3 / (2 + cos(w h))`, so that the spline
/// goes through the function at every knot (Unser 1999).
fn curve(term: &Term, weights: &DVector<f64>, root: &DMatrix<f64>) -> Curve {
    // About six knots a wave of the finest sine.
    let cells = (term.frequency(term.sines - 1) * term.length).ceil().max(4.0) as usize;
    let step = term.length / cells as f64;
    let mut sines = vec![0.0; term.sines];
    let coefficients_rad = (0..=cells)
        .map(|knot| {
            term.sines_at(term.start + step * knot as f64, &mut sines);
            let sum: f64 = (0..term.sines)
                .map(|sine| weights[sine] * sines[sine] * 3.0 / (2.0 + (term.frequency(sine) * step).cos()))
                .sum();
            rounded(sum)
        })
        .collect();
    let sigma_rad = (0..SIGMA_POINTS)
        .map(|point| {
            term.sines_at(term.start + term.length * point as f64 / (SIGMA_POINTS - 1) as f64, &mut sines);
            rounded((root * DVector::from_column_slice(&sines)).norm())
        })
        .collect();
    Curve {
        turns: term.turns + 1,
        along: term.along,
        sense_of: term.sense_of.map(|joint| joint + 1),
        start: term.start,
        step,
        coefficients_rad,
        sigma_rad,
    }
}

/// To a hundredth of a nanoradian: files stay short.
fn rounded(angle_rad: f64) -> f64 {
    (angle_rad * 1e11).round() / 1e11
}

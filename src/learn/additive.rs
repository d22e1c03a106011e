//! The learner of joint errors: geometry and functions of one variable each, in one Bayesian regression.
//!
//! Geometry is free along with the functions, under the prior that identification had: a function that looks like a
//! zero offset or a length must not fight the offset that absorbed it. Rows are made when they are asked for: a week of
//! measuring has more of them than belong in memory.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::state::State;
use crate::identify::unknown::Unknown;
use crate::model::curves::JointCurves;

use super::drawing::{Evidenced, curve};
use super::evidence::{Groups, Moments, Posterior, Variances, maximise, posterior};
use super::samples::Samples;
use super::term::Term;

/// Steps towards the best variances from all records ...
const STEPS: u64 = 60;
/// ... and from there towards those of a fold, whose records are mostly the same.
const STEPS_OF_FOLD: u64 = 10;

/// Leverage beyond which a row is its own only witness.
const MOST_LEVERAGE: f64 = 0.95;

/// Records whose rows are made at a time.
const CHUNK: usize = 256;

/// A regression of the residuals on geometry and terms, its rows summed up by fold.
#[derive(Clone, Debug)]
pub struct Regression<'a> {
    /// The terms; their waves follow the columns of geometry.
    pub terms: Vec<Term>,
    /// Number of columns of geometry.
    pub geometry: usize,
    /// Prior mean of the geometry, in units of its prior.
    prior_mean: DVector<f64>,
    groups: Groups,
    /// The records.
    pub samples: &'a Samples<'a>,
    missing: DVector<f64>,
    fold_of: Vec<usize>,
    folds: Vec<Moments>,
}

/// What a regression found.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Where the prior of the variances lies.
    pub origin: Variances,
    /// The variances.
    pub variances: Variances,
    /// The weights.
    pub posterior: Posterior,
}

impl<'a> Regression<'a> {
    /// Sets the regression up.
    ///
    /// # Arguments
    /// * `unknowns` - those of [`Samples::new`]; with `state` they say where the prior's mean lies
    /// * `fold_of` - fold of each record
    pub fn new(
        samples: &'a Samples<'a>,
        state: &State,
        unknowns: &[Unknown],
        terms: Vec<Term>,
        fold_of: &[usize],
    ) -> Self {
        let geometry = samples.geometry.ncols();
        let mut of = vec![None; geometry];
        let (mut count, mut neighbours) = (0, Vec::new());
        for term in &terms {
            of.extend((0..term.columns).map(|wave| Some(count + term.band_of(wave))));
            if term.is_smooth() {
                neighbours.extend((1..term.bands.len()).map(|band| (count + band - 1, count + band)));
            }
            count += term.bands.len();
        }
        let prior_mean = DVector::from_iterator(
            geometry,
            unknowns.iter().map(|unknown| {
                (unknown.prior.mean - state.get(unknown.id).unwrap_or(unknown.prior.mean)) / unknown.prior.sigma
            }),
        );
        let missing = &samples.missing - &samples.geometry * &prior_mean;
        let mut regression = Self {
            terms,
            geometry,
            prior_mean,
            groups: Groups { of, count, neighbours },
            samples,
            missing,
            fold_of: fold_of.to_vec(),
            folds: Vec::new(),
        };
        let fold_count = fold_of.iter().max().map_or(0, |largest| largest + 1);
        regression.folds = (0..fold_count).into_par_iter().map(|fold| regression.moments_of(fold)).collect();
        regression
    }

    fn columns(&self) -> usize {
        self.groups.of.len()
    }

    fn records_of(&self, fold: usize) -> Vec<usize> {
        (0..self.fold_of.len()).filter(|&record| self.fold_of[record] == fold).collect()
    }

    fn moments_of(&self, fold: usize) -> Moments {
        let mut total = Moments::none(self.columns());
        for records in self.records_of(fold).chunks(CHUNK) {
            let (design, missing) = self.rows(records);
            total.add(&Moments::of(&design, &missing));
        }
        total
    }

    /// Design and observations of these records, one after the other.
    pub fn rows(&self, records: &[usize]) -> (DMatrix<f64>, DVector<f64>) {
        let samples = self.samples;
        let rows: Vec<usize> = records.iter().flat_map(|&record| samples.rows_of(record)).collect();
        let mut design = DMatrix::zeros(rows.len(), self.columns());
        design.columns_mut(0, self.geometry).copy_from(&samples.geometry.select_rows(&rows));
        let mut first_column = self.geometry;
        for term in &self.terms {
            let mut waves = vec![0.0; term.columns];
            let mut first_row = 0;
            for &record in records {
                let of_record = samples.rows_of(record);
                let (x, sense) = term.input(samples, record);
                if sense != 0.0 {
                    term.waves_at(x, &mut waves);
                    for (place, row) in of_record.clone().enumerate() {
                        let lever = samples.levers[(row, term.turns)] * sense;
                        for (wave, &value) in waves.iter().enumerate() {
                            design[(first_row + place, first_column + wave)] = lever * value;
                        }
                    }
                }
                first_row += of_record.len();
            }
            first_column += term.columns;
        }
        (design, self.missing.select_rows(&rows))
    }

    fn moments_without(&self, fold: Option<usize>) -> Moments {
        let mut total = Moments::none(self.columns());
        for (index, moments) in self.folds.iter().enumerate() {
            if Some(index) != fold {
                total.add(moments);
            }
        }
        total
    }

    /// Variances and weights from all records. `None` where numbers are not finite.
    pub fn fit(&self) -> Option<Fitted> {
        let moments = self.moments_without(None);
        let origin = self.origin(&moments);
        self.fit_from(&moments, &origin, &origin, STEPS)
    }

    fn fit_from(&self, moments: &Moments, origin: &Variances, start: &Variances, steps: u64) -> Option<Fitted> {
        let variances = maximise(moments, &self.groups, origin, start, steps);
        let posterior = posterior(moments, &self.groups, &variances)?;
        Some(Fitted { origin: origin.clone(), variances, posterior })
    }

    /// Every group explains a tenth of what geometry leaves, the rest is noise.
    fn origin(&self, moments: &Moments) -> Variances {
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

    /// Whitened residuals of every record, each from a regression that did not see its fold; it looks for its
    /// variances from where those of all records lie.
    pub fn held_out(&self, all: &Fitted) -> Option<Vec<DVector<f64>>> {
        let parts: Option<Vec<_>> = (0..self.folds.len())
            .into_par_iter()
            .map(|fold| {
                let fitted =
                    self.fit_from(&self.moments_without(Some(fold)), &all.origin, &all.variances, STEPS_OF_FOLD)?;
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
        let mut all = Vec::new();
        for records in self.records_of(fold).chunks(CHUNK) {
            let (design, missing) = self.rows(records);
            let left = missing - design * mean;
            let mut first = 0;
            for &record in records {
                let count = self.samples.rows_of(record).len();
                all.push((record, left.rows(first, count).into_owned()));
                first += count;
            }
        }
        all
    }

    /// Variance of what a regression without a row would predict for it, whitened: `v / (1 - v/noise)` with `v` that of
    /// the regression with it. One number for each row of the records, in their order.
    pub fn predicted_variance(&self, fitted: &Fitted, records: &[usize]) -> Vec<f64> {
        let noise = fitted.variances.noise;
        let transposed = fitted.posterior.root.transpose();
        let of_chunk = |records: &[usize]| -> Vec<f64> {
            let spread = self.rows(records).0 * &transposed;
            let variances = spread.row_iter().map(|row| row.norm_squared());
            variances.map(|variance| variance / (1.0 - (variance / noise).min(MOST_LEVERAGE))).collect()
        };
        records.chunks(CHUNK).flat_map(of_chunk).collect()
    }

    /// Prior standard deviation of every column: of geometry in units of its own prior, of waves in rad.
    pub fn prior_sigmas(&self, fitted: &Fitted) -> Vec<f64> {
        self.groups.of.iter().map(|group| group.map_or(1.0, |group| fitted.variances.groups[group].sqrt())).collect()
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
        let learned = self.columns() - self.geometry;
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
                let weights = fitted.posterior.mean.rows(self.geometry + first, term.columns).into_owned();
                let root = root.columns(first, term.columns).into_owned();
                first += term.columns;
                let inputs = (0..self.samples.count()).map(|record| term.input(self.samples, record));
                let measured = inputs.filter(|(_, sense)| *sense != 0.0).map(|(x, _)| x).collect();
                curve(term, &Evidenced { weights, root, measured })
            })
            .collect();
        Some(JointCurves { curves })
    }
}

//! Held-out figures: whole regions of joint space (or stretches of time in motion) are left out in turn.

use nalgebra::{DMatrix, DVector};

use crate::identify::linear::Factor;
use crate::identify::problem::Problem;
use crate::identify::split::regions;
use crate::measure::observation::Observation;
use crate::measure::recording::Kind;

/// Records in a block, about.
const BLOCK: usize = 24;
/// Fewest and most blocks.
const BLOCKS: (usize, usize) = (5, 12);

/// Which block each record belongs to.
#[derive(Clone, Debug)]
pub struct Blocks {
    of_record: Vec<usize>,
    count: usize,
}

impl Blocks {
    /// Blocks of records: regions where the arm stood, stretches of time where it moved.
    pub fn new(problem: &Problem<'_>, kind: Kind, seed: u64) -> Self {
        let records = problem.records.len();
        let count = (records / BLOCK).clamp(BLOCKS.0, BLOCKS.1);
        let of_record = match kind {
            Kind::Static => {
                let observations: Vec<&Observation> = problem.records.iter().map(|record| record.observation).collect();
                regions(&observations, count, seed)
            }
            Kind::Continuous => (0..records).map(|index| index * count / records.max(1)).collect(),
        };
        Self { of_record, count }
    }
}

/// A linear regression that is cross-validated.
pub struct Regression<'a> {
    /// Whitened columns.
    pub columns: &'a DMatrix<f64>,
    /// Prior widths of the first columns; the others have none.
    pub prior_sigmas: &'a [f64],
    /// Their deviations from the prior means, in those widths.
    pub deviations: &'a [f64],
    /// Whitened residuals, model minus measurement.
    pub residuals: &'a DVector<f64>,
}

/// Squared length of each record's held-out position residual, m^2.
pub fn held_out_squares_m2(problem: &Problem<'_>, blocks: &Blocks, regression: &Regression<'_>) -> Vec<f64> {
    let firsts = problem.first_rows();
    let mut squares = vec![0.0; problem.records.len()];
    for block in 0..blocks.count {
        let inside = |record: usize| blocks.of_record.get(record) == Some(&block);
        let training: Vec<usize> = (0..problem.records.len())
            .filter(|&record| !inside(record))
            .flat_map(|record| firsts[record]..firsts[record] + problem.records[record].measured.numbers())
            .collect();
        let change = solved(regression, &training);
        let left = regression.residuals + regression.columns * change;
        for (record, square) in squares.iter_mut().enumerate() {
            if inside(record) {
                let sigma_m = problem.records[record].sigma_m;
                *square = left.fixed_rows::<3>(firsts[record]).norm_squared() * sigma_m * sigma_m;
            }
        }
    }
    squares
}

fn solved(regression: &Regression<'_>, training: &[usize]) -> DVector<f64> {
    let (columns, priors) = (regression.columns.ncols(), regression.prior_sigmas.len());
    let rows = training.len().max(columns);
    let mut stacked = DMatrix::zeros(rows + priors, columns);
    let mut right = DVector::zeros(rows + priors);
    for (row, &from) in training.iter().enumerate() {
        stacked.row_mut(row).copy_from(&regression.columns.row(from));
        right[row] = -regression.residuals[from];
    }
    for (index, (sigma, deviation)) in regression.prior_sigmas.iter().zip(regression.deviations).enumerate() {
        stacked[(rows + index, index)] = 1.0 / sigma;
        right[rows + index] = -deviation;
    }
    Factor::new(stacked, &right).solve(0.0)
}

/// Root mean square of distances, mm.
pub fn rms_mm(squares_m2: &[f64]) -> f64 {
    1e3 * (squares_m2.iter().sum::<f64>() / squares_m2.len().max(1) as f64).sqrt()
}

/// How sure it is that held-out residuals fell: mean fall over its standard error, records paired.
pub fn fall_in_errors(before_m2: &[f64], after_m2: &[f64]) -> f64 {
    let falls: Vec<f64> = before_m2.iter().zip(after_m2).map(|(before, after)| before - after).collect();
    let count = falls.len().max(2) as f64;
    let mean = falls.iter().sum::<f64>() / count;
    let variance = falls.iter().map(|fall| (fall - mean).powi(2)).sum::<f64>() / (count - 1.0);
    if variance > 0.0 { mean / (variance / count).sqrt() } else { 0.0 }
}

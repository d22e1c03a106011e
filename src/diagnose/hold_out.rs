//! Held-out figures: whole regions of joint space (or stretches of time in motion) are left out in turn.

use rayon::prelude::*;

use crate::identify::problem::Problem;
use crate::identify::split::regions;
use crate::learn::folds::{FOLDS, folds};
use crate::measure::observation::Observation;
use crate::measure::recording::Kind;

use super::projection::Projection;

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

    /// The learner's folds where the arm stood: small regions, dealt out, so that no joint loses a part of its range. A curve
    /// says nothing of angles where nothing was measured, and is not asked there; in motion as [`Blocks::new`].
    pub fn for_curves(problem: &Problem<'_>, kind: Kind, seed: u64) -> Self {
        if kind == Kind::Continuous {
            return Self::new(problem, kind, seed);
        }
        let observations: Vec<&Observation> = problem.records.iter().map(|record| record.observation).collect();
        Self { of_record: folds(&observations, FOLDS, seed), count: FOLDS }
    }
}

/// Squared length of each record's held-out position residual, m^2: what the linearised fit without a record's block says
/// of it.
///
/// Exact without any refit: with `H = Q Q'` the hat matrix, the residuals of block b from a fit to all others are
/// `(I - H_bb)^-1 r_b` (Cook and Weisberg 1982, 2.2; the jackknife of blocks).
pub fn held_out_squares_m2(problem: &Problem<'_>, blocks: &Blocks, projection: &Projection) -> Vec<f64> {
    let firsts = problem.first_rows();
    let of_block = |block: usize| {
        let members: Vec<usize> =
            (0..problem.records.len()).filter(|&record| blocks.of_record.get(record) == Some(&block)).collect();
        let rows: Vec<usize> = members
            .iter()
            .flat_map(|&record| firsts[record]..firsts[record] + problem.records[record].measured.numbers())
            .collect();
        let left = projection.held_out(&rows);
        let mut row = 0;
        let square = |record: usize| {
            let length = left.fixed_rows::<3>(row).norm();
            row += problem.records[record].measured.numbers();
            (record, (length * problem.records[record].sigma_m).powi(2))
        };
        members.into_iter().map(square).collect::<Vec<_>>()
    };
    let mut squares = vec![0.0; problem.records.len()];
    for (record, square) in (0..blocks.count).into_par_iter().flat_map_iter(of_block).collect::<Vec<_>>() {
        squares[record] = square;
    }
    squares
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

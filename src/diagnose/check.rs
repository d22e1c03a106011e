//! Whether a suspected cause holds: records held out improve with it, and shuffled residuals do not.

use nalgebra::DMatrix;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use crate::identify::problem::Problem;

use super::hold_out::{Blocks, fall_in_errors, held_out_squares_m2};
use super::projection::Projection;
use super::rank::{Cause, Suspect};

/// Shuffles of the records.
const SHUFFLES: usize = 99;
/// Part of the shuffles that may explain as much.
const BY_CHANCE: f64 = 0.02;
/// Standard errors by which held-out residuals must fall.
const SURE_FALL: f64 = 1.0;

/// True when held-out records improve with a suspect, and when residuals that are shuffled over the records do not follow it.
pub fn holds(
    problem: &Problem<'_>,
    blocks: &Blocks,
    suspect: &Suspect,
    projection: &Projection,
    random: &mut ChaCha8Rng,
) -> bool {
    let beside = match &suspect.cause {
        // What bends by load is nearly a function of a joint's own angle, and has a name. One without a name must hold in regions
        // that it has not seen even where nothing holds it back.
        Cause::Free(function) if function.is_of_own_position() => projection.with(&suspect.columns),
        _ => suspect.beside(projection),
    };
    let without = held_out_squares_m2(problem, blocks, projection);
    let with = held_out_squares_m2(problem, blocks, &beside);
    fall_in_errors(&without, &with) >= SURE_FALL && shuffled(problem, &suspect.columns, projection, random) <= BY_CHANCE
}

/// Part of the shuffles of residuals over records that explain as much (Freedman and Lane 1983).
fn shuffled(problem: &Problem<'_>, columns: &DMatrix<f64>, projection: &Projection, random: &mut ChaCha8Rng) -> f64 {
    let firsts = problem.first_rows();
    let probe = projection.probe(columns);
    let true_gain = probe.explained(&projection.residuals);
    let mut order: Vec<usize> = (0..firsts.len()).collect();
    let mut as_good = 0;
    for _ in 0..SHUFFLES {
        order.shuffle(random);
        let mut shuffled = projection.residuals.clone();
        for (to, &from) in order.iter().enumerate() {
            let rows = problem.records[to].measured.numbers().min(problem.records[from].measured.numbers());
            for row in 0..rows {
                shuffled[firsts[to] + row] = projection.residuals[firsts[from] + row];
            }
        }
        // Shuffled residuals are no longer orthogonal to what is free: projected again.
        if probe.explained(&projection.projected(&shuffled)) >= true_gain {
            as_good += 1;
        }
    }
    f64::from(as_good + 1) / (SHUFFLES + 1) as f64
}

//! How often half of the records would have said the same.

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use super::evidence;
use super::fitted::Fitted;
use super::projection::Projection;

/// Complementary pairs of halves (Shah and Samworth 2013).
const PAIRS: usize = 10;

/// Part of random halves of the records in which a term, all others beside it, still has evidence for it.
///
/// Half of the records bear half of the evidence: a cause that all records just about show is seen in few of their halves. What
/// is large and yet shows in few halves hangs on few records.
pub fn stability(fitted: &Fitted<'_>, term: usize, seed: u64) -> f64 {
    let problem = &fitted.estimate.problem;
    let (free, residuals) = fitted.free_without(&[term]);
    let columns = fitted.columns_of(term);
    let firsts = problem.first_rows();
    let rows_of = |record: usize| firsts[record]..firsts[record] + problem.records[record].measured.numbers();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut order: Vec<usize> = (0..problem.records.len()).collect();
    let mut seen = 0;
    for _ in 0..PAIRS {
        order.shuffle(&mut random);
        let (one, other) = order.split_at(order.len() / 2);
        for half in [one, other] {
            let rows: Vec<usize> = half.iter().flat_map(|&record| rows_of(record)).collect();
            let here = Projection::new(
                &free.columns.select_rows(&rows),
                &free.sigmas,
                &residuals.select_rows(&rows),
                &free.deviations,
            );
            let gain = here.gain(&columns.select_rows(&rows));
            if evidence::of_candidate(&fitted.terms[term], &gain, here.cost, here.rows) < 0.0 {
                seen += 1;
            }
        }
    }
    f64::from(seen) / (2 * PAIRS) as f64
}

//! What a fit leaves: noise, or something that the arm does and the model does not?
//!
//! Residuals are asked for everything that the tool knows an arm to do beyond the model, a group of regressors at a
//! time: each effect at each place, periodic errors of each joint, each joint's dependence on the others, a smooth
//! function of the pose. A group counts when it explains more than noise would, with the number of groups allowed for.
//! Nothing is named or corrected here (that is diagnosis); only the size of what would come again is found.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::measure::observation::Observation;
use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::DOF;

use super::candidates::{effect_columns, effects_at_places};
use super::estimate::Estimate;
use super::linear::{column_space, project_out};
use super::problem::{NoPose, Problem};
use super::unknown::{Prior, Unknown, UnknownId};

/// What residuals are made of, standard deviations per axis, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition {
    /// Scatter without structure.
    pub noise_sigma_m: f64,
    /// Structure: what depends on the pose, the approach or time, and would come again.
    pub unexplained_sigma_m: f64,
}

/// Records looked at: enough to see structure, few enough for many decompositions.
const MOST_RECORDS: usize = 500;
/// Probability with which a recording of nothing but noise is said to have structure.
const FALSE_ALARM: f64 = 0.01;
/// Groups that are taken in at most.
const MOST_GROUPS: usize = 10;
/// Columns of a group that carry less than this part of its strongest direction are not asked.
const RANK_TOLERANCE: f64 = 1e-4;
/// Orders a joint revolution of geometry and encoders, and of gears.
const SLOW_ORDERS: std::ops::RangeInclusive<u32> = 1..=6;
/// See [`SLOW_ORDERS`].
const FAST_ORDERS: std::ops::RangeInclusive<u32> = 7..=30;

/// Splits what an estimate leaves into noise and structure: forward selection of groups by F tests on residuals from
/// which the fitted parameters are projected out (Frisch, Waugh and Lovell), at a level divided by the number of
/// groups (Bonferroni).
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn composition(estimate: &Estimate<'_>) -> Result<Composition, NoPose> {
    let step = estimate.problem.records.len().div_ceil(MOST_RECORDS).max(1);
    let chosen: Vec<usize> = (0..estimate.problem.records.len()).step_by(step).collect();
    let problem = estimate.problem.subset(&chosen);
    let fit = &estimate.fit;
    let whitening = problem.whitening();
    let whitened = |mut matrix: DMatrix<f64>| {
        for mut column in matrix.column_iter_mut() {
            column.component_mul_assign(&whitening);
        }
        matrix
    };
    let residuals = problem.residuals(&fit.state)?.component_mul(&whitening);
    let fitted = column_space(&whitened(problem.jacobian(&fit.state, &fit.unknowns)?), 1e-8);
    let groups: Vec<DMatrix<f64>> = groups(&problem, estimate)?.into_iter().map(whitened).collect();
    let parts = forward(&residuals, &fitted, &groups);
    // Whitened units: one is the whole spread.
    let sigma_m = estimate.spread.sigma_m;
    Ok(Composition {
        noise_sigma_m: sigma_m * parts.noise_variance.sqrt(),
        unexplained_sigma_m: sigma_m * parts.structure_variance.sqrt(),
    })
}

/// Variances per row.
#[derive(Clone, Copy, Debug)]
struct Parts {
    noise_variance: f64,
    structure_variance: f64,
}

fn forward(residuals: &DVector<f64>, fitted: &DMatrix<f64>, groups: &[DMatrix<f64>]) -> Parts {
    let rows = residuals.len();
    let mut left = project_out(fitted, &DMatrix::from_column_slice(rows, 1, residuals.as_slice()));
    let mut groups: Vec<DMatrix<f64>> = groups.iter().map(|group| project_out(fitted, group)).collect();
    let freedom_before = (rows as f64 - fitted.ncols() as f64).max(1.0);
    let before = left.norm_squared();
    let mut freedom = freedom_before;
    let level = FALSE_ALARM / groups.len().max(1) as f64;
    for _ in 0..MOST_GROUPS {
        let best = groups
            .iter()
            .enumerate()
            .filter_map(|(index, group)| {
                let space = column_space(group, RANK_TOLERANCE);
                let count = space.ncols() as f64;
                // A group that takes a third of what is left to be asked cannot be judged.
                if count == 0.0 || 3.0 * count > freedom {
                    return None;
                }
                let gain = (space.transpose() * &left).norm_squared();
                let rest = (left.norm_squared() - gain).max(f64::MIN_POSITIVE);
                let ratio = (gain / count) / (rest / (freedom - count));
                let fisher = FisherSnedecor::new(count, freedom - count).ok()?;
                Some((index, space, fisher.sf(ratio), ratio))
            })
            // Where both probabilities are zero to rounding the larger ratio decides.
            .min_by(|a, b| a.2.total_cmp(&b.2).then(b.3.total_cmp(&a.3)));
        let Some((index, space, probability, _)) = best else { break };
        if probability > level {
            break;
        }
        left = project_out(&space, &left);
        freedom -= space.ncols() as f64;
        groups.swap_remove(index);
        for group in &mut groups {
            *group = project_out(&space, group);
        }
    }
    let noise_variance = left.norm_squared() / freedom;
    // What the groups took beyond the share of noise that any directions take.
    let taken = before - left.norm_squared() - noise_variance * (freedom_before - freedom);
    Parts { noise_variance, structure_variance: taken.max(0.0) / freedom_before }
}

/// The groups of regressors, metres and radians per unit.
fn groups(problem: &Problem<'_>, estimate: &Estimate<'_>) -> Result<Vec<DMatrix<f64>>, NoPose> {
    let state = &estimate.fit.state;
    let observations: Vec<&Observation> = problem.records.iter().map(|record| record.observation).collect();
    let effects = effects_at_places(&state.model.robot, &observations);
    let mut groups = effect_columns(problem, state, &effects)?;

    let any = Prior { mean: 0.0, sigma: 1.0 };
    let zeros: Vec<Unknown> = (0..DOF)
        .map(|joint| Unknown { id: UnknownId::Model(ParameterId::Row(joint, RowQuantity::Offset)), prior: any })
        .collect();
    let levers = problem.jacobian(state, &zeros)?;
    let record_of: Vec<usize> = problem
        .records
        .iter()
        .enumerate()
        .flat_map(|(index, record)| std::iter::repeat_n(index, record.measured.numbers()))
        .collect();
    let along = |joint: usize, values: &dyn Fn(&Observation) -> Vec<f64>| {
        let of_records: Vec<Vec<f64>> = observations.iter().map(|record| values(record)).collect();
        let columns = of_records.first().map_or(0, Vec::len);
        DMatrix::from_fn(problem.rows(), columns, |row, column| {
            levers[(row, joint)] * of_records[record_of[row]][column]
        })
    };
    for joint in 0..DOF {
        for orders in [SLOW_ORDERS, FAST_ORDERS] {
            groups.push(along(joint, &|record| {
                let angle = record.numbers_rad[joint];
                orders.clone().flat_map(|order| <[f64; 2]>::from((f64::from(order) * angle).sin_cos())).collect()
            }));
        }
        groups.push(along(joint, &|record| {
            let others = (0..DOF).filter(|&other| other != joint).map(|other| record.numbers_rad[other]);
            others.flat_map(|angle| [angle, angle.sin(), angle.cos()]).collect()
        }));
    }
    groups.push(smooth(problem, &observations, &record_of));
    Ok(groups)
}

/// A smooth displacement of the measured point as a function of the arm's three large joints: products of first
/// harmonics, in each coordinate.
fn smooth(problem: &Problem<'_>, observations: &[&Observation], record_of: &[usize]) -> DMatrix<f64> {
    let harmonics = |angle: f64| [1.0, angle.sin(), angle.cos()];
    let firsts = problem.first_rows();
    let values: Vec<Vec<f64>> = observations
        .iter()
        .map(|record| {
            let [a, b, c] = [0, 1, 2].map(|joint| harmonics(record.numbers_rad[joint]));
            (0..27).map(|term| a[term / 9] * b[term / 3 % 3] * c[term % 3]).collect()
        })
        .collect();
    let terms = values.first().map_or(0, Vec::len);
    DMatrix::from_fn(problem.rows(), 3 * terms, |row, column| {
        let record = record_of[row];
        if row - firsts[record] == column / terms { values[record][column % terms] } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn variances_that_were_put_in_come_out_and_noise_stays_noise() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let rows = 600;
        let mut matrix = |columns: usize| DMatrix::from_fn(rows, columns, |_, _| normal());
        let (fitted, groups) = (matrix(20), [matrix(1), matrix(12), matrix(40)]);
        let noise = matrix(1).column(0).into_owned();
        let fitted = column_space(&fitted, 1e-10);
        let parts = forward(&noise, &fitted, &groups);
        assert!(parts.structure_variance == 0.0 && (parts.noise_variance - 1.0).abs() < 0.15, "{parts:?}");
        let weights = DVector::from_element(12, 0.3);
        let both = &noise + &groups[1] * weights;
        let parts = forward(&both, &fitted, &groups);
        // Twelve columns of unit variance times 0.3: 1.08 of structure a row.
        assert!((parts.structure_variance - 1.08).abs() < 0.2, "{parts:?}");
        assert!((parts.noise_variance - 1.0).abs() < 0.15, "{parts:?}");
    }
}

//! What a fit leaves: noise, or something that the arm does and the model does not?
//!
//! Residuals are compared with a broad family of things an arm can do beyond the model: angle errors of each joint as
//! any periodic function of its own number, by the sense of approach, in proportion to every other joint, and slow
//! drift. The family is not fitted; only its total variance is, by restricted maximum likelihood. A recording whose
//! residuals are white gives zero, however many functions there are.

use nalgebra::{DMatrix, DVector};

use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::DOF;

use super::estimate::Estimate;
use super::linear::{column_space, project_out};
use super::problem::NoPose;
use super::unknown::{Prior, Unknown, UnknownId};

/// What residuals are made of, standard deviations per axis, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition {
    /// Scatter without structure.
    pub noise_sigma_m: f64,
    /// Structure: what depends on the pose, the approach or time, and would come again.
    pub unexplained_sigma_m: f64,
    /// Twice the gain in log likelihood by allowing structure at all: chi-squared with one degree of freedom (half the
    /// time zero) where there is none.
    pub likelihood_ratio: f64,
}

/// Repetitions a joint revolution that are tried: geometry and encoders below, gears above.
const ORDERS: [f64; 14] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 18.0, 22.0, 26.0, 30.0];
/// Records looked at: enough to see structure, few enough for one decomposition.
const MOST_RECORDS: usize = 700;
/// Likelihood ratio from which structure is believed: one false alarm in a hundred white recordings (half of
/// chi-squared with one degree of freedom, Self and Liang 1987).
const BELIEVED: f64 = 5.41;

/// Splits what an estimate leaves into noise and structure.
///
/// The model of the residuals is `r = M (Z w + e)`, w and e normal with variances `ratio sigma^2` and `sigma^2`, M the
/// annihilator of the fitted parameters; `ratio` maximises the restricted likelihood (Harville 1977), one number over a
/// decomposition of `M Z`.
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
    let fitted = whitened(problem.jacobian(&fit.state, &fit.unknowns)?);
    let family = whitened(family(&problem, estimate)?);
    let basis = column_space(&fitted, 1e-8);
    let left = project_out(&basis, &DMatrix::from_column_slice(residuals.len(), 1, residuals.as_slice()));
    let family = project_out(&basis, &family);
    let freedom = residuals.len() as f64 - basis.ncols() as f64;
    let (ratio, variance, likelihood_ratio) = variance_ratio(&left.column(0).into_owned(), &family, freedom);
    // Whitened units: one is the total spread.
    let sigma_m = estimate.spread.sigma_m;
    if likelihood_ratio < BELIEVED {
        return Ok(Composition { noise_sigma_m: sigma_m, unexplained_sigma_m: 0.0, likelihood_ratio });
    }
    let per_row = family.norm_squared() / freedom;
    Ok(Composition {
        noise_sigma_m: sigma_m * variance.sqrt(),
        unexplained_sigma_m: sigma_m * (ratio * variance * per_row).sqrt(),
        likelihood_ratio,
    })
}

/// The family's columns, each of unit mean square over the records, m per unit.
fn family(problem: &super::problem::Problem<'_>, estimate: &Estimate<'_>) -> Result<DMatrix<f64>, NoPose> {
    let any = Prior { mean: 0.0, sigma: 1.0 };
    let zeros: Vec<Unknown> = (0..DOF)
        .map(|joint| Unknown { id: UnknownId::Model(ParameterId::Row(joint, RowQuantity::Offset)), prior: any })
        .collect();
    let levers = problem.jacobian(&estimate.fit.state, &zeros)?;
    let record_of: Vec<usize> = problem
        .records
        .iter()
        .enumerate()
        .flat_map(|(index, record)| std::iter::repeat_n(index, record.measured.numbers()))
        .collect();
    let span_s = problem.records.iter().filter_map(|record| record.observation.conditions.time_s).fold(0.0, f64::max);
    let mut columns: Vec<DVector<f64>> = Vec::new();
    for joint in 0..DOF {
        let lever = levers.column(joint);
        let mut along = |value: &dyn Fn(&crate::measure::observation::Observation) -> f64| {
            let scaled =
                lever.iter().zip(&record_of).map(|(part, &record)| part * value(problem.records[record].observation));
            columns.push(DVector::from_iterator(lever.len(), scaled));
        };
        for order in ORDERS {
            along(&|record| (order * record.numbers_rad[joint]).sin());
            along(&|record| (order * record.numbers_rad[joint]).cos());
        }
        along(&|record| record.conditions.approach[joint]);
        for other in 0..DOF {
            along(&|record| record.numbers_rad[other]);
            along(&|record| (2.0 * record.numbers_rad[other]).sin());
        }
        if span_s > 0.0 {
            along(&|record| record.conditions.time_s.unwrap_or(0.0) / span_s);
        }
    }
    columns.retain_mut(|column| {
        let size = column.norm() / (column.len() as f64).sqrt();
        if size > 0.0 {
            *column /= size;
        }
        size > 0.0
    });
    if columns.is_empty() {
        return Ok(DMatrix::zeros(problem.rows(), 1));
    }
    Ok(DMatrix::from_columns(&columns))
}

/// The ratio of variances that maximises the restricted likelihood, the noise variance with it, and twice the gain in
/// log likelihood over ratio zero.
fn variance_ratio(left: &DVector<f64>, family: &DMatrix<f64>, freedom: f64) -> (f64, f64, f64) {
    let rotated = if family.nrows() > family.ncols() {
        let qr = family.clone().qr();
        let svd = qr.r().svd(true, false);
        svd.u.map(|u| (u.transpose() * (qr.q().transpose() * left), svd.singular_values))
    } else {
        let svd = family.clone().svd(true, false);
        svd.u.map(|u| (u.transpose() * left, svd.singular_values))
    };
    let total = left.norm_squared();
    let Some((along, values)) = rotated else {
        return (0.0, total / freedom, 0.0);
    };
    let outside = (total - along.norm_squared()).max(0.0);
    let evaluate = |ratio: f64| {
        let mut sum = outside;
        let mut log_determinant = 0.0;
        for (part, value) in along.iter().zip(values.iter()) {
            let widened = 1.0 + ratio * value * value;
            sum += part * part / widened;
            log_determinant += widened.ln();
        }
        let variance = sum / freedom;
        (-0.5 * (freedom * variance.ln() + log_determinant), variance)
    };
    let (none, plain) = evaluate(0.0);
    let mut best = (0.0, none, plain);
    // Ratios from structure a thousandth of the noise to a thousandfold, per column.
    for step in 0..=120 {
        let ratio = 10f64.powf(-8.0 + 0.1 * f64::from(step));
        let (likelihood, variance) = evaluate(ratio);
        if likelihood > best.1 {
            best = (ratio, likelihood, variance);
        }
    }
    (best.0, best.2, 2.0 * (best.1 - none))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn variances_that_were_put_in_come_out() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let (rows, columns) = (600, 80);
        let family = DMatrix::from_fn(rows, columns, |_, _| normal());
        let noise = DVector::from_fn(rows, |_, _| normal());
        let (_, variance, gain) = variance_ratio(&noise, &family, rows as f64);
        assert!((variance - 1.0).abs() < 0.15 && gain < BELIEVED, "{variance} {gain}");
        let weights = DVector::from_fn(columns, |_, _| 0.2 * normal());
        let both = &noise + &family * weights;
        let (ratio, variance, gain) = variance_ratio(&both, &family, rows as f64);
        assert!(gain > 50.0);
        assert!((variance - 1.0).abs() < 0.2, "{variance}");
        assert!((ratio * variance / 0.04 - 1.0).abs() < 0.5, "{ratio}");
    }
}

//! Geometry beside a network: free under its prior, integrated out of the misfit.

use nalgebra::{DMatrix, DVector};

use crate::learn::cholesky;

/// The weighting `P = I - G (noise I + G'G)^-1 G'` that a misfit has where `G g`, `g` normal with unit variance, may
/// explain a part of it: `noise (noise I + G G')^-1` by Woodbury's formula.
#[derive(Clone, Debug)]
pub struct Beside {
    geometry: DMatrix<f64>,
    /// Lower factor of `noise I + G'G`.
    factor: DMatrix<f64>,
    noise: f64,
}

impl Beside {
    /// `None` where numbers are not finite.
    pub fn new(geometry: &DMatrix<f64>, noise: f64) -> Option<Self> {
        let count = geometry.ncols();
        let inner = geometry.tr_mul(geometry) + DMatrix::identity(count, count) * noise;
        Some(Self { geometry: geometry.clone(), factor: cholesky::factor(inner)?, noise })
    }

    /// The geometry that a misfit asks for.
    pub fn geometry_of(&self, left: &DVector<f64>) -> DVector<f64> {
        cholesky::solve(&self.factor, &self.geometry.tr_mul(left))
    }

    /// `P left`.
    pub fn apply(&self, left: &DVector<f64>) -> DVector<f64> {
        left - &self.geometry * self.geometry_of(left)
    }

    /// `P J`: what is left of the columns' movements when geometry has followed them.
    pub fn apply_to_all(&self, jacobian: &DMatrix<f64>) -> DMatrix<f64> {
        let mut left = jacobian.clone();
        for mut column in left.column_iter_mut() {
            let applied = self.apply(&column.clone_owned());
            column.copy_from(&applied);
        }
        left
    }

    /// `J' P J`.
    pub fn inner(&self, jacobian: &DMatrix<f64>) -> DMatrix<f64> {
        let mut across = self.geometry.tr_mul(jacobian);
        self.factor.solve_lower_triangular_mut(&mut across);
        jacobian.tr_mul(jacobian) - across.tr_mul(&across)
    }

    /// Numbers of geometry that the rows determined.
    pub fn determined(&self) -> f64 {
        self.factor.nrows() as f64 - self.noise * cholesky::inverse_lower(&self.factor).norm_squared()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weighting_is_that_of_the_whole_covariance() {
        let geometry = DMatrix::from_fn(12, 3, |row, column| ((row * 5 + column * 3 + 1) as f64 * 0.73).sin());
        let left = DVector::from_fn(12, |row, _| (row as f64).cos());
        let noise = 0.3;
        let beside = Beside::new(&geometry, noise).expect("finite");
        let whole = DMatrix::identity(12, 12) * noise + &geometry * geometry.transpose();
        let weighting = whole.try_inverse().expect("regular") * noise;
        assert!((beside.apply(&left) - &weighting * &left).amax() < 1e-10);
        let jacobian = DMatrix::from_fn(12, 4, |row, column| ((row + 7 * column) as f64).sin());
        assert!((beside.apply_to_all(&jacobian) - &weighting * &jacobian).amax() < 1e-10);
        assert!((beside.inner(&jacobian) - jacobian.tr_mul(&(&weighting * &jacobian))).amax() < 1e-10);
        assert!((beside.determined() - (12.0 - weighting.trace())).abs() < 1e-10);
    }
}

//! Linear algebra of least squares: orthogonal factors only, never `J'J`.

use nalgebra::{DMatrix, DVector};

/// `R` and `Q'b` of the least-squares problem `|A x - b|`, columns of `A` scaled to unit length first.
///
/// The factor is that of `A diag(1/scale)`; [`Factor::solve`] and [`Factor::covariance`] undo the scaling.
#[derive(Clone, Debug)]
pub struct Factor {
    /// Upper triangular, p x p.
    pub r: DMatrix<f64>,
    /// The first p entries of `Q'b`.
    pub rotated: DVector<f64>,
    /// Length of each column of `A`; 1 where it is zero.
    pub scale: Vec<f64>,
}

/// Diagonal entries of `R` below this part of the largest count as zero: the column adds nothing.
const RANK_TOLERANCE: f64 = 1e-13;

impl Factor {
    /// Factors a tall matrix (rows >= columns; pad with zero rows otherwise).
    pub fn new(mut a: DMatrix<f64>, b: &DVector<f64>) -> Self {
        let columns = a.ncols();
        let scale: Vec<f64> = a
            .column_iter()
            .map(|column| {
                let length = column.norm();
                if length > 0.0 { length } else { 1.0 }
            })
            .collect();
        for (mut column, &length) in a.column_iter_mut().zip(&scale) {
            column /= length;
        }
        let qr = a.qr();
        let mut rotated = b.clone();
        qr.q_tr_mul(&mut rotated);
        let r = qr.r();
        Self { r, rotated: rotated.rows(0, columns.min(rotated.len())).into_owned(), scale }
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.scale.len()
    }

    /// The minimiser of `|A x - b|^2 + damping |D x|^2`, where D holds the column lengths (Levenberg and Marquardt's
    /// scaling). Directions that `A` does not see stay zero.
    pub fn solve(&self, damping: f64) -> DVector<f64> {
        let p = self.columns();
        let scaled = if damping > 0.0 {
            let mut stacked = DMatrix::zeros(2 * p, p);
            stacked.rows_mut(0, p).copy_from(&self.r);
            let mut right = DVector::zeros(2 * p);
            right.rows_mut(0, p).copy_from(&self.rotated);
            for index in 0..p {
                stacked[(p + index, index)] = damping.sqrt();
            }
            let qr = stacked.qr();
            qr.q_tr_mul(&mut right);
            back_substitute(&qr.r(), &right)
        } else {
            back_substitute(&self.r, &self.rotated)
        };
        DVector::from_iterator(p, scaled.iter().zip(&self.scale).map(|(x, length)| x / length))
    }

    /// `(A'A)^-1` through `R^-1`: the covariance of the estimate when rows of `A` are whitened.
    ///
    /// # Assumptions
    /// Full column rank (priors see to that); a column that adds nothing gets variance zero.
    pub fn covariance(&self) -> DMatrix<f64> {
        let half = self.inverse_root();
        &half * half.transpose()
    }

    /// `H` with `H H' = (A'A)^-1`, p x p.
    pub fn inverse_root(&self) -> DMatrix<f64> {
        let p = self.columns();
        let mut half = DMatrix::zeros(p, p);
        for column in 0..p {
            let mut unit = DVector::zeros(p);
            unit[column] = 1.0;
            half.set_column(column, &back_substitute(&self.r, &unit));
        }
        for (mut row, length) in half.row_iter_mut().zip(&self.scale) {
            row /= *length;
        }
        half
    }
}

/// Solves `R x = b` for an upper triangular R; directions with a vanishing diagonal are left at zero.
fn back_substitute(r: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let p = r.ncols();
    let largest = r.diagonal().amax();
    let mut x = DVector::zeros(p);
    for row in (0..p).rev() {
        let diagonal = r[(row, row)];
        if diagonal.abs() <= RANK_TOLERANCE * largest {
            continue;
        }
        let known: f64 = (row + 1..p).map(|column| r[(row, column)] * x[column]).sum();
        x[row] = (b[row] - known) / diagonal;
    }
    x
}

/// An orthonormal basis of the column space of `a`, for projections.
///
/// Columns are scaled; singular values below `tolerance` of the largest are left out.
pub fn column_space(a: &DMatrix<f64>, tolerance: f64) -> DMatrix<f64> {
    let mut scaled = a.clone();
    for mut column in scaled.column_iter_mut() {
        let length = column.norm();
        if length > 0.0 {
            column /= length;
        }
    }
    if scaled.ncols() == 0 || scaled.nrows() == 0 {
        return DMatrix::zeros(a.nrows(), 0);
    }
    // QR first: the SVD then works on a small square factor.
    let qr = scaled.qr();
    let svd = qr.r().svd(true, false);
    let largest = svd.singular_values.amax();
    let kept: Vec<usize> =
        (0..svd.singular_values.len()).filter(|&k| svd.singular_values[k] > tolerance * largest).collect();
    match svd.u {
        Some(u) => qr.q() * u.select_columns(&kept),
        None => DMatrix::zeros(a.nrows(), 0),
    }
}

/// What is left of the columns of `what` after their part in the column space `basis` (orthonormal) is taken out: the
/// annihilator `M_X what` of Frisch, Waugh and Lovell.
pub fn project_out(basis: &DMatrix<f64>, what: &DMatrix<f64>) -> DMatrix<f64> {
    let once = what - basis * (basis.transpose() * what);
    // A second pass takes out what rounding left ("twice is enough", Kahan and Parlett).
    &once - basis * (basis.transpose() * &once)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| ((i * 7 + j * 13 + i * j) as f64 * 0.37).sin())
    }

    #[test]
    fn the_solution_and_the_covariance_are_those_of_the_pseudo_inverse() {
        let mut a = sample(30, 4);
        a.column_mut(2).scale_mut(1e7);
        let b = DVector::from_fn(30, |i, _| (i as f64).cos());
        let factor = Factor::new(a.clone(), &b);
        let svd = a.clone().svd(true, true);
        let expected = svd.solve(&b, 0.0).expect("factors");
        let x = factor.solve(0.0);
        for i in 0..4 {
            assert!((x[i] / expected[i] - 1.0).abs() < 1e-8, "{i}");
        }
        let pseudo = a.pseudo_inverse(0.0).expect("factors");
        let covariance = &pseudo * pseudo.transpose();
        for i in 0..4 {
            for j in 0..4 {
                let size = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
                assert!((factor.covariance()[(i, j)] - covariance[(i, j)]).abs() < 1e-8 * size);
            }
        }
    }

    #[test]
    fn damping_shortens_the_step() {
        let (a, b) = (sample(30, 4), DVector::from_element(30, 1.0));
        let factor = Factor::new(a, &b);
        assert!(factor.solve(1.0).norm() < factor.solve(0.0).norm());
    }

    #[test]
    fn projections_leave_nothing_along_the_basis() {
        let x = sample(40, 5);
        let basis = column_space(&x, 1e-10);
        assert_eq!(basis.ncols(), 5);
        let left = project_out(&basis, &sample(40, 9));
        assert!((x.transpose() * left).amax() < 1e-10);
        let mut twice = sample(40, 6);
        let copy = twice.column(0).into_owned();
        twice.set_column(5, &copy);
        assert_eq!(column_space(&twice, 1e-10).ncols(), 5);
    }
}

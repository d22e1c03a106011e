//! Cholesky factors by blocks: matrix products do the work, which is several times faster than column by column.

use nalgebra::{DMatrix, DVector};

/// Width of a block.
const BLOCK: usize = 48;

/// The lower factor L of a symmetric positive definite matrix, `L L' = A`; `None` where A is not.
pub fn factor(mut a: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let n = a.nrows();
    for start in (0..n).step_by(BLOCK) {
        let width = BLOCK.min(n - start);
        let below = n - start - width;
        let diagonal = a.view((start, start), (width, width)).into_owned().cholesky()?.unpack();
        if below > 0 {
            // Rows below: X L' = A, that is L X' = A'.
            let mut rows = a.view((start + width, start), (below, width)).transpose();
            diagonal.solve_lower_triangular_mut(&mut rows);
            let rows = rows.transpose();
            // Only the lower triangle of the rest is needed: update it in stripes.
            for stripe in (0..below).step_by(BLOCK) {
                let columns = BLOCK.min(below - stripe);
                let height = below - stripe;
                let right = rows.rows(stripe, columns).transpose();
                let mut rest = a.view_mut((start + width + stripe, start + width + stripe), (height, columns));
                rest.gemm(-1.0, &rows.rows(stripe, height), &right, 1.0);
            }
            a.view_mut((start + width, start), (below, width)).copy_from(&rows);
        }
        a.view_mut((start, start), (width, width)).copy_from(&diagonal);
    }
    a.fill_upper_triangle(0.0, 1);
    Some(a)
}

/// `L^-1` of a lower triangular matrix with a positive diagonal.
pub fn inverse_lower(l: &DMatrix<f64>) -> DMatrix<f64> {
    let n = l.nrows();
    let mut inverse = DMatrix::zeros(n, n);
    for start in (0..n).step_by(BLOCK) {
        let width = BLOCK.min(n - start);
        let mut own = DMatrix::identity(width, width);
        let diagonal = l.view((start, start), (width, width));
        diagonal.solve_lower_triangular_mut(&mut own);
        if start > 0 {
            // Row block i: -L_ii^-1 (L_i,:i X_:i,:).
            let product = l.view((start, 0), (width, start)) * inverse.view((0, 0), (start, start));
            inverse.view_mut((start, 0), (width, start)).copy_from(&(-(&own * product)));
        }
        inverse.view_mut((start, start), (width, width)).copy_from(&own);
    }
    inverse
}

/// The solution of `L L' x = b`.
pub fn solve(l: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let mut x = b.clone();
    l.solve_lower_triangular_mut(&mut x);
    l.tr_solve_lower_triangular_mut(&mut x);
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factor_inverse_and_solution_agree_with_their_definitions() {
        for n in [1, 7, 48, 49, 150] {
            let root = DMatrix::from_fn(n, n, |i, j| ((i * 7 + j * 13 + i * j) as f64 * 0.37).sin());
            let a = &root * root.transpose() + DMatrix::identity(n, n);
            let l = factor(a.clone()).expect("positive definite");
            assert!((&l * l.transpose() - &a).amax() < 1e-10 * a.amax(), "{n}");
            assert!((inverse_lower(&l) * &l - DMatrix::identity(n, n)).amax() < 1e-10, "{n}");
            let b = DVector::from_fn(n, |i, _| (i as f64).cos());
            assert!((&a * solve(&l, &b) - &b).amax() < 1e-9 * a.amax(), "{n}");
        }
        assert_eq!(factor(-DMatrix::identity(3, 3)), None);
    }
}

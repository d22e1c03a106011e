//! What a further cause could explain beyond all that is free already: the score step of Frisch, Waugh and Lovell.

use nalgebra::{DMatrix, DVector};

/// The linearised fit with everything that is free projected out.
///
/// Priors are further rows of the regression; a candidate has zeros there, so only the upper part of the orthonormal
/// basis is kept: `Z~'Z~ = Z'Z - (Q'Z)'(Q'Z)` and `Z~'r = Z'r`.
#[derive(Clone, Debug)]
pub struct Projection {
    /// Upper part of an orthonormal basis of what is free, rows x parameters ...
    basis: DMatrix<f64>,
    /// ... and its transpose: products with it are what a search spends its time on.
    transposed: DMatrix<f64>,
    /// Residuals, whitened, orthogonal to what is free.
    pub residuals: DVector<f64>,
    /// Sum of squares of residuals and priors.
    pub cost: f64,
    /// Coordinates.
    pub rows: usize,
    /// Free numbers.
    pub free: usize,
}

/// See [`Projection::probe`].
#[derive(Clone, Debug)]
pub struct Probe {
    directions: DMatrix<f64>,
}

impl Probe {
    /// Reduction of the sum of squares of residuals from which everything free is projected out.
    pub fn explained(&self, residuals: &DVector<f64>) -> f64 {
        self.directions.tr_mul(residuals).norm_squared()
    }
}

/// A smooth function at its likeliest size.
struct Smooth {
    /// Directions of its columns, orthogonal beyond what is free.
    vectors: DMatrix<f64>,
    /// Those of them that the records show.
    directions: Vec<Direction>,
    /// Prior variance of its columns' weights.
    size: f64,
    /// Reduction of the sum of squares at that size.
    explained: f64,
    /// Evidence against it, before the price of what was looked at.
    evidence: f64,
}

struct Direction {
    /// Which of the vectors.
    index: usize,
    /// Its square of length beyond what is free.
    own: f64,
    /// Its product with the residuals.
    part: f64,
}

/// What a candidate explains.
#[derive(Clone, Debug)]
pub struct Gain {
    /// Reduction of the sum of squares, whitened.
    pub explained: f64,
    /// Independent numbers that it takes.
    pub rank: usize,
    /// Its parameters.
    pub values: DVector<f64>,
    /// Their standard uncertainties, by the noise that remains with it.
    pub sigmas: DVector<f64>,
}

/// Directions of a candidate of which less than this part (of length) is its own are not looked at: what is left of
/// them is the error of the linearisation.
const OWN_PART: f64 = 0.004;

/// Columns up to which nalgebra makes no blocked product.
const FEW: usize = 5;

/// Sizes of a smooth function that are tried, by half decades.
const SIZES: usize = 14;

impl Projection {
    /// Projects out `free` (whitened Jacobian) with priors (`prior_sigmas`), from residuals and deviations from the
    /// priors' means in their sigmas; both are brought to the optimum first.
    pub fn new(free: &DMatrix<f64>, prior_sigmas: &[f64], residuals: &DVector<f64>, deviations: &[f64]) -> Self {
        let (rows, columns) = free.shape();
        let mut stacked = DMatrix::zeros(rows + columns, columns);
        stacked.rows_mut(0, rows).copy_from(free);
        let mut right = DVector::zeros(rows + columns);
        right.rows_mut(0, rows).copy_from(residuals);
        for (index, (sigma, deviation)) in prior_sigmas.iter().zip(deviations).enumerate() {
            stacked[(rows + index, index)] = 1.0 / sigma;
            right[rows + index] = *deviation;
        }
        for mut column in stacked.column_iter_mut() {
            let length = column.norm();
            if length > 0.0 {
                column /= length;
            }
        }
        let q = stacked.qr().q();
        let right = &right - &q * (q.tr_mul(&right));
        let right = &right - &q * (q.tr_mul(&right));
        let basis = q.rows(0, rows).into_owned();
        Self {
            transposed: basis.transpose(),
            basis,
            residuals: right.rows(0, rows).into_owned(),
            cost: right.norm_squared(),
            rows,
            free: columns,
        }
    }

    /// The same with further columns projected out, of which only what is new counts.
    #[must_use]
    pub fn with(&self, columns: &DMatrix<f64>) -> Self {
        let gram = scaled(&self.own_gram(columns), columns);
        let (vectors, roots) = own_directions(&gram);
        if roots.is_empty() {
            return self.clone();
        }
        // Orthonormal directions of the candidate beyond what is free, in rows only: the part that they have in the
        // prior rows is beyond measurement and is left out, a little to the safe side.
        let mut unit = columns.clone();
        for mut column in unit.column_iter_mut() {
            let length = column.norm();
            if length > 0.0 {
                column /= length;
            }
        }
        let mut fresh = (&unit - &self.basis * (&self.transposed * &unit)) * &vectors;
        for (mut column, root) in fresh.column_iter_mut().zip(&roots) {
            column /= *root;
        }
        let fresh = fresh.qr().q();
        let along = fresh.tr_mul(&self.residuals);
        let mut basis = DMatrix::zeros(self.rows, self.basis.ncols() + fresh.ncols());
        basis.columns_mut(0, self.basis.ncols()).copy_from(&self.basis);
        basis.columns_mut(self.basis.ncols(), fresh.ncols()).copy_from(&fresh);
        Self {
            residuals: &self.residuals - &fresh * &along,
            cost: self.cost - along.norm_squared(),
            free: self.free + fresh.ncols(),
            transposed: basis.transpose(),
            basis,
            rows: self.rows,
        }
    }

    /// Inner products of columns beyond what is free. Of many as products: those are blocked for the cache; of a few column by
    /// column, which such a product would do by rows.
    fn own_gram(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        if columns.ncols() <= FEW {
            let along = self.basis.tr_mul(columns);
            return columns.tr_mul(columns) - along.tr_mul(&along);
        }
        let along = &self.transposed * columns;
        columns.transpose() * columns - along.transpose() * along
    }

    /// What a fit without these rows leaves there: `(I - H_bb)^-1 r_b`.
    pub fn held_out(&self, rows: &[usize]) -> DVector<f64> {
        let own = self.basis.select_rows(rows);
        let left = self.residuals.select_rows(rows);
        // The smaller of the two ways to say it: `(I - Q Q')^-1 = I + Q (I - Q'Q)^-1 Q'`.
        // A number that these rows alone determine cannot be held out: what they leave themselves is all there is.
        if own.nrows() <= own.ncols() {
            let inner = DMatrix::identity(own.nrows(), own.nrows()) - &own * own.transpose();
            return inner.cholesky().map_or_else(|| left.clone(), |factor| factor.solve(&left));
        }
        let inner = DMatrix::identity(own.ncols(), own.ncols()) - own.transpose() * &own;
        inner.cholesky().map_or_else(|| left.clone(), |factor| &left + &own * factor.solve(&own.tr_mul(&left)))
    }

    /// What these columns (whitened) explain of the residuals.
    pub fn gain(&self, columns: &DMatrix<f64>) -> Gain {
        let count = columns.ncols();
        let gram = scaled(&self.own_gram(columns), columns);
        let lengths = lengths_of(columns);
        let slope = DVector::from_iterator(
            count,
            columns.column_iter().zip(&lengths).map(|(column, length)| column.dot(&self.residuals) / length),
        );
        let (vectors, roots) = own_directions(&gram);
        let parts = vectors.transpose() * &slope;
        let mut explained = 0.0;
        let mut values = DVector::zeros(count);
        let mut variances = DVector::zeros(count);
        for (index, root) in roots.iter().enumerate() {
            let part = parts[index] / root;
            explained += part * part;
            for row in 0..count {
                let direction = vectors[(row, index)] / root;
                values[row] -= direction * part / lengths[row];
                variances[row] += (direction / lengths[row]).powi(2);
            }
        }
        let freedom = (self.rows as f64 - self.free as f64 - roots.len() as f64).max(1.0);
        let variance = (self.cost - explained).max(0.0) / freedom;
        Gain { explained, rank: roots.len(), values, sigmas: variances.map(|own: f64| (own * variance).sqrt()) }
    }

    /// Orthonormal directions of a candidate beyond what is free, to ask many residuals for.
    pub fn probe(&self, columns: &DMatrix<f64>) -> Probe {
        let gram = scaled(&self.own_gram(columns), columns);
        let (mut vectors, roots) = own_directions(&gram);
        for (mut vector, root) in vectors.column_iter_mut().zip(&roots) {
            vector /= *root;
        }
        let mut unit = columns.clone();
        for (mut column, length) in unit.column_iter_mut().zip(lengths_of(columns)) {
            column /= length;
        }
        Probe { directions: unit * vectors }
    }

    /// What a smooth function explains whose columns (whitened, the least smooth the smallest) all have one unknown size: the
    /// gain of ridge regression at the size with the strongest evidence (type-II maximum likelihood, MacKay 1992), and that
    /// evidence on the scale of [`super::evidence::penalised`].
    ///
    /// Its price is the dimensions that the records really show, `sum ln(1 + a l_i)`, not all that it could have.
    pub fn smooth_gain(&self, columns: &DMatrix<f64>, looked_at: f64) -> (Gain, f64) {
        let smooth = self.smooth(columns);
        let nothing = DVector::zeros(0);
        let rank = smooth.directions.len();
        let gain = Gain { explained: smooth.explained, rank, values: nothing.clone(), sigmas: nothing };
        (gain, smooth.evidence + (self.rows as f64).ln() + 2.0 * looked_at.ln())
    }

    /// The same with a smooth function free beside all else, held back by the size that [`Projection::smooth_gain`] finds for it:
    /// what a region that is held out has of it is what the others make believable, not where a polynomial runs away to.
    ///
    /// No free numbers are counted for it: what its weights cost at their likeliest size stays in [`Projection::cost`], and that is
    /// in the mean as much as they take of the noise (MacKay 1992).
    #[must_use]
    pub fn with_smooth(&self, columns: &DMatrix<f64>) -> Self {
        let Smooth { vectors, directions, size, .. } = self.smooth(columns);
        let beyond = columns - &self.basis * (&self.transposed * columns);
        let known = self.basis.ncols();
        let mut basis = self.basis.clone().resize_horizontally(known + directions.len(), 0.0);
        let mut residuals = self.residuals.clone();
        let mut cost = self.cost;
        // Orthonormal in the rows of records and priors together, of which only the upper ones are kept.
        for (place, direction) in directions.iter().enumerate() {
            let scale = (size / (1.0 + size * direction.own)).sqrt();
            let fresh = &beyond * vectors.column(direction.index) * scale;
            let along = direction.part * scale;
            residuals -= &fresh * along;
            cost -= along * along;
            basis.set_column(known + place, &fresh);
        }
        Self { transposed: basis.transpose(), basis, residuals, cost, rows: self.rows, free: self.free }
    }

    /// The size of a smooth function with the strongest evidence.
    fn smooth(&self, columns: &DMatrix<f64>) -> Smooth {
        let gram = self.own_gram(columns);
        let slope = columns.tr_mul(&self.residuals);
        let largest = columns.column_iter().map(|column| column.norm_squared()).fold(0.0, f64::max);
        let eigen = nalgebra::SymmetricEigen::new(gram);
        let parts = eigen.eigenvectors.tr_mul(&slope);
        let directions: Vec<Direction> = (0..parts.len())
            .map(|index| Direction { index, own: eigen.eigenvalues[index], part: parts[index] })
            .filter(|direction| direction.own > OWN_PART * OWN_PART * largest)
            .collect();
        let rows = self.rows as f64;
        let strongest = directions.iter().map(|direction| direction.own).fold(0.0, f64::max);
        let mut best = Smooth {
            vectors: eigen.eigenvectors,
            directions: Vec::new(),
            size: 0.0,
            explained: 0.0,
            evidence: f64::INFINITY,
        };
        for step in 0..SIZES {
            let size = 0.1 * 10f64.powf(0.5 * step as f64) / strongest.max(f64::MIN_POSITIVE);
            let explained: f64 = directions.iter().map(|one| one.part * one.part * size / (1.0 + size * one.own)).sum();
            let price: f64 = directions.iter().map(|one| (size * one.own).ln_1p()).sum();
            let left = (1.0 - explained / self.cost).max(1e-12);
            let evidence = rows * left.ln() + price;
            if evidence < best.evidence {
                (best.size, best.explained, best.evidence) = (size, explained, evidence);
            }
        }
        best.directions = directions;
        best
    }

    /// Residuals of other data after all that is free is projected out (what priors hold back left aside).
    pub fn projected(&self, residuals: &DVector<f64>) -> DVector<f64> {
        residuals - &self.basis * (&self.transposed * residuals)
    }
}

/// A Gram matrix for columns of unit length.
fn scaled(gram: &DMatrix<f64>, columns: &DMatrix<f64>) -> DMatrix<f64> {
    let lengths = lengths_of(columns);
    DMatrix::from_fn(gram.nrows(), gram.ncols(), |i, j| gram[(i, j)] / (lengths[i] * lengths[j]))
}

/// Length of each column; 1 for one that is zero.
fn lengths_of(columns: &DMatrix<f64>) -> Vec<f64> {
    let length = |norm: f64| if norm > 0.0 { norm } else { 1.0 };
    columns.column_iter().map(|column| length(column.norm())).collect()
}

/// Eigenvectors of a Gram matrix and roots of their eigenvalues, those that are the candidate's own.
fn own_directions(gram: &DMatrix<f64>) -> (DMatrix<f64>, Vec<f64>) {
    let eigen = nalgebra::SymmetricEigen::new(gram.clone());
    let kept: Vec<usize> =
        (0..eigen.eigenvalues.len()).filter(|&k| eigen.eigenvalues[k] > OWN_PART * OWN_PART).collect();
    let roots = kept.iter().map(|&k| eigen.eigenvalues[k].sqrt()).collect();
    (eigen.eigenvectors.select_columns(&kept), roots)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(rows: usize, columns: usize, seed: f64) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| ((i * 7 + j * 13 + i * j) as f64 * (0.37 + seed)).sin())
    }

    #[test]
    fn the_gain_is_that_of_the_full_regression() {
        let (free, columns) = (sample(60, 5, 0.0), sample(60, 2, 0.1));
        let y = DVector::from_fn(60, |i, _| (i as f64 * 1.7).cos() + 0.3 * columns[(i, 0)]);
        let sigmas = [10.0, 3.0, 1.0, 0.2, 5.0];
        let left = |columns: &DMatrix<f64>, extra: usize| {
            let mut stacked = DMatrix::zeros(65, 5 + extra);
            stacked.view_mut((0, 0), (60, 5)).copy_from(&free);
            stacked.view_mut((0, 5), (60, extra)).copy_from(&columns.columns(0, extra));
            for k in 0..5 {
                stacked[(60 + k, k)] = 1.0 / sigmas[k];
            }
            let mut right = DVector::zeros(65);
            right.rows_mut(0, 60).copy_from(&y);
            let solved = stacked.clone().svd(true, true).solve(&right, 1e-12).expect("factors");
            ((&right - &stacked * &solved).norm_squared(), solved)
        };
        let ((without, _), (with, solved)) = (left(&columns, 0), left(&columns, 2));
        let projection = Projection::new(&free, &sigmas, &y, &[0.0; 5]);
        let gain = projection.gain(&columns);
        assert!((projection.cost - without).abs() < 1e-9 * without);
        assert!((gain.explained - (without - with)).abs() < 1e-8 * without);
        // Residuals are model minus measurement: the parameter that undoes them has the other sign.
        assert!((gain.values[0] + solved[5]).abs() < 1e-8);
        let further = projection.with(&columns.columns(0, 1).into_owned());
        assert!(further.cost < projection.cost && further.free == 6);
    }

    #[test]
    fn held_out_rows_are_those_of_a_fit_without_them() {
        let free = sample(60, 5, 0.0);
        let y = DVector::from_fn(60, |i, _| (i as f64 * 1.7).cos());
        let projection = Projection::new(&free, &[2.0; 5], &y, &[0.0; 5]);
        for held in [(12..24).collect::<Vec<usize>>(), vec![3, 40]] {
            held_out_agrees(&free, &y, &projection, &held);
        }
    }

    #[test]
    fn a_smooth_function_is_held_out_as_ridge_regression_has_it() {
        let (free, columns) = (sample(60, 5, 0.0), sample(60, 4, 0.1));
        let y = DVector::from_fn(60, |i, _| 0.1 * (i as f64 * 1.7).cos() + 0.8 * columns[(i, 0)]);
        let projection = Projection::new(&free, &[2.0; 5], &y, &[0.0; 5]);
        let size = projection.smooth(&columns).size;
        // The same as one more free thing with a prior of that size.
        let mut all = free.resize_horizontally(9, 0.0);
        all.columns_mut(5, 4).copy_from(&columns);
        let sigmas: Vec<f64> = (0..9).map(|column| if column < 5 { 2.0 } else { size.sqrt() }).collect();
        let whole = Projection::new(&all, &sigmas, &y, &[0.0; 9]);
        let smooth = projection.with_smooth(&columns);
        let gain = projection.smooth_gain(&columns, 1.0).0;
        assert!(
            (smooth.cost - whole.cost).abs() < 1e-9 && (projection.cost - gain.explained - whole.cost).abs() < 1e-9
        );
        assert!((&smooth.residuals - &whole.residuals).norm() < 1e-9);
        for held in [(12..24).collect::<Vec<usize>>(), vec![3, 40]] {
            assert!((smooth.held_out(&held) - whole.held_out(&held)).norm() < 1e-9);
        }
    }

    fn held_out_agrees(free: &DMatrix<f64>, y: &DVector<f64>, projection: &Projection, held: &[usize]) {
        let kept: Vec<usize> = (0..60).filter(|row| !held.contains(row)).collect();
        let mut stacked = DMatrix::zeros(kept.len() + 5, 5);
        stacked.rows_mut(0, kept.len()).copy_from(&free.select_rows(&kept));
        stacked.view_mut((kept.len(), 0), (5, 5)).fill_diagonal(0.5);
        let mut right = DVector::zeros(kept.len() + 5);
        right.rows_mut(0, kept.len()).copy_from(&y.select_rows(&kept));
        let solved = stacked.svd(true, true).solve(&right, 1e-12).expect("factors");
        let expected = y.select_rows(held) - free.select_rows(held) * solved;
        assert!((projection.held_out(held) - expected).norm() < 1e-9);
    }

    #[test]
    fn what_is_free_already_explains_nothing() {
        let free = sample(60, 5, 0.0);
        let y = DVector::from_fn(60, |i, _| (i as f64 * 1.7).cos());
        let projection = Projection::new(&free, &[1e9; 5], &y, &[0.0; 5]);
        let again = projection.gain(&free.columns(1, 2).into_owned());
        assert_eq!((again.rank, again.explained), (0, 0.0));
        // Columns that move nothing are no obstacle to those beside them.
        let mut half_empty = DMatrix::zeros(60, 3);
        half_empty.set_column(1, &sample(60, 1, 0.1).column(0));
        let gain = projection.gain(&half_empty);
        assert!(gain.rank == 1 && gain.explained.is_finite() && gain.values[0] == 0.0);
    }
}

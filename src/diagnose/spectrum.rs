//! The strongest line in a sum of waves.

use nalgebra::{DMatrix, DVector};

use crate::learn::term::Term;

/// A line of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Waves a joint revolution.
    pub order: f64,
    /// Amplitude with its standard uncertainty, rad.
    pub amplitude_rad: [f64; 2],
}

/// Points along the measured range for each wave of the finest.
const POINTS_PER_WAVE: f64 = 8.0;
/// Orders tried on one line's width.
const ORDERS_ON_A_LINE: f64 = 8.0;

/// The strongest line of a curve over the range in which its angle was measured: by the discrete Fourier transform of the
/// curve, its mean taken off, at orders from one wave over the range to the finest of the curve.
///
/// # Arguments
/// * `at` - angles at the records, rad
/// * `weights`, `root` - of the waves, rad; `root' root` is their covariance
pub fn strongest_line(term: &Term, at: &[f64], weights: &DVector<f64>, root: &DMatrix<f64>) -> Line {
    let low = at.iter().copied().fold(f64::INFINITY, f64::min);
    let range = at.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low;
    let finest = term.frequency(term.columns.saturating_sub(1));
    let count = (POINTS_PER_WAVE * finest * range / std::f64::consts::TAU).ceil().max(16.0) as usize;
    let mut row = vec![0.0; term.columns];
    let mut waves = DMatrix::zeros(count, term.columns);
    let angle = |point: usize| low + range * (point as f64 + 0.5) / count as f64;
    for point in 0..count {
        term.waves_at(angle(point), &mut row);
        waves.row_mut(point).copy_from_slice(&row);
    }
    for mut column in waves.column_iter_mut() {
        let mean = column.mean();
        column.add_scalar_mut(-mean);
    }
    let values = &waves * weights;
    let transform = |order: f64| {
        let scale = 2.0 / count as f64;
        let sine = DVector::from_fn(count, |point, _| scale * (order * angle(point)).sin());
        let cosine = DVector::from_fn(count, |point, _| scale * (order * angle(point)).cos());
        (sine, cosine)
    };
    let amplitude = |order: f64| {
        let (sine, cosine) = transform(order);
        values.dot(&sine).hypot(values.dot(&cosine))
    };
    let width = std::f64::consts::TAU / range.max(f64::MIN_POSITIVE);
    let step = width / ORDERS_ON_A_LINE;
    let orders = (0..).map(|index| width + step * f64::from(index)).take_while(|order| *order <= finest);
    let (order, size) = orders
        .map(|order| (order, amplitude(order)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or((width, amplitude(width)));
    let (sine, cosine) = transform(order);
    let direction = (&sine * values.dot(&sine) + &cosine * values.dot(&cosine)) / size.max(f64::MIN_POSITIVE);
    let sigma = (root * waves.tr_mul(&direction)).norm();
    Line { order: (100.0 * order).round() / 100.0, amplitude_rad: [size, sigma] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::term::Waves;
    use crate::model::curves::Variable;

    #[test]
    fn the_line_of_a_single_wave_is_found() {
        let term = Term {
            turns: 0,
            along: Variable::Angle(1),
            sense_of: None,
            waves: Waves::Circle,
            start: -1.5,
            length: 3.0,
            columns: 60,
            bands: (0..30).map(|line| 2 * line).collect(),
        };
        let mut weights = DVector::zeros(60);
        // Sine and cosine of order 17 stand at 32 and 33.
        weights[32] = 3e-4;
        weights[33] = -4e-4;
        let at: Vec<f64> = (0..200).map(|index| -1.4 + 0.014 * f64::from(index)).collect();
        let line = strongest_line(&term, &at, &weights, &(DMatrix::identity(60, 60) * 1e-5));
        assert!((line.order - 17.0).abs() < 0.3, "{line:?}");
        assert!((line.amplitude_rad[0] - 5e-4).abs() < 2e-5, "{line:?}");
        assert!(line.amplitude_rad[1] > 0.0 && line.amplitude_rad[1] < 3e-5, "{line:?}");
    }
}

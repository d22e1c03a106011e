//! The strongest line in a sum of waves.

use nalgebra::{DMatrix, DVector};

use crate::learn::term::Term;

/// What a curve shows over the range in which its angle was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// Its strongest line.
    pub line: Line,
    /// How often that repeats in the range.
    pub repeats: f64,
    /// Part of its squares in the eighth of the range that has most of them.
    pub in_one_place: f64,
}

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
/// Places of a range that are looked at for where most of a curve is.
const PLACES: usize = 8;
/// Orders tried on one line's width.
const ORDERS_ON_A_LINE: f64 = 8.0;

/// The strongest line of a curve over the range in which its angle was measured, by the discrete Fourier transform of the
/// curve, its mean taken off, at orders from one wave over the range to the finest of the curve; and whether the curve is
/// everywhere or at one place.
///
/// # Arguments
/// * `at` - angles at the records, rad
/// * `weights`, `root` - of the waves, rad; `root' root` is their covariance
pub fn spectrum(term: &Term, at: &[f64], weights: &DVector<f64>, root: &DMatrix<f64>) -> Spectrum {
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
    Spectrum {
        line: Line { order: (100.0 * order).round() / 100.0, amplitude_rad: [size, sigma] },
        repeats: order / width,
        in_one_place: in_one_place(values.as_slice()),
    }
}

fn in_one_place(values: &[f64]) -> f64 {
    let square = |part: &[f64]| part.iter().map(|value| value * value).sum::<f64>();
    let most = values.windows(values.len().div_ceil(PLACES)).map(square).fold(0.0, f64::max);
    most / square(values).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::term::Waves;
    use crate::model::curves::Variable;

    #[test]
    fn a_bump_is_in_one_place() {
        let bump = |x: f64| (-0.5 * ((x - 0.3) / 0.03).powi(2)).exp() - 0.075;
        let values: Vec<f64> = (0..400).map(|index| bump(f64::from(index) / 400.0)).collect();
        assert!(in_one_place(&values) > 0.8, "{}", in_one_place(&values));
        assert_eq!(in_one_place(&[0.0; 16]), 0.0);
    }

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
        let spectrum = spectrum(&term, &at, &weights, &(DMatrix::identity(60, 60) * 1e-5));
        let line = spectrum.line;
        assert!((spectrum.repeats - 17.0 * 2.786 / std::f64::consts::TAU).abs() < 0.15, "{spectrum:?}");
        assert!((spectrum.in_one_place - 1.0 / 8.0).abs() < 0.03, "{spectrum:?}");
        assert!((line.order - 17.0).abs() < 0.3, "{line:?}");
        assert!((line.amplitude_rad[0] - 5e-4).abs() < 2e-5, "{line:?}");
        assert!(line.amplitude_rad[1] > 0.0 && line.amplitude_rad[1] < 3e-5, "{line:?}");
    }
}

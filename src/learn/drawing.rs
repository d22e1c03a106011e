//! From the weights of a term to the curve that a model file holds: bounded, and nothing where nothing was measured.

use nalgebra::{DMatrix, DVector};

use crate::model::curves::Curve;

use super::term::{Term, Waves};

/// What a regression says of one term.
#[derive(Clone, Debug)]
pub struct Evidenced {
    /// Weight of each wave, rad.
    pub weights: DVector<f64>,
    /// Root of the weights' covariance: a column for each.
    pub root: DMatrix<f64>,
    /// Where the variable was measured.
    pub measured: Vec<f64>,
}

/// Samples of the uncertainty along a smooth curve; fine ones have one at every other knot.
const SIGMA_POINTS: usize = 25;
/// No part of a curve is larger than this many times the largest that it is at a record.
const MOST_PER_RECORDED: f64 = 1.2;
/// Part of the interval without a record over which a curve holds; over as much again it goes to nothing. The distance
/// of an interval's end from its last record.
const HOLDS: f64 = 0.04;

/// A sum of waves as a spline. Sampled sines are cubic splines up to a factor, `3 / (2 + cos(w h))`, so that the spline
/// goes through the function at every knot (Unser 1999).
pub fn curve(term: &Term, evidenced: &Evidenced) -> Curve {
    // About six knots a wave of the finest, and three where a curve goes to nothing.
    let fewest = if term.waves == Waves::Interval { 4.0 } else { 3.0 / HOLDS };
    let cells = (term.frequency(term.columns - 1) * term.length).ceil().max(fewest) as usize;
    let step = term.length / cells as f64;
    let mut waves = vec![0.0; term.columns];
    let mut sum = |x: f64, factor: &dyn Fn(usize) -> f64| -> f64 {
        term.waves_at(x, &mut waves);
        waves.iter().enumerate().map(|(wave, value)| evidenced.weights[wave] * value * factor(wave)).sum()
    };
    let largest = evidenced.measured.iter().map(|&x| sum(x, &|_| 1.0).abs()).fold(0.0, f64::max);
    let mut measured = evidenced.measured.clone();
    measured.sort_by(f64::total_cmp);
    let coefficients_rad = (0..=cells)
        .map(|knot| {
            let x = term.start + step * knot as f64;
            let through = sum(x, &|wave| 3.0 / (2.0 + (term.frequency(wave) * step).cos()));
            let within = (MOST_PER_RECORDED * largest / sum(x, &|_| 1.0).abs().max(f64::MIN_POSITIVE)).min(1.0);
            rounded(through * within * support(term, &measured, x))
        })
        .collect();
    let sigma_points = match term.waves {
        Waves::Circle => (cells / 2).max(SIGMA_POINTS),
        _ => SIGMA_POINTS,
    };
    let mut waves = vec![0.0; term.columns];
    let sigma_rad = (0..sigma_points)
        .map(|point| {
            term.waves_at(term.start + term.length * point as f64 / (sigma_points - 1) as f64, &mut waves);
            rounded((&evidenced.root * DVector::from_column_slice(&waves)).norm())
        })
        .collect();
    Curve {
        turns: term.turns + 1,
        along: term.along,
        sense_of: term.sense_of.map(|joint| joint + 1),
        start: term.start,
        step,
        coefficients_rad,
        sigma_rad,
    }
}

/// One near a record, going to zero (a raised cosine) where there is none. Sines on an interval need none of it within
/// the interval: their prior draws them to zero over the length of their waves.
fn support(term: &Term, measured: &[f64], x: f64) -> f64 {
    let next = measured.partition_point(|&at| at < x);
    let neighbours = [next.checked_sub(1).and_then(|index| measured.get(index)), measured.get(next)];
    let away = neighbours.into_iter().flatten().map(|at| (at - x).abs()).fold(f64::INFINITY, f64::min);
    let holds = HOLDS * term.length;
    match term.waves {
        Waves::Interval => 1.0,
        _ => 0.5 + 0.5 * (std::f64::consts::PI * ((away - holds) / holds).clamp(0.0, 1.0)).cos(),
    }
}

/// To a hundredth of a nanoradian: files stay short.
fn rounded(angle_rad: f64) -> f64 {
    (angle_rad * 1e11).round() / 1e11
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::curves::Variable;

    fn evidenced(columns: usize, measured: Vec<f64>) -> Evidenced {
        let weights = DVector::from_fn(columns, |wave, _| 1e-4 * ((wave * 7 + 3) as f64).sin());
        Evidenced { weights, root: DMatrix::identity(columns, columns) * 1e-6, measured }
    }

    fn circle() -> Term {
        Term {
            turns: 2,
            along: Variable::Angle(3),
            sense_of: None,
            waves: Waves::Circle,
            start: -1.5,
            length: 3.0,
            columns: 20,
            bands: (0..10).map(|line| 2 * line).collect(),
        }
    }

    #[test]
    fn the_curve_goes_through_the_waves_where_records_are() {
        let term = circle();
        let evidenced = evidenced(20, (0..=100).map(|index| -1.4 + 0.028 * f64::from(index)).collect());
        let curve = curve(&term, &evidenced);
        for x in [-1.3, -0.2, 0.513, 1.2] {
            let expected: f64 = (1..=10)
                .map(|line| {
                    let angle = x * f64::from(line);
                    let weight = |wave: i32| 1e-4 * f64::from(wave * 7 + 3).sin();
                    weight(2 * line - 2) * angle.sin() + weight(2 * line - 1) * angle.cos()
                })
                .sum();
            assert!((curve.value(x) - expected).abs() < 1e-6, "{x}: {} {expected}", curve.value(x));
        }
    }

    #[test]
    fn nothing_is_corrected_where_nothing_was_measured() {
        let term = circle();
        // A gap from -0.5 to 0.7.
        let measured = (0..100)
            .map(|index| if index < 50 { -1.4 + 0.018 * f64::from(index) } else { 0.7 + 0.01 * f64::from(index - 50) });
        let curve = curve(&term, &evidenced(20, measured.collect()));
        assert_eq!(curve.value(0.1), 0.0);
        assert!(curve.value(-1.0) != 0.0 && curve.value(1.0) != 0.0);
        assert_eq!(curve.value(1.7), 0.0);
    }

    #[test]
    fn no_correction_is_much_larger_than_those_that_were_learned() {
        let term = circle();
        // Measured near one zero of the sum only: elsewhere the waves would be large.
        let measured: Vec<f64> = (0..200).map(|index| 0.4 + 1e-4 * f64::from(index)).collect();
        let evidenced = evidenced(20, measured.clone());
        let curve = curve(&term, &evidenced);
        let largest = measured.iter().map(|&x| curve.value(x).abs()).fold(0.0, f64::max);
        let anywhere = (0..3000).map(|index| curve.value(-1.5 + 1e-3 * f64::from(index)).abs()).fold(0.0, f64::max);
        assert!(anywhere <= 1.25 * largest && largest > 0.0, "{anywhere} {largest}");
    }
}

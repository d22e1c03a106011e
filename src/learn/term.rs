//! The functions of which a learner of joint errors may be made.
//!
//! A function on an interval is a sum of sines that vanish at its ends; how large each sine may be is the spectral
//! density of a Gaussian process (Solin and Särkkä 2020), here constant over bands of frequency and learned for each
//! band. Nothing is learned beyond the ends.

use std::f64::consts::PI;

use crate::model::curves::Variable;
use crate::model::robot::DOF;

use super::samples::Samples;

/// A function that turns one actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The actuator, from zero.
    pub turns: usize,
    /// The variable.
    pub along: Variable,
    /// The joint, from zero, whose sense of approach multiplies it.
    pub sense_of: Option<usize>,
    /// Where the interval starts, in the unit of the variable.
    pub start: f64,
    /// Its length.
    pub length: f64,
    /// Number of sines.
    pub sines: usize,
    /// First sine of each band.
    pub bands: Vec<usize>,
}

/// How fine a term may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Waves a revolution (of an angle), or over the range (of a torque), of the finest sine.
    pub finest: f64,
    /// Width of a band: ratio of its highest to its lowest frequency.
    pub band: f64,
}

/// The interval reaches this part of the measured range beyond it, on either side.
const MARGIN: f64 = 0.12;

impl Term {
    /// A term over the range of its variable in the records; `None` where the variable does not vary.
    pub fn over(
        samples: &Samples<'_>,
        turns: usize,
        along: Variable,
        sense_of: Option<usize>,
        resolution: Resolution,
    ) -> Option<Self> {
        let values = samples.actuators_rad.iter().zip(&samples.torque_nm).map(|(q, torque)| along.value(q, torque));
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let range = high - low;
        let unit = if let Variable::Torque(_) = along { range } else { 2.0 * PI };
        if !(range.is_finite() && range > 1e-3 && range > 1e-6 * unit) {
            return None;
        }
        let length = range * (1.0 + 2.0 * MARGIN);
        // Sine j makes j/2 waves over the length.
        let waves = |sine: usize| 0.5 * sine as f64 / length * unit;
        let sines = ((2.0 * resolution.finest * length / unit).ceil() as usize).max(2);
        let mut bands = vec![0];
        let mut lowest = waves(1);
        for sine in 2..=sines {
            if waves(sine) > lowest * resolution.band {
                bands.push(sine - 1);
                lowest = waves(sine);
            }
        }
        Some(Self { turns, along, sense_of, start: low - MARGIN * range, length, sines, bands })
    }

    /// Angular frequency of sine `index` (from zero), per unit of the variable.
    pub fn frequency(&self, index: usize) -> f64 {
        PI * (index + 1) as f64 / self.length
    }

    /// Band of sine `index`.
    pub fn band_of(&self, index: usize) -> usize {
        self.bands.iter().rposition(|&first| first <= index).unwrap_or(0)
    }

    /// The sines at a value of the variable, into `out`; zero beyond the ends.
    pub fn sines_at(&self, x: f64, out: &mut [f64]) {
        let phase = PI * (x - self.start) / self.length;
        if !(0.0..=PI).contains(&phase) {
            out.fill(0.0);
            return;
        }
        // sin((j+1) p) = 2 cos(p) sin(j p) - sin((j-1) p)
        let double = 2.0 * phase.cos();
        let (mut before, mut now) = (0.0, phase.sin());
        for number in out.iter_mut() {
            *number = now;
            (before, now) = (now, double * now - before);
        }
    }

    /// Value of the variable and factor by the sense of approach in a record.
    pub fn input(&self, samples: &Samples<'_>, record: usize) -> (f64, f64) {
        let x = self.along.value(&samples.actuators_rad[record], &samples.torque_nm[record]);
        let sense = self.sense_of.map_or(1.0, |joint| samples.observations[record].conditions.approach[joint]);
        (x, sense)
    }
}

/// Which terms a learner has, from few to many.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Each actuator by its own angle.
    Own,
    /// Also by its own torque, and by its own sense of approach along its angle.
    Loaded,
    /// Also smoothly by every other joint's angle.
    Crossed,
}

impl Family {
    /// All, the simplest first.
    pub const ALL: [Family; 3] = [Family::Own, Family::Loaded, Family::Crossed];
}

/// The terms of a family over the range of the records.
pub fn terms(samples: &Samples<'_>, family: Family, finest: f64) -> Vec<Term> {
    let band = std::f64::consts::SQRT_2;
    let own = Resolution { finest, band };
    let smooth = Resolution { finest: 4.0, band: 2.0 };
    let coarse = Resolution { finest: 3.0, band: 2.0 };
    let mut found = Vec::new();
    for joint in 0..DOF {
        found.extend(Term::over(samples, joint, Variable::Angle(joint + 1), None, own));
    }
    if family >= Family::Loaded {
        let senses = |joint: usize| {
            let of = |record: &&crate::measure::observation::Observation| record.conditions.approach[joint];
            samples.observations.iter().any(|record| of(record) != 0.0)
        };
        for joint in 0..DOF {
            found.extend(Term::over(samples, joint, Variable::Torque(joint + 1), None, coarse));
            if senses(joint) {
                found.extend(Term::over(samples, joint, Variable::Angle(joint + 1), Some(joint), smooth));
            }
        }
    }
    if family >= Family::Crossed {
        for joint in 0..DOF {
            for other in (0..DOF).filter(|&other| other != joint) {
                found.extend(Term::over(samples, joint, Variable::Angle(other + 1), None, coarse));
            }
        }
        found.extend(Term::over(samples, 1, Variable::Sum(2, 3), None, smooth));
        found.extend(Term::over(samples, 2, Variable::Sum(2, 3), None, smooth));
    }
    found
}

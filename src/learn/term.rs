//! The functions of which a learner of joint errors may be made.
//!
//! Two kinds of function, for two kinds of physics. A smooth function on an interval is a sum of sines that vanish at its
//! ends; how large each sine may be is the spectral density of a Gaussian process (Solin and Särkkä 2020), constant over
//! bands of frequency and learned for each band. What repeats with the turn of a joint (encoders, gears, bearings) is a
//! sum of whole waves a revolution, each with a variance of its own: few of them are there, and an angle measured twice,
//! a revolution apart, counts as one. Nothing is learned where nothing was measured.

use std::f64::consts::PI;

use crate::model::curves::Variable;
use crate::model::robot::DOF;

use super::samples::Samples;

/// Of what a function is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Waves {
    /// Sines on an interval, vanishing at its ends.
    Interval,
    /// Sine and cosine of whole multiples of an angle, in turn.
    Circle,
    /// One number.
    Constant,
}

/// A function that turns one actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// The actuator, from zero.
    pub turns: usize,
    /// The variable.
    pub along: Variable,
    /// The joint, from zero, whose sense of approach multiplies it.
    pub sense_of: Option<usize>,
    /// Of what it is made.
    pub waves: Waves,
    /// Where the interval starts, in the unit of the variable.
    pub start: f64,
    /// Its length.
    pub length: f64,
    /// Number of waves: columns in a regression.
    pub columns: usize,
    /// First wave of each group that shares a variance.
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

/// Change of a variable, rad or Nm, below which it does not vary.
const STILL: f64 = 1e-3;

impl Term {
    /// A smooth term over the range of its variable in the records; `None` where the variable does not vary.
    pub fn over(
        samples: &Samples<'_>,
        turns: usize,
        along: Variable,
        sense_of: Option<usize>,
        resolution: Resolution,
    ) -> Option<Self> {
        let (start, length) = interval(samples, along)?;
        let unit = if let Variable::Torque(_) = along { length / (1.0 + 2.0 * MARGIN) } else { 2.0 * PI };
        // Sine j makes j/2 waves over the length.
        let waves = |sine: usize| 0.5 * sine as f64 / length * unit;
        let columns = ((2.0 * resolution.finest * length / unit).ceil() as usize).max(2);
        let mut bands = vec![0];
        let mut lowest = waves(1);
        for sine in 2..=columns {
            if waves(sine) > lowest * resolution.band {
                bands.push(sine - 1);
                lowest = waves(sine);
            }
        }
        Some(Self { turns, along, sense_of, waves: Waves::Interval, start, length, columns, bands })
    }

    /// Whole waves of an actuator's own angle, one to `finest` a revolution; `None` where the joint does not turn.
    pub fn around(samples: &Samples<'_>, turns: usize, finest: usize) -> Option<Self> {
        let along = Variable::Angle(turns + 1);
        let (start, length) = interval(samples, along)?;
        let bands = (0..finest).map(|line| 2 * line).collect();
        Some(Self { turns, along, sense_of: None, waves: Waves::Circle, start, length, columns: 2 * finest, bands })
    }

    /// One number for an actuator, with the sign of its own sense of approach: it stops short against friction.
    pub fn short_of(samples: &Samples<'_>, turns: usize) -> Option<Self> {
        let along = Variable::Angle(turns + 1);
        let (start, length) = interval(samples, along)?;
        let sense_of = Some(turns);
        Some(Self { turns, along, sense_of, waves: Waves::Constant, start, length, columns: 1, bands: vec![0] })
    }

    /// Angular frequency of wave `index` (from zero), per unit of the variable.
    pub fn frequency(&self, index: usize) -> f64 {
        match self.waves {
            Waves::Interval => PI * (index + 1) as f64 / self.length,
            Waves::Circle => (index / 2 + 1) as f64,
            Waves::Constant => 0.0,
        }
    }

    /// Band of wave `index`.
    pub fn band_of(&self, index: usize) -> usize {
        match self.waves {
            Waves::Circle => index / 2,
            _ => self.bands.iter().rposition(|&first| first <= index).unwrap_or(0),
        }
    }

    /// True where neighbouring bands are alike: the spectrum of a smooth function is, that of a gear is lines.
    pub fn is_smooth(&self) -> bool {
        self.waves == Waves::Interval
    }

    /// The waves at a value of the variable, into `out`; zero beyond the ends of an interval.
    pub fn waves_at(&self, x: f64, out: &mut [f64]) {
        match self.waves {
            Waves::Interval => {
                let phase = PI * (x - self.start) / self.length;
                if !(0.0..=PI).contains(&phase) {
                    out.fill(0.0);
                    return;
                }
                for (number, (sine, _)) in out.iter_mut().zip(multiples(phase)) {
                    *number = sine;
                }
            }
            Waves::Circle => {
                for (pair, (sine, cosine)) in out.chunks_exact_mut(2).zip(multiples(x)) {
                    pair.copy_from_slice(&[sine, cosine]);
                }
            }
            Waves::Constant => out.fill(1.0),
        }
    }

    /// Value of the variable and factor by the sense of approach in a record.
    pub fn input(&self, samples: &Samples<'_>, record: usize) -> (f64, f64) {
        let x = self.along.value(&samples.actuators_rad[record], &samples.torque_nm[record]);
        let sense = self.sense_of.map_or(1.0, |joint| samples.observations[record].conditions.approach[joint]);
        (x, sense)
    }
}

/// Sine and cosine of one, two, three ... times an angle.
fn multiples(angle: f64) -> impl Iterator<Item = (f64, f64)> {
    let (sine, cosine) = angle.sin_cos();
    std::iter::successors(Some((sine, cosine)), move |&(s, c)| Some((s * cosine + c * sine, c * cosine - s * sine)))
}

/// Start and length of the interval on which a variable was measured, with a margin; `None` where it does not vary.
fn interval(samples: &Samples<'_>, along: Variable) -> Option<(f64, f64)> {
    let values = samples.actuators_rad.iter().zip(&samples.torque_nm).map(|(q, torque)| along.value(q, torque));
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let range = high - low;
    (range.is_finite() && range > STILL).then_some((low - MARGIN * range, range * (1.0 + 2.0 * MARGIN)))
}

/// Which terms a learner has, from few to many.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// Each actuator smoothly by its own angle, and by its own sense of approach.
    Own,
    /// The same, down to waves as fine as the records can bear.
    Fine,
    /// Each actuator by whole waves of its own angle, as fine, and by its own sense of approach.
    Lines,
    /// As [`Family::Own`]; also by its own torque, and by its own sense of approach along its angle.
    Loaded,
    /// Also smoothly by every other joint's angle.
    Crossed,
}

impl Family {
    /// All, the simplest first.
    pub const ALL: [Family; 5] = [Family::Own, Family::Fine, Family::Lines, Family::Loaded, Family::Crossed];
}

/// Waves a joint revolution of the finest smooth function. Public data of real arms show energy up to 30.
const FINEST: f64 = 40.0;
/// Waves a revolution of the finest of all: sub-divisions of encoders (128 pole pairs) and the first wave generator of a
/// harmonic drive (101) lie below.
const FINEST_OF_ALL: f64 = 140.0;
/// Part of the measured numbers that may be waves.
const COLUMNS_PER_ROW: f64 = 2.0 / 3.0;
/// The same for lines, each of which has a variance of its own: with fewer rows, chance picks among them.
const LINES_PER_ROW: f64 = 0.1;
/// Lever arm, against the longest, below which an actuator does not move the measured point.
const NO_LEVER: f64 = 1e-3;

/// Each actuator smoothly by its own angle, and by nothing else.
pub fn own_angles(samples: &Samples<'_>) -> Vec<Term> {
    let mut own = terms(samples, Family::Own);
    own.retain(|term| term.sense_of.is_none());
    own
}

/// The terms of a family over the range of the records; none where they are too few for it.
pub fn terms(samples: &Samples<'_>, family: Family) -> Vec<Term> {
    let band = std::f64::consts::SQRT_2;
    let own = Resolution { finest: FINEST, band };
    let smooth = Resolution { finest: 4.0, band: 2.0 };
    let coarse = Resolution { finest: 3.0, band: 2.0 };
    let longest = samples.levers.column_iter().map(|lever| lever.norm()).fold(0.0, f64::max);
    let joints: Vec<usize> =
        (0..DOF).filter(|&joint| samples.levers.column(joint).norm() > NO_LEVER * longest).collect();
    let senses = |joint: usize| samples.observations.iter().any(|record| record.conditions.approach[joint] != 0.0);
    let most_columns = COLUMNS_PER_ROW * samples.missing.len() as f64;
    let mut found = Vec::new();
    // Two columns for each wave a revolution, of each revolution that a joint's interval is long.
    let revolutions =
        |joint: usize| interval(samples, Variable::Angle(joint + 1)).map_or(0.0, |(_, length)| length / (2.0 * PI));
    let in_all = joints.iter().map(|&joint| revolutions(joint)).sum::<f64>();
    let finest = (0.5 * most_columns / in_all.max(f64::MIN_POSITIVE)).clamp(1.0, FINEST_OF_ALL);
    let lines = 0.5 * LINES_PER_ROW * samples.missing.len() as f64 / joints.len().max(1) as f64;
    let finest_line = lines.min(FINEST_OF_ALL) as usize;
    if family == Family::Lines && finest_line < FINEST as usize {
        return found;
    }
    for &joint in &joints {
        let by_angle = |resolution| Term::over(samples, joint, Variable::Angle(joint + 1), None, resolution);
        found.extend(match family {
            Family::Lines => Term::around(samples, joint, finest_line),
            Family::Fine => by_angle(Resolution { finest, band }),
            _ => by_angle(own),
        });
        if senses(joint) {
            found.extend(Term::short_of(samples, joint));
        }
    }
    if family >= Family::Loaded {
        for &joint in &joints {
            found.extend(Term::over(samples, joint, Variable::Torque(joint + 1), None, coarse));
            if senses(joint) {
                found.extend(Term::over(samples, joint, Variable::Angle(joint + 1), Some(joint), smooth));
            }
        }
    }
    if family >= Family::Crossed {
        for &joint in &joints {
            for other in (0..DOF).filter(|&other| other != joint) {
                found.extend(Term::over(samples, joint, Variable::Angle(other + 1), None, coarse));
            }
        }
        for joint in [1, 2].into_iter().filter(|joint| joints.contains(joint)) {
            found.extend(Term::over(samples, joint, Variable::Sum(2, 3), None, smooth));
        }
    }
    found
}

//! What a network of joint errors learns from: inputs, levers, geometry beside it, and what is missing.

use nalgebra::{DMatrix, DVector};

use crate::identify::state::State;
use crate::identify::unknown::Unknown;
use crate::learn::samples::Samples;
use crate::learn::subject::Subject;
use crate::model::network::Feature;
use crate::model::robot::DOF;

/// Spread of an input, in its own unit (sines, senses, Nm), below which it is constant and left out.
const STILL: f64 = 1e-3;
/// Lever arm, against the longest, below which an actuator does not move the measured point.
const NO_LEVER: f64 = 1e-3;

/// The inputs of all networks of a recording, standardised over it.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// What they are.
    pub features: Vec<Feature>,
    /// Mean of each.
    pub shift: Vec<f64>,
    /// Spread of each.
    pub scale: Vec<f64>,
    /// A column for each record.
    pub values: DMatrix<f64>,
}

impl Inputs {
    /// These features of the records, but for those that stand still in them.
    pub fn new(samples: &Samples<'_>, features: Vec<Feature>) -> Self {
        let count = samples.count();
        let turns: Vec<[(f64, f64); DOF]> =
            samples.actuators_rad.iter().map(|angles| angles.map(f64::sin_cos)).collect();
        let row = |feature: Feature| -> Vec<f64> {
            (0..count)
                .map(|record| {
                    let conditions = &samples.observations[record].conditions;
                    let (angles, torques) = (&samples.actuators_rad[record], &samples.torque_nm[record]);
                    feature.value(angles, &turns[record], torques, conditions)
                })
                .collect()
        };
        let mut inputs = Self { features: vec![], shift: vec![], scale: vec![], values: DMatrix::zeros(0, count) };
        let mut rows = Vec::new();
        for feature in features {
            let values = DVector::from_vec(row(feature));
            let spread = values.variance().sqrt();
            if spread > STILL {
                inputs.features.push(feature);
                inputs.shift.push(values.mean());
                inputs.scale.push(spread);
                rows.push(values.add_scalar(-values.mean()).transpose() / spread);
            }
        }
        inputs.values = DMatrix::from_fn(rows.len(), count, |input, record| rows[input][record]);
        inputs
    }
}

/// Records to learn from. Rows are whitened and follow the records.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// Standardised inputs, a column for each record.
    pub inputs: DMatrix<f64>,
    /// Change of a row per unit of each output: an output of one moves a row by about one.
    pub levers: DMatrix<f64>,
    /// Change of a row per unit of each number of geometry, in units of its prior.
    pub geometry: DMatrix<f64>,
    /// Measured less modelled, less what the mean of geometry's prior moves.
    pub missing: DVector<f64>,
    /// Record of each row.
    pub record_of: Vec<usize>,
}

/// The outputs that a network has: actuators that move the measured point, and how many radians one is.
#[derive(Clone, Debug)]
pub struct Outputs {
    /// Actuators, from zero.
    pub actuators: Vec<usize>,
    /// Radians of an output of one.
    pub unit_rad: Vec<f64>,
}

impl Outputs {
    /// Those of a recording that a network may turn.
    pub fn new(samples: &Samples<'_>, subject: &Subject) -> Self {
        let rows = samples.missing.len().max(1) as f64;
        let size = |actuator: usize| samples.levers.column(actuator).norm() / rows.sqrt();
        let longest = (0..DOF).map(size).fold(0.0, f64::max);
        let actuators: Vec<usize> =
            (0..DOF).filter(|&actuator| subject.turns(actuator) && size(actuator) > NO_LEVER * longest).collect();
        let unit_rad = actuators.iter().map(|&actuator| 1.0 / size(actuator)).collect();
        Self { actuators, unit_rad }
    }
}

/// Where the prior of geometry has its mean, in units of the prior, seen from a state.
pub fn prior_mean(state: &State, unknowns: &[Unknown]) -> DVector<f64> {
    let away = |unknown: &Unknown| {
        (unknown.prior.mean - state.get(unknown.id).unwrap_or(unknown.prior.mean)) / unknown.prior.sigma
    };
    DVector::from_iterator(unknowns.len(), unknowns.iter().map(away))
}

impl Lesson {
    /// Some records of a recording.
    pub fn new(
        samples: &Samples<'_>,
        inputs: &Inputs,
        outputs: &Outputs,
        prior_mean: &DVector<f64>,
        records: &[usize],
    ) -> Self {
        let rows: Vec<usize> = records.iter().flat_map(|&record| samples.rows_of(record)).collect();
        let place_of = |(place, &record): (usize, &usize)| std::iter::repeat_n(place, samples.rows_of(record).len());
        let mut levers = samples.levers.select_columns(&outputs.actuators).select_rows(&rows);
        for (mut column, unit) in levers.column_iter_mut().zip(&outputs.unit_rad) {
            column *= *unit;
        }
        let geometry = samples.geometry.select_rows(&rows);
        Self {
            inputs: inputs.values.select_columns(records),
            levers,
            missing: samples.missing.select_rows(&rows) - &geometry * prior_mean,
            geometry,
            record_of: records.iter().enumerate().flat_map(place_of).collect(),
        }
    }

    /// What outputs (a column for each record) move each row by.
    pub fn moved(&self, outputs: &DMatrix<f64>) -> DVector<f64> {
        let of_row = |(row, &record): (usize, &usize)| self.levers.row(row).transpose().dot(&outputs.column(record));
        DVector::from_iterator(self.record_of.len(), self.record_of.iter().enumerate().map(of_row))
    }
}

//! What a learner learns from: the residual of every record, and what moves it.

use nalgebra::{DMatrix, DVector};

use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;
use crate::identify::unknown::{Prior, Unknown, UnknownId};
use crate::measure::observation::Observation;
use crate::model::linkage::actuators_from_numbers;
use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::DOF;

/// Records as a learner sees them. Rows are whitened and follow [`Problem::records`].
#[derive(Clone, Debug)]
pub struct Samples<'a> {
    /// The records.
    pub observations: Vec<&'a Observation>,
    /// First row of each record, and the number of rows behind the last.
    pub rows: Vec<usize>,
    /// Measured minus modelled, whitened.
    pub missing: DVector<f64>,
    /// Change of the modelled position per rad of each actuator, whitened: a column for each.
    pub levers: DMatrix<f64>,
    /// Change per unit of each unknown of the identification, whitened and in units of its prior.
    pub geometry: DMatrix<f64>,
    /// Actuator angles, rad.
    pub actuators_rad: Vec<[f64; DOF]>,
    /// Load torques, Nm.
    pub torque_nm: Vec<[f64; DOF]>,
}

impl<'a> Samples<'a> {
    /// The records of a problem, seen from a state of the model.
    ///
    /// # Arguments
    /// * `unknowns` - what identification had free: a learner must leave it what belongs to it
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn new(problem: &Problem<'a>, state: &State, unknowns: &[Unknown]) -> Result<Self, NoPose> {
        let whitening = problem.whitening();
        let whitened = |mut matrix: DMatrix<f64>| {
            for mut column in matrix.column_iter_mut() {
                column.component_mul_assign(&whitening);
            }
            matrix
        };
        let any = Prior { mean: 0.0, sigma: 1.0 };
        let zeros: Vec<Unknown> = (0..DOF)
            .map(|joint| Unknown { id: UnknownId::Model(ParameterId::Row(joint, RowQuantity::Offset)), prior: any })
            .collect();
        let mut geometry = whitened(problem.jacobian(state, unknowns)?);
        for (mut column, unknown) in geometry.column_iter_mut().zip(unknowns) {
            column *= unknown.prior.sigma;
        }
        let prepared = state.model.prepared();
        let mut rows = problem.first_rows();
        rows.push(problem.rows());
        let observations: Vec<&Observation> = problem.records.iter().map(|record| record.observation).collect();
        let torque_nm = observations
            .iter()
            .map(|observation| {
                let stand = prepared.at(&observation.numbers_rad, &observation.conditions, None);
                stand.map_or([0.0; DOF], |stand| stand.statics.actuator_torque_nm)
            })
            .collect();
        Ok(Self {
            rows,
            missing: -problem.residuals(state)?.component_mul(&whitening),
            levers: whitened(problem.jacobian(state, &zeros)?),
            geometry,
            actuators_rad: observations
                .iter()
                .map(|observation| actuators_from_numbers(&state.model.robot, &observation.numbers_rad))
                .collect(),
            torque_nm,
            observations,
        })
    }

    /// Number of records.
    pub fn count(&self) -> usize {
        self.observations.len()
    }

    /// The rows of a record.
    pub fn rows_of(&self, record: usize) -> std::ops::Range<usize> {
        self.rows[record]..self.rows[record + 1]
    }
}

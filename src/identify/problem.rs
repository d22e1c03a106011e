//! Residuals and their derivatives: the one place where records meet the model.

use nalgebra::{DMatrix, DVector, Matrix3};
use rayon::prelude::*;

use crate::geometry::pose::Pose;
use crate::geometry::real::{DUAL_WIDTH, Dual, Real, derivatives, seeded};
use crate::measure::observation::{Measured, Observation};
use crate::model::arm::{ArmError, ArmState, PreparedArm};
use crate::model::chain::displacement_pose;
use crate::model::effect::{ModelScalar, Response};
use crate::model::robot::DOF;

use super::state::{State, Station};
use super::unknown::{Unknown, UnknownId};

/// A record with what a fit needs to know of it.
#[derive(Clone, Copy, Debug)]
pub struct Record<'a> {
    /// What was measured where.
    pub observation: &'a Observation,
    /// The measurement itself: only measured records enter a problem.
    pub measured: Measured,
    /// Index of its station in [`State::stations`].
    pub station: usize,
    /// Standard uncertainty of its position per axis, m.
    pub sigma_m: f64,
    /// Standard uncertainty of its orientation about each axis, rad.
    pub sigma_rad: f64,
}

/// Records to be fitted.
#[derive(Clone, Debug, Default)]
pub struct Problem<'a> {
    /// The records. Rows of residuals and Jacobians follow their order: x, y, z of the first, then its three
    /// orientation rows if it has them, then the second record.
    pub records: Vec<Record<'a>>,
}

/// The model has no pose for a record.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("record `{id}` (line {line}): {error}")]
pub struct NoPose {
    /// Index in [`Problem::records`].
    pub record: usize,
    /// Its name.
    pub id: String,
    /// Its line.
    pub line: usize,
    /// Why.
    pub error: ArmError,
}

impl<'a> Problem<'a> {
    /// The records at these indices.
    #[must_use]
    pub fn subset(&self, indices: &[usize]) -> Problem<'a> {
        Problem { records: indices.iter().filter_map(|&index| self.records.get(index).copied()).collect() }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.records.iter().map(|record| record.measured.numbers()).sum()
    }

    /// First row of each record.
    pub fn first_rows(&self) -> Vec<usize> {
        let mut next = 0;
        self.records
            .iter()
            .map(|record| {
                let first = next;
                next += record.measured.numbers();
                first
            })
            .collect()
    }

    /// Model minus measurement of every record, not whitened: metres in the station's frame, then the rotation that
    /// carries measured to modelled in the tool's frame, rad (its sine, which is the same for small ones).
    ///
    /// # Errors
    /// [`NoPose`] for the first record that the model cannot place.
    pub fn residuals(&self, state: &State) -> Result<DVector<f64>, NoPose> {
        let prepared = state.model.prepared();
        let stations: Vec<Pose> = state.stations.iter().map(Station::pose).collect();
        let parts: Vec<Rows<f64>> = self
            .records
            .par_iter()
            .enumerate()
            .map(|(index, record)| {
                rows_of(&prepared, &stations, record, None).map_err(|error| self.no_pose(index, error))
            })
            .collect::<Result<_, _>>()?;
        let mut all = DVector::zeros(self.rows());
        for (part, first) in parts.iter().zip(self.first_rows()) {
            for (row, number) in part.iter().enumerate() {
                all[first + row] = *number;
            }
        }
        Ok(all)
    }

    /// Derivatives of [`Problem::residuals`] by `unknowns`, not whitened: exact, by dual numbers,
    /// [`DUAL_WIDTH`] columns at a time.
    ///
    /// # Errors
    /// [`NoPose`] as there.
    pub fn jacobian(&self, state: &State, unknowns: &[Unknown]) -> Result<DMatrix<f64>, NoPose> {
        let firsts = self.first_rows();
        let mut jacobian = DMatrix::zeros(self.rows(), unknowns.len());
        // Equilibrium is found in plain numbers once; only the derivatives then have to settle.
        let stands = self.stands(state)?;
        for (chunk_index, chunk) in unknowns.chunks(DUAL_WIDTH).enumerate() {
            let (parameters, stations) = seeded_state(state, chunk);
            let prepared = state.model.prepare(parameters);
            let parts: Vec<Rows<Dual>> = self
                .records
                .par_iter()
                .enumerate()
                .map(|(index, record)| {
                    let start = stands[index].response.constant();
                    rows_of(&prepared, &stations, record, Some(&start)).map_err(|error| self.no_pose(index, error))
                })
                .collect::<Result<_, _>>()?;
            for (part, &first) in parts.iter().zip(&firsts) {
                for (row, number) in part.iter().enumerate() {
                    let slopes = derivatives(number);
                    for (slot, slope) in slopes.iter().take(chunk.len()).enumerate() {
                        jacobian[(first + row, chunk_index * DUAL_WIDTH + slot)] = *slope;
                    }
                }
            }
        }
        Ok(jacobian)
    }

    /// The arm at every record.
    ///
    /// # Errors
    /// [`NoPose`] as for [`Problem::residuals`].
    pub fn stands(&self, state: &State) -> Result<Vec<ArmState<f64>>, NoPose> {
        let prepared = state.model.prepared();
        let at = |(index, record): (usize, &Record<'_>)| {
            arm_at(&prepared, record.observation, None).map_err(|error| self.no_pose(index, error))
        };
        self.records.par_iter().enumerate().map(at).collect()
    }

    /// What [`Problem::jacobian`] gives, by differences: for looking at many numbers of which few are then fitted. Several
    /// times quicker, and right to about 1e-4 of the largest entry of a column.
    ///
    /// # Arguments
    /// * `stands` - the arm at every record in this state: each settles from there
    /// * `changes` - the unknowns, each with the step over which it is differentiated
    ///
    /// # Errors
    /// [`NoPose`] where a changed arm has none.
    pub fn differences(
        &self,
        state: &State,
        stands: &[ArmState<f64>],
        changes: &[(UnknownId, f64)],
    ) -> Result<DMatrix<f64>, NoPose> {
        let firsts = self.first_rows();
        let rows_in = |state: &State| -> Result<Vec<Rows<f64>>, NoPose> {
            let prepared = state.model.prepared();
            let stations: Vec<Pose> = state.stations.iter().map(Station::pose).collect();
            let rows = |(index, record): (usize, &Record<'_>)| {
                let start = stands.get(index).map(|stand| &stand.response);
                rows_of(&prepared, &stations, record, start).map_err(|error| self.no_pose(index, error))
            };
            self.records.iter().enumerate().map(rows).collect()
        };
        let before = rows_in(state)?;
        let columns: Vec<Vec<Rows<f64>>> = changes
            .par_iter()
            .map(|&(id, step)| {
                let mut changed = state.clone();
                changed.add(id, step);
                rows_in(&changed)
            })
            .collect::<Result<_, _>>()?;
        let mut all = DMatrix::zeros(self.rows(), changes.len());
        for ((column, after), (_, step)) in columns.iter().enumerate().zip(changes) {
            for ((before, after), first) in before.iter().zip(after).zip(&firsts) {
                for (row, (before, after)) in before.iter().zip(after.iter()).enumerate() {
                    all[(first + row, column)] = (after - before) / step;
                }
            }
        }
        Ok(all)
    }

    /// `1/sigma` of every row.
    pub fn whitening(&self) -> DVector<f64> {
        let rows = self.records.iter().flat_map(|record| {
            let position = [1.0 / record.sigma_m; 3];
            let rotation = record.measured.rotation.map(|_| [1.0 / record.sigma_rad; 3]);
            position.into_iter().chain(rotation.into_iter().flatten())
        });
        DVector::from_iterator(self.rows(), rows)
    }

    /// The largest static torque of each actuator over the records, Nm.
    pub fn largest_torque_nm(&self, state: &State) -> [f64; DOF] {
        let prepared = state.model.prepared();
        let mut largest = [0.0f64; DOF];
        for record in &self.records {
            if let Ok(stand) = arm_at(&prepared, record.observation, None) {
                for (largest, torque) in largest.iter_mut().zip(&stand.statics.actuator_torque_nm) {
                    *largest = largest.max(torque.abs());
                }
            }
        }
        largest
    }

    fn no_pose(&self, record: usize, error: ArmError) -> NoPose {
        let observation = self.records[record].observation;
        NoPose { record, id: observation.id.clone(), line: observation.line, error }
    }
}

/// The rows of a record: three or six numbers.
struct Rows<T> {
    numbers: [T; 6],
    count: usize,
}

impl<T> Rows<T> {
    fn iter(&self) -> impl Iterator<Item = &T> {
        self.numbers.iter().take(self.count)
    }
}

fn arm_at<T: ModelScalar>(
    prepared: &PreparedArm<'_, T>,
    observation: &Observation,
    start: Option<&Response<T>>,
) -> Result<ArmState<T>, ArmError> {
    prepared.at(&observation.numbers_rad.map(T::constant), &observation.conditions, start)
}

/// `station_T_tool` that the model expects for a record.
pub fn expected_pose<T: ModelScalar>(
    prepared: &PreparedArm<'_, T>,
    station_t_measuring: &Pose<T>,
    observation: &Observation,
) -> Result<Pose<T>, ArmError> {
    expected_from(prepared, station_t_measuring, observation, None)
}

fn expected_from<T: ModelScalar>(
    prepared: &PreparedArm<'_, T>,
    station_t_measuring: &Pose<T>,
    observation: &Observation,
    start: Option<&Response<T>>,
) -> Result<Pose<T>, ArmError> {
    let stand = arm_at(prepared, observation, start)?;
    Ok(*station_t_measuring * prepared.measured(&stand))
}

fn rows_of<T: ModelScalar>(
    prepared: &PreparedArm<'_, T>,
    stations: &[Pose<T>],
    record: &Record<'_>,
    start: Option<&Response<T>>,
) -> Result<Rows<T>, ArmError> {
    let station = stations.get(record.station).copied().unwrap_or_else(Pose::identity);
    let pose = expected_from(prepared, &station, record.observation, start)?;
    let away = pose.translation - record.measured.position_m.map(T::constant);
    let turn = match &record.measured.rotation {
        Some(measured) => sine_vector(&(measured.map(T::constant).transpose() * pose.rotation)),
        None => [T::zero(); 3],
    };
    let numbers = [away.x, away.y, away.z, turn[0], turn[1], turn[2]];
    Ok(Rows { numbers, count: record.measured.numbers() })
}

/// Axis times sine of the angle: the rotation vector for small turns, smooth everywhere.
fn sine_vector<T: Real>(rotation: &Matrix3<T>) -> [T; 3] {
    let half = T::constant(0.5);
    [
        (rotation[(2, 1)] - rotation[(1, 2)]) * half,
        (rotation[(0, 2)] - rotation[(2, 0)]) * half,
        (rotation[(1, 0)] - rotation[(0, 1)]) * half,
    ]
}

/// The state over dual numbers, the unknowns of `chunk` carrying one derivative each.
fn seeded_state(state: &State, chunk: &[Unknown]) -> (crate::model::parameters::Parameters<Dual>, Vec<Pose<Dual>>) {
    let mut parameters = state.model.parameters.map(Dual::constant);
    let mut displacements: Vec<[Dual; 6]> =
        state.stations.iter().map(|station| station.displacement.map(Dual::constant)).collect();
    for (slot, unknown) in chunk.iter().enumerate() {
        let number = match unknown.id {
            UnknownId::Model(id) => parameters.get_mut(id),
            UnknownId::Station { station, component } => {
                displacements.get_mut(station).and_then(|displacement| displacement.get_mut(component))
            }
        };
        if let Some(number) = number {
            *number = seeded(number.value(), slot);
        }
    }
    let stations = state
        .stations
        .iter()
        .zip(&displacements)
        .map(|(station, displacement)| Pose::constant(&station.station_t_measuring) * displacement_pose(displacement))
        .collect();
    (parameters, stations)
}

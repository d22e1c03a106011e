//! Columns: by how much each record moves for a unit of a candidate's parameters.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::problem::{NoPose, Problem};
use crate::identify::state::State;
use crate::identify::unknown::{Prior, Unknown, UnknownId};
use crate::geometry::real::DUAL_WIDTH;
use crate::model::arm::{ArmModel, ArmState, EffectInstance};
use crate::model::effect::{Context, Response};
use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::DOF;
use crate::model::statics::{Load, largest_torque_nm};

use super::candidate::Candidate;

/// A prior for columns that are only differentiated.
const ANY: Prior = Prior { mean: 0.0, sigma: 1.0 };

/// Derivatives at one state, whitened, from which the columns of candidates are made.
pub struct Regressors<'a, 'p> {
    /// The records.
    pub problem: &'p Problem<'a>,
    /// Record of each row.
    pub record_of: Vec<usize>,
    /// The arm at each record.
    pub stands: Vec<ArmState<f64>>,
    /// Movement by a turn of each actuator.
    pub joints: DMatrix<f64>,
    /// Movement by a displacement of the base.
    pub base: DMatrix<f64>,
    /// Movement by a displacement of the measured point.
    pub tool: DMatrix<f64>,
    state: &'p State,
    whitening: DVector<f64>,
    largest_torque_nm: [f64; DOF],
}

impl<'a, 'p> Regressors<'a, 'p> {
    /// Evaluates the arm at every record.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn new(problem: &'p Problem<'a>, state: &'p State) -> Result<Self, NoPose> {
        let whitening = problem.whitening();
        let ids = |ids: Vec<ParameterId>| -> Result<DMatrix<f64>, NoPose> {
            let unknowns: Vec<Unknown> =
                ids.into_iter().map(|id| Unknown { id: UnknownId::Model(id), prior: ANY }).collect();
            Ok(whitened(problem.jacobian(state, &unknowns)?, &whitening))
        };
        let prepared = state.model.prepared();
        let stands = problem
            .records
            .par_iter()
            .enumerate()
            .map(|(index, record)| {
                let observation = record.observation;
                prepared.at(&observation.numbers_rad, &observation.conditions, None).map_err(|error| NoPose {
                    record: index,
                    id: observation.id.clone(),
                    line: observation.line,
                    error,
                })
            })
            .collect::<Result<_, _>>()?;
        let record_of = problem
            .records
            .iter()
            .enumerate()
            .flat_map(|(index, record)| std::iter::repeat_n(index, record.measured.numbers()))
            .collect();
        Ok(Self {
            record_of,
            stands,
            joints: ids((0..DOF).map(|joint| ParameterId::Row(joint, RowQuantity::Offset)).collect())?,
            base: ids((0..6).map(ParameterId::Base).collect())?,
            tool: ids((0..6).map(ParameterId::Tool).collect())?,
            problem,
            state,
            largest_torque_nm: std::array::from_fn(|joint| largest_torque_nm(&state.model.robot, joint)),
            whitening,
        })
    }

    /// The model at which everything is differentiated.
    pub fn model(&self) -> &ArmModel {
        &self.state.model
    }

    /// Exact derivatives of every candidate at zero, by dual numbers, several candidates a pass.
    ///
    /// # Errors
    /// [`NoPose`] as above.
    pub fn exact(&self, candidates: &[Candidate]) -> Result<Vec<DMatrix<f64>>, NoPose> {
        let count = |candidate: &Candidate| -> usize {
            candidate.instances.iter().map(|instance| instance.effect.meta().parameters.len()).sum()
        };
        let mut columns = Vec::with_capacity(candidates.len());
        let mut rest = candidates;
        while !rest.is_empty() {
            let (mut taken, mut width) = (0, 0);
            while taken < rest.len() && (taken == 0 || width + count(&rest[taken]) <= DUAL_WIDTH) {
                width += count(&rest[taken]);
                taken += 1;
            }
            let instances: Vec<EffectInstance> =
                rest[..taken].iter().flat_map(|candidate| candidate.instances.clone()).collect();
            let all = self.derivatives(&instances)?;
            let mut first = 0;
            for candidate in &rest[..taken] {
                columns.push(all.columns(first, count(candidate)).into_owned());
                first += count(candidate);
            }
            rest = &rest[taken..];
        }
        Ok(columns)
    }

    fn derivatives(&self, instances: &[EffectInstance]) -> Result<DMatrix<f64>, NoPose> {
        let mut state = self.state.clone();
        let ids = extend(&mut state.model, instances);
        let unknowns: Vec<Unknown> =
            ids.into_iter().map(|id| Unknown { id: UnknownId::Model(id), prior: ANY }).collect();
        Ok(whitened(self.problem.jacobian(&state, &unknowns)?, &self.whitening))
    }

    /// The columns of an effect that only turns actuators or displaces base and tool, in proportion to its parameters:
    /// its own response times the levers. Quick enough for scans over orders and moments.
    pub fn through(&self, instance: &EffectInstance) -> DMatrix<f64> {
        let count = instance.effect.meta().parameters.len();
        let robot = &self.state.model.robot;
        let mut columns = DMatrix::zeros(self.record_of.len(), count);
        let mut row = 0;
        for (record, stand) in self.problem.records.iter().zip(&self.stands) {
            let conditions = &record.observation.conditions;
            let load = Load::declared(robot, conditions.payload.as_ref());
            let context = Context {
                robot,
                largest_torque_nm: &self.largest_torque_nm,
                conditions,
                actuators_rad: &stand.actuators_rad,
                angles: &stand.angles,
                chain: &stand.chain,
                statics: &stand.statics,
                load: &load,
            };
            let rows = record.measured.numbers();
            for column in 0..count {
                let mut unit = vec![0.0; count];
                unit[column] = 1.0;
                let mut response = Response::none();
                instance.effect.respond_plain(&instance.location, &unit, &context, &mut response);
                for part in row..row + rows {
                    columns[(part, column)] = self.moved(part, &response);
                }
            }
            row += rows;
        }
        columns
    }

    fn moved(&self, row: usize, response: &Response<f64>) -> f64 {
        let sum = |levers: &DMatrix<f64>, by: &[f64; 6]| -> f64 {
            by.iter().enumerate().filter(|(_, by)| **by != 0.0).map(|(k, by)| levers[(row, k)] * by).sum()
        };
        sum(&self.joints, &response.actuators_rad) + sum(&self.base, &response.base) + sum(&self.tool, &response.tool)
    }
}

/// Adds effects to a model, all parameters zero; returns the names of their parameters.
pub fn extend(model: &mut ArmModel, instances: &[EffectInstance]) -> Vec<ParameterId> {
    let mut ids = Vec::new();
    for instance in instances {
        let (index, count) = (model.effects.len(), instance.effect.meta().parameters.len());
        model.effects.push(*instance);
        model.parameters.effects.push(vec![0.0; count]);
        ids.extend((0..count).map(|parameter| ParameterId::Effect(index, parameter)));
    }
    ids
}

fn whitened(mut matrix: DMatrix<f64>, whitening: &DVector<f64>) -> DMatrix<f64> {
    for mut column in matrix.column_iter_mut() {
        column.component_mul_assign(whitening);
    }
    matrix
}

//! Columns: by how much each record moves for a unit of a candidate's parameters.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::problem::{NoPose, Problem, Record};
use crate::identify::state::State;
use crate::identify::unknown::UnknownId;
use crate::model::arm::{ArmModel, ArmState, EffectInstance};
use crate::model::effect::{Context, EFFECTS, Location, Place, Response, Setting};
use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::DOF;
use crate::model::statics::{Load, largest_torque_nm};

use super::candidate::Candidate;

/// Part of its usual size by which a parameter is changed to see what it does: small enough for what is not
/// proportional to it to vanish.
const STEP: f64 = 1e-6;
/// The same for effects that change loads or move links: large enough for the equilibrium to be settled beside it.
const DIFFERENCE: f64 = 0.1;
/// The smallest such part that is tried.
const SMALLEST_DIFFERENCE: f64 = 1e-4;
/// Turn or shift, rad or m, by which levers are found.
const MOVED: f64 = 1e-5;
/// An order that stays at its start over any joint range.
const NEVER_ROUND: f64 = 1e-12;

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
    /// Movement by a tilt of each joint axis about x and about y.
    tilts: DMatrix<f64>,
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
        let stands = problem.stands(state)?;
        let ids = |ids: Vec<ParameterId>| -> Result<DMatrix<f64>, NoPose> {
            let changes: Vec<(UnknownId, f64)> = ids.into_iter().map(|id| (UnknownId::Model(id), MOVED)).collect();
            Ok(whitened(problem.differences(state, &stands, &changes)?, &whitening))
        };
        let joints = ids((0..DOF).map(|joint| ParameterId::Row(joint, RowQuantity::Offset)).collect())?;
        let base = ids((0..6).map(ParameterId::Base).collect())?;
        let tool = ids((0..6).map(ParameterId::Tool).collect())?;
        let record_of = problem
            .records
            .iter()
            .enumerate()
            .flat_map(|(index, record)| std::iter::repeat_n(index, record.measured.numbers()))
            .collect();
        let mut all = Self {
            record_of,
            stands,
            joints,
            base,
            tool,
            tilts: DMatrix::zeros(0, 0),
            problem,
            state,
            largest_torque_nm: std::array::from_fn(|joint| largest_torque_nm(&state.model.robot, joint)),
            whitening,
        };
        all.tilts = all.tilt_levers()?;
        Ok(all)
    }

    /// A wobble that never comes round is a tilt: its cosines are the levers.
    fn tilt_levers(&self) -> Result<DMatrix<f64>, NoPose> {
        let wobble = EFFECTS.iter().copied().find(|effect| effect.meta().place == Place::JointOwnOrder);
        let Some(effect) = wobble else { return Ok(DMatrix::zeros(self.record_of.len(), 2 * DOF)) };
        let still = |joint: usize| Location { order: Some(NEVER_ROUND), ..Location::at_joint(joint) };
        let instances: Vec<EffectInstance> =
            (0..DOF).map(|joint| EffectInstance { effect, location: still(joint) }).collect();
        let all = self.derivatives(&instances)?;
        let cosines: Vec<usize> = (0..DOF).flat_map(|joint| [4 * joint + 1, 4 * joint + 3]).collect();
        Ok(all.select_columns(&cosines))
    }

    /// The model at which everything is differentiated.
    pub fn model(&self) -> &ArmModel {
        &self.state.model
    }

    /// Derivatives of every candidate at zero: through the levers where it acts through those, else by differences.
    ///
    /// # Errors
    /// [`NoPose`] when the model cannot place a record.
    pub fn columns(&self, candidates: &[Candidate]) -> Result<Vec<DMatrix<f64>>, NoPose> {
        let mut pending: Vec<EffectInstance> = Vec::new();
        let parts: Vec<Vec<Option<DMatrix<f64>>>> = candidates
            .par_iter()
            .map(|candidate| {
                candidate.instances.iter().map(|one| self.acts_through_levers(one).then(|| self.through(one))).collect()
            })
            .collect();
        for (candidate, parts) in candidates.iter().zip(&parts) {
            let missing = candidate.instances.iter().zip(parts).filter(|(_, part)| part.is_none());
            pending.extend(missing.map(|(instance, _)| *instance));
        }
        let mut exact = self.exact(&pending)?.into_iter();
        Ok(parts
            .into_iter()
            .map(|parts| {
                let blocks: Vec<DMatrix<f64>> =
                    parts.into_iter().filter_map(|part| part.or_else(|| exact.next())).collect();
                side_by_side(&blocks, self.record_of.len())
            })
            .collect())
    }

    /// True for an effect that turns actuators, tilts axes or displaces base and tool, and changes no load.
    fn acts_through_levers(&self, instance: &EffectInstance) -> bool {
        let robot = &self.state.model.robot;
        let steps: Vec<f64> = instance.effect.meta().parameters.iter().map(|meta| STEP * meta.typical).collect();
        self.problem.records.iter().zip(&self.stands).all(|(record, stand)| {
            let conditions = &record.observation.conditions;
            let declared = Load::declared(robot, conditions.payload.as_ref());
            let mut load = declared;
            let setting = Setting { robot, conditions, actuators_rad: &stand.actuators_rad };
            instance.effect.load_plain(&instance.location, &steps, &setting, &mut load);
            let mut response = Response::none();
            instance.effect.respond_plain(
                &instance.location,
                &steps,
                &self.context(record, stand, &declared),
                &mut response,
            );
            let unchanged = load.gravity_m_s2 == declared.gravity_m_s2
                && load.payload_kg == declared.payload_kg
                && load.payload_moment_kg_m == declared.payload_moment_kg_m
                && load.device_torque_nm == declared.device_torque_nm;
            unchanged && !response.links_move
        })
    }

    fn exact(&self, instances: &[EffectInstance]) -> Result<Vec<DMatrix<f64>>, NoPose> {
        let all = self.derivatives(instances)?;
        let mut first = 0;
        let block = |instance: &EffectInstance| {
            let count = instance.effect.meta().parameters.len();
            first += count;
            all.columns(first - count, count).into_owned()
        };
        Ok(instances.iter().map(block).collect())
    }

    fn derivatives(&self, instances: &[EffectInstance]) -> Result<DMatrix<f64>, NoPose> {
        // One effect at a time: one that is off costs time all the same.
        let block = |instance: &EffectInstance| {
            let mut state = self.state.clone();
            let ids = extend(&mut state.model, std::slice::from_ref(instance));
            let with_step = |part: f64| {
                let steps = instance.effect.meta().parameters.iter().map(|meta| part * meta.typical);
                let changes: Vec<(UnknownId, f64)> = ids.iter().copied().map(UnknownId::Model).zip(steps).collect();
                self.problem.differences(&state, &self.stands, &changes)
            };
            // What is usual for large arms may leave a small one without an equilibrium.
            let mut found = with_step(DIFFERENCE);
            let mut part = DIFFERENCE;
            while found.is_err() && part > SMALLEST_DIFFERENCE {
                part *= 0.1;
                found = with_step(part);
            }
            found
        };
        let blocks: Vec<DMatrix<f64>> = instances.par_iter().map(block).collect::<Result<_, _>>()?;
        Ok(whitened(side_by_side(&blocks, self.record_of.len()), &self.whitening))
    }

    /// The columns of an effect that acts through the levers: its own response to a small parameter times the levers.
    /// Quick enough for scans over orders and moments.
    pub fn through(&self, instance: &EffectInstance) -> DMatrix<f64> {
        let meta = instance.effect.meta();
        let count = meta.parameters.len();
        let mut columns = DMatrix::zeros(self.record_of.len(), count);
        let mut parameters = vec![0.0; count];
        let mut row = 0;
        for (record, stand) in self.problem.records.iter().zip(&self.stands) {
            let load = Load::declared(&self.state.model.robot, record.observation.conditions.payload.as_ref());
            let context = self.context(record, stand, &load);
            let rows = record.measured.numbers();
            for column in 0..count {
                let step = STEP * meta.parameters[column].typical;
                parameters[column] = step;
                let mut response = Response::none();
                instance.effect.respond_plain(&instance.location, &parameters, &context, &mut response);
                parameters[column] = 0.0;
                for part in row..row + rows {
                    columns[(part, column)] = self.moved(part, &response) / step;
                }
            }
            row += rows;
        }
        columns
    }

    fn context<'c>(
        &'c self,
        record: &'c Record<'_>,
        stand: &'c ArmState<f64>,
        load: &'c Load<f64>,
    ) -> Context<'c, f64> {
        Context {
            robot: &self.state.model.robot,
            largest_torque_nm: &self.largest_torque_nm,
            conditions: &record.observation.conditions,
            actuators_rad: &stand.actuators_rad,
            angles: &stand.angles,
            chain: &stand.chain,
            statics: &stand.statics,
            load,
        }
    }

    fn moved(&self, row: usize, response: &Response<f64>) -> f64 {
        let sum = |levers: &DMatrix<f64>, by: &[f64; 6]| -> f64 {
            by.iter().enumerate().filter(|(_, by)| **by != 0.0).map(|(k, by)| levers[(row, k)] * by).sum()
        };
        let mut moved = sum(&self.joints, &response.actuators_rad) + sum(&self.tool, &response.tool);
        if response.base_moves {
            moved += sum(&self.base, &response.base);
        }
        if response.axes_tilt {
            for (joint, tilt) in response.tilt.iter().enumerate() {
                moved += self.tilts[(row, 2 * joint)] * tilt.x + self.tilts[(row, 2 * joint + 1)] * tilt.y;
            }
        }
        moved
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

/// Matrices of as many rows side by side.
pub fn side_by_side(blocks: &[DMatrix<f64>], rows: usize) -> DMatrix<f64> {
    if let [only] = blocks {
        return only.clone();
    }
    let mut all = DMatrix::zeros(rows, blocks.iter().map(DMatrix::ncols).sum());
    let mut first = 0;
    for block in blocks {
        all.columns_mut(first, block.ncols()).copy_from(block);
        first += block.ncols();
    }
    all
}

fn whitened(mut matrix: DMatrix<f64>, whitening: &DVector<f64>) -> DMatrix<f64> {
    for mut column in matrix.column_iter_mut() {
        column.component_mul_assign(whitening);
    }
    matrix
}

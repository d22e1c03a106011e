//! One pass over all targets of a job: the false target of each, its digits, its edits. On all processors, in waves: what
//! comes out is in the order of the program and the same on any number of them.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::base::edit::EditSet;
use crate::geometry::pose::Pose;
use crate::model::robot::{DOF, Robot};
use crate::program::target::{Program, TargetValue};

use super::arrivals::Arrivals;
use super::class::Class;
use super::correct::Job;
use super::digits;
use super::displaced;
use super::false_target::{FalseTarget, Work};
use super::outcome::TargetOutcome;
use super::setting::Obstacle;

/// Targets that one processor takes at once: a millisecond or two.
const PORTION: usize = 256;
/// Targets between two gatherings of what was found.
const WAVE: usize = 64 * PORTION;

/// What a pass finds.
pub struct Pass {
    /// One a target.
    pub outcomes: Vec<TargetOutcome>,
    /// Joint numbers of the corrected targets, exactly, rad; empty where nobody asks.
    pub commanded: Vec<Option<[f64; DOF]>>,
    /// The edits of each file of the job.
    pub edits: Vec<EditSet>,
}

/// A target from which others are displaced: exactly, and as it will be read.
#[derive(Clone, Copy)]
struct Base {
    exact: Pose,
    read: Pose,
}

/// What was found for some targets.
struct Portion {
    found: Vec<Found>,
    edits: Vec<EditSet>,
}

/// What was found for one target.
struct Found {
    outcome: TargetOutcome,
    corrected: Option<([f64; DOF], Base)>,
}

/// Corrects every target; `with_commands` keeps the joint numbers.
pub fn pass(work: &Work<'_>, arrivals: &Arrivals, with_commands: bool) -> Pass {
    let program = work.job.program;
    let count = program.targets.len();
    let mut gathered = Gathered {
        pass: Pass {
            outcomes: vec![TargetOutcome::left(Class::Computed, None); count],
            commanded: if with_commands { vec![None; count] } else { Vec::new() },
            edits: vec![EditSet::default(); work.job.sources.len()],
        },
        bases: bases(program),
    };
    let is_displaced = |index: usize| matches!(program.targets[index].value, TargetValue::Displaced(_));
    for start in (0..count).step_by(WAVE) {
        let wave: Vec<usize> = (start..count.min(start + WAVE)).filter(|&index| !is_displaced(index)).collect();
        let portion = |indices: &[usize]| portion(work, arrivals, indices, &HashMap::new());
        match wave.len() {
            // Threads cost more than so few targets.
            ..=PORTION => gathered.take(&wave, portion(&wave)),
            _ => {
                let portions: Vec<Portion> = wave.par_chunks(PORTION).map(portion).collect();
                wave.chunks(PORTION).zip(portions).for_each(|(indices, portion)| gathered.take(indices, portion));
            }
        }
    }
    // Displaced targets need the corrected values of their bases, which may stand later in the text.
    for index in (0..count).filter(|&index| is_displaced(index)) {
        let portion = portion(work, arrivals, &[index], &gathered.bases);
        gathered.take(&[index], portion);
    }
    gathered.pass
}

/// The targets from which others are displaced.
fn bases(program: &Program) -> HashMap<usize, Option<Base>> {
    let base = |value: &TargetValue| match value {
        TargetValue::Displaced(displacement) => Some((displacement.base, None)),
        _ => None,
    };
    program.targets.iter().filter_map(|target| base(&target.value)).collect()
}

struct Gathered {
    pass: Pass,
    /// Those that are corrected, as far as that is known.
    bases: HashMap<usize, Option<Base>>,
}

impl Gathered {
    fn take(&mut self, indices: &[usize], portion: Portion) {
        for (&index, Found { outcome, corrected }) in indices.iter().zip(portion.found) {
            self.pass.outcomes[index] = outcome;
            if let Some((numbers_rad, base)) = corrected {
                if let Some(place) = self.pass.commanded.get_mut(index) {
                    *place = Some(numbers_rad);
                }
                if let Some(place) = self.bases.get_mut(&index) {
                    *place = Some(base);
                }
            }
        }
        self.pass.edits.iter_mut().zip(&portion.edits).for_each(|(all, some)| all.append(some));
    }
}

fn portion(work: &Work<'_>, arrivals: &Arrivals, indices: &[usize], bases: &HashMap<usize, Option<Base>>) -> Portion {
    let mut edits = vec![EditSet::default(); work.job.sources.len()];
    let found = indices.iter().map(|&index| one(work, arrivals, index, bases, &mut edits)).collect();
    Portion { found, edits }
}

fn one(
    work: &Work<'_>,
    arrivals: &Arrivals,
    index: usize,
    bases: &HashMap<usize, Option<Base>>,
    edits: &mut [EditSet],
) -> Found {
    if let Some(outcome) = work.left_alone(index) {
        return Found { outcome, corrected: None };
    }
    let base = |index: usize| bases.get(&index).copied().flatten();
    match work.false_target(index, arrivals, &|index| base(index).map(|base| base.exact)) {
        Ok(exact) => {
            let read = write(work.job, work.arm.robot(), index, &exact, &base, edits);
            let outcome = TargetOutcome {
                class: Class::Corrected,
                reason: arrivals.both_sides(index),
                figures: Some(exact.figures),
                shared: false,
            };
            Found { outcome, corrected: Some((exact.numbers_rad, Base { exact: exact.after, read })) }
        }
        Err(Obstacle { class, reason, shared }) => {
            let outcome = TargetOutcome { shared, ..TargetOutcome::left(class, reason) };
            Found { outcome, corrected: None }
        }
    }
}

/// Adds the edits of a target; gives it as it will be read.
fn write(
    job: &Job<'_>,
    robot: &Robot,
    index: usize,
    exact: &FalseTarget,
    base: &dyn Fn(usize) -> Option<Base>,
    edits: &mut [EditSet],
) -> Pose {
    let target = &job.program.targets[index];
    let (source, edits, rules) = (&job.sources[target.file], &mut edits[target.file], &job.rules);
    if exact.figures.iterations == 0 {
        return exact.after;
    }
    match &target.value {
        TargetValue::Cartesian(numbers) => return digits::write_pose(edits, source, numbers, rules, &exact.after),
        TargetValue::Joint(numbers) => {
            let reach_m = robot.joints.iter().map(|joint| joint.a_m.abs() + joint.d_m.abs()).sum();
            digits::write_joints(edits, source, numbers, rules, &exact.numbers_rad, reach_m);
        }
        TargetValue::Displaced(displacement) => {
            if let Some(base) = base(displacement.base) {
                let point = &exact.after.translation;
                let by = displaced::displacement_to(&base.read, point, displacement.kind);
                digits::write_position(edits, source, &displacement.position, displacement.units, rules, &by);
            }
        }
        TargetValue::Counts | TargetValue::Unwritten => {}
    }
    exact.after
}

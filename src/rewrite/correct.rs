//! The main job: every target of a program replaced by the one that makes the real arm land where it was meant.

use crate::base::edit::EditSet;
use crate::base::text::Source;
use crate::files::calibration::Region;
use crate::files::cell::Cell;
use crate::invert::RealArm;
use crate::kinematics::controller::Controller;
use crate::model::arm::ArmModel;
use crate::model::robot::DOF;
use crate::program::number::NumberRules;
use crate::program::target::{Program, TargetValue};

use super::arrivals::Arrivals;
use super::digits;
use super::false_target::Work;
use super::outcome::{Outcome, TargetOutcome};
use super::pass::{Pass, pass};
use super::setting::Settings;
use super::visits::{Senses, Visit, follow, senses};

/// What the caller may ask for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Rewrite joint targets too.
    pub joint_targets: bool,
    /// Refuse targets outside this region.
    pub inside_only: Option<Region>,
}

/// A program with everything that its correction needs.
pub struct Job<'a> {
    /// The files.
    pub sources: &'a [Source],
    /// What the dialect read from them.
    pub program: &'a Program,
    /// How the dialect lets numbers be written.
    pub rules: NumberRules,
    /// Tools and frames that the program names but does not hold.
    pub cell: &'a Cell,
}

/// Rounds in which senses of approach and corrected commands are brought to agree.
const SENSE_ROUNDS: usize = 4;

/// Corrects the targets of a job. Nothing is written here: the outcome holds the edits.
pub fn correct(job: &Job<'_>, model: &ArmModel, controller: &Controller, options: &Options) -> Outcome {
    let arm = RealArm::new(model);
    let mut settings = Settings::new(job.program, job.cell, &arm);
    let arrivals = Arrivals::new(follow(job.program, &mut settings, controller), job.program.targets.len());
    let work = Work { job, arm, controller, settings, options };
    let Pass { outcomes, mut edits, .. } = match model.depends_on_approach() {
        true => pass_by_senses(&work, arrivals),
        false => pass(&work, &arrivals, false),
    };
    write_repeated_of_others(job, &outcomes, &mut edits);
    Outcome { targets: outcomes, edits }
}

/// A correction of a milliradian can turn the sense in which a joint arrives: then it is the corrected command's sense that
/// counts. Where none agrees with itself, the joint is taken in the middle of its play.
fn pass_by_senses(work: &Work<'_>, mut arrivals: Arrivals) -> Pass {
    let of = |visits: &[Visit], commanded: &dyn Fn(&Visit) -> Option<[f64; DOF]>| {
        senses(work.job.program, work.controller, visits, commanded)
    };
    let found = of(&arrivals.visits, &Visit::numbers_rad);
    arrivals.senses = Some(found);
    let mut last = pass(work, &arrivals, true);
    for round in 1..=SENSE_ROUNDS {
        let commanded = |visit: &Visit| last.commanded[visit.target()].or_else(|| visit.numbers_rad());
        let found = of(&arrivals.visits, &commanded);
        let Some(known) = arrivals.senses.as_mut().filter(|known| **known != found) else { break };
        settle(known, &found, round == SENSE_ROUNDS);
        drop(last);
        last = pass(work, &arrivals, true);
    }
    last
}

/// Takes the senses that were found; in the `last` round zero for those that do not agree.
fn settle(known: &mut [Senses], found: &[Senses], last: bool) {
    for (known, found) in known.iter_mut().flatten().zip(found.iter().flatten()) {
        *known = if last && known != found { 0 } else { *found };
    }
}

/// A target that stays as it is must not take over corrected numbers of the one before.
fn write_repeated_of_others(job: &Job<'_>, outcomes: &[TargetOutcome], edits: &mut [EditSet]) {
    for (target, outcome) in job.program.targets.iter().zip(outcomes) {
        let changed = outcome.figures.is_some_and(|figures| figures.iterations > 0);
        if let (TargetValue::Cartesian(numbers), false, false) = (&target.value, changed, edits[target.file].is_empty())
        {
            digits::write_all_repeated(&mut edits[target.file], &job.sources[target.file], numbers);
        }
    }
}

//! The main job: every target of a program replaced by the one that makes the real arm land where it was meant.

use crate::base::edit::EditSet;
use crate::base::text::Source;
use crate::files::calibration::Region;
use crate::files::cell::Cell;
use crate::geometry::pose::{Pose, pose_difference};
use crate::invert::{Correction, MeantPose, RealArm};
use crate::kinematics::controller::Controller;
use crate::model::arm::ArmModel;
use crate::model::conditions::Conditions;
use crate::model::robot::DOF;
use crate::program::number::NumberRules;
use crate::program::target::{Displacement, Program, TargetValue};

use super::class::{Class, class_by_text};
use super::digits;
use super::displaced;
use super::outcome::{Figures, Outcome, TargetOutcome};
use super::setting::{Obstacle, Setting, Settings};
use super::visits::{Visit, follow};

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

/// Two false targets of one written target may differ by this much and still count as one: 1 um, 1 urad.
const SAME_TARGET: f64 = 1e-6;
/// Orientation, rad, that a displaced target may leave uncorrected: a hundredth of a degree.
const DISPLACED_ORIENTATION_RAD: f64 = 1.75e-4;

/// Corrects the targets of a job. Nothing is written here: the outcome holds the edits.
pub fn correct(job: &Job<'_>, model: &ArmModel, controller: &Controller, options: &Options) -> Outcome {
    let arm = RealArm::new(model);
    let mut settings = Settings::new(job.program, job.cell, &arm);
    let visits = follow(job.program, &mut settings, controller, options.joint_targets);
    let mut of_target: Vec<Vec<&Visit>> = vec![Vec::new(); job.program.targets.len()];
    for visit in &visits {
        of_target[visit.target].push(visit);
    }
    let edits = vec![EditSet::default(); job.sources.len()];
    let mut work = Work { job, model, arm, controller, settings, options, edits, outcomes: Vec::new() };
    // Displaced targets need the corrected values of their bases, which may stand later in the text.
    let count = job.program.targets.len();
    let is_displaced = |index: &usize| matches!(job.program.targets[*index].value, TargetValue::Displaced(_));
    let (later, first): (Vec<usize>, Vec<usize>) = (0..count).partition(is_displaced);
    let placeholder = TargetOutcome::left(Class::Computed, None);
    work.outcomes = vec![placeholder; count];
    for index in first.into_iter().chain(later) {
        work.outcomes[index] = work.target(index, &of_target[index]);
    }
    Outcome { targets: work.outcomes, edits: work.edits }
}

struct Work<'a> {
    job: &'a Job<'a>,
    model: &'a ArmModel,
    arm: RealArm<'a>,
    controller: &'a Controller,
    settings: Settings<'a>,
    options: &'a Options,
    edits: Vec<EditSet>,
    outcomes: Vec<TargetOutcome>,
}

/// The false target for one way of arriving.
struct FalseTarget {
    figures: Figures,
    setting: usize,
    use_line: usize,
}

impl Work<'_> {
    fn target(&mut self, index: usize, visits: &[&Visit]) -> TargetOutcome {
        let target = &self.job.program.targets[index];
        let (class, reason) = class_by_text(target);
        let by_text_alone = match class {
            Class::Corrected => false,
            Class::Joint => !self.options.joint_targets,
            Class::Computed | Class::Refused => true,
        };
        if by_text_alone {
            return TargetOutcome::left(class, reason);
        }
        match self.false_target(index, visits) {
            Ok(figures) => self.write(index, figures),
            Err(obstacle) => TargetOutcome::left(obstacle.class, obstacle.reason),
        }
    }

    /// One false target that serves every arrival, or the reason why there is none.
    fn false_target(&self, index: usize, visits: &[&Visit]) -> Result<Figures, Obstacle> {
        let mut found: Vec<FalseTarget> = Vec::new();
        let approach = common_approach(visits);
        for visit in visits {
            if found.iter().any(|known| known.setting == visit.setting) {
                continue;
            }
            let figures = self.arrival(index, visit, approach)?;
            let one = &self.job.program.targets[index].uses[visit.one_use];
            let use_line = self.job.sources[one.file].line(one.span.start);
            found.push(FalseTarget { figures, setting: visit.setting, use_line });
        }
        let mut all = found.into_iter();
        let Some(first) = all.next() else {
            return Err(Obstacle::computed("no move goes there as written"));
        };
        for other in all {
            let (shift, turn) = pose_difference(&other.figures.after, &first.figures.after);
            if shift.norm() > SAME_TARGET || turn.norm() > SAME_TARGET {
                return Err(Obstacle::refused(format!(
                    "used with different tools, frames or loads in lines {} and {}: no single value lands for both",
                    first.use_line, other.use_line
                )));
            }
        }
        Ok(first.figures)
    }

    fn arrival(&self, index: usize, visit: &Visit, approach: [f64; DOF]) -> Result<Figures, Obstacle> {
        let setting = self.settings.get(visit.setting).as_ref().map_err(Obstacle::clone)?;
        let nominal_rad = visit.nominal_rad.clone()?;
        let conditions = Conditions { approach, payload: setting.payload, ..Conditions::default() };
        let figures = match &self.job.program.targets[index].value {
            TargetValue::Displaced(displacement) => {
                self.displaced(displacement, setting, visit, &nominal_rad, &conditions)?
            }
            _ => self.full_pose(index, setting, visit, &nominal_rad, &conditions)?,
        };
        if let Some(region) = &self.options.inside_only {
            check_region(region, &figures.numbers_rad)?;
        }
        Ok(figures)
    }

    /// All six coordinates.
    fn full_pose(
        &self,
        index: usize,
        setting: &Setting,
        visit: &Visit,
        nominal_rad: &[f64; DOF],
        conditions: &Conditions,
    ) -> Result<Figures, Obstacle> {
        let forward = |numbers: &[f64; DOF]| {
            self.controller.forward(numbers).map_err(|error| Obstacle::refused(error.to_string()))
        };
        // A joint target means the pose that the nominal robot takes there.
        let is_joint = matches!(self.job.program.targets[index].value, TargetValue::Joint(_));
        let written = if is_joint { setting.target(&forward(nominal_rad)?) } else { visit.written };
        let meant = MeantPose { base_t_flange: setting.meant_flange(&written), conditions };
        let correction = self.arm.command(&meant, nominal_rad).map_err(|error| Obstacle::refused(error.to_string()))?;
        // With nothing to correct the target stays the very numbers it was.
        let after =
            if correction.iterations == 0 { written } else { setting.target(&forward(&correction.numbers_rad)?) };
        let lands_before = self.lands(setting, nominal_rad, conditions)?;
        Ok(figures(&correction, *nominal_rad, written, after, lands_before))
    }

    /// The position alone, with the orientation that the base target got.
    fn displaced(
        &self,
        displacement: &Displacement,
        setting: &Setting,
        visit: &Visit,
        nominal_rad: &[f64; DOF],
        conditions: &Conditions,
    ) -> Result<Figures, Obstacle> {
        let base = &self.outcomes[displacement.base];
        let Some(base_figures) = base.figures.as_ref().filter(|_| base.class == Class::Corrected) else {
            return Err(Obstacle::computed("displaced from a target that is not corrected itself"));
        };
        let meant = visit.written;
        let start = displaced::displaced(&base_figures.after, displacement);
        let landing =
            displaced::land_position(&self.arm, self.controller, setting, conditions, &meant, &start, nominal_rad)?;
        if landing.orientation_left_rad > DISPLACED_ORIENTATION_RAD {
            return Err(Obstacle::computed(format!(
                "displaced too far from its base target: {:.4} deg of orientation error would stay",
                landing.orientation_left_rad.to_degrees()
            )));
        }
        if let Some(violation) = self.arm.robot().limit_violation(&landing.numbers_rad, 0.0) {
            return Err(Obstacle::refused(violation.to_string()));
        }
        let lands_before = self.lands(setting, nominal_rad, conditions)?;
        let (shift, turn) = pose_difference(&landing.target, &meant);
        Ok(Figures {
            correction_m: shift.norm(),
            correction_rad: turn.norm(),
            iterations: landing.rounds,
            nominal_rad: *nominal_rad,
            numbers_rad: landing.numbers_rad,
            before: meant,
            after: landing.target,
            lands_before,
            orientation_left_rad: landing.orientation_left_rad,
        })
    }

    fn lands(&self, setting: &Setting, numbers: &[f64; DOF], conditions: &Conditions) -> Result<Pose, Obstacle> {
        let flange = self.arm.flange(numbers, conditions).map_err(|error| Obstacle::refused(error.to_string()))?;
        Ok(setting.landed(&flange))
    }

    /// Adds the edits of a target and completes its figures with what the digits make of them.
    fn write(&mut self, index: usize, mut figures: Figures) -> TargetOutcome {
        let target = &self.job.program.targets[index];
        let source = &self.job.sources[target.file];
        let edits = &mut self.edits[target.file];
        let rules = &self.job.rules;
        if figures.iterations > 0 {
            match &target.value {
                TargetValue::Cartesian(numbers) => {
                    figures.after = digits::write_pose(edits, source, numbers, rules, &figures.after);
                }
                TargetValue::Joint(numbers) => {
                    let reach_m = self.model.robot.joints.iter().map(|joint| joint.a_m.abs() + joint.d_m.abs()).sum();
                    figures.numbers_rad =
                        digits::write_joints(edits, source, numbers, rules, &figures.numbers_rad, reach_m);
                }
                TargetValue::Displaced(displacement) => {
                    if let Some(base) = &self.outcomes[displacement.base].figures {
                        let kind = displacement.kind;
                        let exact = displaced::displacement_to(&base.after, &figures.after.translation, kind);
                        let units = displacement.units;
                        digits::write_position(edits, source, &displacement.position, units, rules, &exact);
                    }
                }
                TargetValue::Unwritten => {}
            }
        }
        TargetOutcome { class: Class::Corrected, reason: None, figures: Some(figures) }
    }
}

fn figures(correction: &Correction, nominal_rad: [f64; DOF], before: Pose, after: Pose, lands_before: Pose) -> Figures {
    let (shift, turn) = pose_difference(&after, &before);
    Figures {
        correction_m: shift.norm(),
        correction_rad: turn.norm(),
        iterations: correction.iterations,
        nominal_rad,
        numbers_rad: correction.numbers_rad,
        before,
        after,
        lands_before,
        orientation_left_rad: correction.left_rad,
    }
}

/// The sense that all arrivals share; zero for a joint that arrives from both sides.
fn common_approach(visits: &[&Visit]) -> [f64; DOF] {
    std::array::from_fn(|joint| {
        let mut senses = visits.iter().map(|visit| visit.approach[joint]);
        let first = senses.next().unwrap_or(0.0);
        if senses.all(|sense| sense == first) { first } else { 0.0 }
    })
}

fn check_region(region: &Region, numbers_rad: &[f64; DOF]) -> Result<(), Obstacle> {
    for (joint, &number) in numbers_rad.iter().enumerate() {
        if number < region.min_rad[joint] || number > region.max_rad[joint] {
            return Err(Obstacle::refused(format!(
                "outside the calibrated region: joint {} at {:.2} deg, measured from {:.2} to {:.2} deg",
                joint + 1,
                number.to_degrees(),
                region.min_rad[joint].to_degrees(),
                region.max_rad[joint].to_degrees()
            )));
        }
    }
    Ok(())
}

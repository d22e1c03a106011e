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
use super::spin;
use super::visits::{Visit, follow, senses};
use super::words;

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

/// Rounds in which senses of approach and corrected commands are brought to agree.
const SENSE_ROUNDS: usize = 4;

/// Corrects the targets of a job. Nothing is written here: the outcome holds the edits.
pub fn correct(job: &Job<'_>, model: &ArmModel, controller: &Controller, options: &Options) -> Outcome {
    let arm = RealArm::new(model);
    let mut settings = Settings::new(job.program, job.cell, &arm);
    let visits = follow(job.program, &mut settings, controller);
    let work = Work { job, arm, controller, settings, options };
    let nominal = |index: usize| visits[index].nominal_rad.as_ref().ok().copied();
    let by_sense = model.depends_on_approach();
    let mut approaches = match by_sense {
        true => senses(job.program, controller, &visits, nominal),
        false => vec![[0.0; DOF]; visits.len()],
    };
    let mut outcomes = work.all(&visits, &approaches);
    // A correction of a milliradian can turn the sense in which a joint arrives: then it is the corrected command's
    // sense that counts. Where none agrees with itself, the joint is taken in the middle of its play.
    for round in 0..if by_sense { SENSE_ROUNDS } else { 0 } {
        let commanded = |index: usize| {
            let figures = outcomes[visits[index].target].figures.as_ref();
            figures.map(|figures| figures.numbers_rad).or_else(|| nominal(index))
        };
        let next = senses(job.program, controller, &visits, commanded);
        if next == approaches {
            break;
        }
        let last = round + 1 == SENSE_ROUNDS;
        for (known, found) in approaches.iter_mut().flatten().zip(next.iter().flatten()) {
            *known = if last && *known != *found { 0.0 } else { *found };
        }
        outcomes = work.all(&visits, &approaches);
    }
    let mut edits = vec![EditSet::default(); job.sources.len()];
    for index in in_order_of_dependence(job.program) {
        write(job, model, &mut outcomes, index, &mut edits);
    }
    write_repeated_of_others(job, &outcomes, &mut edits);
    Outcome { targets: outcomes, edits }
}

/// Displaced targets need the corrected values of their bases, which may stand later in the text: bases first.
fn in_order_of_dependence(program: &Program) -> impl Iterator<Item = usize> {
    let is_displaced = |index: &usize| matches!(program.targets[*index].value, TargetValue::Displaced(_));
    let (later, first): (Vec<usize>, Vec<usize>) = (0..program.targets.len()).partition(is_displaced);
    first.into_iter().chain(later)
}

struct Work<'a> {
    job: &'a Job<'a>,
    arm: RealArm<'a>,
    controller: &'a Controller,
    settings: Settings<'a>,
    options: &'a Options,
}

/// An arrival and the sense in which every joint comes there.
type Arrival<'a> = (&'a Visit, &'a [f64; DOF]);

/// The false target for one way of arriving.
struct FalseTarget {
    figures: Figures,
    setting: usize,
    use_line: usize,
}

impl Work<'_> {
    /// The outcome of every target, digits not yet rounded.
    fn all(&self, visits: &[Visit], approaches: &[[f64; DOF]]) -> Vec<TargetOutcome> {
        let count = self.job.program.targets.len();
        let mut arrivals: Vec<Arrival<'_>> = visits.iter().zip(approaches).collect();
        arrivals.sort_by_key(|(visit, _)| visit.target);
        let mut of_target: Vec<&[Arrival<'_>]> = vec![&[]; count];
        for group in arrivals.chunk_by(|(one, _), (other, _)| one.target == other.target) {
            of_target[group[0].0.target] = group;
        }
        let mut outcomes = vec![TargetOutcome::left(Class::Computed, None); count];
        for index in in_order_of_dependence(self.job.program) {
            outcomes[index] = self.target(index, of_target[index], &outcomes);
        }
        outcomes
    }

    fn target(&self, index: usize, arrivals: &[Arrival<'_>], outcomes: &[TargetOutcome]) -> TargetOutcome {
        let target = &self.job.program.targets[index];
        let (class, reason) = class_by_text(self.job.program, self.job.sources, target);
        let by_text_alone = match class {
            Class::Corrected => false,
            Class::Joint => !self.options.joint_targets,
            Class::Computed | Class::Refused => true,
        };
        if by_text_alone {
            return TargetOutcome::left(class, reason);
        }
        if self.job.program.read_only.contains(&target.file) {
            let reason = "stands in a file that other programs share, which is never written";
            let class = if class == Class::Joint { Class::Joint } else { Class::Computed };
            return TargetOutcome::left(class, reason.to_string());
        }
        match self.false_target(index, arrivals, outcomes) {
            Ok(figures) => TargetOutcome {
                class: Class::Corrected,
                reason: both_sides(arrivals),
                figures: Some(figures),
                shared: false,
            },
            Err(Obstacle { class, reason, shared }) => TargetOutcome { shared, ..TargetOutcome::left(class, reason) },
        }
    }

    /// One false target that serves every arrival, or the reason why there is none.
    fn false_target(
        &self,
        index: usize,
        arrivals: &[Arrival<'_>],
        outcomes: &[TargetOutcome],
    ) -> Result<Figures, Obstacle> {
        let mut found: Vec<FalseTarget> = Vec::new();
        let approach = common_approach(arrivals);
        for (visit, _) in arrivals {
            if found.iter().any(|known| known.setting == visit.setting) {
                continue;
            }
            let figures = self.arrival(index, visit, approach, outcomes)?;
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
                let reason = format!(
                    "used with different tools, frames or loads in lines {} and {}: no single value lands for both",
                    first.use_line, other.use_line
                );
                return Err(Obstacle { shared: true, ..Obstacle::refused(reason) });
            }
        }
        Ok(first.figures)
    }

    fn arrival(
        &self,
        index: usize,
        visit: &Visit,
        approach: [f64; DOF],
        outcomes: &[TargetOutcome],
    ) -> Result<Figures, Obstacle> {
        let setting = &*self.settings.at(visit.setting, &self.job.program.targets[index])?;
        let nominal_rad = visit.nominal_rad.clone()?;
        let conditions = Conditions { approach, payload: setting.payload, ..Conditions::default() };
        let figures = match &self.job.program.targets[index].value {
            TargetValue::Displaced(displacement) => {
                let base = &outcomes[displacement.base];
                self.displaced(base, displacement, setting, visit, &nominal_rad, &conditions)?
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
        let in_words = |error| Obstacle::refused(words::no_command(&error, self.controller, nominal_rad));
        let command = |meant: &Pose| {
            let meant_pose = MeantPose { base_t_flange: setting.meant_flange(meant), conditions };
            let correction = self.arm.command(&meant_pose, nominal_rad).map_err(in_words)?;
            // With nothing to correct the target stays the very numbers it was.
            let after =
                if correction.iterations == 0 { *meant } else { setting.target(&forward(&correction.numbers_rad)?) };
            Ok((correction, after))
        };
        let (correction, after) = match &self.job.program.targets[index].value {
            TargetValue::Cartesian(numbers) if numbers.convention.spin_rule().is_some() => {
                spin::along_axis(numbers.convention, &written, command)?
            }
            _ => command(&written)?,
        };
        let lands_before = setting.landed(&correction.nominal_lands);
        Ok(figures(&correction, *nominal_rad, written, after, lands_before))
    }

    /// The position alone, with the orientation that the base target got.
    fn displaced(
        &self,
        base: &TargetOutcome,
        displacement: &Displacement,
        setting: &Setting,
        visit: &Visit,
        nominal_rad: &[f64; DOF],
        conditions: &Conditions,
    ) -> Result<Figures, Obstacle> {
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
}

/// Adds the edits of a target and completes its figures with what the digits make of them.
fn write(job: &Job<'_>, model: &ArmModel, outcomes: &mut [TargetOutcome], index: usize, edits: &mut [EditSet]) {
    let target = &job.program.targets[index];
    let Some(mut figures) = outcomes[index].figures.take() else {
        return;
    };
    let (source, edits, rules) = (&job.sources[target.file], &mut edits[target.file], &job.rules);
    if figures.iterations > 0 {
        match &target.value {
            TargetValue::Cartesian(numbers) => {
                figures.after = digits::write_pose(edits, source, numbers, rules, &figures.after);
            }
            TargetValue::Joint(numbers) => {
                let reach_m = model.robot.joints.iter().map(|joint| joint.a_m.abs() + joint.d_m.abs()).sum();
                let exact = &figures.numbers_rad;
                figures.numbers_rad = digits::write_joints(edits, source, numbers, rules, exact, reach_m);
            }
            TargetValue::Displaced(displacement) => {
                if let Some(base) = &outcomes[displacement.base].figures {
                    let point = &figures.after.translation;
                    let exact = displaced::displacement_to(&base.after, point, displacement.kind);
                    let units = displacement.units;
                    digits::write_position(edits, source, &displacement.position, units, rules, &exact);
                }
            }
            TargetValue::Counts | TargetValue::Unwritten => {}
        }
    }
    outcomes[index].figures = Some(figures);
}

/// A target that stays as it is must not take over corrected numbers of the one before.
fn write_repeated_of_others(job: &Job<'_>, outcomes: &[TargetOutcome], edits: &mut [EditSet]) {
    for (target, outcome) in job.program.targets.iter().zip(outcomes) {
        let changed = outcome.figures.as_ref().is_some_and(|figures| figures.iterations > 0);
        if let (TargetValue::Cartesian(numbers), false, false) = (&target.value, changed, edits[target.file].is_empty())
        {
            digits::write_all_repeated(&mut edits[target.file], &job.sources[target.file], numbers);
        }
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
fn common_approach(arrivals: &[Arrival<'_>]) -> [f64; DOF] {
    std::array::from_fn(|joint| {
        let mut senses = arrivals.iter().map(|(_, approach)| approach[joint]);
        let first = senses.next().unwrap_or(0.0);
        if senses.all(|sense| sense == first) { first } else { 0.0 }
    })
}

/// What to know of a target that is reached from both sides: play cannot be corrected in one value.
fn both_sides(arrivals: &[Arrival<'_>]) -> Option<String> {
    let both = |joint: &usize| arrivals.iter().any(|(_, approach)| approach[*joint] != arrivals[0].1[*joint]);
    let joints: Vec<String> = (0..DOF).filter(both).map(|joint| (joint + 1).to_string()).collect();
    let message = "is reached from both sides of the play; the middle is taken";
    (!joints.is_empty()).then(|| format!("joint {} {message}", joints.join(", ")))
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

//! The false target of one target: the one that makes the real arm land where the written one was meant.

use crate::files::calibration::Region;
use crate::geometry::pose::{Pose, pose_difference};
use crate::invert::{MeantPose, RealArm};
use crate::kinematics::controller::Controller;
use crate::model::conditions::Conditions;
use crate::model::robot::DOF;
use crate::program::target::{Displacement, TargetValue};

use super::arrivals::Arrivals;
use super::class::{Class, class_by_text};
use super::correct::{Job, Options};
use super::displaced;
use super::outcome::{Figures, TargetOutcome};
use super::setting::{Obstacle, Setting, Settings};
use super::spin;
use super::visits::{Visit, written_pose};
use super::words;

/// Two false targets of one written target may differ by this much and still count as one: 1 um, 1 urad.
const SAME_TARGET: f64 = 1e-6;
/// Orientation, rad, that a displaced target may leave uncorrected: a hundredth of a degree.
const DISPLACED_ORIENTATION_RAD: f64 = 1.75e-4;

/// What corrects the targets of a job.
pub struct Work<'a> {
    /// The job.
    pub job: &'a Job<'a>,
    /// The real arm.
    pub arm: RealArm<'a>,
    /// The nominal one.
    pub controller: &'a Controller,
    /// Tools, frames and loads of the moves.
    pub settings: Settings<'a>,
    /// What the caller asks for.
    pub options: &'a Options,
}

/// A target to write, exactly.
#[derive(Clone, Debug)]
pub struct FalseTarget {
    /// What reports say about it.
    pub figures: Figures,
    /// Joint numbers that the controller then commands, rad.
    pub numbers_rad: [f64; DOF],
    /// The target, in its frame.
    pub after: Pose,
}

/// The false target for one way of arriving.
struct OneWay {
    target: FalseTarget,
    setting: usize,
    use_line: usize,
}

/// The false target of a base of displaced targets, if it has one, by its index.
pub type BaseTargets<'a> = &'a dyn Fn(usize) -> Option<Pose>;

impl Work<'_> {
    /// What becomes of a target by the text and the options alone; `None` for one that is to be corrected.
    pub fn left_alone(&self, index: usize) -> Option<TargetOutcome> {
        let target = &self.job.program.targets[index];
        let (class, reason) = class_by_text(self.job.program, self.job.sources, target);
        let by_text_alone = match class {
            Class::Corrected => false,
            Class::Joint => !self.options.joint_targets,
            Class::Computed | Class::Refused => true,
        };
        if by_text_alone {
            return Some(TargetOutcome::left(class, reason));
        }
        if self.job.program.read_only.contains(&target.file) {
            let reason = "stands in a file that other programs share, which is never written";
            let class = if class == Class::Joint { Class::Joint } else { Class::Computed };
            return Some(TargetOutcome::left(class, reason.to_string()));
        }
        None
    }

    /// One false target that serves every arrival, or the reason why there is none.
    ///
    /// # Errors
    /// [`Obstacle`]
    pub fn false_target(
        &self,
        index: usize,
        arrivals: &Arrivals,
        bases: BaseTargets<'_>,
    ) -> Result<FalseTarget, Obstacle> {
        let mut found: Vec<OneWay> = Vec::with_capacity(1);
        let approach = arrivals.common_approach(index);
        for visit in arrivals.at(index) {
            if found.iter().any(|known| known.setting == visit.setting()) {
                continue;
            }
            let target = self.arrival(index, visit, approach, bases)?;
            let one = &self.job.program.targets[index].uses[visit.one_use()];
            let use_line = self.job.sources[one.file].line(one.span.start);
            found.push(OneWay { target, setting: visit.setting(), use_line });
        }
        let mut all = found.into_iter();
        let Some(first) = all.next() else {
            return Err(Obstacle::computed("no move goes there as written"));
        };
        for other in all {
            let (shift, turn) = pose_difference(&other.target.after, &first.target.after);
            if shift.norm() > SAME_TARGET || turn.norm() > SAME_TARGET {
                let reason = format!(
                    "used with different tools, frames or loads in lines {} and {}: no single value lands for both",
                    first.use_line, other.use_line
                );
                return Err(Obstacle { shared: true, ..Obstacle::refused(reason) });
            }
        }
        Ok(first.target)
    }

    fn arrival(
        &self,
        index: usize,
        visit: &Visit,
        approach: [f64; DOF],
        bases: BaseTargets<'_>,
    ) -> Result<FalseTarget, Obstacle> {
        let setting = &*self.settings.at(visit.setting(), &self.job.program.targets[index])?;
        let nominal_rad = visit.nominal_rad.clone().map_err(|obstacle| *obstacle)?;
        let conditions = Conditions { approach, payload: setting.payload, ..Conditions::default() };
        let found = match &self.job.program.targets[index].value {
            TargetValue::Displaced(displacement) => {
                let Some(base) = bases(displacement.base) else {
                    return Err(Obstacle::computed("displaced from a target that is not corrected itself"));
                };
                let meant = self.written(index)?;
                self.displaced(&base, displacement, setting, &meant, &nominal_rad, &conditions)?
            }
            _ => self.full_pose(index, setting, &nominal_rad, &conditions)?,
        };
        if let Some(region) = &self.options.inside_only {
            check_region(region, &found.numbers_rad)?;
        }
        Ok(found)
    }

    fn written(&self, index: usize) -> Result<Pose, Obstacle> {
        let program = self.job.program;
        written_pose(program, &program.targets[index].value)
            .ok_or_else(|| Obstacle::refused("its numbers make no pose"))
    }

    /// All six coordinates.
    fn full_pose(
        &self,
        index: usize,
        setting: &Setting,
        nominal_rad: &[f64; DOF],
        conditions: &Conditions,
    ) -> Result<FalseTarget, Obstacle> {
        let forward = |numbers: &[f64; DOF]| {
            self.controller.forward(numbers).map_err(|error| Obstacle::refused(error.to_string()))
        };
        // A joint target means the pose that the nominal robot takes there.
        let is_joint = matches!(self.job.program.targets[index].value, TargetValue::Joint(_));
        let written = if is_joint { setting.target(&forward(nominal_rad)?) } else { self.written(index)? };
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
        let (shift, turn) = pose_difference(&after, &written);
        let figures = Figures {
            correction_m: shift.norm(),
            correction_rad: turn.norm(),
            iterations: correction.iterations,
            orientation_left_rad: correction.left_rad,
        };
        Ok(FalseTarget { figures, numbers_rad: correction.numbers_rad, after })
    }

    /// The position alone, with the orientation that the base target got.
    fn displaced(
        &self,
        base: &Pose,
        displacement: &Displacement,
        setting: &Setting,
        meant: &Pose,
        nominal_rad: &[f64; DOF],
        conditions: &Conditions,
    ) -> Result<FalseTarget, Obstacle> {
        let start = displaced::displaced(base, displacement);
        let landing =
            displaced::land_position(&self.arm, self.controller, setting, conditions, meant, &start, nominal_rad)?;
        if landing.orientation_left_rad > DISPLACED_ORIENTATION_RAD {
            return Err(Obstacle::computed(format!(
                "displaced too far from its base target: {:.4} deg of orientation error would stay",
                landing.orientation_left_rad.to_degrees()
            )));
        }
        if let Some(violation) = self.arm.robot().limit_violation(&landing.numbers_rad, 0.0) {
            return Err(Obstacle::refused(violation.to_string()));
        }
        let (shift, turn) = pose_difference(&landing.target, meant);
        let figures = Figures {
            correction_m: shift.norm(),
            correction_rad: turn.norm(),
            iterations: landing.rounds,
            orientation_left_rad: landing.orientation_left_rad,
        };
        Ok(FalseTarget { figures, numbers_rad: landing.numbers_rad, after: landing.target })
    }
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

//! One concealed trial: an arm, what is wrong with it, and the files that its user has.

use std::sync::Arc;

use falsetarget::base::text::Source;
use falsetarget::files::robot::RobotEntry;
use falsetarget::files::{builtin, robot};
use falsetarget::geometry::pose::Pose;
use falsetarget::model::robot::{DOF, Mass, Robot};
use nalgebra::{Isometry3, Vector3};

use crate::arm::Arm;
use crate::cause::{Cause, Setting};
use crate::dice::Dice;
use crate::measurement::{self, Measured};
use crate::motion::{Habits, Moment, Motion, along, poses, ranges};
use crate::real::Real;
use crate::rivals::Bench;
use crate::size::{Nuisance, sized};

/// Hardships of a measuring campaign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Hardship {
    FewRecords,
    Restricted,
    Masses,
    Compliances,
    PayloadUnknown,
    FramesUnknown,
    NoDir,
    NoTime,
    NoTemperature,
    HeavyTails,
    DirectedNoise,
    Outliers,
    MovedStation,
    Quantised,
    Unsettled,
}

impl Hardship {
    pub const ALL: [(Self, &'static str); 15] = [
        (Self::FewRecords, "60 records"),
        (Self::Restricted, "a third of the joint range"),
        (Self::Masses, "masses and centres 15 % off"),
        (Self::Compliances, "known compliances 30 % off"),
        (Self::PayloadUnknown, "payload unknown"),
        (Self::FramesUnknown, "base and tool unknown"),
        (Self::NoDir, "no sense of approach"),
        (Self::NoTime, "no time"),
        (Self::NoTemperature, "no temperature"),
        (Self::HeavyTails, "heavy-tailed noise"),
        (Self::DirectedNoise, "noise by direction"),
        (Self::Outliers, "2 % gross errors"),
        (Self::MovedStation, "tracker set up twice"),
        (Self::Quantised, "joints read to 0.005 deg"),
        (Self::Unsettled, "read before the arm stood"),
    ];

    pub fn words(self) -> &'static str {
        Self::ALL.iter().find(|(own, _)| *own == self).map_or("", |(_, words)| words)
    }
}

/// What a trial is to be.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Tells trials apart, and seeds.
    pub number: u64,
    /// Which table it belongs to.
    pub group: &'static str,
    pub moving: bool,
    /// Kinds of causes and their levels.
    pub wanted: Vec<(&'static str, f64)>,
    pub hardships: Vec<Hardship>,
    /// Poses of an arm that stands.
    pub records: usize,
    /// Noise per axis, m; `None`: drawn, in proportion to the arm.
    pub noise_m: Option<f64>,
    /// The recording says how large its noise is.
    pub noise_stated: bool,
}

impl Spec {
    pub fn has(&self, hardship: Hardship) -> bool {
        self.hardships.contains(&hardship)
    }
}

/// A concealed cause.
#[derive(Clone, Debug)]
pub struct Concealed {
    pub kind: &'static str,
    pub cause: Cause,
    pub size: f64,
    /// Trace beside geometry over the noise.
    pub level: f64,
}

/// Pause between records without a time column, s (docs/files.md).
const USUAL_PAUSE_S: f64 = 10.0;

/// What a user has, and what only the judge knows.
pub struct Trial {
    pub robot_text: String,
    pub recording_text: String,
    /// Poses to predict, a file too.
    pub poses_text: String,
    pub truth: Truth,
}

pub struct Truth {
    pub arm: &'static str,
    pub concealed: Vec<Concealed>,
    pub sigma_m: f64,
    pub outliers: Vec<String>,
    /// Noise-free points of the poses to predict, m.
    pub points_m: Vec<Vector3<f64>>,
    /// When the recording ends, by its own clock, s.
    pub whole_s: f64,
    /// What tells rivals apart.
    pub bench: Bench,
}

/// Draws until every cause reaches its level.
const ATTEMPTS: u64 = 40;
/// A cause smaller than this share of its level has not reached it.
const REACHED: f64 = 0.9;
const HOLDOUT: usize = 150;
const MOVING_RECORDS: usize = 1500;
const STEP_S: f64 = 0.02;

/// Makes a trial; the same one for the same specification.
pub fn build(spec: &Spec) -> Trial {
    let mut best: Option<(f64, Trial)> = None;
    for attempt in 0..ATTEMPTS {
        let mut dice = Dice::new(spec.number.wrapping_mul(1_000_003).wrapping_add(attempt));
        let Some(trial) = draw(spec, &mut dice) else { continue };
        let reached = spec
            .wanted
            .iter()
            .zip(&trial.truth.concealed)
            .map(|((_, wanted), concealed)| concealed.level / wanted)
            .fold(f64::INFINITY, f64::min);
        if reached >= REACHED {
            return trial;
        }
        if best.as_ref().is_none_or(|(most, _)| reached > *most) {
            best = Some((reached, trial));
        }
    }
    best.expect("an arm with poses").1
}

fn draw(spec: &Spec, dice: &mut Dice) -> Option<Trial> {
    let (id, _) = *dice.pick(builtin::BUILT_IN);
    let mut file = varied(builtin::by_name(id)?.ok()?, dice);
    let ranges = ranges(&file, spec.has(Hardship::Restricted), dice);
    let bare = Arm::of_file(&file);
    let speeds: [f64; DOF] = std::array::from_fn(|joint| file.joints[joint].max_speed_rad_s.unwrap_or(2.0).min(4.0));
    let motion = Arc::new(Motion::draw(&ranges, &speeds, dice));
    let habits = Habits {
        direct: spec.has(Hardship::NoDir),
        winding_rad: dice.between(0.5, 1.0_f64).to_radians(),
        pause_s: 14.0,
        warming: (dice.between(6.0, 12.0), dice.between(1200.0, 2700.0)),
    };
    let mut moments = match spec.moving {
        true => along(&motion, MOVING_RECORDS, STEP_S, 1e-3),
        false => poses(&file, &bare, &ranges, spec.records, habits, dice)?,
    };
    if spec.moving && moments.iter().step_by(25).any(|moment| !crate::motion::allowed(&file, &bare, &moment.numbers)) {
        return None;
    }
    let whole_s = moments.last()?.time_s;
    let largest_nm = largest(&bare, &moments)?;
    soften(&mut file, &largest_nm, dice);
    let lengths_m = std::array::from_fn(|link| bare.bodies[link + 1].translation.vector.norm());
    let soft = file.compliance_rad_per_nm.map(|compliance| compliance > 0.0);
    let payload = file.payload;
    let setting = Setting {
        largest_nm: &largest_nm,
        lengths_m: &lengths_m,
        ranges: &ranges,
        soft: &soft,
        payload_kg: payload.mass_kg,
        payload_m: &payload.center_of_mass_m,
    };
    let causes = different(spec, &setting, dice)?;
    // A drive whose softness is to be found is stiff in the file.
    for cause in &causes {
        if let Cause::Compliance { joint } = cause {
            file.compliance_rad_per_nm[*joint] = 0.0;
        }
    }
    let mut arm = Arm::of_file(&file);
    let reach_m: f64 = lengths_m.iter().sum();
    arm.disturb(dice, 2.5e-4 * reach_m.sqrt(), 3e-4);
    let usual_m = 1e-5 * dice.between(0.8, 1.4) * reach_m.max(0.8);
    let sigma_m = spec.noise_m.unwrap_or(usual_m);
    let nuisance = Nuisance::of(&arm, &moments)?;
    let mut concealed = Vec::new();
    for ((kind, level), cause) in spec.wanted.iter().zip(causes) {
        let (size, trace_m) = sized(&arm, &cause, cause.sizes(&setting), level * sigma_m, &moments, &nuisance)?;
        concealed.push(Concealed { kind, cause, size, level: trace_m / sigma_m });
    }
    let bench = Bench::new(&arm, &moments, nuisance, &concealed, &setting, sigma_m)?;
    spoil(spec, &mut arm, &mut moments, sigma_m / reach_m, dice);
    let all: Vec<(Cause, f64)> = concealed.iter().map(|one| (one.cause.clone(), one.size)).collect();
    let real = Real::new(&arm, &all);
    let points_m: Vec<Vector3<f64>> = moments.iter().map(|moment| real.point(moment)).collect::<Option<_>>()?;
    let measured = Measured { robot: &file, moments: &moments, points_m: &points_m, sigma_m, reach_m };
    let (recording_text, outliers) = measurement::written(spec, &measured, dice);
    let (held, held_points_m) = held_out(spec, &file, &bare, &real, &motion, &ranges, habits, whole_s, dice)?;
    let poses_text = measurement::poses(spec, &file, &held);
    // Without a time column the order is time, at the pace that the program takes for usual.
    let whole_s = if spec.has(Hardship::NoTime) { USUAL_PAUSE_S * (moments.len() - 1) as f64 } else { whole_s };
    let truth = Truth { arm: id, concealed, sigma_m, outliers, points_m: held_points_m, whole_s, bench };
    Some(Trial { robot_text: as_user_has_it(spec, file)?, recording_text, poses_text, truth })
}

/// Different causes: no two that act on the same joint in ways that only their sum would show.
fn different(spec: &Spec, setting: &Setting<'_>, dice: &mut Dice) -> Option<Vec<Cause>> {
    let mut causes: Vec<Cause> = Vec::new();
    for (kind, _) in &spec.wanted {
        let mut tries = 0;
        loop {
            let cause = Cause::draw(kind, setting, dice);
            if causes.iter().all(|other| cause.joint().is_none() || other.joint() != cause.joint()) {
                causes.push(cause);
                break;
            }
            tries += 1;
            if tries > 20 {
                return None;
            }
        }
    }
    Some(causes)
}

/// A built-in arm in another size, with tool, load and measuring frame.
fn varied(mut robot: Robot, dice: &mut Dice) -> Robot {
    let size = dice.between(0.75, 1.25);
    let factors: [[f64; 2]; DOF] =
        std::array::from_fn(|_| [size * dice.between(0.93, 1.07), size * dice.between(0.93, 1.07)]);
    for (joint, [along, across]) in robot.joints.iter_mut().zip(factors) {
        joint.d_m *= along;
        joint.a_m *= across;
    }
    if let Some(rods) = &mut robot.parallelogram {
        rods.arm_m = robot.joints[1].a_m.abs();
        rods.coupler_m = rods.arm_m;
        rods.crank_m *= size;
        rods.rocker_m = rods.crank_m;
    }
    let mut total_kg = 0.0;
    for link in robot.links.iter_mut().flatten() {
        link.mass_kg *= size.powi(3) * dice.between(0.9, 1.1);
        link.center_of_mass_m *= size;
        total_kg += link.mass_kg;
    }
    let reach_m: f64 = robot.joints.iter().map(|joint| joint.a_m.hypot(joint.d_m)).sum();
    let beside = Vector3::new(dice.sign() * dice.between(0.02, 0.05), dice.sign() * dice.between(0.02, 0.05), 0.0);
    let along = Vector3::new(0.0, 0.0, dice.between(0.04, 0.09));
    robot.tool = Some(Pose { translation: (beside + along) * reach_m, ..Pose::identity() });
    let center = Vector3::new(0.01 * dice.normal(), 0.01 * dice.normal(), dice.between(0.03, 0.06)) * reach_m;
    robot.payload = Mass { mass_kg: total_kg * dice.between(0.08, 0.16), center_of_mass_m: center };
    robot.base = Some(Pose::identity());
    rounded(robot)
}

/// Numbers as a person writes them.
fn rounded(mut robot: Robot) -> Robot {
    let to = |value: f64, digit: f64| (value / digit).round() * digit;
    for joint in &mut robot.joints {
        joint.a_m = to(joint.a_m, 1e-4);
        joint.d_m = to(joint.d_m, 1e-4);
    }
    if let Some(rods) = &mut robot.parallelogram {
        rods.arm_m = to(rods.arm_m, 1e-4);
        rods.coupler_m = rods.arm_m;
        rods.crank_m = to(rods.crank_m, 1e-4);
        rods.rocker_m = rods.crank_m;
    }
    robot
}

/// Largest torque of each joint over the records, Nm.
fn largest(arm: &Arm, moments: &[Moment]) -> Option<[f64; DOF]> {
    let bare = Real::new(arm, &[]);
    let mut largest = [0.0f64; DOF];
    for moment in moments {
        let (torques, _) = bare.loaded(moment)?;
        largest.iter_mut().zip(torques).for_each(|(most, torque)| *most = most.max(torque.abs()));
    }
    Some(largest)
}

/// Drives 2 to 5 give way by some tenths of a milliradian under their largest torque.
fn soften(robot: &mut Robot, largest_nm: &[f64; DOF], dice: &mut Dice) {
    for (compliance, largest) in robot.compliance_rad_per_nm.iter_mut().zip(largest_nm).take(5).skip(1) {
        let twist = dice.between(3e-4, 1e-3);
        let exact = twist / largest.max(1e-3);
        // Two digits, as a data sheet has them.
        let digit = 10f64.powf(exact.log10().floor() - 1.0);
        *compliance = (exact / digit).round() * digit;
    }
}

/// What the file does not know about masses and drives, and what the campaign does to the records.
fn spoil(spec: &Spec, arm: &mut Arm, moments: &mut [Moment], noise_rad: f64, dice: &mut Dice) {
    if spec.has(Hardship::Masses) {
        for lump in &mut arm.lumps {
            lump.mass_kg *= 1.0 + dice.between(-0.15, 0.15);
            lump.at_m.iter_mut().for_each(|at| *at *= 1.0 + dice.between(-0.15, 0.15));
        }
    }
    if spec.has(Hardship::Compliances) {
        arm.compliance.iter_mut().for_each(|compliance| *compliance *= 1.0 + dice.between(-0.3, 0.3));
    }
    if spec.has(Hardship::FramesUnknown) {
        let place = Isometry3::new(dice.normals() * 2.0, Vector3::new(0.02, -0.03, dice.angle()));
        arm.bodies[0] = place * arm.bodies[0];
        arm.gravity = place.rotation * arm.gravity;
    }
    if spec.has(Hardship::Unsettled) {
        for moment in moments {
            // The last mode dies away; the operator waits now longer, now shorter.
            let left = 6.0 * noise_rad * (-dice.between(0.0, 4.0)).exp();
            moment.unsettled =
                std::array::from_fn(|joint| if joint < 3 { -left * moment.approach[joint] } else { 0.0 });
        }
    }
}

#[allow(clippy::too_many_arguments, reason = "everything that the recording had")]
fn held_out(
    spec: &Spec,
    file: &Robot,
    bare: &Arm,
    real: &Real,
    motion: &Arc<Motion>,
    ranges: &[(f64, f64); DOF],
    habits: Habits,
    whole_s: f64,
    dice: &mut Dice,
) -> Option<(Vec<Moment>, Vec<Vector3<f64>>)> {
    let mut held = if spec.moving {
        // The same motion between the records.
        let later = |moment: Moment| {
            let time_s = moment.time_s + 0.5 * STEP_S;
            let approach = motion.speeds(time_s).map(f64::signum);
            Moment { numbers: motion.numbers(time_s), approach, time_s, ..moment }
        };
        along(motion, MOVING_RECORDS, STEP_S, 1e-3).into_iter().map(later).step_by(MOVING_RECORDS / HOLDOUT).collect()
    } else {
        poses(file, bare, ranges, HOLDOUT, habits, dice)?
    };
    for moment in &mut held {
        // Somewhere within the recording.
        if !spec.moving {
            moment.time_s = whole_s * dice.between(0.02, 0.98);
            moment.fraction = moment.time_s / whole_s;
            moment.warmer_k = habits.warming.0 * (1.0 - (-moment.time_s / habits.warming.1).exp());
        }
    }
    let points = held.iter().map(|moment| real.point(moment)).collect::<Option<Vec<_>>>()?;
    Some((held, points))
}

/// The robot file without what the user does not know.
fn as_user_has_it(spec: &Spec, mut file: Robot) -> Option<String> {
    if spec.has(Hardship::FramesUnknown) {
        file.base = None;
        file.tool = None;
    }
    if spec.has(Hardship::PayloadUnknown) {
        file.payload = Mass::NONE;
    }
    let text = serde_yaml::to_string(&RobotEntry::from_robot(&file, true)).ok()?;
    robot::read(&Source::new("robot.yaml", text.as_str())).ok()?;
    Some(text)
}

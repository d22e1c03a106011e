//! Is this a recording of this robot, in the units and frames that the file says? Found out before anything is fitted,
//! by placing the nominal arm on the measurements and asking whether some other reading places it far better.

use nalgebra::Vector3;

use crate::base::units::{deg_from_rad, mm_from_m};
use crate::geometry::pose::{Pose, vector_from_rotation};
use crate::measure::observation::Observation;
use crate::model::arm::{ArmModel, PreparedArm};
use crate::model::robot::DOF;

use super::place::{Handedness, Placement, place};
use super::prior::reach_m;

/// Records that are looked at: enough to tell readings apart, few enough for a hundred trials.
const SAMPLE: usize = 150;
/// Records looked at where two changes are tried together.
const SAMPLE_FOR_PAIRS: usize = 50;
/// Another reading is believed when it fits this many times better.
const DECISIVE: f64 = 4.0;
/// A misfit below this part of the reach is what calibration is for: no other reading is looked for.
const ORDINARY: f64 = 2e-3;
/// A misfit beyond this part of the reach, with no reading that explains it, is no recording of this robot.
const HOPELESS: f64 = 0.03;
/// A base found further than this from where the file has it was not set up by hand, m and rad.
const BASE_LIMIT: [f64; 2] = [0.15, 0.05];

/// Why a recording is not used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Misread {
    /// Another reading of the columns fits far better.
    #[error(
        "the recording fits {times:.0} times better {reading}: {given_mm:.1} mm from the nominal arm becomes {other_mm:.2} mm"
    )]
    OtherReading {
        /// `with lengths in metres`.
        reading: String,
        /// How much better.
        times: f64,
        /// Typical misfit as it stands, mm.
        given_mm: f64,
        /// Typical misfit in the other reading, mm.
        other_mm: f64,
    },
    /// The base is elsewhere.
    #[error(
        "the recording fits {times:.0} times better with the robot's base {shift_mm:.0} mm and {turn_deg:.1} deg from where \
         the robot file has it{kind}; correct `base` or leave it out, then it is found from the recording"
    )]
    OtherBase {
        /// How much better.
        times: f64,
        /// How far, mm.
        shift_mm: f64,
        /// How turned, deg.
        turn_deg: f64,
        /// ` (the measuring frame is turned by 90 deg about z)`, or nothing.
        kind: String,
    },
    /// Nothing fits.
    #[error(
        "the recording does not fit this robot: the best placement leaves {given_mm:.0} mm typically, and no other units, \
         signs, zeros or column orders explain it"
    )]
    NotThisRobot {
        /// Typical misfit, mm.
        given_mm: f64,
    },
    /// The nominal arm cannot take these poses.
    #[error("the arm cannot take most of the recorded poses: its parallelogram does not close there")]
    Impossible,
}

/// A way in which the numbers of a file may be meant.
#[derive(Clone, Debug, Default)]
struct Reading {
    changes: Vec<Change>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    LengthUnit(&'static str, f64),
    Radians,
    Mirrored,
    Sign(usize),
    Zero(usize, f64),
    Swapped(usize, usize),
}

impl Change {
    fn all(tool_known: bool) -> Vec<Change> {
        let units = [("metres", 1e3), ("centimetres", 10.0), ("inches", 25.4), ("micrometres", 1e-3)];
        let mut all: Vec<Change> = units.iter().map(|&(name, factor)| Change::LengthUnit(name, factor)).collect();
        all.extend([Change::Radians, Change::Mirrored]);
        for joint in 0..DOF {
            all.push(Change::Sign(joint));
            // A zero of the first joint is the same as a turned base, one of the last as a turned tool.
            let told_by_frames = joint == 0 || (joint == DOF - 1 && !tool_known);
            if !told_by_frames {
                all.extend([90.0, -90.0, 180.0].map(|turn_deg| Change::Zero(joint, turn_deg)));
            }
            all.extend((0..joint).map(|other| Change::Swapped(other, joint)));
        }
        all
    }

    fn words(self) -> String {
        match self {
            Change::LengthUnit(name, _) => format!("with lengths in {name}"),
            Change::Radians => "with joint positions in radians".into(),
            Change::Mirrored => "with one axis of the measuring frame reversed (it is left-handed, or two columns are \
                                 swapped)"
                .into(),
            Change::Sign(joint) => format!("with joint {} counted the other way", joint + 1),
            Change::Zero(joint, turn_deg) => format!("with the zero of joint {} moved by {turn_deg} deg", joint + 1),
            Change::Swapped(a, b) => format!("with the columns of joints {} and {} exchanged", a + 1, b + 1),
        }
    }

    fn numbers(self, numbers: &mut [f64; DOF]) {
        match self {
            Change::Radians => *numbers = numbers.map(deg_from_rad),
            Change::Sign(joint) => numbers[joint] = -numbers[joint],
            Change::Zero(joint, turn_deg) => numbers[joint] += turn_deg.to_radians(),
            Change::Swapped(a, b) => numbers.swap(a, b),
            Change::LengthUnit(..) | Change::Mirrored => {}
        }
    }
}

impl Reading {
    fn words(&self) -> String {
        self.changes.iter().map(|change| change.words()).collect::<Vec<_>>().join(" and ")
    }

    fn place(
        &self,
        prepared: &PreparedArm<'_, f64>,
        records: &[&Observation],
        tool: Option<Vector3<f64>>,
    ) -> Option<Placement> {
        let mut flanges = Vec::with_capacity(records.len());
        let mut points = Vec::with_capacity(records.len());
        let mut handedness = Handedness::Right;
        let mut scale = 1.0;
        for change in &self.changes {
            match change {
                Change::LengthUnit(_, factor) => scale *= factor,
                Change::Mirrored => handedness = Handedness::Left,
                _ => {}
            }
        }
        for record in records {
            let mut numbers = record.numbers_rad;
            self.changes.iter().for_each(|change| change.numbers(&mut numbers));
            if let (Some(measured), Ok(state)) = (record.measured, prepared.at(&numbers, &record.conditions, None)) {
                flanges.push(state.base_t_flange);
                points.push(measured.position_m * scale);
            }
        }
        // A reading in which half the poses are impossible is no reading.
        (2 * flanges.len() > records.len()).then(|| place(&flanges, &points, tool, handedness))?
    }
}

/// Where the nominal arm stands, once the recording is known to be one of it.
#[derive(Clone, Debug)]
pub struct Checked {
    /// Base and tool as they fit the nominal arm best.
    pub placement: Placement,
}

/// Checks that the measured records are of this robot.
///
/// # Errors
/// [`Misread`] with the sentence for the person who made the file.
pub fn check(nominal: &ArmModel, records: &[&Observation]) -> Result<Checked, Misread> {
    let robot = &nominal.robot;
    // What the controller believes, without gravity: quick, and near enough to tell readings apart.
    let bare = ArmModel::controller(robot.clone());
    let prepared = bare.prepared();
    let step = records.len().div_ceil(SAMPLE).max(1);
    let sample: Vec<&Observation> = records.iter().step_by(step).copied().collect();
    let tool = robot.tool.map(|tool| tool.translation);
    let as_given = Reading::default().place(&prepared, &sample, tool).ok_or(Misread::Impossible)?;
    let reach = reach_m(robot);
    if as_given.typical_misfit_m > ORDINARY * reach
        && let Some((reading, other)) = best_reading(&prepared, &sample, tool, &as_given)
    {
        return Err(Misread::OtherReading {
            reading: reading.words(),
            times: as_given.typical_misfit_m / other.typical_misfit_m,
            given_mm: mm_from_m(as_given.typical_misfit_m),
            other_mm: mm_from_m(other.typical_misfit_m),
        });
    }
    if as_given.typical_misfit_m > HOPELESS * reach {
        return Err(Misread::NotThisRobot { given_mm: mm_from_m(as_given.typical_misfit_m) });
    }
    if let Some(base) = robot.base {
        check_base(&base, &as_given, &sample)?;
    }
    Ok(Checked { placement: as_given })
}

/// The simplest reading that fits decisively better: one change, else two of which at least one says how the whole file
/// is meant (units, handedness).
fn best_reading(
    prepared: &PreparedArm<'_, f64>,
    sample: &[&Observation],
    tool: Option<Vector3<f64>>,
    given: &Placement,
) -> Option<(Reading, Placement)> {
    let changes = Change::all(tool.is_some());
    let best_after = |first: Option<Change>, sample: &[&Observation]| {
        changes
            .iter()
            .filter(|&&change| Some(change) != first)
            .filter_map(|&change| {
                let reading = Reading { changes: first.into_iter().chain([change]).collect() };
                let placement = reading.place(prepared, sample, tool)?;
                Some((reading, placement))
            })
            .min_by(|a, b| a.1.typical_misfit_m.total_cmp(&b.1.typical_misfit_m))
    };
    let decisive = |found: &(Reading, Placement), against_m: f64| found.1.typical_misfit_m * DECISIVE < against_m;
    let one = best_after(None, sample);
    let few: Vec<&Observation> =
        sample.iter().step_by(sample.len().div_ceil(SAMPLE_FOR_PAIRS).max(1)).copied().collect();
    let whole_file = changes
        .iter()
        .filter(|change| matches!(change, Change::LengthUnit(..) | Change::Radians | Change::Mirrored))
        .filter_map(|&first| best_after(Some(first), &few))
        .min_by(|a, b| a.1.typical_misfit_m.total_cmp(&b.1.typical_misfit_m));
    let one_m = one.as_ref().map_or(f64::INFINITY, |one| one.1.typical_misfit_m.min(given.typical_misfit_m));
    if let Some(two) = whole_file.filter(|two| decisive(two, one_m)) {
        return Some(two);
    }
    one.filter(|one| decisive(one, given.typical_misfit_m))
}

/// The base of the robot file against the one that fits.
fn check_base(stated: &Pose, found: &Placement, sample: &[&Observation]) -> Result<(), Misread> {
    let difference = stated.inverse() * found.measuring_t_base;
    let (shift_m, turn_rad) = (difference.translation.norm(), vector_from_rotation(&difference.rotation).norm());
    if shift_m <= BASE_LIMIT[0] && turn_rad <= BASE_LIMIT[1] {
        return Ok(());
    }
    let move_m = |point: &Vector3<f64>| {
        let in_base = found.measuring_t_base.inverse().transform_point(point);
        (stated.transform_point(&in_base) - point).norm()
    };
    let moves: Vec<f64> =
        sample.iter().filter_map(|record| record.measured.map(|measured| move_m(&measured.position_m))).collect();
    let times = super::robust::median(&moves) / found.typical_misfit_m;
    let turn = vector_from_rotation(&(found.measuring_t_base.rotation * stated.rotation.transpose()));
    Err(Misread::OtherBase {
        times,
        shift_mm: mm_from_m(shift_m),
        turn_deg: deg_from_rad(turn_rad),
        kind: quarter_turn(&turn)
            .map(|words| format!(" (the measuring frame is turned by {words})"))
            .unwrap_or_default(),
    })
}

/// `90 deg about z`, when a turn is nearly that.
fn quarter_turn(turn_rad: &Vector3<f64>) -> Option<String> {
    let angle_deg = deg_from_rad(turn_rad.norm());
    let quarters = (angle_deg / 90.0).round();
    if quarters < 1.0 || (angle_deg - 90.0 * quarters).abs() > 2.0 {
        return None;
    }
    let axis = turn_rad.iamax();
    let straight = turn_rad[axis].abs() > 0.999 * turn_rad.norm();
    let sign = if turn_rad[axis] < 0.0 && quarters < 2.0 { "-" } else { "" };
    straight.then(|| format!("{sign}{} deg about {}", 90.0 * quarters, ["x", "y", "z"][axis]))
}

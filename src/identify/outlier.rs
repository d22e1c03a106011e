//! Why a record is left out: the simplest mistake that explains where it stands.

use nalgebra::Vector3;

use crate::base::units::{deg_from_rad, mm_from_m};
use crate::geometry::pose::Pose;
use crate::measure::observation::Observation;
use crate::model::arm::PreparedArm;
use crate::model::robot::DOF;

use super::problem::expected_pose;

/// Why a record is not used.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// Nothing was measured there.
    Unmeasured,
    /// It repeats an earlier record to the last digit.
    Copy {
        /// The name of that record.
        of: String,
        /// Its line.
        line: usize,
    },
    /// The arm cannot stand there.
    Impossible {
        /// What the model says.
        why: String,
    },
    /// Two coordinates are exchanged.
    Swapped(usize, usize),
    /// A coordinate has the wrong sign.
    Reversed(usize),
    /// Its lengths are in another unit.
    Unit(&'static str),
    /// Its position belongs to another record's joints.
    OtherRow {
        /// The name of that record.
        of: String,
    },
    /// One coordinate alone is off.
    Coordinate {
        /// Which.
        axis: usize,
        /// By how much, m.
        by_m: f64,
    },
    /// One joint reading alone explains it.
    Joint {
        /// Which, from zero.
        joint: usize,
        /// By how much the reading is too large, rad.
        by_rad: f64,
    },
    /// It is far off and no single mistake explains it.
    Unexplained,
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl Reason {
    /// A word that scripts can match.
    pub fn code(&self) -> &'static str {
        match self {
            Reason::Unmeasured => "unmeasured",
            Reason::Copy { .. } => "duplicate",
            Reason::Impossible { .. } => "impossible",
            Reason::Swapped(..) => "swapped-coordinates",
            Reason::Reversed(_) => "reversed-coordinate",
            Reason::Unit(_) => "unit",
            Reason::OtherRow { .. } => "wrong-row",
            Reason::Coordinate { .. } => "one-coordinate",
            Reason::Joint { .. } => "one-joint",
            Reason::Unexplained => "gross-error",
        }
    }
}

impl std::fmt::Display for Reason {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Reason::Unmeasured => write!(f, "no position was measured"),
            Reason::Copy { of, line } => write!(f, "it repeats record `{of}` (line {line}) to the last digit"),
            Reason::Impossible { why } => write!(f, "the arm cannot stand there: {why}"),
            Reason::Swapped(a, b) => write!(f, "{} and {} are exchanged", AXES[*a], AXES[*b]),
            Reason::Reversed(axis) => write!(f, "{} has the wrong sign", AXES[*axis]),
            Reason::Unit(unit) => write!(f, "its position is in {unit}"),
            Reason::OtherRow { of } => write!(f, "its position is the one of record `{of}`"),
            Reason::Coordinate { axis, by_m } => {
                write!(f, "{} alone is off, by {:.2} mm", AXES[*axis], mm_from_m(*by_m))
            }
            Reason::Joint { joint, by_rad } => {
                write!(f, "the reading of joint {} alone is off, by {:.3} deg", joint + 1, deg_from_rad(*by_rad))
            }
            Reason::Unexplained => {
                write!(f, "a gross error (reflector bumped, beam broken or wrong row); no single mistake explains it")
            }
        }
    }
}

/// What an explanation may use: the fitted arm and where it puts every record.
pub struct Scene<'a> {
    /// The fitted arm.
    pub arm: &'a PreparedArm<'a, f64>,
    /// Names and expected positions of all records, each in its own station's frame, m.
    pub expected: &'a [(String, Vector3<f64>)],
}

/// An explanation must leave less than this part of the deviation: a near miss explains nothing.
const EXPLAINS: f64 = 0.25;

/// Finds the simplest explanation of a record that stands off.
///
/// # Arguments
/// * `station_t_measuring` - the frame of its station
/// * `limit_m` - the distance up to which a record is an ordinary one
pub fn explain(scene: &Scene<'_>, record: &Observation, station_t_measuring: &Pose, limit_m: f64) -> Reason {
    let Some(measured) = record.measured.map(|measured| measured.position_m) else {
        return Reason::Unmeasured;
    };
    let expected = match expected_pose(scene.arm, station_t_measuring, record) {
        Ok(pose) => pose.translation,
        Err(error) => return Reason::Impossible { why: error.to_string() },
    };
    let away = measured - expected;
    let good = limit_m.min(EXPLAINS * away.norm());
    let fits = |position: &Vector3<f64>| (position - expected).norm() < good;
    for (a, b) in [(0, 1), (0, 2), (1, 2)] {
        let mut swapped = measured;
        swapped.swap_rows(a, b);
        if fits(&swapped) {
            return Reason::Swapped(a, b);
        }
    }
    for axis in 0..3 {
        let mut reversed = measured;
        reversed[axis] = -reversed[axis];
        if fits(&reversed) {
            return Reason::Reversed(axis);
        }
    }
    for (unit, factor) in [("metres", 1e3), ("centimetres", 10.0), ("inches", 25.4), ("micrometres", 1e-3)] {
        if fits(&(measured * factor)) {
            return Reason::Unit(unit);
        }
    }
    let other = scene.expected.iter().find(|(id, position)| *id != record.id && (position - measured).norm() < good);
    if let Some((of, _)) = other {
        return Reason::OtherRow { of: of.clone() };
    }
    let axis = away.iamax();
    let across = (away.norm_squared() - away[axis].powi(2)).max(0.0).sqrt();
    if across < good {
        return Reason::Coordinate { axis, by_m: away[axis] };
    }
    one_joint(scene.arm, record, station_t_measuring, &measured, good).unwrap_or(Reason::Unexplained)
}

/// Turns of a joint that are tried as starts, rad: a digit lost or a revolution counted wrongly lies near one of them.
const STARTS: [f64; 5] = [0.0, 0.2, -0.2, 1.0, -1.0];

fn one_joint(
    arm: &PreparedArm<'_, f64>,
    record: &Observation,
    station_t_measuring: &Pose,
    measured: &Vector3<f64>,
    good: f64,
) -> Option<Reason> {
    let miss = |joint: usize, turn: f64| {
        let mut moved = record.clone();
        moved.numbers_rad[joint] += turn;
        expected_pose(arm, station_t_measuring, &moved).ok().map(|pose| pose.translation - measured)
    };
    let mut best: Option<(usize, f64, f64)> = None;
    for joint in 0..DOF {
        for start in STARTS {
            let mut turn = start;
            for _ in 0..20 {
                let step = 1e-6;
                let (Some(here), Some(there)) = (miss(joint, turn), miss(joint, turn + step)) else { break };
                let slope = (there - here) / step;
                let change = -slope.dot(&here) / slope.norm_squared().max(f64::MIN_POSITIVE);
                turn += change.clamp(-0.3, 0.3);
                if change.abs() < 1e-9 {
                    break;
                }
            }
            let Some(left) = miss(joint, turn).map(|left| left.norm()) else { continue };
            if left < good && best.is_none_or(|(_, known, _)| turn.abs() < known.abs()) {
                best = Some((joint, turn, left));
            }
        }
    }
    best.map(|(joint, turn, _)| Reason::Joint { joint, by_rad: -turn })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fixture::observation;
    use crate::measure::observation::Measured;
    use crate::model::arm::ArmModel;
    use crate::model::conditions::Conditions;
    use crate::model::fixture;

    const POSE: [f64; DOF] = [0.4, -0.3, 0.2, 1.1, -0.7, 2.0];

    fn reason(edit: impl Fn(&mut Vector3<f64>), joints: [f64; DOF]) -> Reason {
        let mut robot = fixture::looped_with_masses();
        robot.tool = Some(Pose::from_translation(Vector3::new(0.1, -0.05, 0.3)));
        let model = ArmModel::nominal(robot);
        let arm = model.prepared();
        let at = |numbers: &[f64; DOF]| {
            arm.measured(&arm.at(numbers, &Conditions::default(), None).expect("a pose")).translation
        };
        let mut position = at(&POSE);
        edit(&mut position);
        let mut record = observation(joints);
        record.id = "5".into();
        record.measured = Some(Measured { position_m: position, rotation: None });
        let others = [("5".to_string(), at(&joints)), ("9".to_string(), at(&POSE))];
        let expected = if joints == POSE { &others[..1] } else { &others[..] };
        explain(&Scene { arm: &arm, expected }, &record, &Pose::identity(), 3e-4)
    }

    #[test]
    fn each_mistake_has_its_name() {
        assert_eq!(reason(|p| p.swap_rows(0, 1), POSE), Reason::Swapped(0, 1));
        assert_eq!(reason(|p| p.z = -p.z, POSE), Reason::Reversed(2));
        assert_eq!(reason(|p| *p *= 1e-3, POSE), Reason::Unit("metres"));
        assert!(
            matches!(reason(|p| p.y += 0.1, POSE), Reason::Coordinate { axis: 1, by_m } if (by_m - 0.1).abs() < 1e-9)
        );
        assert_eq!(reason(|_| {}, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]), Reason::OtherRow { of: "9".into() });
        assert_eq!(reason(|p| *p += Vector3::new(0.004, -0.003, 0.005), POSE), Reason::Unexplained);
    }

    #[test]
    fn one_bad_joint_reading_is_found_with_its_size() {
        for joint in [1, 3, 4] {
            let mut read = POSE;
            read[joint] += 0.05;
            let mut robot = fixture::looped_with_masses();
            robot.tool = Some(Pose::from_translation(Vector3::new(0.1, -0.05, 0.3)));
            let model = ArmModel::nominal(robot);
            let arm = model.prepared();
            let stand = arm.at(&POSE, &Conditions::default(), None).expect("a pose");
            let mut record = observation(read);
            record.measured = Some(Measured { position_m: arm.measured(&stand).translation, rotation: None });
            let found = explain(&Scene { arm: &arm, expected: &[] }, &record, &Pose::identity(), 1e-4);
            let Reason::Joint { joint: named, by_rad } = found else { panic!("joint {joint}: {found:?}") };
            assert_eq!(named, joint);
            assert!((by_rad - 0.05).abs() < 1e-6, "{by_rad}");
        }
    }
}

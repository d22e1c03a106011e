//! Concealed trials: an arm written here, apart from the model (a bare product of turns and shifts), does something that
//! its robot file does not say; the diagnosis must say what. The larger trials stand in docs/diagnosis.md.

#![allow(clippy::expect_used, reason = "a test may stop where its own preparation fails")]

use std::fmt::Write;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use falsetarget::base::text::Source;
use falsetarget::diagnose::diagnosis::{Diagnosis, Verdict, diagnose};
use falsetarget::diagnose::updated::updated;
use falsetarget::files::{recording, robot};
use falsetarget::identify::predict::predict;
use falsetarget::measure::observation::Observation;
use falsetarget::measure::recording::Recording;
use falsetarget::model::arm::ArmModel;
use falsetarget::report::diagnosis::DiagnosisReport;

/// Rows theta, d, a, alpha (deg and mm), standard convention.
const ROWS: [[f64; 4]; 6] = [
    [0.0, 480.0, 120.0, -90.0],
    [-90.0, 0.0, 640.0, 0.0],
    [0.0, 0.0, 110.0, -90.0],
    [0.0, 690.0, 0.0, 90.0],
    [0.0, 0.0, 0.0, -90.0],
    [180.0, 110.0, 0.0, 0.0],
];
const TOOL_MM: [f64; 3] = [40.0, -30.0, 160.0];
const NOISE_MM: f64 = 0.03;

fn robot_text() -> String {
    let mut text = String::from("schema: falsetarget/robot/1\nname: trial\nconvention: standard-dh\njoints:\n");
    for (index, [theta, d, a, alpha]) in ROWS.iter().enumerate() {
        writeln!(
            text,
            "  - {{name: J{}, theta_deg: {theta}, d_mm: {d}, a_mm: {a}, alpha_deg: {alpha}, min_deg: -150, max_deg: 150}}",
            index + 1
        )
        .expect("a string");
    }
    text + "base: {xyz_mm: [0, 0, 0], rpy_deg: [0, 0, 0]}\ntool: {xyz_mm: [40, -30, 160], rpy_deg: [0, 0, 0]}\n"
}

/// What a trial conceals: extra turns of the joints, rad, from joint numbers, rad, and senses of approach.
type Concealed = fn(&[f64; 6], &[f64; 6]) -> [f64; 6];

/// A recording of an arm with random geometry errors, noise, and what is concealed.
fn recorded(records: usize, seed: u64, concealed: Concealed) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let normal = |random: &mut ChaCha8Rng| -> f64 { StandardNormal.sample(random) };
    // Every link carries a displacement of its own, six numbers, not those of the tool's error parameters.
    let links: Vec<Isometry3<f64>> = (0..6)
        .map(|_| {
            let shift = Vector3::from_fn(|_, _| 0.3 * normal(&mut random));
            let turn = Vector3::from_fn(|_, _| 4e-4 * normal(&mut random));
            Isometry3::new(shift, turn)
        })
        .collect();
    let columns = ["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"].join(",");
    let senses = ["dir1", "dir2", "dir3", "dir4", "dir5", "dir6"].join(",");
    let mut text = format!("id,{columns},{senses},t_s,x_mm,y_mm,z_mm\n");
    for record in 0..records {
        let joints_deg: [f64; 6] = std::array::from_fn(|_| (random.random::<f64>() - 0.5) * 220.0);
        let joints_deg = joints_deg.map(|angle| (1e4 * angle).round() / 1e4);
        let joints = joints_deg.map(f64::to_radians);
        let sense: [f64; 6] = std::array::from_fn(|_| if random.random::<f64>() < 0.5 { -1.0 } else { 1.0 });
        let extra = concealed(&joints, &sense);
        let mut pose = Isometry3::identity();
        for (row, [theta, d, a, alpha]) in ROWS.iter().enumerate() {
            let turn =
                UnitQuaternion::from_axis_angle(&Vector3::z_axis(), theta.to_radians() + joints[row] + extra[row]);
            let twist = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), alpha.to_radians());
            pose = pose * turn * Translation3::new(*a, 0.0, *d) * twist * links[row];
        }
        let point = pose * nalgebra::Point3::from(TOOL_MM);
        write!(text, "{}", record + 1).expect("a string");
        joints_deg.iter().chain(&sense).for_each(|number| write!(text, ",{number}").expect("a string"));
        write!(text, ",{}", 10 * record).expect("a string");
        point.iter().for_each(|x| write!(text, ",{:.5}", x + NOISE_MM * normal(&mut random)).expect("a string"));
        text.push('\n');
    }
    text
}

fn diagnosed<'a>(recordings: &'a [Recording], arm: &ArmModel) -> Diagnosis<'a> {
    diagnose(arm, recordings, 1).expect("a diagnosis")
}

fn trial(seed: u64, concealed: Concealed) -> (Vec<Recording>, ArmModel) {
    trial_of(160, seed, concealed)
}

fn trial_of(records: usize, seed: u64, concealed: Concealed) -> (Vec<Recording>, ArmModel) {
    let robot = robot::read(&Source::new("robot.yaml", robot_text())).expect("a robot");
    let text = recorded(records, seed, concealed);
    let recording = recording::read(&Source::new("r.csv", text), &robot).expect("a recording");
    (vec![recording], ArmModel::nominal(robot))
}

#[test]
fn nothing_is_named_where_nothing_is_missing() {
    let (recordings, arm) = trial(5, |_, _| [0.0; 6]);
    let found = diagnosed(&recordings, &arm);
    assert_eq!(found.verdict, Verdict::NothingMissing, "{:?}", found.findings);
    assert!(found.outliers.is_empty());
    // Noise per axis of 160 records: known to 4 %.
    assert!((1e3 * found.noise_sigma_m / NOISE_MM - 1.0).abs() < 0.15, "{}", found.noise_sigma_m);
}

#[test]
fn a_periodic_error_and_a_lost_motion_are_found_in_turn_with_their_sizes() {
    let (recordings, arm) = trial(6, |q, sense| {
        let mut extra = [0.0; 6];
        extra[3] = 4e-4 * (3.0 * q[3] + 0.7).sin();
        extra[0] = -6e-5 * sense[0];
        extra
    });
    let found = diagnosed(&recordings, &arm);
    assert_eq!(found.verdict, Verdict::Explained);
    let named: Vec<(&str, Option<usize>)> = found
        .findings
        .iter()
        .map(|finding| (finding.instance.effect.meta().id, finding.instance.location.joint))
        .collect();
    assert!(named.contains(&("joint_periodic", Some(4))), "{named:?}");
    // Without masses in the robot file play and wind-up are one: either name, the other as its rival.
    let lost = found.findings.iter().find(|finding| finding.instance.location.joint == Some(1)).expect("joint 1");
    let names: Vec<&str> =
        lost.alternatives.iter().map(|rival| rival.effect).chain([lost.instance.effect.meta().id]).collect();
    assert!(names.contains(&"backlash") && names.contains(&"friction_windup"), "{names:?}");
    assert_eq!(found.findings.len(), 2);
    let periodic = found.findings.iter().find(|finding| finding.instance.location.joint == Some(4)).expect("joint 4");
    assert_eq!(periodic.instance.location.order, Some(3.0));
    let [low, high] = periodic.order_95.expect("an interval");
    assert!(low < 3.0 && high > 3.0 && high - low < 0.2, "{low} to {high}");
    let amplitude = periodic.values[0].value.hypot(periodic.values[1].value);
    assert!((amplitude / 4e-4 - 1.0).abs() < 0.1, "{amplitude}");
    // What is left is noise and the uncertainty of some 30 numbers from 160 records.
    let noise_rms_mm = NOISE_MM * 3f64.sqrt();
    assert!(found.after.held_out_rms_mm < 1.35 * noise_rms_mm && found.before.held_out_rms_mm > 1.4 * noise_rms_mm);
}

/// Two waves a turn of the wave generator of a 1:160 strain wave gear.
#[test]
fn a_very_fine_line_is_found_where_the_poses_sample_it() {
    let (recordings, arm) = trial_of(240, 10, |q, _| {
        let mut extra = [0.0; 6];
        extra[1] = 7e-5 * (320.0 * q[1] + 0.4).sin();
        extra
    });
    let found = diagnosed(&recordings, &arm);
    let [line] = &found.findings[..] else { panic!("{:?}", found.findings) };
    let location = line.instance.location;
    assert_eq!((line.instance.effect.meta().id, location.joint), ("joint_periodic", Some(2)));
    assert!((location.order.expect("an order") - 320.0).abs() < 0.1, "{location}");
}

/// Where a tracker stands that was set up again, seen from where it stood.
fn elsewhere() -> Isometry3<f64> {
    Isometry3::new(Vector3::new(1.8e-3, -0.9e-3, 1.1e-3), Vector3::new(0.7e-3, -1.1e-3, 0.9e-3))
}

/// A recording of a periodic error whose records from number `first` on were measured from [`elsewhere`].
fn set_up_twice(seed: u64, first: usize) -> (Vec<Recording>, ArmModel) {
    let (mut recordings, arm) = trial(seed, |q, _| {
        let mut extra = [0.0; 6];
        extra[3] = 4e-4 * (3.0 * q[3] + 0.7).sin();
        extra
    });
    for record in recordings[0].observations.iter_mut().skip(first) {
        let point = &mut record.measured.as_mut().expect("measured").position_m;
        *point = elsewhere().transform_point(&(*point).into()).coords;
    }
    (recordings, arm)
}

#[test]
fn a_station_that_stood_elsewhere_gets_its_frame_and_hides_nothing() {
    let (mut recordings, arm) = set_up_twice(21, 70);
    for (index, record) in recordings[0].observations.iter_mut().enumerate() {
        record.station = Some(if index < 70 { "first" } else { "second" }.into());
    }
    let found = diagnosed(&recordings, &arm);
    assert_eq!(found.verdict, Verdict::Explained);
    let named: Vec<&str> = found.findings.iter().map(|finding| finding.instance.effect.meta().id).collect();
    assert_eq!(named, ["joint_periodic"]);
    let report = DiagnosisReport::new(&found);
    let moved = report.stations.iter().find(|station| station.own_frame).expect("one of the two");
    assert_eq!(moved.name.as_deref(), Some("first"), "the larger one is the reference");
    assert!((moved.turn_deg.to_radians() / elsewhere().rotation.angle() - 1.0).abs() < 0.05, "{}", moved.turn_deg);
    // Each record is predicted where its own station sees it.
    let model = updated(&found, &recordings);
    let records: Vec<&Observation> = recordings[0].observations.iter().collect();
    let predicted = predict(&model.arm, None, &model.stations, &records).expect("poses");
    let furthest_mm = predicted.iter().zip(&records).map(|(predicted, record)| {
        let measured = record.measured.as_ref().expect("measured").position_m;
        1e3 * (predicted.position_m - measured).norm()
    });
    assert!(furthest_mm.fold(0.0, f64::max) < 6.0 * NOISE_MM);
}

/// Whether in the middle, or so late or so early that the fewer records look like gross errors.
#[test]
fn a_large_step_does_not_hide_a_small_error() {
    for first in [70, 115, 140, 25] {
        let (recordings, arm) = set_up_twice(22, first);
        let found = diagnosed(&recordings, &arm);
        let mut named: Vec<&str> = found.findings.iter().map(|finding| finding.instance.effect.meta().id).collect();
        named.sort_unstable();
        assert_eq!(named, ["joint_periodic", "step_shift"], "{first}");
        assert!(found.outliers.is_empty(), "{first}: {:?}", found.outliers);
        assert!((1e3 * found.noise_sigma_m / NOISE_MM - 1.0).abs() < 0.15, "{first}: {}", found.noise_sigma_m);
    }
}

/// Recordings of other arms, by another simulator: what their robot files state of a drive is taken from the file, and found.
#[test]
fn a_compliance_that_is_switched_off_is_found_again() {
    for (folder, joint) in [("null-a", 1), ("null-a", 3), ("null-b", 2)] {
        let path = |file: &str| format!("{}/calibration/recordings/{folder}/{file}", env!("CARGO_MANIFEST_DIR"));
        let source = |file: &str| Source::new(file, std::fs::read_to_string(path(file)).expect("a file"));
        let mut robot = robot::read(&source("robot.yaml")).expect("a robot");
        let known = std::mem::take(&mut robot.compliance_rad_per_nm[joint]);
        let recordings = [recording::read(&source("recording.csv"), &robot).expect("a recording")];
        let arm = ArmModel::nominal(robot);
        let found = diagnosed(&recordings, &arm);
        let [finding] = &found.findings[..] else { panic!("{folder}, joint {}: {:?}", joint + 1, found.findings) };
        assert_eq!(finding.instance.effect.meta().id, "joint_compliance");
        assert_eq!(finding.instance.location.joint_index(), Some(joint));
        let again = &finding.values[0];
        assert!((again.value - known).abs() < 3.0 * again.sigma, "{} +- {} for {known}", again.value, again.sigma);
        assert_eq!(found.verdict, Verdict::Explained);
    }
}

/// A tracker that stands 3 m away and whose horizontal circle is off centre: nothing in the arm is to blame.
#[test]
fn an_error_of_the_trackers_beam_is_none_of_the_arm() {
    let (mut recordings, arm) = trial(9, |_, _| [0.0; 6]);
    let stands_m = Vector3::new(2.4, -1.8, 0.0);
    for record in &mut recordings[0].observations {
        let point = &mut record.measured.as_mut().expect("measured").position_m;
        let beam = *point - stands_m;
        let turn_rad = 6e-5 * (9.0 * beam.y.atan2(beam.x)).sin();
        *point = stands_m + UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn_rad) * beam;
    }
    let found = diagnosed(&recordings, &arm);
    assert_eq!(found.verdict, Verdict::Unexplained, "{:?}", found.findings);
    let unexplained = found.unexplained.as_ref().expect("structure");
    assert_eq!(unexplained.depends_on(), ["beam_azimuth"]);
    assert!(unexplained.place().starts_with("measurement"), "{}", unexplained.place());
    assert!(found.learned.is_none(), "an arm is not taught what its tracker does");
}

#[test]
fn what_has_no_name_is_located_and_not_named() {
    let (recordings, arm) = trial(7, |q, _| {
        let mut extra = [0.0; 6];
        extra[4] = 9e-4 * (1.7 * q[1]).sin() * (1.3 * q[3]).cos();
        extra
    });
    let found = diagnosed(&recordings, &arm);
    assert_eq!(found.verdict, Verdict::Unexplained, "{:?}", found.findings);
    let unexplained = found.unexplained.as_ref().expect("something without a name");
    assert_eq!(unexplained.location().joint, Some(5));
    assert_eq!(unexplained.depends_on(), ["q2", "q4"]);
    // The updated model holds it all the same, and knows what it holds: asked again, it misses nothing.
    let [before, after] = found.learned.as_ref().expect("learned").held_out_rms_mm;
    assert!(after < 0.5 * before, "{before} {after}");
    let model = updated(&found, &recordings);
    assert!(model.arm.learner.is_some());
    assert_eq!(diagnosed(&recordings, &model.arm).verdict, Verdict::NothingMissing);
    // What geometry undoes of a network is no uncertainty of a point: radii are those of an error of half the noise.
    let records: Vec<&Observation> = recordings[0].observations.iter().collect();
    let uncertainty = model.uncertainty.as_ref();
    let predicted = predict(&model.arm, uncertainty, &model.stations, &records).expect("poses");
    let mut radii_mm: Vec<f64> = predicted.iter().map(|one| 1e3 * one.u95_m.expect("a radius")).collect();
    radii_mm.sort_by(f64::total_cmp);
    assert!((0.5 * NOISE_MM..5.0 * NOISE_MM).contains(&radii_mm[radii_mm.len() / 2]), "{radii_mm:?}");
}

/// On some arms the third number counts the second joint's turn. The gear does not.
#[test]
fn a_line_of_a_coupled_joint_follows_its_drive() {
    let coupled = robot_text() + "coupling: [{joint: 3, by: 2, factor: 1}]\n";
    let robot = robot::read(&Source::new("robot.yaml", coupled)).expect("a robot");
    let text = recorded(160, 6, |q, _| {
        let mut extra = [0.0; 6];
        extra[2] = q[1] + 3e-4 * (21.25 * (q[1] + q[2])).sin();
        extra
    });
    let recordings = [recording::read(&Source::new("r.csv", text), &robot).expect("a recording")];
    let found = diagnosed(&recordings, &ArmModel::nominal(robot));
    let [finding] = &found.findings[..] else { panic!("{:?}", found.findings) };
    let location = finding.instance.location;
    assert_eq!((finding.instance.effect.meta().id, location.joint), ("joint_periodic", Some(3)));
    assert!((location.order.expect("an order") - 21.25).abs() < 0.05, "{location:?}");
}

/// An encoder whose error is no line but a band of them: 40 orders from 5 to 33, closer than a joint's range resolves.
fn band(angle_rad: f64, amplitude_rad: f64, phase: f64) -> f64 {
    let line = |k: u32| ((5.0 + 0.7 * f64::from(k)) * angle_rad + phase * f64::from(k * k)).sin();
    amplitude_rad * (0..40).map(line).sum::<f64>()
}

#[test]
fn a_joint_of_many_lines_gets_one_curve_and_one_name() {
    let (recordings, arm) = trial_of(300, 8, |q, _| {
        let mut extra = [0.0; 6];
        extra[1] = band(q[1], 4e-5, 1.1);
        extra[2] = band(q[2], 4e-5, 2.3);
        extra
    });
    let found = diagnosed(&recordings, &arm);
    let named: Vec<_> = found.findings.iter().map(|finding| &finding.instance).collect();
    assert!(named.iter().all(|one| one.effect.meta().id == "joint_periodic"), "{named:?}");
    let mut joints: Vec<Option<usize>> = named.iter().map(|one| one.location.joint).collect();
    joints.sort_unstable();
    assert_eq!(joints, [Some(2), Some(3)]);
    assert!(found.estimate.fit.state.model.learner.is_some(), "a list of lines instead of curves");
    for finding in &found.findings {
        let order = finding.instance.location.order.expect("its strongest line");
        assert!((4.0..35.0).contains(&order), "{order}");
        // The root mean square of such a sum is the root of half the sum of squares.
        let rms = finding.values.iter().find(|value| value.name == "rms_of_all_orders").expect("its size");
        assert!((rms.value / (4e-5 * 20f64.sqrt()) - 1.0).abs() < 0.25, "{rms:?}");
    }
    assert!(found.after.held_out_rms_mm < 0.6 * found.before.held_out_rms_mm);
}

/// Ten orders from 3.2 to 7.3, none of them much of the whole: a function of the joint's angle that is seen to repeat.
#[test]
fn what_follows_a_joints_own_angle_and_repeats_is_periodic() {
    let (recordings, arm) = trial_of(300, 8, |q, _| {
        let line = |k: u32| ((3.2 + 0.45 * f64::from(k)) * q[1] + 1.1 * f64::from(k * k)).sin();
        [0.0, 4e-5 * (0..10).map(line).sum::<f64>(), 0.0, 0.0, 0.0, 0.0]
    });
    let found = diagnosed(&recordings, &arm);
    let [finding] = &found.findings[..] else { panic!("{:?}", found.findings) };
    assert_eq!((finding.instance.effect.meta().id, finding.instance.location.joint), ("joint_periodic", Some(2)));
    assert_eq!(found.verdict, Verdict::Explained);
}

#[test]
fn a_damaged_place_of_a_gear_is_not_periodic() {
    let (recordings, arm) =
        trial_of(300, 8, |q, _| [0.0, 0.0, 6e-4 * (-0.5 * ((q[2] - 0.4) / 0.12).powi(2)).exp(), 0.0, 0.0, 0.0]);
    let found = diagnosed(&recordings, &arm);
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let unexplained = found.unexplained.as_ref().expect("a bump");
    assert_eq!((unexplained.location().joint, unexplained.depends_on()), (Some(3), vec!["q3".to_string()]));
    let [before, after] = found.learned.as_ref().expect("learned").held_out_rms_mm;
    assert!(after < 0.7 * before, "{before} {after}");
}

#[test]
fn what_would_not_show_is_told() {
    let (recordings, arm) = trial(5, |_, _| [0.0; 6]);
    let found = diagnosed(&recordings, &arm);
    let limit = found.next_measurements.iter().find(|advice| advice.why.contains("mrad")).expect("a limit");
    let of_first: f64 = limit
        .why
        .split("J1 ")
        .nth(1)
        .and_then(|text| text.split(',').next())
        .expect("joint 1")
        .parse()
        .expect("a number");
    assert!((0.005..0.2).contains(&of_first), "{}", limit.why);
}

//! What people get wrong: each ends in a good model with the fault named, or in a refusal that names it.

use falsetarget::files::calibration::Calibration;
use falsetarget::identify::calibrate::Refusal;
use falsetarget::identify::report::Report;
use falsetarget::measure::observation::Observation;
use falsetarget::measure::recording::Recording;
use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::shelf::{calibrated, missed_mm, recording_of, robot_of};

const SIGMA_MM: f64 = 0.04;

fn edited(edit: impl FnMut(usize, &mut Observation)) -> Recording {
    let mut recording = recording_of("null-a", "recording.csv");
    let mut edit = edit;
    for (index, record) in recording.observations.iter_mut().enumerate() {
        edit(index, record);
    }
    recording
}

fn calibrate(recording: Recording) -> Result<(Calibration, Report), Refusal> {
    calibrated(&robot_of("null-a"), &[recording])
}

fn move_point(record: &mut Observation, by: impl FnOnce(&mut Vector3<f64>)) {
    by(&mut record.measured.as_mut().expect("measured").position_m);
}

/// RMS distance of predictions from the truth, mm.
fn held_out_mm(model: &Calibration) -> f64 {
    missed_mm(model, "null-a")
}

#[test]
fn wrong_readings_of_the_file_are_said_not_fitted() {
    type Edit = Box<dyn FnMut(usize, &mut Observation)>;
    let cases: Vec<(Edit, &str)> = vec![
        (Box::new(|_, record| move_point(record, |point| *point *= 1e-3)), "lengths in metres"),
        (Box::new(|_, record| move_point(record, |point| *point /= 25.4)), "lengths in inches"),
        (Box::new(|_, record| record.numbers_rad = record.numbers_rad.map(f64::to_radians)), "in radians"),
        (Box::new(|_, record| record.numbers_rad[1] *= -1.0), "joint 2 counted the other way"),
        (Box::new(|_, record| record.numbers_rad[5] *= -1.0), "joint 6 counted the other way"),
        (Box::new(|_, record| record.numbers_rad[2] += std::f64::consts::FRAC_PI_2), "zero of joint 3 moved by -90"),
        (Box::new(|_, record| record.numbers_rad[4] += std::f64::consts::PI), "zero of joint 5 moved by 180"),
        (Box::new(|_, record| record.numbers_rad.swap(3, 4)), "columns of joints 4 and 5 exchanged"),
        (Box::new(|_, record| move_point(record, |point| point.swap_rows(0, 1))), "two columns are swapped"),
        (Box::new(|_, record| move_point(record, |point| point.z = -point.z)), "left-handed"),
        (
            Box::new(|_, record| move_point(record, |point| *point = Vector3::new(-point.y, point.x, point.z))),
            "turned by 90 deg about z",
        ),
        (
            Box::new(|_, record| move_point(record, |point| point.x += 0.7)),
            "mm and 0.0 deg from where the robot file has it",
        ),
    ];
    for (edit, sentence) in cases {
        let refusal = calibrate(edited(edit)).expect_err(sentence).to_string();
        assert!(refusal.contains(sentence) && refusal.contains("times better"), "{refusal}");
    }
    let both = edited(|_, record| {
        record.numbers_rad[1] *= -1.0;
        move_point(record, |point| *point *= 1e-3);
    });
    let refusal = calibrate(both).expect_err("two misreadings").to_string();
    assert!(refusal.contains("metres") && refusal.contains("joint 2"), "{refusal}");
}

#[test]
fn a_recording_in_disorder_is_refused() {
    let points: Vec<_> = recording_of("null-a", "recording.csv").observations.iter().map(|one| one.measured).collect();
    let shuffled = edited(|index, record| record.measured = points[(index * 89 + 17) % points.len()]);
    assert!(calibrate(shuffled).expect_err("disorder").to_string().contains("does not fit this robot"));
    let few = {
        let mut recording = edited(|_, _| {});
        recording.observations.truncate(8);
        recording
    };
    assert!(matches!(calibrate(few), Err(Refusal::TooFewRecords { measured: 8 })));
}

#[test]
fn ten_percent_gross_errors_are_found_listed_and_do_no_harm() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let spoiled = edited(|index, record| {
        if index % 10 == 3 {
            let size = [0.003, 0.05, 0.6][index / 10 % 3];
            move_point(record, |point| *point += Vector3::from_fn(|_, _| size * (2.0 * random.random::<f64>() - 1.0)));
        }
    });
    let (model, report) = calibrate(spoiled).expect("a model");
    let wrong: Vec<&str> = report.left_out.iter().map(|left| left.id.as_str()).collect();
    let expected: Vec<String> = (0..240).filter(|index| index % 10 == 3).map(|index| (index + 1).to_string()).collect();
    assert_eq!(wrong, expected);
    assert!(held_out_mm(&model) <= 0.6 * SIGMA_MM, "{}", held_out_mm(&model));
}

#[test]
fn mistakes_in_single_records_have_their_reasons() {
    let mut recording = edited(|_, _| {});
    move_point(&mut recording.observations[10], |point| point.swap_rows(0, 1));
    recording.observations[50].numbers_rad[3] += 0.03;
    let next = recording.observations[91].measured;
    recording.observations[91].measured = std::mem::replace(&mut recording.observations[90].measured, next);
    move_point(&mut recording.observations[130], |point| *point *= 1e-3);
    let copy = recording.observations[20].clone();
    recording.observations.push(copy);
    recording.observations[200].measured = None;
    let (model, report) = calibrate(recording).expect("a model");
    let mut found: Vec<(&str, &str)> = report.left_out.iter().map(|left| (left.id.as_str(), left.code)).collect();
    found.sort_unstable();
    let mut expected = vec![
        ("11", "swapped-coordinates"),
        ("51", "one-joint"),
        ("91", "wrong-row"),
        ("92", "wrong-row"),
        ("131", "unit"),
        ("21", "duplicate"),
        ("201", "unmeasured"),
    ];
    expected.sort_unstable();
    assert_eq!(found, expected);
    let reading = report.left_out.iter().find(|left| left.code == "one-joint").expect("listed");
    assert!(reading.reason.contains("joint 4") && reading.reason.contains("1.7"), "{}", reading.reason);
    assert!(held_out_mm(&model) <= 0.6 * SIGMA_MM);
}

#[test]
fn forty_poses_do_not_explode() {
    let mut recording = edited(|_, _| {});
    recording.observations.truncate(40);
    let (model, report) = calibrate(recording).expect("a model");
    assert!(held_out_mm(&model) < 2.0 * SIGMA_MM, "{}", held_out_mm(&model));
    assert!(report.notes.iter().any(|note| note.contains("too few records")));
}

#[test]
fn a_joint_that_hardly_moved_is_named_and_its_numbers_stay_near_nominal() {
    let robot = robot_of("null-a");
    let arm = crate::simulator::VirtualArm::draw(&robot, 77);
    let mut poses = crate::simulator::poses(&robot, 120, 5);
    for pose in &mut poses {
        pose[4] = 0.7 + 0.001 * pose[4];
    }
    let points: Vec<Vector3<f64>> = poses.iter().map(|pose| arm.point(pose)).collect();
    let recording = crate::simulator::record(&poses, &points, SIGMA_MM * 1e-3, 6);
    let (_, report) = calibrated(&robot, &[recording]).expect("a model");
    assert!(report.notes.iter().any(|note| note.starts_with("joint 5 moved only")), "{:?}", report.notes);
    assert!(!report.undetermined.is_empty());
    for parameter in report.parameters.iter().filter(|one| report.undetermined.contains(&one.name)) {
        assert!(parameter.value.abs() < 2.5 * parameter.prior_sigma, "{parameter:?}");
    }
}

#[test]
fn a_station_that_moved_gets_its_own_frame_and_work_areas_do_not() {
    // Nearly half of the records, by half a millimetre: no robust fit alone would see it.
    let moved = edited(|index, record| {
        record.station = Some(if index < 121 { "A" } else { "B" }.to_string());
        if index >= 121 {
            move_point(record, |point| point.x += 5e-4);
        }
    });
    let (model, report) = calibrate(moved).expect("a model");
    let own: Vec<_> = report.stations.iter().filter(|station| station.own_frame).collect();
    assert_eq!(own.len(), 1);
    assert_eq!(own[0].name.as_deref(), Some("B"));
    assert!((own[0].shift_mm - 0.5).abs() < 0.1, "{own:?}");
    assert_eq!(model.stations.len(), 1);
    assert!(held_out_mm(&model) <= 0.6 * SIGMA_MM, "{}", held_out_mm(&model));
    let areas = edited(|index, record| record.station = Some(format!("area {}", index % 6)));
    let (_, report) = calibrate(areas).expect("a model");
    assert!(report.stations.iter().all(|station| !station.own_frame));
}

#[test]
fn a_second_tracker_position_in_a_second_file_is_found() {
    let turn = falsetarget::geometry::pose::rotation_from_vector(&Vector3::new(0.1, -0.2, 1.0));
    let (mut first, mut second) = (edited(|_, _| {}), edited(|_, _| {}));
    first.observations.truncate(140);
    second.observations.drain(..140);
    second.name = "second.csv".into();
    for record in &mut second.observations {
        move_point(record, |point| *point = turn * *point + Vector3::new(2.0, -3.0, 0.4));
    }
    let (model, report) = calibrated(&robot_of("null-a"), &[first, second]).expect("a model");
    assert_eq!(model.stations.len(), 1);
    assert_eq!(model.stations[0].name, "second.csv");
    assert_eq!(report.recordings.iter().map(|one| one.records).collect::<Vec<_>>(), [140, 100]);
    assert!(held_out_mm(&model) <= 0.6 * SIGMA_MM, "{}", held_out_mm(&model));
}

#[test]
fn many_records_off_by_one_drive_are_physics_and_stay_in() {
    // Play of 1.3 mrad in joint 3 that one record in twelve takes up the other way.
    let play = edited(|index, record| {
        if index % 12 == 5 {
            record.numbers_rad[2] += 1.3e-3;
        }
    });
    let (_, report) = calibrate(play).expect("a model");
    assert!(report.left_out.is_empty(), "{:?}", report.left_out);
    assert!(report.rest.sigma_mm > 3.0 * SIGMA_MM, "{:?}", report.rest);
}

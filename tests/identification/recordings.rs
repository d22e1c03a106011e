//! The recordings on the shelf: figures as good as those that are known for them.

use falsetarget::identify::report::Report;

use falsetarget::geometry::pose::{rotation_from_vector, vector_from_rotation};
use nalgebra::{Matrix3, Vector3};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

use crate::shelf::{calibrated, missed_mm, recording_of, robot_of, validation};
use crate::simulator::{VirtualArm, poses, record};

fn report_of(folder: &str, file: &str) -> Report {
    calibrated(&robot_of(folder), &[recording_of(folder, file)]).expect("a model").1
}

#[test]
fn where_nothing_is_missing_the_truth_is_met_to_0_6_sigma() {
    for (folder, sigma_mm) in [("null-a", 0.04), ("null-b", 0.06), ("null-c", 0.02)] {
        let recording = recording_of(folder, "recording.csv");
        let (model, report) = calibrated(&robot_of(folder), &[recording]).expect("a model");
        let rms_mm = missed_mm(&model, folder);
        assert!(rms_mm <= 0.6 * sigma_mm, "{folder}: {rms_mm} mm with noise of {sigma_mm} mm");
        assert!((report.rest.noise_sigma_mm / sigma_mm - 1.0).abs() < 0.1, "{folder}: {:?}", report.rest);
        assert_eq!(report.rest.unexplained_sigma_mm, 0.0, "{folder}");
        assert!(report.left_out.is_empty(), "{folder}: {:?}", report.left_out);
        // What drives of that class are: the stated compliances are the true ones of these recordings.
        let robot = robot_of(folder);
        for (joint, stated) in robot.compliance_rad_per_nm.iter().enumerate().filter(|(_, stated)| **stated > 0.0) {
            let name = format!("joint_compliance at joint {}: compliance", joint + 1);
            let found = report.parameters.iter().find(|one| one.name == name).expect("a compliance");
            assert!((found.value - stated).abs() < 5.0 * found.sigma, "{folder} {name}: {found:?}");
        }
    }
}

#[test]
fn the_protocol_of_the_paper_gives_the_picture_of_the_paper() {
    let report = report_of("hh800-class", "recording.csv");
    assert_eq!((report.split.identify, report.split.train, report.split.validate), (40, 200, 200));
    let nominal = validation(&report, "nominal");
    assert!((nominal.mean_mm - 5.1).abs() < 0.1, "{nominal:?}");
    let compliant = validation(&report, "geometry_compliance");
    assert!((0.6..0.76).contains(&compliant.mean_mm) && compliant.max_mm < 1.75, "{compliant:?}");
    let geometry = validation(&report, "geometry");
    assert!(geometry.mean_mm > compliant.mean_mm, "{geometry:?}");
    // The sectors are work areas, not trackers; the rest is the arm's, and the tracker's noise is seen through it.
    assert!(report.stations.len() == 10 && report.stations.iter().all(|station| !station.own_frame));
    assert!(report.rest.unexplained_sigma_mm > 0.3, "{:?}", report.rest);
    assert!((0.04..0.065).contains(&report.rest.noise_sigma_mm), "{:?}", report.rest);
    assert!(report.redundant.iter().any(|one| one.name == "joint 1 offset" && one.coupled_with[0].name == "base rz"));
}

#[test]
fn a_real_ur5_reaches_the_known_figures() {
    let report = report_of("ur5", "grid.csv");
    let geometry = validation(&report, "geometry");
    assert!(geometry.mean_mm <= 0.1035 && geometry.rms_mm <= 0.1125 && geometry.max_mm <= 0.265, "{geometry:?}");
    let compliant = validation(&report, "geometry_compliance");
    assert!(compliant.mean_mm <= 0.0955 && compliant.rms_mm <= 0.1045 && compliant.max_mm <= 0.255, "{compliant:?}");
}

#[test]
fn a_real_ur10_reaches_the_known_figures_with_base_and_tool_unknown() {
    let report = report_of("ur10", "series-d.csv");
    let frames = validation(&report, "frames");
    assert!(frames.mean_mm <= 0.7295, "{frames:?}");
    let geometry = validation(&report, "geometry");
    assert!(geometry.mean_mm <= 0.3635 && geometry.rms_mm <= 0.4035, "{geometry:?}");
    let compliant = validation(&report, "geometry_compliance");
    assert!(compliant.mean_mm <= 0.3215 && compliant.rms_mm <= 0.3675 && compliant.max_mm <= 1.055, "{compliant:?}");
}

#[test]
fn full_poses_tell_the_tools_orientation_and_few_of_them_suffice() {
    let mut robot = robot_of("null-a");
    let arm = VirtualArm::draw(&robot, 31);
    let all = poses(&robot, 80, 32);
    let exact: Vec<_> = all.iter().map(|pose| arm.pose(pose)).collect();
    let rotation_of = |pose: usize| -> Matrix3<f64> { exact[pose].fixed_view::<3, 3>(0, 0).into_owned() };
    let point_of = |pose: usize| -> Vector3<f64> { exact[pose].fixed_view::<3, 1>(0, 3).into_owned() };
    let points: Vec<Vector3<f64>> = (0..30).map(point_of).collect();
    let mut recording = record(&all[..30], &points, 4e-5, 33);
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(34);
    let noise_rad = 8e-5;
    for (index, observation) in recording.observations.iter_mut().enumerate() {
        let turn = Vector3::from_fn(|_, _| noise_rad * Distribution::<f64>::sample(&StandardNormal, &mut random));
        let measured = observation.measured.as_mut().expect("measured");
        measured.rotation = Some(rotation_of(index) * rotation_from_vector(&turn));
    }
    // Base and tool are not told: both are found from the recording, the tool with its orientation.
    (robot.base, robot.tool) = (None, None);
    let (model, report) = calibrated(&robot, &[recording]).expect("a model");
    assert!(report.parameters.iter().any(|one| one.name == "tool rz" && one.sigma < 1e-3), "{:?}", report.parameters);
    let prepared = model.arm.prepared();
    let (mut shift, mut turn) = (0.0, 0.0);
    for (index, pose) in all.iter().enumerate().skip(30) {
        let stand = prepared.at(pose, &Default::default(), None).expect("a pose");
        let found = prepared.measured(&stand);
        shift += (found.translation - point_of(index)).norm_squared() / 50.0;
        turn += vector_from_rotation(&(found.rotation.transpose() * rotation_of(index))).norm_squared() / 50.0;
    }
    assert!(shift.sqrt() < 6e-5 && turn.sqrt() < 1e-4, "{} m, {} rad", shift.sqrt(), turn.sqrt());
}

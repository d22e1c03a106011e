//! Every built-in robot stands where its maker's drawings and URDFs say: `calibration/<id>/verify.yaml` holds poses and
//! reaches that were computed without the Denavit-Hartenberg table beside them.

use falsetarget::base::text::Source;
use falsetarget::files::builtin;
use falsetarget::geometry::orientation::OrientationConvention;
use falsetarget::geometry::pose::vector_from_rotation;
use falsetarget::model::arm::ArmModel;
use falsetarget::model::conditions::Conditions;
use serde::Deserialize;

#[derive(Deserialize)]
struct Verification {
    reach: Option<Reach>,
    poses: Vec<KnownPose>,
}

#[derive(Deserialize)]
struct Reach {
    published_mm: f64,
    tolerance_mm: f64,
    measured_to: String,
    joints_deg: [f64; 6],
}

#[derive(Deserialize)]
#[allow(non_snake_case)]
struct KnownPose {
    joints_deg: [f64; 6],
    base_T_flange: PoseInFile,
}

#[derive(Deserialize)]
struct PoseInFile {
    xyz_mm: [f64; 3],
    rpy_deg: [f64; 3],
}

fn verification(id: &str) -> Verification {
    let path = format!("{}/calibration/{id}/verify.yaml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_yaml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn every_folder_is_listed_and_every_listed_robot_is_sound() {
    for (id, text) in builtin::BUILT_IN {
        let robot = falsetarget::files::robot::read(&Source::new(*id, *text)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(robot.name, *id);
    }
    let folders = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/calibration")).expect("calibration/");
    for folder in folders.flatten().filter(|folder| folder.path().join("verify.yaml").exists()) {
        let name = folder.file_name().into_string().expect("a plain name");
        assert!(builtin::BUILT_IN.iter().any(|(id, _)| *id == name), "{name} is not in src/files/builtin.rs");
    }
}

#[test]
fn known_poses_are_met() {
    for (id, _) in builtin::BUILT_IN {
        let model = ArmModel::controller(builtin::by_name(id).expect("listed").expect("sound"));
        let known = verification(id).poses;
        assert!(!known.is_empty(), "{id} has no known pose");
        for pose in known {
            let numbers = pose.joints_deg.map(f64::to_radians);
            let state = model.prepared().at(&numbers, &Conditions::default(), None).expect("a pose");
            let shift = state.base_t_flange.translation * 1e3 - nalgebra::Vector3::from(pose.base_T_flange.xyz_mm);
            assert!(shift.norm() < 1e-6, "{id} at {:?} is off by {shift} mm", pose.joints_deg);
            let angles = pose.base_T_flange.rpy_deg.map(f64::to_radians);
            let expected = OrientationConvention::FixedXyz.rotation(&angles).expect("three angles");
            let turn = vector_from_rotation(&(state.base_t_flange.rotation * expected.transpose())).norm();
            assert!(turn < 1e-9, "{id} at {:?} is turned by {turn} rad", pose.joints_deg);
        }
    }
}

#[test]
fn published_reaches_are_met() {
    let mut checked = 0;
    for (id, _) in builtin::BUILT_IN {
        let Some(reach) = verification(id).reach else { continue };
        let robot = builtin::by_name(id).expect("listed").expect("sound");
        let numbers = reach.joints_deg.map(f64::to_radians);
        assert_eq!(robot.limit_violation(&numbers, 1e-6), None, "{id}");
        let model = ArmModel::controller(robot);
        let state = model.prepared().at(&numbers, &Conditions::default(), None).expect("a pose");
        let point = match reach.measured_to.as_str() {
            "flange" => state.base_t_flange.translation,
            "wrist-centre" => state.chain.frames[4].translation,
            other => panic!("{id}: measured to {other}"),
        };
        let found_mm = point.x.hypot(point.y) * 1e3;
        assert!((found_mm - reach.published_mm).abs() <= reach.tolerance_mm, "{id} reaches {found_mm} mm");
        checked += 1;
    }
    assert!(checked >= 15, "only {checked} reaches are published");
}

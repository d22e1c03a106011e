//! Poses at the edges: nothing panics, and what cannot be done is said with a number.

use falsetarget::geometry::pose::Pose;
use falsetarget::kinematics::choose::Wish;
use falsetarget::kinematics::controller::Controller;
use falsetarget::kinematics::solution::NoSolution;
use nalgebra::{Matrix3, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::arms::*;

#[test]
fn out_of_reach_is_said_in_metres() {
    let robot = named("abb-irb4600");
    let controller = Controller::new(&robot);
    // Straight ahead at shoulder height, the flange pointing forward: reach is a1 + a2 + hypot(a3, d4) + d6.
    let rows = &robot.joints;
    let reach = rows[0].a_m + rows[1].a_m + rows[2].a_m.hypot(rows[3].d_m) + rows[5].d_m;
    let forward = Matrix3::new(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0);
    let at = |x: f64| Pose { rotation: forward, translation: Vector3::new(x, 0.0, rows[0].d_m) };
    match controller.inverse(&at(reach + 0.25)) {
        Err(NoSolution::OutOfReach { by_m }) => assert!((by_m - 0.25).abs() < 1e-12, "{by_m}"),
        other => panic!("{other:?}"),
    }
    assert!(controller.inverse(&at(reach - 1e-9)).is_ok());
    let broken = Pose { translation: Vector3::new(f64::NAN, 0.0, 0.0), ..at(1.0) };
    assert!(matches!(controller.inverse(&broken), Err(NoSolution::NotFinite)));
}

#[test]
fn a_joint_limit_is_named_with_its_number() {
    let mut robot = named("abb-irb4600");
    let numbers = [0.3, 0.2, 0.1, 0.4, 0.5, 0.6];
    let pose = Controller::new(&robot).forward(&numbers).expect("no loop");
    // Every branch has axis 1 at 0.3 or half a turn away: neither is allowed.
    (robot.joints[0].min_rad, robot.joints[0].max_rad) = (-0.2, 0.2);
    let error = Controller::new(&robot).solve(&pose, &Wish::default(), None).expect_err("a limit");
    let NoSolution::JointLimit(violation) = error else { panic!("{error}") };
    assert_eq!(violation.joint, Some(0));
    assert!((violation.value_rad - 0.3).abs() < 1e-9);
    assert_eq!(error.to_string(), "joint 1 would stand at 17.189 deg, outside -11.459 to 11.459 deg");
}

#[test]
fn a_pose_taught_at_a_limit_is_within_it() {
    let robot = named("abb-irb4600");
    let controller = Controller::new(&robot);
    let beyond = |over: f64| {
        let numbers = [0.3, 0.2, 0.1, 0.4, robot.joints[4].max_rad + over, 0.6];
        let pose = controller.forward(&numbers).expect("no loop");
        controller
            .solve(&pose, &Wish::default(), Some(&numbers))
            .is_ok_and(|choice| apart(&choice.numbers_rad, &numbers) < 1e-9)
    };
    assert!(beyond(2e-5));
    assert!(!beyond(2e-3));
}

#[test]
fn the_passive_joint_of_a_loop_has_limits_too() {
    let mut robot = named("hh800-class");
    let controller = Controller::new(&robot);
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let numbers = random_numbers(&robot, &controller, &mut random);
    let pose = controller.forward(&numbers).expect("a closed loop");
    let passive = robot.passive_rad(&numbers);
    let rods = robot.parallelogram.as_mut().expect("a loop");
    (rods.passive_min_rad, rods.passive_max_rad) = (passive + 0.01, passive + 0.02);
    let error = Controller::new(&robot).solve(&pose, &Wish::default(), Some(&numbers)).expect_err("a limit");
    let NoSolution::JointLimit(violation) = error else { panic!("{error}") };
    assert_eq!(violation.joint, None);
    assert!(violation.value_rad < violation.min_rad || violation.value_rad > violation.max_rad);
}

#[test]
fn singular_poses_are_solved_and_random_ones_never_panic() {
    let mut arms = built_in();
    arms.push(uneven_loop());
    for robot in arms {
        let controller = Controller::new(&robot);
        let mut random = ChaCha8Rng::seed_from_u64(9);
        for trial in 0..60 {
            let mut numbers = random_numbers(&robot, &controller, &mut random);
            // Ever nearer to the straight wrist, and on it.
            numbers[4] = if trial < 10 { 0.0 } else { 10f64.powi(-(trial % 16)) };
            let pose = controller.forward(&numbers).expect("a closed loop");
            let branches = controller.inverse(&pose).expect("in reach");
            for solution in branches.iter() {
                let reached = controller.forward(&solution.numbers_rad).expect("a closed loop");
                let allowed = if solution.singularity.wrist_sin < 1e-7 { 3e-7 } else { 1e-10 };
                let error = pose_error(&reached, &pose);
                assert!(error < allowed, "{}: {error} at {numbers:?}", robot.name);
            }
            let choice = controller.solve(&pose, &Wish::default(), Some(&numbers)).expect("in reach and in limits");
            let reached = controller.forward(&choice.numbers_rad).expect("a closed loop");
            assert!(pose_error(&reached, &pose) < 3e-7, "{}", robot.name);
        }
        for _ in 0..200 {
            let wild = std::array::from_fn(|_| random.random_range(-2.0 * PI..2.0 * PI));
            if let Ok(pose) = controller.forward(&wild) {
                let far = Pose { translation: pose.translation * random.random_range(0.0..3.0), ..pose };
                let _ = controller.solve(&far, &Wish::default(), None);
            }
        }
        let origin = Pose::identity();
        let _ = controller.solve(&origin, &Wish::default(), None);
    }
}

#[test]
fn a_wrist_centre_on_axis_one_keeps_the_previous_turn() {
    let robot = named("abb-irb120");
    let controller = Controller::new(&robot);
    // Axis 1 carries no offset in this arm: upright, its wrist centre comes to lie on axis 1 where
    // a2 cos + ... vanish; found here by halving axis 2.
    let ahead = |second: f64| {
        let (chain, _) = controller.chain(&[0.0, second, -1.0, 0.0, 0.7, 0.0]).expect("no loop");
        chain.frames[3].translation.x
    };
    let (mut low, mut high) = (-1.5, 1.5);
    assert!(ahead(low) * ahead(high) < 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if ahead(low) * ahead(middle) <= 0.0 { high = middle } else { low = middle }
    }
    let numbers = [0.8, low, -1.0, 0.3, 0.7, -0.2];
    let pose = controller.forward(&numbers).expect("no loop");
    let choice = controller.solve(&pose, &Wish::default(), Some(&numbers)).expect("in reach");
    assert!(choice.singularity.shoulder_m < 1e-9);
    assert!(apart(&choice.numbers_rad, &numbers) < 1e-7, "{:?}", choice.numbers_rad);
}

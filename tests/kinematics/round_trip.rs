//! Random numbers, forward, inverse: the numbers come back, every solution stands in the pose.

use falsetarget::kinematics::controller::{Controller, Family};
use falsetarget::model::robot::Robot;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::arms::*;

/// Poses nearer to a singular one than this are left to other tests: there the numbers are badly determined.
const CLEAR: f64 = 1e-3;

fn round_trips(robot: &Robot, poses: usize, seed: u64) -> usize {
    let controller = Controller::new(robot);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut most = 0;
    for _ in 0..poses {
        let numbers = random_numbers(robot, &controller, &mut random);
        let wanted = controller.forward(&numbers).expect("a closed loop");
        let branches =
            controller.inverse(&wanted).unwrap_or_else(|error| panic!("{}: {numbers:?}: {error}", robot.name));
        let clear = branches.iter().all(|solution| {
            let near = solution.singularity;
            near.shoulder_m > CLEAR && near.elbow_sin > CLEAR && near.wrist_sin > CLEAR
        });
        if !clear {
            continue;
        }
        for solution in branches.iter() {
            let reached = controller.forward(&solution.numbers_rad).expect("a closed loop");
            let error = pose_error(&reached, &wanted);
            assert!(error < 1e-10, "{}: {error} at {numbers:?}", robot.name);
        }
        let mut nearest = f64::INFINITY;
        for solution in branches.iter() {
            controller.each_turn(solution, |turned| {
                nearest = nearest.min(apart(&turned, &numbers));
                assert!(robot.limit_violation(&turned, 1.001e-4).is_none());
            });
        }
        assert!(nearest < 1e-8, "{}: {numbers:?} is missing by {nearest}", robot.name);
        if robot.parallelogram.is_none() {
            assert_eq!(branches.len() % 2, 0, "{}: {} solutions", robot.name, branches.len());
        }
        most = most.max(branches.len());
    }
    most
}

#[test]
fn built_in_arms_go_round() {
    for robot in built_in() {
        let family = Controller::new(&robot).family();
        let expected = if robot.name.starts_with("ur") { Family::ThreeParallel } else { Family::SphericalWrist };
        assert_eq!(family, expected, "{}", robot.name);
        assert!(round_trips(&robot, 200, 1) >= 4, "{}", robot.name);
    }
}

#[test]
fn random_arms_with_a_spherical_wrist_go_round() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for index in 0..60 {
        let robot = random_spherical(&mut random);
        assert_eq!(Controller::new(&robot).family(), Family::SphericalWrist, "arm {index}");
        round_trips(&robot, 40, index);
    }
}

#[test]
fn random_arms_with_three_parallel_axes_go_round() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for index in 0..40 {
        let robot = random_three_parallel(&mut random);
        assert_eq!(Controller::new(&robot).family(), Family::ThreeParallel, "arm {index}");
        round_trips(&robot, 40, index);
    }
}

#[test]
fn loops_with_uneven_rods_go_round() {
    round_trips(&uneven_loop(), 200, 4);
}

#[test]
fn arms_of_no_family_go_round_by_iteration() {
    for robot in [offset_wrist(), skew()] {
        assert_eq!(Controller::new(&robot).family(), Family::General);
        assert!(round_trips(&robot, 25, 5) >= 8);
    }
}

#[test]
fn an_arm_just_off_its_family_goes_round_by_iteration() {
    for id in ["kuka-kr6-r900", "ur5e"] {
        let mut robot = named(id);
        robot.joints[1].alpha_rad += 1e-3;
        robot.joints[3].a_m += 4e-4;
        robot.joints[4].a_m -= 3e-4;
        assert_eq!(Controller::new(&robot).family(), Family::General);
        round_trips(&robot, 40, 6);
    }
}

#[test]
fn postures_are_distinct_and_complete_for_square_arms() {
    for id in ["abb-irb4600", "ur10e"] {
        let robot = named(id);
        let controller = Controller::new(&robot);
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut full = 0;
        for _ in 0..100 {
            let numbers = random_numbers(&robot, &controller, &mut random);
            let pose = controller.forward(&numbers).expect("no loop");
            let branches = controller.inverse(&pose).expect("in reach");
            let mut postures: Vec<_> = branches.iter().map(|solution| solution.posture).collect();
            let count = postures.len();
            postures.sort_by_key(|posture| (posture.rear, posture.elbow_down, posture.wrist_negative));
            postures.dedup();
            assert_eq!(postures.len(), count, "{id}: two solutions in one posture at {numbers:?}");
            full += usize::from(count == 8);
        }
        assert!(full > 10, "{id}: eight postures only {full} times");
    }
}

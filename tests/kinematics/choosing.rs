//! The choice of a branch.

use falsetarget::geometry::pose::Pose;
use falsetarget::kinematics::choose::Wish;
use falsetarget::kinematics::controller::Controller;
use falsetarget::kinematics::posture::Posture;
use falsetarget::model::robot::DOF;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::arms::*;

fn posture_at(controller: &Controller, numbers: &[f64; DOF]) -> Posture {
    let pose = controller.forward(numbers).expect("a closed loop");
    controller.solve(&pose, &Wish::default(), Some(numbers)).expect("in reach").posture
}

#[test]
fn postures_of_known_poses() {
    let degrees = |numbers: [f64; DOF]| numbers.map(f64::to_radians);
    let check = |id: &str, numbers: [f64; DOF], expected: [bool; 3]| {
        let controller = Controller::new(&named(id));
        let Posture { rear, elbow_down, wrist_negative } = posture_at(&controller, &degrees(numbers));
        assert_eq!([rear, elbow_down, wrist_negative], expected, "{id} at {numbers:?}");
    };
    // Upright lower arm, forearm level and ahead, hand down: every maker's working pose.
    check("abb-irb4600", [20.0, 0.0, 0.0, 0.0, 90.0, 0.0], [false, false, false]);
    check("abb-irb4600", [20.0, 0.0, 0.0, 0.0, -30.0, 0.0], [false, false, true]);
    check("kuka-kr210-r2700", [20.0, -90.0, 90.0, 0.0, 60.0, 0.0], [false, false, false]);
    check("kuka-kr6-r900", [20.0, -90.0, 90.0, 0.0, -60.0, 0.0], [false, false, true]);
    check("fanuc-r2000ic-210f", [20.0, 0.0, 0.0, 0.0, -60.0, 0.0], [false, false, true]);
    check("yaskawa-gp25", [20.0, 0.0, 0.0, 0.0, -60.0, 0.0], [false, false, true]);
    check("hyundai-hs220", [20.0, 90.0, 0.0, 0.0, 30.0, 0.0], [false, false, false]);
    check("staubli-tx90l", [20.0, 0.0, 90.0, 0.0, 30.0, 0.0], [false, false, false]);
    // Leaning back over its own head.
    check("abb-irb4600", [0.0, -80.0, -60.0, 0.0, 30.0, 0.0], [true, false, false]);
    // The forearm folded behind the lower arm: ABB axis 3 beyond the stretched pose.
    check("abb-irb1600", [0.0, 80.0, -150.0, 0.0, 30.0, 0.0], [false, true, false]);
    // At zero a UR arm lies along -x: that is its forward side. Upright with the forearm level it reaches forward with
    // axis 3 at +90 deg, backward over its shoulder with axis 3 at -90 deg and the elbow bent the other way.
    check("ur5e", [0.0, -90.0, 90.0, -90.0, 90.0, 0.0], [false, false, false]);
    check("ur5e", [0.0, -90.0, -90.0, -90.0, -90.0, 0.0], [true, true, true]);
}

#[test]
fn a_posture_wished_is_a_posture_got() {
    for id in ["abb-irb6640", "fanuc-m20ia", "ur10e"] {
        let robot = named(id);
        let controller = Controller::new(&robot);
        let mut random = ChaCha8Rng::seed_from_u64(21);
        for _ in 0..100 {
            let numbers = random_numbers(&robot, &controller, &mut random);
            let pose = controller.forward(&numbers).expect("no loop");
            for solution in controller.inverse(&pose).expect("in reach").iter() {
                let Posture { rear, elbow_down, wrist_negative } = solution.posture;
                let near = solution.singularity;
                if !solution.within_limits || near.elbow_sin.min(near.wrist_sin) < 0.06 || near.shoulder_m < 0.3 {
                    continue;
                }
                let wish = Wish {
                    rear: Some(rear),
                    elbow_down: Some(elbow_down),
                    wrist_negative: Some(wrist_negative),
                    ..Wish::default()
                };
                let choice = controller.solve(&pose, &wish, None).expect("in limits");
                assert_eq!(choice.posture, solution.posture);
                assert_eq!(choice.wish_violation_rad, 0.0);
                assert!(apart_modulo_turns(&choice.numbers_rad, &solution.numbers_rad) < 1e-9);
            }
        }
    }
}

#[test]
fn a_hair_across_a_quadrant_stays_in_its_branch() {
    let controller = Controller::new(&named("abb-irb4600"));
    let hair = 2e-6;
    // Axis 4 was taught at 90 deg less a hair and reads 90 deg and a hair: quadrant 0 is still meant.
    let numbers = [0.5, 0.2, 0.1, PI / 2.0 + hair, 0.8, -1.0];
    let pose = controller.forward(&numbers).expect("no loop");
    let mut wish = Wish::default();
    wish.intervals_rad[0] = Some((0.0, PI / 2.0));
    wish.intervals_rad[3] = Some((0.0, PI / 2.0));
    wish.intervals_rad[5] = Some((-PI / 2.0, 0.0));
    let choice = controller.solve(&pose, &wish, None).expect("in reach");
    assert!(apart(&choice.numbers_rad, &numbers) < 1e-9);
    assert!((choice.wish_violation_rad - hair).abs() < 1e-9);
}

#[test]
fn an_interval_picks_the_turn() {
    let mut robot = named("abb-irb4600");
    for joint in [3, 5] {
        (robot.joints[joint].min_rad, robot.joints[joint].max_rad) = (-400f64.to_radians(), 400f64.to_radians());
    }
    let controller = Controller::new(&robot);
    let numbers = [0.5, 0.2, 0.1, 0.3, 0.8, 0.4 - 2.0 * PI];
    let pose = controller.forward(&numbers).expect("no loop");
    let mut wish = Wish::default();
    wish.intervals_rad[5] = Some((-2.0 * PI, -1.5 * PI));
    let choice = controller.solve(&pose, &wish, None).expect("in reach");
    assert!(apart(&choice.numbers_rad, &numbers) < 1e-9, "{:?}", choice.numbers_rad);
    // Nothing said: the turn nearest to home, or to where the arm was.
    let choice = controller.solve(&pose, &Wish::default(), None).expect("in reach");
    assert!((choice.numbers_rad[5] - 0.4).abs() < 1e-9);
    let choice = controller.solve(&pose, &Wish::default(), Some(&numbers)).expect("in reach");
    assert!(apart(&choice.numbers_rad, &numbers) < 1e-9);
}

#[test]
fn a_path_is_followed_without_a_jump() {
    for id in ["kuka-kr210-r2700", "ur10", "hh800-class", "hyundai-ha006b"] {
        let robot = named(id);
        let controller = Controller::new(&robot);
        let mut random = ChaCha8Rng::seed_from_u64(22);
        for _ in 0..10 {
            let from = random_numbers(&robot, &controller, &mut random);
            let to = random_numbers(&robot, &controller, &mut random);
            let mut previous = from;
            for step in 0..=400 {
                let part = f64::from(step) / 400.0;
                let numbers: [f64; DOF] = std::array::from_fn(|joint| from[joint] + (to[joint] - from[joint]) * part);
                let Ok(pose) = controller.forward(&numbers) else { break };
                let choice = controller.solve(&pose, &Wish::default(), Some(&previous)).expect("in limits");
                let near = choice.singularity;
                if near.wrist_sin < 0.03 || near.elbow_sin < 0.03 || near.shoulder_m < 0.03 {
                    // Where branches meet the nearest one may be another one.
                    break;
                }
                assert!(apart(&choice.numbers_rad, &numbers) < 1e-7, "{id}: step {step}");
                previous = choice.numbers_rad;
            }
        }
    }
}

#[test]
fn a_straight_wrist_keeps_the_turn_of_axis_four() {
    for id in ["abb-irb4600", "kuka-kr500", "hh800-class"] {
        let robot = named(id);
        let controller = Controller::new(&robot);
        let mut numbers = random_numbers(&robot, &controller, &mut ChaCha8Rng::seed_from_u64(23));
        (numbers[3], numbers[4], numbers[5]) = (0.6, 0.0, -1.1);
        let pose = controller.forward(&numbers).expect("a closed loop");
        let mut previous = numbers;
        previous[0] += 0.01;
        let choice = controller.solve(&pose, &Wish::default(), Some(&previous)).expect("in reach");
        assert!(choice.singular);
        assert!(apart(&choice.numbers_rad, &numbers) < 1e-9, "{id}: {:?}", choice.numbers_rad);
        // By quadrants: axis 4 in 0..90, axis 6 in -180..-90.
        let mut wish = Wish { near_rad: Some([numbers[0], numbers[1], numbers[2], 0.0, 0.0, 0.0]), ..Wish::default() };
        wish.intervals_rad[3] = Some((0.0, PI / 2.0));
        wish.intervals_rad[5] = Some((-PI, -PI / 2.0));
        let choice = controller.solve(&pose, &wish, None).expect("in reach");
        assert!(choice.wish_violation_rad < 1e-9, "{id}: {choice:?}");
        let reached = controller.forward(&choice.numbers_rad).expect("a closed loop");
        assert!(pose_error(&reached, &pose) < 1e-9);
    }
}

#[test]
fn a_straight_wrist_of_three_parallel_axes_keeps_axis_six() {
    let robot = named("ur5e");
    let controller = Controller::new(&robot);
    let numbers = [0.4, -1.2, 1.5, -0.6, 0.0, 0.9];
    let pose = controller.forward(&numbers).expect("no loop");
    let choice = controller.solve(&pose, &Wish::default(), Some(&numbers)).expect("in reach");
    assert!(choice.singular);
    assert!(apart(&choice.numbers_rad, &numbers) < 1e-7, "{:?}", choice.numbers_rad);
}

#[test]
fn a_wrist_straight_but_for_rounding_is_straight_when_asked() {
    let controller = Controller::new(&named("abb-irb4600"));
    let taught = [0.3, 0.2, 0.1, 0.5, 0.0, 0.7];
    let exact = controller.forward(&taught).expect("no loop");
    // The file keeps five decimals of the orientation.
    let turn = falsetarget::geometry::pose::rotation_from_vector(&nalgebra::Vector3::new(4e-6, -7e-6, 5e-6));
    let written = Pose { rotation: turn * exact.rotation, ..exact };
    let strict = controller.solve(&written, &Wish::default(), Some(&taught)).expect("in reach");
    assert!(apart(&strict.numbers_rad, &taught) > 0.01);
    let wish = Wish { straight_wrist_rad: 2e-5, ..Wish::default() };
    let loose = controller.solve(&written, &wish, Some(&taught)).expect("in reach");
    assert!(loose.singular && apart(&loose.numbers_rad, &taught) < 5e-5, "{:?}", loose.numbers_rad);
    assert!(pose_error(&controller.forward(&loose.numbers_rad).expect("no loop"), &written) < 4e-5);
}

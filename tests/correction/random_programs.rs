//! The promise of the tool: a corrected program, read again and sent through the controller's nominal inverse and the
//! real arm, lands on the intended poses within 2 um and 5 urad. Random arms, errors, tools, frames and branches.

use std::fmt::Write;

use falsetarget::base::text::Source;
use falsetarget::files::builtin::{BUILT_IN, by_name};
use falsetarget::files::cell::Cell;
use falsetarget::geometry::orientation::{OrientationConvention, quaternion_from_rotation};
use falsetarget::geometry::pose::{Pose, pose_difference};
use falsetarget::kinematics::controller::Controller;
use falsetarget::model::robot::{DOF, Mass};
use falsetarget::program::dialect;
use falsetarget::rewrite::class::Class;
use falsetarget::rewrite::correct::{Job, Options, correct};
use falsetarget::rewrite::play::play;
use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::spoil::{loosen, spoil};
use super::{LANDS_WITHIN_M, LANDS_WITHIN_RAD};

fn random_pose(random: &mut ChaCha8Rng, spread_m: f64) -> Pose {
    let mut any = |size: f64| random.random_range(-size..size);
    let angles = [any(3.1), any(1.5), any(3.1)];
    let rotation = OrientationConvention::FixedXyz.rotation(&angles).expect("three angles");
    Pose { rotation, translation: Vector3::new(any(spread_m), any(spread_m), any(spread_m)) }
}

fn rapid_pose(pose: &Pose, mm_decimals: usize, q_decimals: usize) -> String {
    let p = pose.translation * 1e3;
    let q = quaternion_from_rotation(&pose.rotation);
    format!(
        "[{:.m$},{:.m$},{:.m$}],[{:.d$},{:.d$},{:.d$},{:.d$}]",
        p.x,
        p.y,
        p.z,
        q[0],
        q[1],
        q[2],
        q[3],
        m = mm_decimals,
        d = q_decimals
    )
}

fn quadrant(angle_rad: f64) -> i64 {
    (angle_rad.to_degrees() / 90.0).floor() as i64
}

/// A RAPID program whose targets the nominal arm reaches away from singularities, configuration data as ABB has it.
fn program_text(controller: &Controller, random: &mut ChaCha8Rng, count: usize) -> String {
    let (tool, frame) = (random_pose(random, 0.25), random_pose(random, 1.5));
    let mm_decimals = random.random_range(0..5);
    let q_decimals = random.random_range(5..10);
    let mut text = String::from("MODULE Closure\n");
    let tool_text = rapid_pose(&tool, 4, 9);
    let frame_text = rapid_pose(&frame, 4, 9);
    let _ = writeln!(text, "  PERS tooldata tRandom:=[TRUE,[{tool_text}],[35,[20,0,150],[1,0,0,0],0,0,0]];");
    let _ = writeln!(text, "  PERS wobjdata wRandom:=[FALSE,TRUE,\"\",[{frame_text}],[[0,0,0],[1,0,0,0]]];");
    text.push_str("  PROC main()\n");
    let mut written = 0;
    let mut tries = 0;
    while written < count {
        tries += 1;
        assert!(tries < 1000 * count, "{} has no room", controller.robot().name);
        let numbers: [f64; DOF] = std::array::from_fn(|joint| {
            let limits = &controller.robot().joints[joint];
            let margin = 0.05;
            random.random_range(limits.min_rad + margin..limits.max_rad - margin)
        });
        if controller.robot().limit_violation(&numbers, -0.02).is_some() {
            continue;
        }
        let Ok(flange) = controller.forward(&numbers) else { continue };
        let jacobian = controller.jacobian(&numbers).expect("a pose");
        let singular_values = jacobian.singular_values();
        if singular_values.min() < 0.03 * singular_values.max() {
            continue;
        }
        let target = frame.inverse() * flange * tool;
        let Ok(branches) = controller.inverse(&flange) else { continue };
        let same = |solution: &&falsetarget::kinematics::solution::Solution| {
            let away = |joint: usize| ((solution.numbers_rad[joint] - numbers[joint]) / 2.0).sin().abs();
            (0..DOF).all(|joint| away(joint) < 1e-6)
        };
        let Some(own) = branches.iter().find(same) else { panic!("{numbers:?} is not among the branches") };
        let posture = own.posture;
        let cfx = 4 * u8::from(posture.rear) + 2 * u8::from(posture.elbow_down) + u8::from(posture.wrist_negative);
        let _ = writeln!(
            text,
            "    MoveJ [{},[{},{},{},{cfx}],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,z10,tRandom\\WObj:=wRandom;",
            rapid_pose(&target, mm_decimals, q_decimals),
            quadrant(numbers[0]),
            quadrant(numbers[3]),
            quadrant(numbers[5]),
        );
        written += 1;
    }
    text.push_str("  ENDPROC\nENDMODULE\n");
    text
}

#[test]
fn ten_thousand_corrected_targets_land() {
    let mut random = ChaCha8Rng::seed_from_u64(20_261_122);
    let (mut landed, mut refused, mut worst_m, mut worst_rad, mut missed_before_m) = (0, 0, 0.0f64, 0.0f64, 0.0f64);
    let rounds = 24;
    for round in 0..rounds {
        for (id, _) in BUILT_IN {
            let mut robot = by_name(id).expect("listed").expect("sound");
            robot.payload = Mass { mass_kg: 20.0, center_of_mass_m: Vector3::new(0.02, 0.01, 0.1) };
            robot.gravity_m_s2 = OrientationConvention::FixedXyz
                .rotation(&[random.random_range(-0.5..0.5), random.random_range(-0.5..0.5), 0.0])
                .expect("three angles")
                * robot.gravity_m_s2;
            let controller = Controller::new(&robot);
            let mut model = spoil(robot, &mut random);
            loosen(&mut model, &mut random);
            let text = program_text(&controller, &mut random, 20);
            let sources = [Source::new(format!("{id}-{round}.mod"), text)];
            let rapid = dialect::by_id("rapid").expect("in the registry");
            let program = rapid.read(&sources);
            assert_eq!(program.targets.len(), 20);
            let cell = Cell::default();
            let job = Job { sources: &sources, program: &program, rules: rapid.meta().numbers, cell: &cell };
            let outcome = correct(&job, &model, &controller, &Options::default());
            let bytes = outcome.edits[0].apply(sources[0].bytes()).expect("disjoint edits");
            let again = [Source::new("again", bytes)];
            let reread = rapid.read(&again);
            let before = play(&program, &cell, &model, &controller);
            let after = play(&reread, &cell, &model, &controller);
            for (arrival, meant) in after.iter().zip(&before) {
                assert_eq!(arrival.target, meant.target);
                if outcome.targets[arrival.target].class != Class::Corrected {
                    refused += 1;
                    continue;
                }
                let (shift, turn) = pose_difference(&arrival.landed, &meant.written);
                missed_before_m = missed_before_m.max((meant.landed.translation - meant.written.translation).norm());
                worst_m = worst_m.max(shift.norm());
                worst_rad = worst_rad.max(turn.norm());
                landed += 1;
                assert!(
                    shift.norm() < LANDS_WITHIN_M && turn.norm() < LANDS_WITHIN_RAD,
                    "{id}, target {}: {:.2e} m, {:.2e} rad\n{}",
                    arrival.target,
                    shift.norm(),
                    turn.norm(),
                    again[0].text(reread.targets[arrival.target].span)
                );
            }
        }
    }
    assert!(landed >= 10_000, "only {landed} targets were corrected, {refused} refused");
    assert!(refused * 100 < landed, "{refused} of {} refused", landed + refused);
    assert!(missed_before_m > 1e-3, "the errors were too small to prove anything: {missed_before_m} m");
    println!("{landed} landed within {worst_m:.1e} m and {worst_rad:.1e} rad, {refused} refused");
}

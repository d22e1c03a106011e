//! The simulator itself, held against what is known: with nothing wrong it is the nominal arm, and simple cases have
//! simple answers.

use falsetarget::files::builtin;
use falsetarget::model::arm::ArmModel;
use falsetarget::model::conditions::Conditions;
use falsetarget::model::robot::DOF;

use crate::arm::{Arm, BODIES, Shape};
use crate::cause::{Cause, Frame, MOVING_KINDS, OUTSIDE_KINDS, STATIC_KINDS};
use crate::dice::Dice;
use crate::motion::Moment;
use crate::plan::spec;
use crate::real::Real;
use crate::tables::wilson;
use crate::trial::{Spec, build};

fn at(numbers: [f64; DOF]) -> Moment {
    Moment {
        numbers,
        approach: [1.0; DOF],
        wound: [1.0; DOF],
        time_s: 0.0,
        fraction: 0.5,
        warmer_k: 0.0,
        unsettled: [0.0; DOF],
        motion: None,
    }
}

#[test]
fn with_nothing_wrong_every_built_in_arm_stands_as_its_file_says() {
    let mut dice = Dice::new(1);
    for (id, _) in builtin::BUILT_IN {
        let mut robot = builtin::by_name(id).expect("built in").expect("sound");
        robot.compliance_rad_per_nm[1] = 1e-7;
        robot.compliance_rad_per_nm[3] = 1e-6;
        let arm = Arm::of_file(&robot);
        let model = ArmModel::nominal(robot.clone());
        for _ in 0..20 {
            let numbers = std::array::from_fn(|_| dice.between(-0.4, 0.4));
            let state = model.prepared().at(&numbers, &Conditions::default(), None).expect("a pose");
            let point = Real::new(&arm, &[]).point(&at(numbers)).expect("a pose");
            let apart = point - model.prepared().measured(&state).translation;
            // Both settle under gravity, each by its own statics.
            assert!(apart.norm() < 2e-9, "{id}: {apart}");
        }
    }
}

#[test]
fn a_weight_on_a_level_arm_pulls_as_the_lever_says() {
    let robot = builtin::by_name("abb-irb4600").expect("built in").expect("sound");
    let mut arm = Arm::of_file(&robot);
    arm.lumps.iter_mut().for_each(|lump| lump.mass_kg = 0.0);
    arm.payload.mass_kg = 10.0;
    arm.payload.at_m *= 0.0;
    let drives = [0.0, 0.4, 0.2, 0.0, 0.3, 0.0];
    let stand = arm.stand(&drives, &Shape::default()).expect("a pose");
    let torques = arm.torques(&drives, &Shape::default(), &[arm.gravity; BODIES]).expect("torques");
    let lever = stand.ends[5].translation.x - stand.turning[1].translation.x;
    // Joint 2 leans forward as its number grows: the weight pushes it on.
    assert!((torques[1] - 10.0 * 9.80665 * lever).abs() < 1e-4, "{} {}", torques[1], lever);
    assert!(torques[0].abs() < 1e-5);
}

#[test]
fn a_softened_drive_sags_and_a_shifted_base_shifts() {
    let robot = builtin::by_name("abb-irb4600").expect("built in").expect("sound");
    let arm = Arm::of_file(&robot);
    let moment = at([0.1, 0.4, 0.2, 0.3, 0.3, 0.1]);
    let bare = Real::new(&arm, &[]).point(&moment).expect("a pose");
    let soft = Real::new(&arm, &[(Cause::Compliance { joint: 1 }, 1e-6)]).point(&moment).expect("a pose");
    assert!(soft.z < bare.z - 1e-5);
    let shift = nalgebra::Vector3::new(1.0, 2.0, 3.0);
    let turn = nalgebra::Vector3::zeros();
    let step = Cause::Step { frame: Frame::Base, at: 0.4, shift, turn };
    let shifted = Real::new(&arm, &[(step, 1e-3)]).point(&moment).expect("a pose");
    assert!((shifted - bare - shift * 1e-3).norm() < 1e-12);
}

#[test]
fn every_kind_is_concealed_at_the_size_that_was_asked_for() {
    let static_kinds = STATIC_KINDS.iter().chain(&OUTSIDE_KINDS).map(|kind| (*kind, false));
    for (number, (kind, moving)) in static_kinds.chain(MOVING_KINDS.iter().map(|kind| (*kind, true))).enumerate() {
        let wanted = vec![(kind, 1.0)];
        let spec = Spec { number: 7000 + number as u64, ..spec("law", moving, wanted, Vec::new()) };
        let trial = build(&spec);
        let one = &trial.truth.concealed[0];
        assert!((one.level - 1.0).abs() < 0.1, "{kind}: {} at {:?} {:.2e}", one.level, one.cause, one.size);
    }
}

#[test]
fn wilsons_interval_is_that_of_the_literature() {
    // Newcombe, Statistics in Medicine 17 (1998) 857, table I: 81 of 263, and 0 of 20.
    let [low, high] = wilson(81, 263);
    assert!((low - 0.2553).abs() < 5e-5 && (high - 0.3662).abs() < 5e-5, "{low} {high}");
    let [low, high] = wilson(0, 20);
    assert!(low == 0.0 && (high - 0.1611).abs() < 5e-5, "{high}");
}

//! The learner against arms whose errors are made by named effects, never by its own functions.

#![allow(clippy::expect_used)]

use falsetarget::files::builtin;
use falsetarget::identify::calibrate::{Options, calibrate};
use falsetarget::identify::predict::predict;
use falsetarget::identify::summary::summarise;
use falsetarget::learn::calibration::{add, add_paper_network};
use falsetarget::measure::observation::{Measured, Observation, SetName};
use falsetarget::measure::recording::{ApproachSource, Kind, Recording};
use falsetarget::model::arm::{ArmModel, EffectInstance};
use falsetarget::model::conditions::Conditions;
use falsetarget::model::effect::{Location, by_id};
use falsetarget::model::robot::{DOF, Robot};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

const SIGMA_M: f64 = 3e-5;

fn robot() -> Robot {
    builtin::by_name("ur10e").expect("built in").expect("sound")
}

/// A UR10e whose first three joints have errors of 0.3 mrad at 7, 11 and 16 waves a revolution.
fn wavy(robot: &Robot) -> ArmModel {
    let mut arm = ArmModel::nominal(robot.clone());
    arm.parameters.rows[1].offset_rad = 1e-3;
    arm.parameters.rows[2].a_m = 4e-4;
    let effect = by_id("joint_periodic").expect("in the registry");
    for (joint, order) in [(0, 7.0), (1, 11.0), (2, 16.0)] {
        let location = Location { order: Some(order), ..Location::at_joint(joint) };
        arm.effects.push(EffectInstance { effect, location });
        arm.parameters.effects.push(vec![3e-4, 1e-4]);
    }
    arm
}

/// Records in a box of joint numbers, the last third for validation.
fn recording(arm: &ArmModel, count: usize, seed: u64) -> Recording {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let noise = Normal::new(0.0, SIGMA_M).expect("a width");
    let prepared = arm.prepared();
    let observations = (0..count)
        .map(|index| {
            let low = [-1.5, -2.2, -1.8, -1.5, -1.5, -2.0];
            let numbers_rad: [f64; DOF] = std::array::from_fn(|joint| low[joint] + random.random_range(0.0..2.6));
            let conditions = Conditions::default();
            let stand = prepared.at(&numbers_rad, &conditions, None).expect("a pose");
            let position_m = prepared.measured(&stand).translation.map(|x| x + noise.sample(&mut random));
            Observation {
                id: index.to_string(),
                station: None,
                numbers_rad,
                conditions,
                measured: Some(Measured { position_m, rotation: None }),
                sigma_m: None,
                sigma_rad: None,
                set: Some(if 3 * index < 2 * count { SetName::Identify } else { SetName::Validate }),
                line: index + 2,
            }
        })
        .collect();
    Recording {
        name: "simulated".into(),
        sha256: String::new(),
        kind: Kind::Static,
        approach: ApproachSource::Recorded,
        observations,
    }
}

fn truth_m(arm: &ArmModel, observation: &Observation) -> nalgebra::Vector3<f64> {
    let prepared = arm.prepared();
    let stand = prepared.at(&observation.numbers_rad, &observation.conditions, None).expect("a pose");
    prepared.measured(&stand).translation
}

#[test]
fn waves_of_the_joints_are_learned_and_the_uncertainty_holds() {
    let robot = robot();
    let arm = wavy(&robot);
    let recordings = [recording(&arm, 360, 1)];
    let mut outcome =
        calibrate(&ArmModel::nominal(robot), &recordings, &Options::default(), &mut |_| {}).expect("a calibration");
    let learned = add(&mut outcome, 1).expect("poses");
    assert!(learned.state.is_some(), "{:?}", learned.candidates);
    let (model, report) = summarise(&outcome, &recordings).expect("poses");
    let validated = |name: &str| {
        let stage = report.stages.iter().find(|stage| stage.name == name).expect("a stage");
        stage.validate.expect("validation records").rms_mm
    };
    assert!(validated("learner") < 0.4 * validated("geometry_compliance"));

    let fresh = recording(&arm, 400, 2);
    let observations: Vec<&Observation> = fresh.observations.iter().collect();
    let predicted = predict(&model.arm, model.uncertainty.as_ref(), &model.stations, &observations).expect("poses");
    let inside = predicted
        .iter()
        .zip(&observations)
        .filter(|(predicted, observation)| {
            let away = (predicted.position_m - truth_m(&arm, observation)).norm();
            away <= predicted.u95_m.expect("an uncertainty")
        })
        .count();
    assert!((0.88..=0.995).contains(&(inside as f64 / 400.0)), "{inside} of 400 inside u95");
}

#[test]
fn nothing_is_learned_from_noise() {
    let robot = robot();
    let mut arm = ArmModel::nominal(robot.clone());
    arm.parameters.rows[2].a_m = 4e-4;
    let recordings = [recording(&arm, 180, 3)];
    let mut outcome =
        calibrate(&ArmModel::nominal(robot), &recordings, &Options::default(), &mut |_| {}).expect("a calibration");
    let learned = add(&mut outcome, 1).expect("poses");
    assert_eq!(learned.chosen, 0, "{:?}", learned.candidates);
    assert!(outcome.delivered.fit.state.model.learner.is_none());
}

#[test]
fn the_paper_network_is_the_last_stage() {
    let robot = robot();
    let recordings = [recording(&wavy(&robot), 120, 4)];
    let mut outcome =
        calibrate(&ArmModel::nominal(robot), &recordings, &Options::default(), &mut |_| {}).expect("a calibration");
    add_paper_network(&mut outcome, 1).expect("poses");
    let (_, report) = summarise(&outcome, &recordings).expect("poses");
    let [.., before, network] = report.stages.as_slice() else { panic!("stages") };
    assert_eq!(network.name, "network");
    let trained = |stage: &falsetarget::identify::report::Stage| stage.identify.expect("records").rms_mm;
    assert!(trained(network) < trained(before));
}

//! What a recording costs. 500 poses of an 800 kg class arm with a parallelogram, measured base and tool given.

use std::sync::LazyLock;

use falsetarget::base::text::Source;
use falsetarget::files::{recording, robot};
use falsetarget::identify::calibrate::{Options, calibrate};
use falsetarget::identify::estimate::START_PER_REACH;
use falsetarget::identify::identifiability::select;
use falsetarget::identify::identify::identify;
use falsetarget::identify::prior::{reach_m, unknown_of};
use falsetarget::identify::problem::{Problem, Record};
use falsetarget::identify::state::State;
use falsetarget::identify::unknown::{Scope, Unknown, model_ids};
use falsetarget::measure::observation::Observation;
use falsetarget::measure::recording::Recording;
use falsetarget::model::arm::{ArmModel, EffectInstance};
use falsetarget::model::effect::{Location, by_id};
use falsetarget::model::robot::{DOF, Robot};

fn shelf(file: &str) -> Source {
    let path = format!("{}/calibration/recordings/hh800-class/{file}", env!("CARGO_MANIFEST_DIR"));
    Source::new(file.to_string(), std::fs::read(path).expect("on the shelf"))
}

static ROBOT: LazyLock<Robot> = LazyLock::new(|| robot::read(&shelf("robot.yaml")).expect("a robot"));
static RECORDING: LazyLock<Recording> =
    LazyLock::new(|| recording::read(&shelf("recording.csv"), &ROBOT).expect("a recording"));

/// Geometry and compliance of the arm, and of each joint play, gear ratio and waves twice and three times a turn:
/// more than 60 unknowns.
fn sixty() -> (State, Vec<Unknown>) {
    let mut model = ArmModel::nominal(ROBOT.clone());
    for joint in 0..DOF {
        let waves = [("joint_periodic", Some(2.0)), ("joint_periodic", Some(3.0))];
        for (id, order) in [("backlash", None), ("gear_ratio", None)].into_iter().chain(waves) {
            let effect = by_id(id).expect("in the registry");
            model.effects.push(EffectInstance { effect, location: Location { order, ..Location::at_joint(joint) } });
            model.parameters.effects.push(vec![0.0; effect.meta().parameters.len()]);
        }
    }
    let state = State::new(model);
    let problem = problem();
    let torque = problem.largest_torque_nm(&state);
    let ids = model_ids(&state.model, Scope::Everything, false);
    let all = ids.into_iter().map(|id| unknown_of(id, &state.model, &torque)).collect();
    let free = select(&problem, &state, all, 1).expect("placeable").free;
    (state, free)
}

fn problem() -> Problem<'static> {
    let sigma_m = START_PER_REACH * reach_m(&ROBOT);
    let record = |observation: &'static Observation| {
        let measured = observation.measured.expect("measured");
        Record { observation, measured, station: 0, sigma_m, sigma_rad: 1.0 }
    };
    Problem { records: RECORDING.observations.iter().map(record).collect() }
}

/// Gross errors looked for, noise level found, covariance: the whole identification of 500 poses.
#[divan::bench(sample_count = 5)]
fn identify_500_poses_60_unknowns(bencher: divan::Bencher) {
    let (state, free) = sixty();
    assert!(free.len() >= 60, "{}", free.len());
    let problem = problem();
    bencher.bench(|| identify(&problem, state.clone(), &free, false).expect("a fit"));
}

/// One exact Jacobian of 500 poses by 60 unknowns.
#[divan::bench(sample_count = 20)]
fn jacobian_500_poses_60_unknowns(bencher: divan::Bencher) {
    let (state, free) = sixty();
    let problem = problem();
    bencher.bench(|| problem.jacobian(&state, &free).expect("placeable"));
}

/// Check, placing, split, stages, reasons: everything that `calibrate` does before it learns.
#[divan::bench(sample_count = 5)]
fn calibrate_500_poses(bencher: divan::Bencher) {
    let start = ArmModel::nominal(ROBOT.clone());
    let recordings = std::slice::from_ref(&*RECORDING);
    bencher.bench(|| calibrate(&start, recordings, &Options::default(), &mut |_| {}).expect("a model").fitted.len());
}

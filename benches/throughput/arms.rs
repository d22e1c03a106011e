//! The arms that are measured.

use falsetarget::files::builtin::by_name;
use falsetarget::model::arm::ArmModel;
use falsetarget::model::network::{Feature, Layers, Output, ResidualNetwork};
use falsetarget::model::robot::{DOF, Mass, Robot};
use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;

/// Poses of a batch: enough to leave the branch predictor nothing to remember, few enough for the first cache.
pub const POSES: usize = 512;

/// A calibrated heavy arm: closed parallelogram, geometry errors, compliance of four joints under a payload, and a
/// network on what is left.
pub fn calibrated() -> ArmModel {
    let mut model = ArmModel::nominal(heavy());
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for row in &mut model.parameters.rows {
        let mut error = || random.random_range(-3e-4..3e-4);
        (row.offset_rad, row.a_m, row.alpha_rad) = (error(), error(), error());
    }
    model.parameters.crank_m = 2e-4;
    model.parameters.coupler_m = -3e-4;
    model.learner = Some(network(&mut random).into());
    model
}

/// The built-in arm of 800 kg, carrying half of that.
fn heavy() -> Robot {
    let mut robot = by_name("hh800-class").expect("built in").expect("sound");
    robot.payload = Mass { mass_kg: 400.0, center_of_mass_m: Vector3::new(0.0, 0.0, 0.2) };
    robot
}

/// Three networks of ten hidden units that give up to some tenths of a millimetre.
fn network(random: &mut ChaCha8Rng) -> ResidualNetwork {
    let features: Vec<Feature> = (1..=DOF).flat_map(|joint| [Feature::Sine(joint), Feature::Cosine(joint)]).collect();
    let inputs = features.len();
    let mut row = |size: f64, count: usize| (0..count).map(|_| random.random_range(-size..size)).collect::<Vec<f64>>();
    let hidden = 10;
    let mut layers = || Layers {
        hidden_weights: (0..hidden).map(|_| row(0.7, inputs)).collect(),
        hidden_biases: row(0.5, hidden),
        output_weights: (0..3).map(|_| row(1e-4, hidden)).collect(),
        output_biases: row(1e-4, 3),
    };
    ResidualNetwork {
        features,
        shift: vec![0.0; inputs],
        scale: vec![1.0; inputs],
        output: Output::Position,
        members: vec![layers(), layers(), layers()],
        measured: None,
        sureness: None,
    }
}

/// The arm that both kinematics compute: ABB IRB 2400/10 as rs-opw-kinematics describes it.
pub fn opw() -> Parameters {
    Parameters::irb2400_10()
}

/// The same arm for this crate: Rz Tz(c1) Tx(a1) Ry Tz(c2) Ry Tx(a2) Tz(c3) Rz Ry Rz Tz(c4) as rows.
pub fn same_as_opw(opw: &Parameters) -> Robot {
    let mut robot = by_name("abb-irb2400").expect("built in").expect("sound");
    robot.parallelogram = None;
    let half = std::f64::consts::FRAC_PI_2;
    let rows = [
        [0.0, opw.c1, opw.a1, -half],
        [-half, opw.b, opw.c2, 0.0],
        [half, 0.0, opw.a2, half],
        [0.0, opw.c3, 0.0, -half],
        [0.0, 0.0, 0.0, half],
        [0.0, opw.c4, 0.0, 0.0],
    ];
    for (index, (joint, row)) in robot.joints.iter_mut().zip(rows).enumerate() {
        [joint.theta_rad, joint.d_m, joint.a_m, joint.alpha_rad] = row;
        joint.theta_rad -= opw.offsets[index];
        joint.sign = f64::from(opw.sign_corrections[index]);
    }
    robot
}

/// Joint numbers all over the robot's range.
pub fn numbers(robot: &Robot) -> Vec<[f64; DOF]> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut one = || {
        std::array::from_fn(|joint| {
            let limits = &robot.joints[joint];
            random.random_range(limits.min_rad..limits.max_rad)
        })
    };
    (0..POSES).map(|_| one()).collect()
}

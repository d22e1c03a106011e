//! Forward and inverse kinematics against formulations that share no line with the tool.

use falsetarget::geometry::pose::Pose;
use falsetarget::geometry::real::{Dual, Real, derivatives, seeded};
use falsetarget::kinematics::controller::Controller;
use falsetarget::model::arm::ArmModel;
use falsetarget::model::conditions::Conditions;
use falsetarget::model::jacobian::jacobian_from_chain;
use falsetarget::model::robot::{Convention, DOF, Robot};
use nalgebra::{Isometry3, Matrix3, Matrix4, Translation3, UnitQuaternion};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;

use crate::arms::*;

/// The rows of an arm that rs-opw-kinematics describes, derived from its sequence
/// Rz Tz(c1) Tx(a1) Ty(b) Ry Tz(c2) Ry Tx(a2) Tz(c3) Rz Ry Rz Tz(c4).
fn rows_of(opw: &Parameters) -> Robot {
    let half = PI / 2.0;
    let rows = [
        [0.0, opw.c1, opw.a1, -half],
        [-half, opw.b, opw.c2, 0.0],
        [half, 0.0, opw.a2, half],
        [0.0, opw.c3, 0.0, -half],
        [0.0, 0.0, 0.0, half],
        [0.0, opw.c4, 0.0, 0.0],
    ];
    let mut robot = arm(Convention::Standard, rows, opw.sign_corrections.map(f64::from));
    for (joint, offset) in robot.joints.iter_mut().zip(opw.offsets) {
        joint.theta_rad -= offset;
    }
    robot
}

fn opw_arms() -> Vec<Parameters> {
    vec![
        Parameters::irb2400_10(),
        Parameters::fanuc_r2000ib_200r(),
        Parameters::kuka_kr6_r700_sixx(),
        Parameters::staubli_tx2_160l(),
        Parameters::staubli_rx160(),
        Parameters::igus_rebel(),
        Parameters::abb_1600(),
        Parameters { b: 0.12, ..Parameters::irb4600_60_205() },
    ]
}

#[test]
fn forward_and_inverse_agree_with_rs_opw_kinematics() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    for opw in opw_arms() {
        let peer = OPWKinematics::new(opw);
        let controller = Controller::new(&rows_of(&opw));
        for _ in 0..100 {
            let numbers: [f64; DOF] = std::array::from_fn(|_| random.random_range(-PI..PI));
            let pose = controller.forward(&numbers).expect("no loop");
            let theirs = peer.forward(&numbers);
            let as_ours = Pose {
                rotation: theirs.rotation.to_rotation_matrix().into_inner(),
                translation: theirs.translation.vector,
            };
            assert!(pose_error(&pose, &as_ours) < 1e-9);

            let isometry = Isometry3::from_parts(
                Translation3::from(pose.translation),
                UnitQuaternion::from_matrix(&pose.rotation),
            );
            let branches = controller.inverse(&pose).expect("in reach");
            if branches.iter().any(|solution| solution.singularity.wrist_sin < 1e-2) {
                continue;
            }
            for theirs in peer.inverse(&isometry) {
                let nearest = branches.iter().map(|ours| apart_modulo_turns(&ours.numbers_rad, &theirs));
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                // Their solutions are no better than 1e-6 in places; ours are measured against the pose elsewhere.
                assert!(nearest < 1e-6, "they have {theirs:?}, ours is {nearest} away");
            }
            let known = peer.inverse(&isometry).len();
            assert!(branches.len() >= known, "{} against {known}", branches.len());
        }
    }
}

/// Four by four matrices, multiplied as the contract writes the rows.
fn plain_product(robot: &Robot, theta: &[f64; DOF]) -> Matrix4<f64> {
    let rz = |angle: f64| {
        let (s, c) = angle.sin_cos();
        Matrix4::new(c, -s, 0.0, 0.0, s, c, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    };
    let rx = |angle: f64| {
        let (s, c) = angle.sin_cos();
        Matrix4::new(1.0, 0.0, 0.0, 0.0, 0.0, c, -s, 0.0, 0.0, s, c, 0.0, 0.0, 0.0, 0.0, 1.0)
    };
    let shift = |x: f64, z: f64| Matrix4::new_translation(&nalgebra::Vector3::new(x, 0.0, z));
    robot.joints.iter().zip(theta).fold(Matrix4::identity(), |product, (row, &angle)| match robot.convention {
        Convention::Standard => product * rz(angle) * shift(0.0, row.d_m) * shift(row.a_m, 0.0) * rx(row.alpha_rad),
        Convention::Modified => product * rx(row.alpha_rad) * shift(row.a_m, 0.0) * rz(angle) * shift(0.0, row.d_m),
    })
}

/// Row angles as the contract defines them, with an ideal parallelogram.
fn plain_angles(robot: &Robot, numbers: &[f64; DOF]) -> [f64; DOF] {
    let mut theta: [f64; DOF] =
        std::array::from_fn(|row| robot.joints[row].sign * numbers[row] + robot.joints[row].theta_rad);
    for coupling in &robot.couplings {
        theta[coupling.joint] += coupling.factor * numbers[coupling.by];
    }
    if robot.parallelogram.is_some() {
        theta[2] -= robot.joints[1].sign * numbers[1];
    }
    theta
}

#[test]
fn forward_is_the_plain_product_of_the_rows() {
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let mut arms = built_in();
    arms.extend((0..40).map(|_| random_spherical(&mut random)));
    for robot in arms {
        let controller = Controller::new(&robot);
        for _ in 0..50 {
            let numbers = random_numbers(&robot, &controller, &mut random);
            let product = plain_product(&robot, &plain_angles(&robot, &numbers));
            let pose = controller.forward(&numbers).expect("a closed loop");
            let rotation: Matrix3<f64> = product.fixed_view::<3, 3>(0, 0).into();
            assert!((pose.rotation - rotation).norm() < 1e-12, "{}", robot.name);
            assert!((pose.translation - product.fixed_view::<3, 1>(0, 3)).norm() < 1e-12, "{}", robot.name);
        }
    }
}

#[test]
fn the_jacobian_is_the_central_difference() {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    let mut arms = built_in();
    arms.push(uneven_loop());
    arms.extend((0..20).map(|_| random_spherical(&mut random)));
    for robot in arms {
        let controller = Controller::new(&robot);
        for _ in 0..10 {
            let numbers = random_numbers(&robot, &controller, &mut random);
            let Ok(jacobian) = controller.jacobian(&numbers) else { continue };
            let step = 1e-6;
            for joint in 0..DOF {
                let at = |shift: f64| {
                    let mut moved = numbers;
                    moved[joint] += shift;
                    controller.forward(&moved)
                };
                let (Ok(up), Ok(down)) = (at(step), at(-step)) else { continue };
                let (shift, turn) = falsetarget::geometry::pose::pose_difference(&up, &down);
                for axis in 0..3 {
                    let error = jacobian[(axis, joint)] - shift[axis] / (2.0 * step);
                    assert!(error.abs() < 1e-7, "{}: joint {joint}: {error}", robot.name);
                    let error = jacobian[(axis + 3, joint)] - turn[axis] / (2.0 * step);
                    assert!(error.abs() < 1e-7, "{}: joint {joint}: {error}", robot.name);
                }
            }
        }
    }
}

#[test]
fn the_jacobian_of_a_real_chain_is_what_dual_numbers_carry() {
    // Geometry errors, uneven rods and couplings at once; no deflection, which the Jacobian leaves out.
    let mut robot = uneven_loop();
    robot.compliance_rad_per_nm = [0.0; DOF];
    robot.couplings = vec![falsetarget::model::robot::Coupling { joint: 5, by: 4, factor: 0.25 }];
    let mut model = ArmModel::controller(robot.clone());
    for (index, row) in model.parameters.rows.iter_mut().enumerate() {
        let size = 1e-3 * (index as f64 + 1.0);
        (row.a_m, row.d_m, row.alpha_rad, row.beta_rad, row.offset_rad) = (size, -size, 0.7 * size, 0.4 * size, -size);
    }
    let mut random = ChaCha8Rng::seed_from_u64(14);
    let numbers = random_numbers(&robot, &Controller::new(&robot), &mut random);
    let plain = model.prepared().at(&numbers, &Conditions::default(), None).expect("a pose");
    let jacobian = jacobian_from_chain(&robot, &plain.chain, &plain.angles);
    let dual_numbers: [Dual; DOF] = std::array::from_fn(|joint| seeded(numbers[joint], joint));
    let prepared = model.prepare(model.parameters.map(Dual::constant));
    let dual = prepared.at(&dual_numbers, &Conditions::default(), None).expect("a pose");
    for joint in 0..DOF {
        for axis in 0..3 {
            let exact = derivatives(&dual.base_t_flange.translation[axis])[joint];
            assert!((jacobian[(axis, joint)] - exact).abs() < 1e-12);
        }
        // dR R' is the cross-product matrix of the turn.
        let turning = dual.base_t_flange.rotation.map(|entry| derivatives(&entry)[joint]);
        let spin = turning * plain.base_t_flange.rotation.transpose();
        let vector = [spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]];
        for axis in 0..3 {
            assert!((jacobian[(axis + 3, joint)] - vector[axis]).abs() < 1e-12);
        }
    }
}

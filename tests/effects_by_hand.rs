//! Effects against numbers worked by hand on an arm stretched out level along x, with all its weight at the flange.
//!
//! Shoulder at (0, 0, 1), elbow at (1.5, 0, 1), flange and tool at (2.7, 0, 1); 100 kg there.

#![allow(clippy::expect_used)]

use falsetarget::geometry::pose::Pose;
use falsetarget::model::arm::{ArmModel, EffectInstance};
use falsetarget::model::conditions::Conditions;
use falsetarget::model::effect::{Location, MovingFrame, by_id};
use falsetarget::model::robot::{Convention, Coupling, DOF, Joint, Mass, Parallelogram, Robot};
use nalgebra::Vector3;

const UPPER_M: f64 = 1.5;
const FORE_M: f64 = 1.2;
const HEIGHT_M: f64 = 1.0;
const WEIGHT_N: f64 = 980.665;
const LEVEL: [f64; DOF] = [0.0; DOF];

fn stretched() -> Robot {
    let rows = [
        [0.0, HEIGHT_M, 0.0, 90.0],
        [0.0, 0.0, UPPER_M, 0.0],
        [90.0, 0.0, 0.0, 90.0],
        [0.0, 1.0, 0.0, -90.0],
        [0.0, 0.0, 0.0, 90.0],
        [0.0, FORE_M - 1.0, 0.0, 0.0],
    ];
    let joints = rows.map(|[theta_deg, d_m, a_m, alpha_deg]: [f64; 4]| Joint {
        name: String::new(),
        theta_rad: theta_deg.to_radians(),
        d_m,
        a_m,
        alpha_rad: alpha_deg.to_radians(),
        sign: 1.0,
        min_rad: -3.0,
        max_rad: 3.0,
        max_speed_rad_s: None,
    });
    Robot {
        name: "stretched".into(),
        convention: Convention::Standard,
        joints,
        parallelogram: None,
        couplings: Vec::new(),
        links: Some([Mass::NONE; DOF]),
        base: None,
        tool: None,
        payload: Mass { mass_kg: 100.0, center_of_mass_m: Vector3::zeros() },
        gravity_m_s2: Vector3::new(0.0, 0.0, -9.80665),
        compliance_rad_per_nm: [0.0; DOF],
    }
}

/// The same arm in modified rows.
fn stretched_modified() -> Robot {
    let mut robot = Robot { convention: Convention::Modified, ..stretched() };
    let (a_m, alpha_rad) = (robot.joints.clone().map(|row| row.a_m), robot.joints.clone().map(|row| row.alpha_rad));
    for joint in 0..DOF {
        robot.joints[joint].a_m = if joint == 0 { 0.0 } else { a_m[joint - 1] };
        robot.joints[joint].alpha_rad = if joint == 0 { 0.0 } else { alpha_rad[joint - 1] };
    }
    robot
}

fn pinned() -> Robot {
    let parallelogram = Parallelogram {
        crank_m: 0.5,
        coupler_m: UPPER_M,
        rocker_m: 0.5,
        arm_m: UPPER_M,
        crank_offset_rad: 0.0,
        passive_min_rad: -1.0,
        passive_max_rad: 1.0,
    };
    Robot { parallelogram: Some(parallelogram), ..stretched() }
}

/// What an effect adds to the model of a robot that stands level.
fn moved(mut model: ArmModel, id: &str, location: Location, values: &[f64], conditions: &Conditions) -> Vector3<f64> {
    let at = |model: &ArmModel| {
        let prepared = model.prepared();
        prepared.measured(&prepared.at(&LEVEL, conditions, None).expect("a pose")).translation
    };
    let before = at(&model);
    let effect = by_id(id).expect("an effect");
    assert!(effect.meta().place.fits(&location));
    model.effects.push(EffectInstance { effect, location });
    model.parameters.effects.push(values.to_vec());
    at(&model) - before
}

fn level(robot: Robot, id: &str, location: Location, values: &[f64]) -> Vector3<f64> {
    moved(ArmModel::nominal(robot), id, location, values, &Conditions::default())
}

fn close(found: Vector3<f64>, expected: [f64; 3], tolerance: f64) {
    assert!((found - Vector3::from(expected)).norm() < tolerance, "{found} against {expected:?}");
}

fn nowhere() -> Location {
    Location::default()
}

fn base() -> Location {
    Location { base: Some(true), ..nowhere() }
}

#[test]
fn the_arm_stands_as_described() {
    let prepared = ArmModel::nominal(stretched());
    let state = prepared.prepared().at(&LEVEL, &Conditions::default(), None).expect("a pose");
    close(state.base_t_flange.translation, [UPPER_M + FORE_M, 0.0, HEIGHT_M], 1e-12);
}

#[test]
fn a_soft_shoulder_sags_by_torque_times_compliance_times_reach() {
    let (reach, compliance) = (UPPER_M + FORE_M, 1e-8);
    let sag = WEIGHT_N * reach * compliance * reach;
    close(level(stretched(), "joint_compliance", Location::at_joint(1), &[compliance]), [0.0, 0.0, -sag], 1e-8);
}

#[test]
fn stiffening_adds_its_twist_at_the_largest_torque() {
    // Stretched level is where the largest torque is: the whole cubic twist, against the weight for c > 0.
    let twist = 1e-5;
    let found = level(stretched(), "joint_stiffening", Location::at_joint(1), &[twist]);
    close(found, [0.0, 0.0, -twist * (UPPER_M + FORE_M)], 1e-8);
}

#[test]
fn a_link_bends_as_the_handbook_says() {
    let stiffness = 1e7;
    let link = Location { link: Some(2), ..nowhere() };
    let bending = [1.0 / stiffness, 0.0];
    // Serial: force and moment at the elbow; its slope carries the forearm.
    let (force, moment) = (WEIGHT_N, WEIGHT_N * FORE_M);
    let shift = (force * UPPER_M.powi(3) / 3.0 + moment * UPPER_M.powi(2) / 2.0) / stiffness;
    let slope = (force * UPPER_M.powi(2) / 2.0 + moment * UPPER_M) / stiffness;
    // A parallelogram's arm and coupler bend as one.
    for robot in [stretched(), stretched_modified(), pinned()] {
        close(level(robot, "link_flexibility", link, &bending), [0.0, 0.0, -shift - slope * FORE_M], 2e-7);
    }
}

#[test]
fn the_base_tilts_with_the_overturning_moment() {
    // 980.665 N at x = 2.7 m turn about +y: the arm sinks by the tilt times x and leans out by the tilt times z.
    let compliance = 1e-8;
    let tilt = compliance * WEIGHT_N * (UPPER_M + FORE_M);
    let found = level(stretched(), "base_compliance", base(), &[0.0, compliance]);
    close(found, [tilt * HEIGHT_M, 0.0, -tilt * (UPPER_M + FORE_M)], 1e-8);
    close(level(stretched(), "base_compliance", base(), &[compliance, 0.0]), [0.0; 3], 1e-15);
}

#[test]
fn a_balancer_and_a_payload_act_through_the_compliance() {
    let (reach, compliance) = (UPPER_M + FORE_M, 1e-7);
    let mut soft = stretched();
    soft.compliance_rad_per_nm[1] = compliance;
    // At angle zero the cosines count: 300 + 50 Nm lift the arm.
    let lifted = level(soft.clone(), "gravity_compensator", Location::at_joint(1), &[900.0, 300.0, -800.0, 50.0]);
    close(lifted, [0.0, 0.0, 350.0 * compliance * reach], 1e-7);
    // 10 kg more at the flange, and 4 kg m further out along its z, which points along x.
    let payload = Location { payload: Some(true), ..nowhere() };
    let sunk = level(soft, "payload_error", payload, &[10.0, 0.0, 0.0, 4.0]);
    let torque = 9.80665 * (10.0 * reach + 4.0);
    close(sunk, [0.0, 0.0, -torque * compliance * reach], 1e-7);
}

#[test]
fn gravity_that_leans_sideways_turns_joint_one() {
    let mut soft = stretched();
    soft.compliance_rad_per_nm[0] = 1e-8;
    let reach = UPPER_M + FORE_M;
    // Turned about x by 1 %, the weight pulls to +y: 9.8 N at 2.7 m about a vertical axis.
    let torque = WEIGHT_N * 0.01f64.sin() * reach;
    close(level(soft, "gravity_tilt", base(), &[0.01, 0.0]), [0.0, torque * 1e-8 * reach, 0.0], 1e-12);
}

#[test]
fn a_balancer_works_without_a_gravity_model() {
    let mut soft = Robot { links: None, ..stretched() };
    soft.compliance_rad_per_nm[1] = 1e-7;
    let lifted = level(soft, "gravity_compensator", Location::at_joint(1), &[0.0, 350.0, 0.0, 0.0]);
    close(lifted, [0.0, 0.0, 350.0 * 1e-7 * (UPPER_M + FORE_M)], 1e-7);
}

#[test]
fn the_approach_leaves_the_joint_behind() {
    let mut approach = [0.0; DOF];
    approach[0] = 1.0;
    let conditions = Conditions { approach, ..Conditions::default() };
    let model = ArmModel::nominal(stretched());
    // Moved in the positive sense about z, it stands short: to -y. Half the play, the whole wind-up.
    let reach = UPPER_M + FORE_M;
    let stays = |id, value| moved(model.clone(), id, Location::at_joint(0), &[value], &conditions);
    close(stays("friction_windup", 1e-4), [0.0, -1e-4 * reach, 0.0], 1e-7);
    close(stays("backlash", 2e-4), [0.0, -1e-4 * reach, 0.0], 1e-7);
    // Joint 2 is pulled down to one flank whatever the approach.
    close(moved(model, "backlash", Location::at_joint(1), &[2e-4], &conditions), [0.0, 0.0, -1e-4 * reach], 1e-7);
}

fn flange_at(model: &ArmModel, numbers: &[f64; DOF]) -> Vector3<f64> {
    model.prepared().at(numbers, &Conditions::default(), None).expect("a pose").base_t_flange.translation
}

#[test]
fn a_wobbling_axis_lifts_the_arm_out_of_its_plane() {
    let mut numbers = LEVEL;
    numbers[0] = 0.5;
    let plain = ArmModel::nominal(stretched());
    let before = flange_at(&plain, &numbers);
    // Twice a turn unless told otherwise.
    for (order, known) in [(2.0, None), (3.0, Some(3.0))] {
        let (sin, cos) = f64::sin_cos(order * 0.5);
        let wobble = |values: [f64; 4]| {
            let mut model = plain.clone();
            let location = Location { order: known, ..Location::at_joint(0) };
            model.effects.push(EffectInstance { effect: by_id("axis_wobble").expect("an effect"), location });
            model.parameters.effects.push(values.to_vec());
            flange_at(&model, &numbers) - before
        };
        // A tilt t of joint 1, whose frame stands at the foot, moves a point p by t x p.
        let about_x = Vector3::x().cross(&before) * 1e-5;
        let about_y = Vector3::y().cross(&before) * 1e-5;
        close(wobble([1e-5, 0.0, 0.0, 0.0]), (about_x * sin).into(), 1e-9);
        close(wobble([0.0, 1e-5, 0.0, 0.0]), (about_x * cos).into(), 1e-9);
        close(wobble([0.0, 0.0, 1e-5, 0.0]), (about_y * sin).into(), 1e-9);
        close(wobble([0.0, 0.0, 0.0, 1e-5]), (about_y * cos).into(), 1e-9);
    }
}

#[test]
fn errors_of_a_drive_count_from_its_own_turn() {
    // Joint 3 shows its turn plus that of joint 2: its own drive turned q3 - q2.
    let mut robot = stretched();
    robot.couplings.push(Coupling { joint: 2, by: 1, factor: -1.0 });
    let numbers = [0.2, 0.3, -0.4, 0.5, 0.6, 0.7];
    let own = numbers[2] - numbers[1];
    let turned = |id: &str, location: Location, values: &[f64]| {
        let mut model = ArmModel::controller(robot.clone());
        model.effects.push(EffectInstance { effect: by_id(id).expect("an effect"), location });
        model.parameters.effects.push(values.to_vec());
        flange_at(&model, &numbers)
    };
    let commanded = |by: f64| {
        let mut numbers = numbers;
        numbers[2] += by;
        flange_at(&ArmModel::controller(robot.clone()), &numbers).into()
    };
    let at = Location::at_joint(2);
    close(turned("gear_ratio", at, &[1e-3]), commanded(1e-3 * own), 1e-12);
    let from_fifth = Location { source_joint: Some(5), ..at };
    close(turned("joint_coupling", from_fifth, &[1e-3]), commanded(1e-3 * numbers[4]), 1e-12);
    let (sin, cos) = (2.5 * own).sin_cos();
    let periodic = Location { order: Some(2.5), ..at };
    close(turned("joint_periodic", periodic, &[1e-3, 3e-3]), commanded(1e-3 * sin + 3e-3 * cos), 1e-12);
}

/// A tracker that stands elsewhere and looks another way, and a tool beside the flange.
fn stationed() -> ArmModel {
    let mut robot = stretched();
    let turn = falsetarget::geometry::pose::rotation_z(0.7);
    robot.base = Some(Pose { rotation: turn, translation: Vector3::new(3.0, -1.0, 0.4) });
    robot.tool = Some(Pose::from_translation(Vector3::new(0.1, 0.2, 0.3)));
    ArmModel::nominal(robot)
}

#[test]
fn drift_and_step_of_the_base_are_what_a_tracker_sees() {
    let model = stationed();
    let late = Conditions { time_s: Some(3600.0), ..Conditions::default() };
    let station = Location { frame: Some(MovingFrame::Base), ..nowhere() };
    // 0.1 um/s along the base's x and 10 nrad/s about its z, for an hour.
    let rates = [1e-7, 0.0, 0.0, 0.0, 0.0, 1e-8];
    let drifted = moved(model.clone(), "drift", station, &rates, &late);
    let prepared = model.prepared();
    let state = prepared.at(&LEVEL, &late, None).expect("a pose");
    let in_base = state.base_t_flange.transform_point(&Vector3::new(0.1, 0.2, 0.3));
    let expected = Vector3::new(3.6e-4, 0.0, 0.0) + Vector3::new(0.0, 0.0, 3.6e-5).cross(&in_base);
    let seen = model.measuring_t_base.rotation * expected;
    close(drifted, seen.into(), 1e-8);
    // Levelling off in half an hour: 1800 s (1 - e^-2) of the same rates.
    let levelled = moved(model.clone(), "drift", Location { reference: Some(1800.0), ..station }, &rates, &late);
    close(levelled, (seen * (0.5 * (1.0 - (-2.0f64).exp()))).into(), 1e-8);
    // The same as one step: nothing before it, all of it after.
    let step = Location { at_s: Some(1000.0), ..station };
    let values = [3.6e-4, 0.0, 0.0, 0.0, 0.0, 3.6e-5];
    close(moved(model.clone(), "step_shift", step, &values, &late), seen.into(), 1e-8);
    let early = Conditions { time_s: Some(999.0), ..Conditions::default() };
    close(moved(model, "step_shift", step, &values, &early), [0.0; 3], 1e-15);
}

#[test]
fn a_slipped_tool_moves_with_the_flange() {
    let model = stationed();
    let late = Conditions { time_s: Some(10.0), ..Conditions::default() };
    let step = Location { frame: Some(MovingFrame::Tool), at_s: Some(5.0), ..nowhere() };
    let slipped = moved(model.clone(), "step_shift", step, &[1e-4, 2e-4, 3e-4, 0.0, 0.0, 0.0], &late);
    let state = model.prepared().at(&LEVEL, &late, None).expect("a pose");
    let flange_axes = model.measuring_t_base.rotation * state.base_t_flange.rotation;
    close(slipped, (flange_axes * Vector3::new(1e-4, 2e-4, 3e-4)).into(), 1e-12);
}

#[test]
fn a_lagging_joint_is_late_by_its_speed() {
    let mut speed = [0.0; DOF];
    speed[0] = 2.0;
    let conditions = Conditions { speed_rad_s: Some(speed), ..Conditions::default() };
    let model = ArmModel::nominal(stretched());
    let reach = UPPER_M + FORE_M;
    close(
        moved(model.clone(), "servo_lag", Location::at_joint(0), &[1e-5], &conditions),
        [0.0, -2e-5 * reach, 0.0],
        1e-9,
    );
    let clock = Location { clock: Some(true), ..nowhere() };
    close(moved(model, "time_offset", clock, &[1e-5], &conditions), [0.0, 2e-5 * reach, 0.0], 1e-9);
}

#[test]
fn acceleration_presses_the_arm_back() {
    // Joint 1 at 3 rad/s^2: 100 kg at 2.7 m load it with -100 * 2.7^2 * 3 Nm.
    let mut acceleration = [0.0; DOF];
    acceleration[0] = 3.0;
    let conditions =
        Conditions { speed_rad_s: Some([0.0; DOF]), acceleration_rad_s2: Some(acceleration), ..Conditions::default() };
    let (reach, compliance) = (UPPER_M + FORE_M, 1e-8);
    let back = 100.0 * reach * reach * 3.0 * compliance * reach;
    let found =
        moved(ArmModel::nominal(stretched()), "inertial_deflection", Location::at_joint(0), &[compliance], &conditions);
    close(found, [0.0, -back, 0.0], 1e-9);
}

//! What every effect of the registry must do: a new effect gets these tests for its one line in `EFFECTS`.

#![allow(clippy::expect_used)]

use std::f64::consts::FRAC_PI_2;

use falsetarget::geometry::pose::{Pose, vector_from_rotation};
use falsetarget::geometry::real::{Dual, Real, derivatives, seeded};
use falsetarget::model::arm::{ArmModel, EffectInstance, PreparedArm};
use falsetarget::model::conditions::Conditions;
use falsetarget::model::effect::{EFFECTS, Effect, Location, ModelScalar, MovingFrame, Place};
use falsetarget::model::robot::{Convention, DOF, Joint, Mass, Parallelogram, Robot};
use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The words and places of the contract's table, in its order.
const CONTRACT: [(&str, &[&str]); 19] = [
    ("joint_compliance", &["joint"]),
    ("joint_stiffening", &["joint"]),
    ("link_flexibility", &["link"]),
    ("backlash", &["joint"]),
    ("friction_windup", &["joint"]),
    ("joint_periodic", &["joint", "order"]),
    ("gear_ratio", &["joint"]),
    ("joint_coupling", &["joint", "source_joint"]),
    ("axis_wobble", &["joint"]),
    ("gravity_compensator", &["joint"]),
    ("payload_error", &["payload"]),
    ("gravity_tilt", &["base"]),
    ("base_compliance", &["base"]),
    ("thermal_growth", &["link"]),
    ("drift", &["frame"]),
    ("step_shift", &["frame", "at_s"]),
    ("time_offset", &["clock"]),
    ("servo_lag", &["joint"]),
    ("inertial_deflection", &["joint"]),
];

const POSES: usize = 12;

fn joint(theta_deg: f64, d_mm: f64, a_mm: f64, alpha_deg: f64, limits_deg: (f64, f64)) -> Joint {
    Joint {
        name: String::new(),
        theta_rad: theta_deg.to_radians(),
        d_m: d_mm * 1e-3,
        a_m: a_mm * 1e-3,
        alpha_rad: alpha_deg.to_radians(),
        sign: 1.0,
        min_rad: limits_deg.0.to_radians(),
        max_rad: limits_deg.1.to_radians(),
        max_speed_rad_s: None,
    }
}

fn mass(mass_kg: f64, com_mm: [f64; 3]) -> Mass {
    Mass { mass_kg, center_of_mass_m: Vector3::from(com_mm) * 1e-3 }
}

/// A serial arm of the 200 kg class in modified rows, on a tilted floor.
fn serial() -> Robot {
    Robot {
        name: "serial".into(),
        convention: Convention::Modified,
        joints: [
            joint(0.0, 780.0, 0.0, 0.0, (-170.0, 170.0)),
            joint(-90.0, 0.0, 320.0, -90.0, (-60.0, 70.0)),
            joint(0.0, 0.0, 1075.0, 0.0, (-80.0, 70.0)),
            joint(0.0, 1392.5, 200.0, -90.0, (-170.0, 170.0)),
            joint(0.0, 0.0, 0.0, 90.0, (-120.0, 120.0)),
            joint(180.0, 200.0, 0.0, -90.0, (-300.0, 300.0)),
        ],
        parallelogram: None,
        couplings: Vec::new(),
        links: Some([
            mass(420.0, [140.0, 40.0, -120.0]),
            mass(280.0, [500.0, 10.0, -60.0]),
            mass(330.0, [60.0, -30.0, 90.0]),
            mass(120.0, [0.0, 10.0, -480.0]),
            mass(50.0, [0.0, 20.0, 5.0]),
            mass(22.0, [3.0, 0.0, -40.0]),
        ]),
        base: None,
        tool: Some(Pose::from_translation(Vector3::new(0.06, 0.08, 0.26))),
        payload: mass(150.0, [30.0, -10.0, 180.0]),
        gravity_m_s2: Vector3::new(1.8, -1.2, -9.5),
        compliance_rad_per_nm: [1e-7, 2.2e-7, 3.5e-7, 6e-7, 8e-7, 9e-7],
    }
}

/// The same size with the third drive at the shoulder, standard rows, and an axis that counts the other way.
fn looped() -> Robot {
    let mut robot = Robot {
        name: "looped".into(),
        convention: Convention::Standard,
        joints: [
            joint(0.0, 1200.0, 517.0, 90.0, (-120.0, 120.0)),
            joint(90.0, 0.0, 1607.0, 0.0, (-40.0, 40.0)),
            joint(0.0, 0.0, 351.0, 90.0, (-40.0, 40.0)),
            joint(0.0, 1908.0, 0.0, -90.0, (-150.0, 150.0)),
            joint(0.0, 0.0, 0.0, 90.0, (-110.0, 110.0)),
            joint(0.0, 447.0, 0.0, 0.0, (-170.0, 170.0)),
        ],
        parallelogram: Some(Parallelogram {
            crank_m: 0.5,
            coupler_m: 1.609,
            rocker_m: 0.5,
            arm_m: 1.607,
            crank_offset_rad: -FRAC_PI_2,
            passive_min_rad: -1.05,
            passive_max_rad: 1.05,
        }),
        links: Some([
            mass(1520.0, [-200.0, -150.0, 30.0]),
            mass(780.0, [-800.0, 10.0, 40.0]),
            mass(850.0, [-120.0, -20.0, 80.0]),
            mass(400.0, [10.0, 700.0, 0.0]),
            mass(150.0, [0.0, 5.0, 30.0]),
            mass(85.0, [3.0, 0.0, -60.0]),
        ]),
        payload: mass(600.0, [40.0, 20.0, 280.0]),
        compliance_rad_per_nm: [1e-8, 4.3e-8, 9e-8, 2.5e-7, 2.8e-7, 3e-7],
        ..serial()
    };
    robot.joints[3].sign = -1.0;
    robot
}

/// Every field that any effect looks at is there.
fn telling(random: &mut ChaCha8Rng) -> Conditions {
    let mut each = |size: f64| std::array::from_fn(|_| random.random_range(-size..size));
    Conditions {
        approach: each(1.0).map(f64::signum),
        speed_rad_s: Some(each(2.0)),
        acceleration_rad_s2: Some(each(8.0)),
        time_s: Some(1800.0),
        temperature_c: Some(27.5),
        payload: None,
    }
}

fn within_limits(robot: &Robot, random: &mut ChaCha8Rng) -> [f64; DOF] {
    loop {
        let pose = std::array::from_fn(|j| random.random_range(robot.joints[j].min_rad..robot.joints[j].max_rad));
        if robot.limit_violation(&pose, 0.0).is_none() {
            return pose;
        }
    }
}

/// A few locations of every place.
fn locations(place: Place) -> Vec<Location> {
    let none = Location::default();
    let joints = || (0..DOF).map(Location::at_joint);
    match place {
        Place::Joint | Place::JointLaw => joints().collect(),
        Place::JointOrder => {
            joints().flat_map(|at| [1.0, 2.0, 7.5].map(|order| Location { order: Some(order), ..at })).collect()
        }
        Place::JointOwnOrder => joints().flat_map(|at| [at, Location { order: Some(3.0), ..at }]).collect(),
        Place::JointPair => joints().map(|at| Location { source_joint: at.joint.map(|j| j % DOF + 1), ..at }).collect(),
        Place::Link => (1..=DOF).map(|link| Location { link: Some(link), ..none }).collect(),
        Place::Base => vec![Location { base: Some(true), ..none }],
        Place::Payload => vec![Location { payload: Some(true), ..none }],
        Place::Clock => vec![Location { clock: Some(true), ..none }],
        Place::Frame => frames().map(|frame| Location { frame: Some(frame), ..none }).collect(),
        Place::FrameMoment => {
            frames().map(|frame| Location { frame: Some(frame), at_s: Some(900.0), ..none }).collect()
        }
    }
}

fn frames() -> impl Iterator<Item = MovingFrame> {
    [MovingFrame::Base, MovingFrame::Tool].into_iter()
}

/// The robot with its known compliances and one effect more.
fn with_effect(robot: &Robot, effect: &'static dyn Effect, location: Location, values: Vec<f64>) -> ArmModel {
    let mut model = ArmModel::nominal(robot.clone());
    model.effects.push(EffectInstance { effect, location });
    model.parameters.effects.push(values);
    model
}

fn measured<T: ModelScalar>(arm: &PreparedArm<'_, T>, pose: &[f64; DOF], conditions: &Conditions) -> Pose<T> {
    let state = arm.at(&pose.map(T::constant), conditions, None).expect("a pose");
    arm.measured(&state)
}

/// Position and orientation as twelve numbers.
fn numbers<T: Real>(pose: &Pose<T>) -> Vec<T> {
    pose.translation.iter().chain(pose.rotation.iter()).copied().collect()
}

/// Runs `check` for every effect at every place on both arms in random poses.
fn everywhere(check: impl Fn(&Robot, &'static dyn Effect, Location, &[f64; DOF], &Conditions)) {
    let mut random = ChaCha8Rng::seed_from_u64(20);
    for robot in [serial(), looped()] {
        for &effect in EFFECTS {
            for location in locations(effect.meta().place) {
                for _ in 0..POSES {
                    let pose = within_limits(&robot, &mut random);
                    check(&robot, effect, location, &pose, &telling(&mut random));
                }
            }
        }
    }
}

fn zeros(effect: &dyn Effect) -> Vec<f64> {
    vec![0.0; effect.meta().parameters.len()]
}

fn typical(effect: &dyn Effect) -> Vec<f64> {
    effect.meta().parameters.iter().map(|parameter| parameter.typical).collect()
}

/// Derivatives of the measured pose by the effect's own parameters: a column each.
fn slopes(model: &ArmModel, pose: &[f64; DOF], conditions: &Conditions) -> Vec<Vec<f64>> {
    let mut parameters = model.parameters.map(Dual::constant);
    let own = parameters.effects.last_mut().expect("an effect");
    for (slot, number) in own.iter_mut().enumerate() {
        *number = seeded(number.value(), slot);
    }
    let count = own.len();
    let columns = numbers(&measured(&model.prepare(parameters), pose, conditions));
    (0..count).map(|slot| columns.iter().map(|number| derivatives(number)[slot]).collect()).collect()
}

#[test]
fn the_registry_is_the_contract() {
    let found: Vec<(&str, &[&str])> =
        EFFECTS.iter().map(|effect| (effect.meta().id, effect.meta().place.fields())).collect();
    assert_eq!(found, CONTRACT);
}

#[test]
fn the_name_cards_are_filled_in() {
    for effect in EFFECTS {
        let meta = effect.meta();
        assert!(!meta.title.is_empty() && !meta.signature.is_empty(), "{}", meta.id);
        assert!(!meta.mistaken_for.is_empty(), "{}", meta.id);
        for other in meta.mistaken_for {
            assert!(*other != meta.id, "{other} is itself");
            assert!(CONTRACT.iter().any(|(id, _)| id == other), "{}: no effect {other}", meta.id);
        }
        assert!(!meta.parameters.is_empty(), "{}", meta.id);
        for (index, parameter) in meta.parameters.iter().enumerate() {
            let (low, high) = parameter.plausible;
            assert!(low <= 0.0 && parameter.typical > 0.0 && parameter.typical <= high, "{}", meta.id);
            assert!(!parameter.unit.is_empty());
            assert!(meta.parameters[..index].iter().all(|before| before.name != parameter.name), "{}", meta.id);
        }
        for location in locations(meta.place) {
            assert!(meta.place.fits(&location), "{}: {location}", meta.id);
            assert!(!meta.place.fits(&Location::default()));
        }
    }
}

#[test]
fn zero_parameters_change_nothing_at_all() {
    everywhere(|robot, effect, location, pose, conditions| {
        let model = with_effect(robot, effect, location, zeros(effect));
        let plain = ArmModel::nominal(robot.clone());
        let (with, without) =
            (measured(&model.prepared(), pose, conditions), measured(&plain.prepared(), pose, conditions));
        assert_eq!(with, without, "{} at {location}", effect.meta().id);
    });
}

#[test]
fn a_record_that_tells_nothing_adds_nothing_that_needs_telling() {
    let mute = Conditions::default();
    everywhere(|robot, effect, location, pose, _| {
        // Play asks for the approach, yet gravity alone picks its flank on loaded joints.
        if effect.meta().needs.met_by(robot, &mute) || effect.meta().id == "backlash" {
            return;
        }
        let model = with_effect(robot, effect, location, typical(effect));
        let plain = ArmModel::nominal(robot.clone());
        let (with, without) = (measured(&model.prepared(), pose, &mute), measured(&plain.prepared(), pose, &mute));
        assert_eq!(with, without, "{} at {location}", effect.meta().id);
    });
}

#[test]
fn dual_numbers_give_the_central_differences() {
    everywhere(|robot, effect, location, pose, conditions| {
        let values = typical(effect);
        let model = with_effect(robot, effect, location, values.clone());
        let columns = slopes(&model, pose, conditions);
        for (slot, column) in columns.iter().enumerate() {
            // As large a step as an exact model stays straight over, so that rounding does not count.
            let step = 0.1 * values[slot];
            let shifted = |by: f64| {
                let mut changed = values.clone();
                changed[slot] += by;
                let model = with_effect(robot, effect, location, changed);
                numbers(&measured(&model.prepared(), pose, conditions))
            };
            for ((up, down), exact) in shifted(step).iter().zip(shifted(-step)).zip(column) {
                let (exact, central) = (exact * step, (up - down) / 2.0);
                let id = effect.meta().id;
                // Metres and radians: a thousandth of the effect of one step, or rounding.
                let tolerance = 1e-3 * exact.abs() + 2e-10;
                assert!((exact - central).abs() < tolerance, "{id} at {location}: {exact:e} against {central:e}");
            }
        }
    });
}

#[test]
fn derivatives_at_zero_are_finite_over_the_whole_range() {
    everywhere(|robot, effect, location, pose, conditions| {
        let model = with_effect(robot, effect, location, zeros(effect));
        for column in slopes(&model, pose, conditions) {
            assert!(column.iter().all(|number| number.is_finite()), "{} at {location}", effect.meta().id);
        }
        // Rest, no approach known, all axes at their zero: the corners where a formula would divide by nothing.
        for column in slopes(&model, &[0.0; DOF], &Conditions::default()) {
            assert!(column.iter().all(|number| number.is_finite()), "{} at {location}", effect.meta().id);
        }
    });
}

#[test]
fn values_at_the_edge_of_belief_give_a_finite_pose_or_an_error() {
    everywhere(|robot, effect, location, pose, conditions| {
        for pick in [|range: (f64, f64)| range.0, |range: (f64, f64)| range.1] {
            let values = effect.meta().parameters.iter().map(|parameter| pick(parameter.plausible)).collect();
            let model = with_effect(robot, effect, location, values);
            // A heavy arm as soft as the softest small one has no equilibrium, and may say so.
            if let Ok(state) = model.prepared().at(pose, conditions, None) {
                assert!(numbers(&state.base_t_flange).iter().all(|number| number.is_finite()));
            }
        }
    });
}

/// Links whose two joint axes meet in a point: no beam, nothing that could grow.
fn has_length(robot: &Robot, location: &Location) -> bool {
    let Some(link) = location.link_index() else {
        return true;
    };
    let next_a = robot.joints.get(link + 1).map_or(0.0, |next| next.a_m);
    let a_m = if robot.convention == Convention::Standard { robot.joints[link].a_m } else { next_a };
    a_m.hypot(robot.joints[link].d_m) > 0.0
}

#[test]
fn every_parameter_moves_the_arm_at_zero_and_more_moves_it_more() {
    for robot in [serial(), looped()] {
        for &effect in EFFECTS {
            for location in locations(effect.meta().place) {
                if !has_length(&robot, &location) {
                    continue;
                }
                let model = with_effect(&robot, effect, location, zeros(effect));
                let plain = ArmModel::nominal(robot.clone());
                let mut random = ChaCha8Rng::seed_from_u64(7);
                let (mut slope, mut single, mut double) = (zeros(effect), 0.0f64, 0.0f64);
                for _ in 0..POSES {
                    let (pose, conditions) = (within_limits(&robot, &mut random), telling(&mut random));
                    for (most, column) in slope.iter_mut().zip(slopes(&model, &pose, &conditions)) {
                        *most = column.iter().fold(*most, |most, number| most.max(number.abs()));
                    }
                    let moved = |times: f64| {
                        let values = typical(effect).iter().map(|value| value * times).collect();
                        let with = with_effect(&robot, effect, location, values);
                        let with = measured(&with.prepared(), &pose, &conditions);
                        let without = measured(&plain.prepared(), &pose, &conditions);
                        let turned = vector_from_rotation(&(with.rotation * without.rotation.transpose()));
                        (with.translation - without.translation).norm() + turned.norm()
                    };
                    (single, double) = (single.max(moved(1.0)), double.max(moved(2.0)));
                }
                let id = effect.meta().id;
                for (parameter, slope) in effect.meta().parameters.iter().zip(&slope) {
                    // A typical value that shows less than a tenth of a micrometre is no typical value.
                    let shows = slope * parameter.typical;
                    assert!(shows > 1e-7, "{id} at {location}: {} moves {shows:e}", parameter.name);
                }
                assert!(double > 1.5 * single, "{id} at {location}: {single:e} m, doubled {double:e} m");
            }
        }
    }
}

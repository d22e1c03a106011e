//! Arms for these tests: the built-in ones, random ones of each family, and what tells two poses apart.

use falsetarget::files::builtin::{BUILT_IN, by_name};
use falsetarget::geometry::pose::{Pose, pose_difference};
use falsetarget::kinematics::controller::Controller;
use falsetarget::model::robot::{Convention, Coupling, DOF, Joint, Mass, Parallelogram, Robot};
use nalgebra::Vector3;
use rand::Rng;
use rand_chacha::ChaCha8Rng;

pub const PI: f64 = std::f64::consts::PI;

/// Rows `[theta_rad, d_m, a_m, alpha_rad]`, limits of half a turn each way.
pub fn arm(convention: Convention, rows: [[f64; 4]; DOF], signs: [f64; DOF]) -> Robot {
    let joints = std::array::from_fn(|index| {
        let [theta_rad, d_m, a_m, alpha_rad] = rows[index];
        let name = format!("J{}", index + 1);
        let sign = signs[index];
        Joint { name, theta_rad, d_m, a_m, alpha_rad, sign, min_rad: -PI, max_rad: PI, max_speed_rad_s: None }
    });
    Robot {
        name: "test".into(),
        convention,
        joints,
        parallelogram: None,
        couplings: Vec::new(),
        links: None,
        base: None,
        tool: None,
        payload: Mass::NONE,
        gravity_m_s2: Vector3::new(0.0, 0.0, -9.80665),
        compliance_rad_per_nm: [0.0; DOF],
    }
}

pub fn built_in() -> Vec<Robot> {
    BUILT_IN.iter().map(|(id, _)| by_name(id).expect("listed").expect("sound")).collect()
}

pub fn named(id: &str) -> Robot {
    by_name(id).expect("listed").expect("sound")
}

fn quarter(random: &mut ChaCha8Rng) -> f64 {
    if random.random_bool(0.5) { PI / 2.0 } else { -PI / 2.0 }
}

fn signs(random: &mut ChaCha8Rng) -> [f64; DOF] {
    std::array::from_fn(|_| if random.random_bool(0.5) { 1.0 } else { -1.0 })
}

fn length(random: &mut ChaCha8Rng) -> f64 {
    let size: f64 = random.random_range(0.2..1.5);
    if random.random_bool(0.5) { size } else { -size }
}

/// Axes 2 and 3 parallel and a wrist whose axes meet; oblique wrists and oblique shoulders among them.
pub fn random_spherical(random: &mut ChaCha8Rng) -> Robot {
    let flip = |random: &mut ChaCha8Rng| if random.random_bool(0.5) { 0.0 } else { PI };
    let oblique = random.random_bool(0.3);
    let bend = |random: &mut ChaCha8Rng| {
        let square = quarter(random);
        if oblique { square + random.random_range(-0.3..0.3) } else { square }
    };
    let mut theta = || random.random_range(-PI..PI);
    let thetas: [f64; DOF] = std::array::from_fn(|_| theta());
    let twists = [bend(random), flip(random), bend(random), bend(random), bend(random), flip(random)];
    let a = [length(random) * 0.3, length(random), length(random) * 0.3, 0.0, 0.0, 0.0];
    let mut d = [length(random), length(random) * 0.2, length(random) * 0.2, length(random), 0.0, length(random) * 0.3];
    let convention = if random.random_bool(0.5) { Convention::Standard } else { Convention::Modified };
    let rows = match convention {
        Convention::Standard => std::array::from_fn(|row| [thetas[row], d[row], a[row], twists[row]]),
        Convention::Modified => {
            // The twist and length of row i + 1 stand between axes i and i + 1.
            d[5] = length(random) * 0.3;
            std::array::from_fn(|row| {
                let (length, twist) = if row == 0 { (0.1, flip(random)) } else { (a[row - 1], twists[row - 1]) };
                [thetas[row], d[row], length, twist]
            })
        }
    };
    let mut robot = arm(convention, rows, signs(random));
    if random.random_bool(0.3) {
        robot.couplings = vec![Coupling { joint: 4, by: 3, factor: 1.0 }, Coupling { joint: 5, by: 4, factor: -0.5 }];
    } else if random.random_bool(0.3) {
        robot.couplings = vec![Coupling { joint: 2, by: 1, factor: -1.0 }];
    }
    robot
}

/// Three parallel axes, then two that meet, as in arms of Universal Robots.
pub fn random_three_parallel(random: &mut ChaCha8Rng) -> Robot {
    let thetas: [f64; DOF] = std::array::from_fn(|_| random.random_range(-PI..PI));
    let a = [length(random) * 0.1, length(random), length(random), length(random) * 0.1, 0.0, 0.0];
    let d = [0.4, length(random) * 0.1, 0.05, length(random) * 0.2, length(random) * 0.2, length(random) * 0.2];
    let twists = [quarter(random), 0.0, PI, quarter(random), quarter(random), 0.0];
    let rows = std::array::from_fn(|row| [thetas[row], d[row], a[row], twists[row]]);
    arm(Convention::Standard, rows, signs(random))
}

/// An arm of the 800 kg class with a parallelogram that is none quite: opposite rods differ by millimetres.
pub fn uneven_loop() -> Robot {
    let mut robot = named("hh800-class");
    let rods = robot.parallelogram.expect("a loop");
    robot.parallelogram =
        Some(Parallelogram { crank_m: rods.crank_m + 0.004, coupler_m: rods.coupler_m - 0.006, ..rods });
    robot
}

/// An arm whose wrist axes do not meet, in the manner of FANUC's CRX-10iA: axis 5 is offset along itself.
pub fn offset_wrist() -> Robot {
    let rows = [
        [0.0, 0.245, 0.0, -PI / 2.0],
        [-PI / 2.0, 0.0, 0.71, 0.0],
        [0.0, 0.0, 0.0, -PI / 2.0],
        [0.0, 0.54, 0.0, PI / 2.0],
        [0.0, 0.15, 0.0, -PI / 2.0],
        [0.0, 0.16, 0.0, 0.0],
    ];
    arm(Convention::Standard, rows, [1.0; DOF])
}

/// An arm in which no axes are parallel and none meet.
pub fn skew() -> Robot {
    let rows = [
        [0.0, 0.245, 0.1, -1.4],
        [-PI / 2.0, 0.1, 0.71, 0.17],
        [0.0, 0.05, 0.1, -1.4],
        [0.0, 0.54, 0.05, 1.48],
        [0.0, 0.15, 0.03, -PI / 2.0],
        [0.0, 0.16, 0.0, 0.0],
    ];
    arm(Convention::Standard, rows, [1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
}

/// Numbers within the limits (and within one and a half turns), the loop closed.
pub fn random_numbers(robot: &Robot, controller: &Controller, random: &mut ChaCha8Rng) -> [f64; DOF] {
    for _ in 0..100_000 {
        let numbers = std::array::from_fn(|joint| {
            let limits = &robot.joints[joint];
            random.random_range(limits.min_rad.max(-1.5 * PI)..limits.max_rad.min(1.5 * PI))
        });
        if robot.limit_violation(&numbers, 0.0).is_none() && controller.forward(&numbers).is_ok() {
            return numbers;
        }
    }
    panic!("{} allows no pose", robot.name)
}

/// Largest of position error, m, and orientation error, rad.
pub fn pose_error(one: &Pose, other: &Pose) -> f64 {
    let (shift, turn) = pose_difference(one, other);
    shift.norm().max(turn.norm())
}

/// Largest difference of numbers, full turns aside, rad.
pub fn apart_modulo_turns(one: &[f64; DOF], other: &[f64; DOF]) -> f64 {
    one.iter().zip(other).map(|(a, b)| 2.0 * (0.5 * (a - b)).sin().abs()).fold(0.0, f64::max)
}

/// Largest difference of numbers, rad.
pub fn apart(one: &[f64; DOF], other: &[f64; DOF]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

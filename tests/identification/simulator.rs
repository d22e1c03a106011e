//! A virtual arm by other formulas than the tool's: homogeneous matrices, a free displacement of six numbers behind every
//! link, and statics as the minimum of potential plus spring energy.

use falsetarget::measure::observation::{Measured, Observation};
use falsetarget::measure::recording::{ApproachSource, Kind, Recording};
use falsetarget::model::conditions::Conditions;
use falsetarget::model::robot::{Convention, DOF, Robot};
use nalgebra::{Matrix4, Matrix6, Vector3, Vector4, Vector6};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A real arm: the nominal one with its faults.
pub struct VirtualArm {
    robot: Robot,
    /// Base, six links, tool.
    displacements: [Matrix4<f64>; DOF + 2],
    compliance_rad_per_nm: [f64; DOF],
}

/// Sizes of the faults, m and rad.
const BASE: [f64; 2] = [1e-3, 5e-4];
const LINK: [f64; 2] = [3e-4, 3e-4];
const TOOL: [f64; 2] = [5e-4, 5e-4];

impl VirtualArm {
    /// Draws an arm whose drives are up to 20 % softer or stiffer than the robot file has them.
    pub fn draw(robot: &Robot, seed: u64) -> Self {
        assert!(robot.parallelogram.is_none() && robot.convention == Convention::Standard, "serial arms only");
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let displacements = std::array::from_fn(|place| {
            let [shift, turn] = match place {
                0 => BASE,
                place if place == DOF + 1 => TOOL,
                _ => LINK,
            };
            let mut normal = |sigma: f64| -> f64 { sigma * Distribution::<f64>::sample(&StandardNormal, &mut random) };
            let angles = [normal(turn), normal(turn), normal(turn)];
            let position = Vector3::new(normal(shift), normal(shift), normal(shift));
            Matrix4::new_translation(&position) * Matrix4::from_euler_angles(angles[0], angles[1], angles[2])
        });
        let compliance_rad_per_nm =
            robot.compliance_rad_per_nm.map(|stated| stated * (1.0 + 0.2 * (2.0 * random.random::<f64>() - 1.0)));
        Self { robot: robot.clone(), displacements, compliance_rad_per_nm }
    }

    /// Frames after each row, in the measuring frame.
    fn frames(&self, angles: &Vector6<f64>) -> [Matrix4<f64>; DOF] {
        let base = self.robot.base.expect("a base");
        let mut pose = base.rotation.to_homogeneous();
        pose.fixed_view_mut::<3, 1>(0, 3).copy_from(&base.translation);
        pose *= self.displacements[0];
        std::array::from_fn(|index| {
            let row = &self.robot.joints[index];
            let theta = row.sign * angles[index] + row.theta_rad;
            pose *= Matrix4::from_euler_angles(0.0, 0.0, theta)
                * Matrix4::new_translation(&Vector3::new(row.a_m, 0.0, row.d_m))
                * Matrix4::from_euler_angles(row.alpha_rad, 0.0, 0.0)
                * self.displacements[index + 1];
            pose
        })
    }

    /// Potential energy of all masses and the springs of the drives, J.
    fn energy(&self, command: &Vector6<f64>, twist: &Vector6<f64>) -> f64 {
        let frames = self.frames(&(command + twist));
        let gravity = self.robot.gravity_m_s2;
        // Gravity stands in the base, which the file puts upright in the measuring frame; its error turns it along.
        let base = self.robot.base.expect("a base");
        let down = base.rotation * self.displacements[0].fixed_view::<3, 3>(0, 0) * gravity;
        let weight = |frame: &Matrix4<f64>, mass_kg: f64, center: &Vector3<f64>| {
            let at = frame * Vector4::new(center.x, center.y, center.z, 1.0);
            -mass_kg * down.dot(&at.xyz())
        };
        let links = self.robot.links.expect("masses");
        let mut energy: f64 =
            links.iter().zip(&frames).map(|(link, frame)| weight(frame, link.mass_kg, &link.center_of_mass_m)).sum();
        energy += weight(&frames[DOF - 1], self.robot.payload.mass_kg, &self.robot.payload.center_of_mass_m);
        for joint in 0..DOF {
            if self.compliance_rad_per_nm[joint] > 0.0 {
                energy += twist[joint].powi(2) / (2.0 * self.compliance_rad_per_nm[joint]);
            }
        }
        energy
    }

    /// The twist of the drives at which the energy is least: Newton's method on central differences.
    fn equilibrium(&self, command: &Vector6<f64>) -> Vector6<f64> {
        let soft: Vec<usize> = (0..DOF).filter(|&joint| self.compliance_rad_per_nm[joint] > 0.0).collect();
        let mut twist = Vector6::zeros();
        let h = 1e-4;
        for _ in 0..4 {
            let at = |moves: &[(usize, f64)]| {
                let mut moved = twist;
                for &(joint, by) in moves {
                    moved[joint] += by;
                }
                self.energy(command, &moved)
            };
            let mut hessian = Matrix6::identity();
            let mut gradient = Vector6::zeros();
            let here = at(&[]);
            for &a in &soft {
                gradient[a] = (at(&[(a, h)]) - at(&[(a, -h)])) / (2.0 * h);
                for &b in &soft {
                    hessian[(a, b)] = if a == b {
                        (at(&[(a, h)]) - 2.0 * here + at(&[(a, -h)])) / (h * h)
                    } else {
                        (at(&[(a, h), (b, h)]) - at(&[(a, h), (b, -h)]) - at(&[(a, -h), (b, h)])
                            + at(&[(a, -h), (b, -h)]))
                            / (4.0 * h * h)
                    };
                }
            }
            twist -= hessian.lu().solve(&gradient).expect("a stable arm");
        }
        twist
    }

    /// Where the measured point stands, in the measuring frame, m.
    pub fn point(&self, numbers_rad: &[f64; DOF]) -> Vector3<f64> {
        self.pose(numbers_rad).fixed_view::<3, 1>(0, 3).into_owned()
    }

    /// Where the tool stands and how, in the measuring frame.
    pub fn pose(&self, numbers_rad: &[f64; DOF]) -> Matrix4<f64> {
        let command = Vector6::from(*numbers_rad);
        let frames = self.frames(&(command + self.equilibrium(&command)));
        let tool = self.robot.tool.expect("a tool");
        let mut nominal = tool.rotation.to_homogeneous();
        nominal.fixed_view_mut::<3, 1>(0, 3).copy_from(&tool.translation);
        frames[DOF - 1] * self.displacements[DOF + 1] * nominal
    }
}

/// Random poses within the joint limits.
pub fn poses(robot: &Robot, count: usize, seed: u64) -> Vec<[f64; DOF]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..count)
        .map(|_| {
            std::array::from_fn(|joint| {
                let limits = &robot.joints[joint];
                limits.min_rad + (limits.max_rad - limits.min_rad) * random.random::<f64>()
            })
        })
        .collect()
}

/// A recording of these poses whose exact points are known, with normal noise.
pub fn record(poses: &[[f64; DOF]], points_m: &[Vector3<f64>], sigma_m: f64, seed: u64) -> Recording {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let observations = poses
        .iter()
        .zip(points_m)
        .enumerate()
        .map(|(index, (&numbers_rad, point))| {
            let noisy = point.map(|exact| exact + sigma_m * Distribution::<f64>::sample(&StandardNormal, &mut random));
            Observation {
                id: (index + 1).to_string(),
                station: None,
                numbers_rad,
                conditions: Conditions::default(),
                measured: Some(Measured { position_m: noisy, rotation: None }),
                sigma_m: None,
                sigma_rad: None,
                set: None,
                line: index + 2,
            }
        })
        .collect();
    let (name, sha256) = ("simulated".to_string(), String::new());
    Recording { name, sha256, kind: Kind::Static, approach: ApproachSource::Recorded, observations }
}

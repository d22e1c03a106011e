//! The arm as a list of rigid bodies between axes, by transforms of its own: no Denavit-Hartenberg error parameters. Every
//! body carries a free displacement of six numbers; the parallelogram is two circles that meet.

use falsetarget::geometry::pose::Pose;
use falsetarget::model::robot::{Convention, DOF, Mass, Robot};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector2, Vector3};

use crate::dice::Dice;

/// Bodies: the pedestal and one behind every joint.
pub const BODIES: usize = DOF + 1;

/// A point mass and where it sits: in the frame that turns with its joint, or in the flange.
#[derive(Clone, Copy)]
pub struct Lump {
    pub mass_kg: f64,
    pub at_m: Vector3<f64>,
}

/// The rods of a parallelogram, m and rad.
#[derive(Clone, Copy)]
pub struct Rods {
    pub crank: f64,
    pub coupler: f64,
    pub rocker: f64,
    pub arm: f64,
    pub offset: f64,
    theta_2: f64,
}

/// An arm that stands somewhere.
#[derive(Clone)]
pub struct Arm {
    sign: [f64; DOF],
    zero: [f64; DOF],
    couplings: Vec<(usize, usize, f64)>,
    pub bodies: [Isometry3<f64>; BODIES],
    pub lumps: [Lump; DOF],
    pub payload: Lump,
    pub tool_m: Vector3<f64>,
    /// In the measuring frame, m/s^2.
    pub gravity: Vector3<f64>,
    /// Of the drives that the robot file knows to be soft.
    pub compliance: [f64; DOF],
    pub rods: Option<Rods>,
}

/// What bends an arm away from its commanded shape: nothing by default.
#[derive(Clone)]
pub struct Shape {
    /// Further turn of each drive, rad.
    pub turns: [f64; DOF],
    /// Rotation vector before each joint's turn, rad.
    pub axis_tilts: [Vector3<f64>; DOF],
    /// Displacement of each body's far end, in its own frame.
    pub ends: [Isometry3<f64>; BODIES],
    /// Growth of each body, relative.
    pub growth: [f64; BODIES],
    /// Displacement of the measured point's frame against the flange.
    pub tool: Isometry3<f64>,
}

impl Default for Shape {
    fn default() -> Self {
        Self {
            turns: [0.0; DOF],
            axis_tilts: [Vector3::zeros(); DOF],
            ends: [Isometry3::identity(); BODIES],
            growth: [0.0; BODIES],
            tool: Isometry3::identity(),
        }
    }
}

/// Where everything stands, in the measuring frame.
pub struct Stand {
    /// The foot of axis 1.
    pub foot: Isometry3<f64>,
    /// Frames that turn with the joints.
    pub turning: [Isometry3<f64>; DOF],
    /// Far ends of the bodies behind the joints: the last is the flange.
    pub ends: [Isometry3<f64>; DOF],
    /// The measured point.
    pub point: Vector3<f64>,
}

fn about_z(angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle)
}

fn about_x(angle: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle)
}

impl Arm {
    /// The arm that a robot file describes.
    pub fn of_file(robot: &Robot) -> Self {
        let row = |joint: usize| &robot.joints[joint];
        let slide = |a: f64, d: f64| Translation3::new(a, 0.0, d);
        let isometry = |pose: &Pose| {
            let rotation = nalgebra::Rotation3::from_matrix_unchecked(pose.rotation);
            Isometry3::from_parts(pose.translation.into(), UnitQuaternion::from_rotation_matrix(&rotation))
        };
        let mut bodies = [Isometry3::identity(); BODIES];
        let base = robot.base.as_ref().map_or(Isometry3::identity(), isometry);
        bodies[0] = base;
        for joint in 0..DOF {
            let own = row(joint);
            match robot.convention {
                Convention::Standard => bodies[joint + 1] = slide(own.a_m, own.d_m) * about_x(own.alpha_rad),
                Convention::Modified => {
                    bodies[joint] *= about_x(own.alpha_rad) * slide(own.a_m, 0.0);
                    bodies[joint + 1] = slide(0.0, own.d_m) * UnitQuaternion::identity();
                }
            }
        }
        let lumps = std::array::from_fn(|joint| {
            let link = robot.links.map_or(Mass::NONE, |links| links[joint]);
            // A file counts from the frame after the row.
            let after = match robot.convention {
                Convention::Standard => bodies[joint + 1],
                Convention::Modified => slide(0.0, row(joint).d_m) * UnitQuaternion::identity(),
            };
            Lump { mass_kg: link.mass_kg, at_m: (after * Point3::from(link.center_of_mass_m)).coords }
        });
        let rods = robot.parallelogram.as_ref().map(|p| Rods {
            crank: p.crank_m,
            coupler: p.coupler_m,
            rocker: p.rocker_m,
            arm: p.arm_m,
            offset: p.crank_offset_rad,
            theta_2: row(1).theta_rad,
        });
        Self {
            sign: std::array::from_fn(|joint| row(joint).sign),
            zero: std::array::from_fn(|joint| row(joint).theta_rad),
            couplings: robot.couplings.iter().map(|c| (c.joint, c.by, c.factor)).collect(),
            bodies,
            lumps,
            payload: Lump { mass_kg: robot.payload.mass_kg, at_m: robot.payload.center_of_mass_m },
            tool_m: robot.tool.as_ref().map_or(Vector3::zeros(), |tool| tool.translation),
            gravity: base.rotation * robot.gravity_m_s2,
            compliance: robot.compliance_rad_per_nm,
            rods,
        }
    }

    /// Displaces every body, the measured point, and the rods of the loop: sizes in m and rad.
    pub fn disturb(&mut self, dice: &mut Dice, shift_m: f64, turn_rad: f64) {
        let mut slip = Vector3::zeros();
        for (index, body) in self.bodies.iter_mut().enumerate() {
            let shift = dice.normals() * shift_m;
            *body *= Isometry3::new(shift, dice.normals() * turn_rad);
            if index == 2 {
                slip = shift;
            }
        }
        self.tool_m += dice.normals() * shift_m;
        if let Some(rods) = &mut self.rods {
            // The arm of the loop is link 2 itself.
            rods.arm += slip.x;
            rods.crank += 0.5 * shift_m * dice.normal();
            rods.coupler += 0.5 * shift_m * dice.normal();
        }
    }

    /// Drive angles of the controller's numbers, rad.
    pub fn drives(&self, numbers: &[f64; DOF]) -> [f64; DOF] {
        let mut drives = *numbers;
        for &(joint, by, factor) in &self.couplings {
            drives[joint] += self.sign[joint] * factor * numbers[by];
        }
        drives
    }

    /// Angles at the axes; `None` where the loop cannot close.
    fn angles(&self, drives: &[f64; DOF]) -> Option<[f64; DOF]> {
        let mut angles: [f64; DOF] = std::array::from_fn(|joint| self.sign[joint] * drives[joint] + self.zero[joint]);
        let Some(rods) = &self.rods else { return Some(angles) };
        let unit = |angle: f64| Vector2::new(angle.cos(), angle.sin());
        let crank_angle = angles[2] + rods.theta_2 + rods.offset;
        let (elbow, pin) = (rods.arm * unit(angles[1]), rods.crank * unit(crank_angle));
        // Two circles: about the crank's pin with the coupler, about the elbow with the rocker.
        let between = pin - elbow;
        let apart = between.norm();
        let along = (apart * apart + rods.rocker.powi(2) - rods.coupler.powi(2)) / (2.0 * apart);
        let beside = (rods.rocker.powi(2) - along * along).sqrt();
        if beside.is_nan() {
            return None;
        }
        let ahead = between / apart;
        let side = Vector2::new(-ahead.y, ahead.x);
        let meets = [ahead * along + side * beside, ahead * along - side * beside];
        let parallel = rods.rocker * unit(crank_angle);
        let tip = if (meets[0] - parallel).norm() < (meets[1] - parallel).norm() { meets[0] } else { meets[1] };
        // Continuous with the crank.
        let lean = (parallel.x * tip.y - parallel.y * tip.x).atan2(parallel.dot(&tip));
        angles[2] = crank_angle + lean - angles[1] - rods.offset;
        Some(angles)
    }

    /// Where everything stands for these drive angles.
    pub fn stand(&self, drives: &[f64; DOF], shape: &Shape) -> Option<Stand> {
        let turned: [f64; DOF] = std::array::from_fn(|joint| drives[joint] + shape.turns[joint]);
        let angles = self.angles(&turned)?;
        let foot = self.bodies[0] * shape.ends[0];
        let mut here = foot;
        let mut turning = [Isometry3::identity(); DOF];
        let mut ends = [Isometry3::identity(); DOF];
        for joint in 0..DOF {
            here = here * UnitQuaternion::from_scaled_axis(shape.axis_tilts[joint]) * about_z(angles[joint]);
            turning[joint] = here;
            let mut body = self.bodies[joint + 1];
            body.translation.vector *= 1.0 + shape.growth[joint + 1];
            here = here * body * shape.ends[joint + 1];
            ends[joint] = here;
        }
        let point = (here * shape.tool * Point3::from(self.tool_m)).coords;
        Some(Stand { foot, turning, ends, point })
    }

    /// The masses and where they are: links, then the payload.
    pub fn masses(&self, stand: &Stand) -> [(f64, Vector3<f64>); BODIES] {
        std::array::from_fn(|index| match self.lumps.get(index) {
            Some(lump) => (lump.mass_kg, (stand.turning[index] * Point3::from(lump.at_m)).coords),
            None => (self.payload.mass_kg, (stand.ends[DOF - 1] * Point3::from(self.payload.at_m)).coords),
        })
    }

    /// Torque at each drive, Nm, of `fields` (m/s^2 on each mass): the work that a small turn of it sets free.
    pub fn torques(&self, drives: &[f64; DOF], shape: &Shape, fields: &[Vector3<f64>; BODIES]) -> Option<[f64; DOF]> {
        const STEP: f64 = 1e-4;
        let work = |drives: &[f64; DOF]| -> Option<f64> {
            let stand = self.stand(drives, shape)?;
            Some(self.masses(&stand).iter().zip(fields).map(|((mass, at), field)| mass * field.dot(at)).sum())
        };
        let mut torques = [0.0; DOF];
        for (joint, torque) in torques.iter_mut().enumerate() {
            let (mut ahead, mut behind) = (*drives, *drives);
            ahead[joint] += STEP;
            behind[joint] -= STEP;
            *torque = (work(&ahead)? - work(&behind)?) / (2.0 * STEP);
        }
        Some(torques)
    }
}

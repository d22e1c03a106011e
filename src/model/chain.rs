//! The open chain: six rows with their errors, each turned by its angle.

use nalgebra::{Matrix3, Vector3};

use crate::geometry::pose::{Pose, composed, rotation_from_vector, rotation_x, rotation_y};
use crate::geometry::real::Real;

use super::effect::Response;
use super::parameters::{Displacement, Parameters};
use super::robot::{Convention, DOF, Robot};

/// The constant parts of the rows: row i is `before_i * Rz(theta_i) * after_i`.
///
/// Made once for a set of parameters, so that a pose costs six sines and cosines and six products.
#[derive(Clone, Debug)]
pub struct Rows<T: Real> {
    before: [Option<Pose<T>>; DOF],
    after: [Pose<T>; DOF],
}

/// A joint axis in the robot base.
#[derive(Clone, Copy, Debug)]
pub struct Axis<T: Real> {
    /// A point on it, m.
    pub origin: Vector3<T>,
    /// Its direction, unit length.
    pub direction: Vector3<T>,
}

/// The chain in one pose, everything in the robot base.
#[derive(Clone, Copy, Debug)]
pub struct Chain<T: Real> {
    /// The joint axes.
    pub axes: [Axis<T>; DOF],
    /// `base_T_frame_i` after row i.
    pub frames: [Pose<T>; DOF],
}

impl<T: Real> Chain<T> {
    /// A chain in no pose yet.
    pub fn at_rest() -> Self {
        let idle = Axis { origin: Vector3::zeros(), direction: Vector3::zeros() };
        Self { axes: [idle; DOF], frames: [Pose::identity(); DOF] }
    }

    /// `base_T_flange`.
    pub fn flange(&self) -> Pose<T> {
        self.frames[DOF - 1]
    }
}

impl<T: Real> Rows<T> {
    /// The constant parts for a robot with these errors.
    pub fn new(robot: &Robot, parameters: &Parameters<T>) -> Self {
        let mut before = [None; DOF];
        let mut after = [Pose::identity(); DOF];
        for (joint, (row, errors)) in robot.joints.iter().zip(&parameters.rows).enumerate() {
            let along_z = Vector3::new(T::zero(), T::zero(), T::constant(row.d_m) + errors.d_m);
            let along_x = Vector3::new(T::constant(row.a_m) + errors.a_m, T::zero(), T::zero());
            let twist = rotation_x(T::constant(row.alpha_rad) + errors.alpha_rad);
            let beta = rotation_y(errors.beta_rad);
            match robot.convention {
                Convention::Standard => {
                    after[joint] = Pose { rotation: twist * beta, translation: along_z + along_x };
                }
                Convention::Modified => {
                    before[joint] = Some(Pose { rotation: twist * beta, translation: along_x });
                    after[joint] = Pose::from_translation(along_z);
                }
            }
        }
        Self { before, after }
    }

    /// The chain at these row angles, with what the effects do to axes, links and base.
    pub fn at(&self, theta_rad: &[T; DOF], response: &Response<T>) -> Chain<T> {
        let mut chain = Chain::at_rest();
        self.place(theta_rad, response, &mut chain);
        chain
    }

    /// [`Rows::at`] in a chain that is there already.
    pub fn place(&self, theta_rad: &[T; DOF], response: &Response<T>, chain: &mut Chain<T>) {
        let mut pose = if response.base_moves { displacement_pose(&response.base) } else { Pose::identity() };
        for (joint, &theta) in theta_rad.iter().enumerate() {
            if let Some(before) = &self.before[joint] {
                pose = pose * *before;
            }
            if response.axes_tilt {
                pose.rotation = composed(&pose.rotation, &rotation_from_vector(&response.tilt[joint]));
            }
            chain.axes[joint] = Axis { origin: pose.translation, direction: pose.rotation.column(2).clone_owned() };
            pose = Pose { rotation: turned(&pose.rotation, theta), ..pose } * self.after[joint];
            if response.links_move {
                pose = pose * displacement_pose(&response.links[joint]);
            }
            chain.frames[joint] = pose;
        }
    }
}

/// `rotation * Rz(angle)`: only the first two columns change.
fn turned<T: Real>(rotation: &Matrix3<T>, angle: T) -> Matrix3<T> {
    let (sin, cos) = num_dual::DualNum::sin_cos(&angle);
    let (x, y) = (rotation.column(0), rotation.column(1));
    Matrix3::from_columns(&[x * cos + y * sin, y * cos - x * sin, rotation.column(2).clone_owned()])
}

/// The pose of a small displacement: shift, then turn about the shifted origin.
pub fn displacement_pose<T: Real>(displacement: &Displacement<T>) -> Pose<T> {
    let [x, y, z, rx, ry, rz] = *displacement;
    Pose { rotation: rotation_from_vector(&Vector3::new(rx, ry, rz)), translation: Vector3::new(x, y, z) }
}

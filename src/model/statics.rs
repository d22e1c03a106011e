//! Gravity and inertia: what pulls at each joint.

use nalgebra::Vector3;

use crate::geometry::real::Real;

use super::chain::Chain;
use super::linkage::RowAngles;
use super::robot::{DOF, LOOP_AROUND, LOOP_DRIVEN, Mass, Robot};

/// What loads the arm, after the effects that change loads.
#[derive(Clone, Copy, Debug)]
pub struct Load<T: Real> {
    /// Gravity in the robot base, m/s^2.
    pub gravity_m_s2: Vector3<T>,
    /// Mass at the flange, kg.
    pub payload_kg: T,
    /// Its centre in the flange, m.
    pub payload_com_m: Vector3<T>,
    /// Torque that a device adds at an actuator (a spring or gas balancer), Nm, in the controller's sense.
    pub device_torque_nm: [T; DOF],
}

impl<T: Real> Load<T> {
    /// The load that the robot file and the record declare.
    pub fn declared(robot: &Robot, payload: Option<&Mass>) -> Self {
        let payload = payload.unwrap_or(&robot.payload);
        Self {
            gravity_m_s2: robot.gravity_m_s2.map(T::constant),
            payload_kg: T::constant(payload.mass_kg),
            payload_com_m: payload.center_of_mass_m.map(T::constant),
            device_torque_nm: [T::zero(); DOF],
        }
    }
}

/// The masses beyond a joint: from its own link to the payload.
#[derive(Clone, Copy, Debug)]
pub struct Outboard<T: Real> {
    /// Their sum, kg.
    pub mass_kg: T,
    /// Their first moment `sum m c` about the origin of the base, kg m, in the base.
    pub first_moment_kg_m: Vector3<T>,
}

/// Static loads in one pose.
#[derive(Clone, Copy, Debug)]
pub struct Statics<T: Real> {
    /// Beyond each joint.
    pub outboard: [Outboard<T>; DOF],
    /// Gravity in the base, m/s^2.
    pub gravity_m_s2: Vector3<T>,
    /// Load torque at each actuator, Nm, in the controller's sense: positive pushes the joint number up.
    pub actuator_torque_nm: [T; DOF],
}

impl<T: Real> Statics<T> {
    /// Nothing weighs anything.
    pub fn none() -> Self {
        let nothing = Outboard { mass_kg: T::zero(), first_moment_kg_m: Vector3::zeros() };
        Self { outboard: [nothing; DOF], gravity_m_s2: Vector3::zeros(), actuator_torque_nm: [T::zero(); DOF] }
    }

    /// The loads of a robot with link masses; [`Statics::none`] for a robot without.
    pub fn of(robot: &Robot, chain: &Chain<T>, angles: &RowAngles<T>, load: &Load<T>) -> Self {
        let Some(links) = &robot.links else {
            return Self::none();
        };
        let mut statics = Self { gravity_m_s2: load.gravity_m_s2, ..Self::none() };
        let mut beyond = Outboard {
            mass_kg: load.payload_kg,
            first_moment_kg_m: chain.flange().transform_point(&load.payload_com_m) * load.payload_kg,
        };
        let mut row_torque = [T::zero(); DOF];
        for joint in (0..DOF).rev() {
            let mass = T::constant(links[joint].mass_kg);
            let center = chain.frames[joint].transform_point(&links[joint].center_of_mass_m.map(T::constant));
            beyond.mass_kg += mass;
            beyond.first_moment_kg_m += center * mass;
            statics.outboard[joint] = beyond;
            let axis = &chain.axes[joint];
            row_torque[joint] = axis.direction.dot(&statics.moment_about(joint, &axis.origin));
        }
        statics.actuator_torque_nm = actuator_torque(robot, angles, &row_torque);
        for (torque, device) in statics.actuator_torque_nm.iter_mut().zip(&load.device_torque_nm) {
            *torque += *device;
        }
        statics
    }

    /// Moment of the weight beyond `joint` about `point`, Nm, both in the base.
    pub fn moment_about(&self, joint: usize, point: &Vector3<T>) -> Vector3<T> {
        let outboard = &self.outboard[joint];
        (outboard.first_moment_kg_m - point * outboard.mass_kg).cross(&self.gravity_m_s2)
    }

    /// Weight beyond `joint`, N, in the base.
    pub fn weight(&self, joint: usize) -> Vector3<T> {
        self.gravity_m_s2 * self.outboard[joint].mass_kg
    }
}

/// Torques at the rows carried to the actuators by virtual work: `tau_a = (d theta / d a)' tau_theta`.
pub fn actuator_torque<T: Real>(robot: &Robot, angles: &RowAngles<T>, row_torque_nm: &[T; DOF]) -> [T; DOF] {
    let mut torque: [T; DOF] =
        std::array::from_fn(|joint| row_torque_nm[joint] * T::constant(robot.joints[joint].sign));
    let driven = row_torque_nm[LOOP_DRIVEN];
    torque[LOOP_AROUND] += angles.driven_by_around * driven;
    torque[LOOP_DRIVEN] = angles.driven_by_own * driven;
    torque
}

/// Torque at each actuator that accelerates the arm, as a load, Nm: `-sum (c - o) x m c''` with every link a point
/// mass at its centre (a robot file holds no inertias).
///
/// `row_speed_rad_s` and `row_acceleration_rad_s2` are those of the rows, in the rows' sense.
pub fn inertial_torque<T: Real>(
    robot: &Robot,
    chain: &Chain<T>,
    angles: &RowAngles<T>,
    load: &Load<T>,
    row_speed_rad_s: &[T; DOF],
    row_acceleration_rad_s2: &[T; DOF],
) -> [T; DOF] {
    let Some(links) = &robot.links else {
        return [T::zero(); DOF];
    };
    let (mut omega, mut alpha) = (Vector3::zeros(), Vector3::zeros());
    let (mut point, mut point_acceleration) = (chain.axes[0].origin, Vector3::zeros());
    let mut forces: [(Vector3<T>, Vector3<T>); DOF + 1] = [(Vector3::zeros(), Vector3::zeros()); DOF + 1];
    let carried = |to: &Vector3<T>, from: &Vector3<T>, start: &Vector3<T>, omega: &Vector3<T>, alpha: &Vector3<T>| {
        let arm = to - from;
        start + alpha.cross(&arm) + omega.cross(&omega.cross(&arm))
    };
    for joint in 0..DOF {
        let axis = &chain.axes[joint];
        point_acceleration = carried(&axis.origin, &point, &point_acceleration, &omega, &alpha);
        point = axis.origin;
        let spin = axis.direction * row_speed_rad_s[joint];
        alpha += axis.direction * row_acceleration_rad_s2[joint] + omega.cross(&spin);
        omega += spin;
        let center = chain.frames[joint].transform_point(&links[joint].center_of_mass_m.map(T::constant));
        let acceleration = carried(&center, &point, &point_acceleration, &omega, &alpha);
        forces[joint] = (center, acceleration * T::constant(-links[joint].mass_kg));
    }
    let center = chain.flange().transform_point(&load.payload_com_m);
    let acceleration = carried(&center, &point, &point_acceleration, &omega, &alpha);
    forces[DOF] = (center, -(acceleration * load.payload_kg));
    let row_torque: [T; DOF] = std::array::from_fn(|joint| {
        let axis = &chain.axes[joint];
        let moment = forces[joint..]
            .iter()
            .fold(Vector3::zeros(), |sum: Vector3<T>, (center, force)| sum + (center - axis.origin).cross(force));
        axis.direction.dot(&moment)
    });
    actuator_torque(robot, angles, &row_torque)
}

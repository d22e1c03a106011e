//! Gravity and devices: what pulls at each joint at rest.

use nalgebra::Vector3;

use crate::geometry::pose::{rotated, rotation_x};
use crate::geometry::real::Real;

use super::chain::Chain;
use super::linkage::RowAngles;
use super::robot::{Convention, DOF, LOOP_AROUND, LOOP_DRIVEN, Mass, Robot};

/// What loads the arm, after the effects that change loads.
#[derive(Clone, Copy, Debug)]
pub struct Load<T: Real> {
    /// Gravity in the robot base, m/s^2.
    pub gravity_m_s2: Vector3<T>,
    /// Mass at the flange, kg.
    pub payload_kg: T,
    /// Its first moment `m c` in the flange, kg m: linear in what can be wrong with a payload, and defined without one.
    pub payload_moment_kg_m: Vector3<T>,
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
            payload_moment_kg_m: (payload.center_of_mass_m * payload.mass_kg).map(T::constant),
            device_torque_nm: [T::zero(); DOF],
        }
    }

    /// The payload's centre in the flange, m; the flange's origin for a payload without mass.
    pub fn payload_com_m(&self) -> Vector3<T> {
        if self.payload_kg.value() == 0.0 { Vector3::zeros() } else { self.payload_moment_kg_m / self.payload_kg }
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

impl<T: Real> Outboard<T> {
    /// Nothing is there.
    pub fn nothing() -> Self {
        Self { mass_kg: T::zero(), first_moment_kg_m: Vector3::zeros() }
    }

    /// Weight, N, in the base.
    pub fn weight(&self, gravity_m_s2: &Vector3<T>) -> Vector3<T> {
        gravity_m_s2 * self.mass_kg
    }

    /// Moment of the weight about `point`, Nm, both in the base.
    pub fn moment_about(&self, point: &Vector3<T>, gravity_m_s2: &Vector3<T>) -> Vector3<T> {
        (self.first_moment_kg_m - point * self.mass_kg).cross(gravity_m_s2)
    }
}

/// Static loads in one pose.
#[derive(Clone, Copy, Debug)]
pub struct Statics<T: Real> {
    /// Beyond each joint.
    pub outboard: [Outboard<T>; DOF],
    /// The payload alone.
    pub payload: Outboard<T>,
    /// Gravity in the base, m/s^2.
    pub gravity_m_s2: Vector3<T>,
    /// Load torque at each actuator, Nm, in the controller's sense: positive pushes the joint number up.
    pub actuator_torque_nm: [T; DOF],
}

impl<T: Real> Statics<T> {
    /// Nothing weighs anything.
    pub fn none() -> Self {
        Self {
            outboard: [Outboard::nothing(); DOF],
            payload: Outboard::nothing(),
            gravity_m_s2: Vector3::zeros(),
            actuator_torque_nm: [T::zero(); DOF],
        }
    }

    /// Puts in the loads of a robot with link masses; of one without, the torques of devices alone.
    pub fn weigh(&mut self, robot: &Robot, chain: &Chain<T>, angles: &RowAngles<T>, load: &Load<T>) {
        if let Some(links) = &robot.links {
            self.weigh_links(robot, links, chain, angles, load);
            for (torque, device) in self.actuator_torque_nm.iter_mut().zip(&load.device_torque_nm) {
                *torque += *device;
            }
        } else {
            self.actuator_torque_nm = load.device_torque_nm;
        }
    }

    fn weigh_links(
        &mut self,
        robot: &Robot,
        links: &[Mass; DOF],
        chain: &Chain<T>,
        angles: &RowAngles<T>,
        load: &Load<T>,
    ) {
        self.gravity_m_s2 = load.gravity_m_s2;
        let flange = chain.flange();
        self.payload = Outboard {
            mass_kg: load.payload_kg,
            first_moment_kg_m: rotated(&flange.rotation, &load.payload_moment_kg_m)
                + flange.translation * load.payload_kg,
        };
        let mut beyond = self.payload;
        let mut row_torque = [T::zero(); DOF];
        for joint in (0..DOF).rev() {
            let mass = T::constant(links[joint].mass_kg);
            let center = chain.frames[joint].transform_point(&links[joint].center_of_mass_m.map(T::constant));
            beyond.mass_kg += mass;
            beyond.first_moment_kg_m += center * mass;
            self.outboard[joint] = beyond;
            let axis = &chain.axes[joint];
            row_torque[joint] = axis.direction.dot(&beyond.moment_about(&axis.origin, &load.gravity_m_s2));
        }
        self.actuator_torque_nm = actuator_torque(robot, angles, &row_torque);
    }

    /// What hangs on the far end of a link: the links after it and the payload.
    pub fn beyond_link(&self, link: usize) -> &Outboard<T> {
        self.outboard.get(link + 1).unwrap_or(&self.payload)
    }
}

/// The torque that weight could at most make at a joint, Nm: everything beyond it stretched out level, with the
/// payload of the robot file. A constant of the robot that says how large its torques are, never less than any.
///
/// Zero for a robot without link masses.
pub fn largest_torque_nm(robot: &Robot, joint: usize) -> f64 {
    let Some(links) = &robot.links else {
        return 0.0;
    };
    // What the parallelogram carries hangs on its pin as far as the arm's own drive feels it.
    let pinned = joint == LOOP_AROUND && robot.parallelogram.is_some();
    let (mut reach_m, mut moment_kg_m) = (0.0, 0.0);
    for (index, link) in links.iter().enumerate().skip(joint) {
        // Along a joint's own axis there is no lever.
        let lever = |point: Vector3<f64>| if index == joint { point.xy().norm() } else { point.norm() };
        let payload = (index + 1 == DOF).then_some(&robot.payload);
        for mass in [Some(link), payload].into_iter().flatten() {
            let own_m = if pinned && index > joint { 0.0 } else { lever(center_beyond_axis(robot, index, mass)) };
            moment_kg_m += mass.mass_kg * (reach_m + own_m);
        }
        if !(pinned && index > joint) {
            reach_m += lever(next_axis(robot, index));
        }
    }
    moment_kg_m * robot.gravity_m_s2.norm()
}

/// Where the next joint's axis frame stands in the frame that turns with this joint, m.
fn next_axis(robot: &Robot, joint: usize) -> Vector3<f64> {
    let a_m = match robot.convention {
        Convention::Standard => robot.joints[joint].a_m,
        Convention::Modified => robot.joints.get(joint + 1).map_or(0.0, |next| next.a_m),
    };
    Vector3::new(a_m, 0.0, robot.joints[joint].d_m)
}

/// Where a mass given in the frame after the row lies in the frame that turns with the joint, m.
fn center_beyond_axis(robot: &Robot, joint: usize, mass: &Mass) -> Vector3<f64> {
    let row = &robot.joints[joint];
    match robot.convention {
        Convention::Standard => rotation_x(row.alpha_rad) * mass.center_of_mass_m + next_axis(robot, joint),
        Convention::Modified => mass.center_of_mass_m + Vector3::z() * row.d_m,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::arm::ArmModel;
    use crate::model::conditions::Conditions;
    use crate::model::fixture;

    #[test]
    fn no_pose_makes_more_than_the_largest_torque() {
        for robot in [fixture::looped_with_masses(), fixture::serial_with_masses()] {
            let model = ArmModel::controller(robot.clone());
            let mut seen = [0.0f64; DOF];
            for step in 0..4000 {
                let phase = f64::from(step);
                let pose: [f64; DOF] = std::array::from_fn(|j| {
                    let turn = (phase * [0.754, 0.569, 0.430, 0.324, 0.245, 0.185][j]).fract() - 0.5;
                    turn * if matches!(j, 1 | 2) { 1.0 } else { 6.0 }
                });
                let state = model.prepared().at(&pose, &Conditions::default(), None).expect("a pose");
                for (most, torque) in seen.iter_mut().zip(&state.statics.actuator_torque_nm) {
                    *most = most.max(torque.abs());
                }
            }
            for (joint, most) in seen.iter().enumerate() {
                let bound = largest_torque_nm(&robot, joint);
                assert!(*most <= bound, "joint {joint}: {most} over {bound}");
                // Joint 1 is loaded only as far as gravity leans.
                assert!(joint == 0 || *most > 0.4 * bound, "joint {joint}: {most} is far below {bound}");
            }
        }
        assert_eq!(largest_torque_nm(&fixture::bare(Convention::Standard, &fixture::LOOPED), 1), 0.0);
    }
}

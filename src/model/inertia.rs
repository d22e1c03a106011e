//! What accelerating the arm loads its drives with.

use nalgebra::Vector3;

use crate::geometry::real::Real;

use super::chain::Chain;
use super::linkage::{RowAngles, RowRates};
use super::robot::{DOF, Robot};
use super::statics::{Load, actuator_torque};

/// Torque at each actuator that accelerates the arm, as a load, Nm: `-sum (c - o) x m c''` with every link a point
/// mass at its centre (a robot file holds no inertias).
pub fn inertial_torque<T: Real>(
    robot: &Robot,
    chain: &Chain<T>,
    angles: &RowAngles<T>,
    load: &Load<T>,
    rates: &RowRates<T>,
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
        let spin = axis.direction * rates.speed_rad_s[joint];
        alpha += axis.direction * rates.acceleration_rad_s2[joint] + omega.cross(&spin);
        omega += spin;
        let center = chain.frames[joint].transform_point(&links[joint].center_of_mass_m.map(T::constant));
        let acceleration = carried(&center, &point, &point_acceleration, &omega, &alpha);
        forces[joint] = (center, acceleration * T::constant(-links[joint].mass_kg));
    }
    let center = chain.flange().transform_point(&load.payload_com_m());
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::arm::ArmModel;
    use crate::model::conditions::Conditions;
    use crate::model::fixture;
    use crate::model::linkage::row_rates;
    use crate::model::parameters::Parameters;
    use crate::model::robot::Mass;

    const POSE: [f64; DOF] = [0.4, -0.3, 0.2, 1.1, -0.7, 2.0];
    const SPEED: [f64; DOF] = [0.6, -0.8, 0.9, 2.0, -1.5, 2.5];
    const ACCELERATION: [f64; DOF] = [2.0, -3.0, 1.5, 4.0, 5.0, -6.0];

    /// The arm with unequal rods, so that the loop's curvature counts.
    fn arm() -> ArmModel {
        let mut model = ArmModel::controller(fixture::looped_with_masses());
        model.parameters = Parameters { crank_m: 4e-3, coupler_m: -5e-3, ..Parameters::zero() };
        model
    }

    /// Masses and where they are, in the base.
    fn points(model: &ArmModel, actuators: &[f64; DOF]) -> Vec<(f64, Vector3<f64>)> {
        let state = model.prepared().at(actuators, &Conditions::default(), None).expect("a pose");
        let links = model.robot.links.expect("masses");
        let place = |(link, frame): (&Mass, &crate::geometry::pose::Pose)| {
            (link.mass_kg, frame.transform_point(&link.center_of_mass_m))
        };
        let mut points: Vec<_> = links.iter().zip(&state.chain.frames).map(place).collect();
        let payload = &model.robot.payload;
        points.push((payload.mass_kg, state.base_t_flange.transform_point(&payload.center_of_mass_m)));
        points
    }

    fn moved(from: &[f64; DOF], joint: usize, by: f64) -> [f64; DOF] {
        let mut to = *from;
        to[joint] += by;
        to
    }

    /// Momentum `dT/da'` of the point masses, from differences of their positions.
    fn momentum(model: &ArmModel, actuators: &[f64; DOF], speed: &[f64; DOF]) -> [f64; DOF] {
        let step = 1e-5;
        let slopes: Vec<Vec<Vector3<f64>>> = (0..DOF)
            .map(|joint| {
                let ahead = points(model, &moved(actuators, joint, step));
                let behind = points(model, &moved(actuators, joint, -step));
                ahead.iter().zip(&behind).map(|(a, b)| (a.1 - b.1) / (2.0 * step)).collect()
            })
            .collect();
        let masses = points(model, actuators);
        std::array::from_fn(|joint| {
            let of_point = |(index, (mass, _)): (usize, &(f64, Vector3<f64>))| {
                let velocity: Vector3<f64> = (0..DOF).map(|other| slopes[other][index] * speed[other]).sum();
                mass * slopes[joint][index].dot(&velocity)
            };
            masses.iter().enumerate().map(of_point).sum()
        })
    }

    fn kinetic_energy(model: &ArmModel, actuators: &[f64; DOF], speed: &[f64; DOF]) -> f64 {
        0.5 * momentum(model, actuators, speed).iter().zip(speed).map(|(p, v)| p * v).sum::<f64>()
    }

    #[test]
    fn inertial_torque_obeys_lagrange() {
        let model = arm();
        let state = model.prepared().at(&POSE, &Conditions::default(), None).expect("a pose");
        let rates = row_rates(&model.robot, &state.angles, &SPEED, &ACCELERATION);
        let load = Load::declared(&model.robot, None);
        let torque = inertial_torque(&model.robot, &state.chain, &state.angles, &load, &rates);
        let step = 1e-4;
        let momentum_at = |t: f64| {
            let position = std::array::from_fn(|j| POSE[j] + SPEED[j] * t + 0.5 * ACCELERATION[j] * t * t);
            let speed = std::array::from_fn(|j| SPEED[j] + ACCELERATION[j] * t);
            momentum(&model, &position, &speed)
        };
        let (ahead, behind) = (momentum_at(step), momentum_at(-step));
        for joint in 0..DOF {
            let rise = (ahead[joint] - behind[joint]) / (2.0 * step);
            let energy = |by: f64| kinetic_energy(&model, &moved(&POSE, joint, by), &SPEED);
            let slope = (energy(step) - energy(-step)) / (2.0 * step);
            // The drive gives d/dt dT/da' - dT/da; what loads it is the opposite.
            let expected = slope - rise;
            let tolerance = 1e-4 * expected.abs().max(100.0);
            assert!(
                (torque[joint] - expected).abs() < tolerance,
                "joint {joint}: {} against {expected}",
                torque[joint]
            );
        }
    }
}

//! Gravity does not point where the model has it: the base is not level.
//!
//! `g' = exp(v) g` in the robot base, v a rotation vector along the two base axes that stand most nearly level: x and y
//! for an arm on the floor or the ceiling. (A turn about gravity itself changes nothing.)
//!
//! Signature: torques change in proportion to what hangs across the tilt, joint 1 gets a torque at all, all of it once
//! a turn of joint 1. Size: 1 to 20 mrad for a floor that nobody levelled, 0.1 rad for a wedge forgotten.
//! Easily mistaken for: a payload error, base compliance, twist of axis 1.

use nalgebra::Vector3;

use crate::geometry::pose::{rotated, rotation_from_vector};
use crate::geometry::real::Real;
use crate::model::statics::Load;

use super::{EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Setting};

/// See the module.
pub struct GravityTilt;

const fn tilt(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "rad", typical: 1e-2, plausible: (-0.3, 0.3) }
}

static META: EffectMeta = EffectMeta {
    id: "gravity_tilt",
    title: "base is not level",
    parameters: &[tilt("first_level_axis"), tilt("second_level_axis")],
    place: Place::Base,
    needs: Needs { gravity_model: true, ..Needs::NOTHING },
    signature: "load torques change once a turn of joint 1",
    mistaken_for: &["payload_error", "base_compliance", "joint_compliance"],
    follows: Follows::Several,
    told_apart_by: "level the base or measure it with an inclinometer; 12 poses stretched out, every 30 deg of joint 1 \
        level the base or measure it with an inclinometer; 12 poses stretched out, every 30 deg of joint 1",
};

impl Physics for GravityTilt {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn load<T: Real>(&self, at: &Location, parameters: &[T], setting: &Setting<'_, T>, load: &mut Load<T>) {
        if let (Some(true), [first, second]) = (at.base, parameters) {
            let mut turn = Vector3::zeros();
            // The axis along gravity stays out; the other two keep their order.
            let upright = setting.robot.gravity_m_s2.iamax();
            turn[if upright == 0 { 1 } else { 0 }] = *first;
            turn[if upright == 2 { 1 } else { 2 }] = *second;
            load.gravity_m_s2 = rotated(&rotation_from_vector(&turn), &load.gravity_m_s2);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::conditions::Conditions;
    use crate::model::fixture;
    use crate::model::robot::DOF;

    fn tilted(gravity_m_s2: Vector3<f64>, parameters: [f64; 2]) -> Vector3<f64> {
        let mut robot = fixture::looped_with_masses();
        robot.gravity_m_s2 = gravity_m_s2;
        let mut load = Load::declared(&robot, None);
        let setting = Setting { robot: &robot, conditions: &Conditions::default(), actuators_rad: &[0.0; DOF] };
        GravityTilt.load(&Location { base: Some(true), ..Location::default() }, &parameters, &setting, &mut load);
        load.gravity_m_s2
    }

    #[test]
    fn on_the_floor_the_axes_are_x_and_y() {
        let (sin, cos) = 0.1f64.sin_cos();
        // Turned about x by +0.1 rad, a vector along -z leans to +y; about y, to -x.
        let down = Vector3::new(0.0, 0.0, -10.0);
        assert!((tilted(down, [0.1, 0.0]) - Vector3::new(0.0, 10.0 * sin, -10.0 * cos)).norm() < 1e-12);
        assert!((tilted(down, [0.0, 0.1]) - Vector3::new(-10.0 * sin, 0.0, -10.0 * cos)).norm() < 1e-12);
    }

    #[test]
    fn on_a_wall_both_parameters_still_tilt() {
        for gravity in [Vector3::new(9.8, 0.0, 0.0), Vector3::new(0.0, -9.8, 0.0)] {
            for parameters in [[0.1, 0.0], [0.0, 0.1]] {
                assert!((tilted(gravity, parameters) - gravity).norm() > 0.9);
            }
        }
    }
}

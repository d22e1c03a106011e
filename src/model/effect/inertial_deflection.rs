//! The drive train twists under the torque that accelerates the arm.
//!
//! `d a = s tau_dyn(a, a', a'')`, tau_dyn = the inertial load at the actuator, Nm, against the acceleration, with every
//! link a point mass at its centre (a robot file holds no inertias): see [`inertial_torque`].
//!
//! Signature: one joint against its acceleration and against the centrifugal load of the others; nothing at rest. Size:
//! the joint's compliance, 4e-8 to 2e-5 rad/Nm.
//! Easily mistaken for: a clock offset or lag in short strokes, where acceleration and position go together.

use crate::geometry::real::Real;
use crate::model::inertia::inertial_torque;
use crate::model::linkage::{actuators_from_numbers, row_rates};

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct InertialDeflection;

static META: EffectMeta = EffectMeta {
    id: "inertial_deflection",
    title: "drive train twists under acceleration",
    parameters: &[ParameterMeta { name: "compliance", unit: "rad/Nm", typical: 1e-6, plausible: (0.0, 2e-3) }],
    place: Place::Joint,
    needs: Needs { gravity_model: true, speed: true, acceleration: true, ..Needs::NOTHING },
    signature: "one joint against the torque that accelerates what it carries",
    mistaken_for: &["servo_lag", "time_offset", "joint_compliance"],
    follows: Follows::OwnAcceleration,
    told_apart_by: "the same path at half and at full speed, and back again",
};

impl Physics for InertialDeflection {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(joint), [compliance]) = (at.joint_index(), parameters) else {
            return;
        };
        let conditions = context.conditions;
        let (Some(speed), Some(acceleration)) = (&conditions.speed_rad_s, &conditions.acceleration_rad_s2) else {
            return;
        };
        let robot = context.robot;
        let speed = actuators_from_numbers(robot, speed);
        let acceleration = actuators_from_numbers(robot, acceleration);
        let rates = row_rates(robot, context.angles, &speed, &acceleration);
        let torque = inertial_torque(robot, context.chain, context.angles, context.load, &rates);
        response.turn(joint, *compliance * torque[joint]);
    }
}

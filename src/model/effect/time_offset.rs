//! The two recorders' clocks differ: the tracker saw the arm where it stood a moment later than the joints tell.
//!
//! `d a = a' dt + a'' dt^2 / 2` for every joint, dt > 0 where the measured point is ahead of the recorded joints. The
//! quadratic term where the record has accelerations.
//!
//! Signature: all joints at once in proportion to their speeds; nothing at rest. Size: 1 ms at 1 m/s is 1 mm.
//! Easily mistaken for: servo lag of the joint that moves most (opposite sign), wind-up (by sign of speed).

use crate::geometry::real::Real;
use crate::model::linkage::actuators_from_numbers;
use crate::model::robot::DOF;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct TimeOffset;

static META: EffectMeta = EffectMeta {
    id: "time_offset",
    title: "clocks of arm and tracker differ",
    parameters: &[ParameterMeta { name: "offset", unit: "s", typical: 1e-3, plausible: (-0.2, 0.2) }],
    place: Place::Clock,
    needs: Needs { speed: true, ..Needs::NOTHING },
    signature: "all joints at once in proportion to their speeds",
    mistaken_for: &["servo_lag", "friction_windup", "backlash"],
    follows: Follows::Several,
    told_apart_by: "the same path at half and at full speed, and back again",
};

impl Physics for TimeOffset {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(true), Some(speed), [offset]) = (at.clock, &context.conditions.speed_rad_s, parameters) else {
            return;
        };
        let speed = actuators_from_numbers(context.robot, speed);
        let acceleration = context.conditions.acceleration_rad_s2.unwrap_or([0.0; DOF]);
        let acceleration = actuators_from_numbers(context.robot, &acceleration);
        for (joint, (speed, acceleration)) in speed.into_iter().zip(acceleration).enumerate() {
            let late = *offset * T::constant(speed) + *offset * *offset * T::constant(0.5 * acceleration);
            response.turn(joint, late);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::arm::{ArmModel, EffectInstance};
    use crate::model::conditions::Conditions;
    use crate::model::fixture;

    #[test]
    fn the_arm_stands_where_it_was_a_moment_later() {
        let robot = fixture::looped_with_masses();
        let mut model = ArmModel::controller(robot);
        let start: [f64; DOF] = [0.4, -0.3, 0.2, 1.1, -0.7, 2.0];
        let speed: [f64; DOF] = [1.0, -0.5, 0.4, 2.0, -1.5, 0.7];
        let acceleration: [f64; DOF] = [-3.0, 2.0, 1.0, 5.0, 4.0, -6.0];
        let dt = 4e-3;
        let later = std::array::from_fn(|joint| start[joint] + speed[joint] * dt + 0.5 * acceleration[joint] * dt * dt);
        let expected = model.prepared().at(&later, &Conditions::default(), None).expect("a pose");
        let location = Location { clock: Some(true), ..Location::default() };
        model.effects.push(EffectInstance { effect: &TimeOffset, location });
        model.parameters.effects.push(vec![dt]);
        let moving =
            Conditions { speed_rad_s: Some(speed), acceleration_rad_s2: Some(acceleration), ..Conditions::default() };
        let found = model.prepared().at(&start, &moving, None).expect("a pose");
        let apart = found.base_t_flange.translation - expected.base_t_flange.translation;
        assert!(apart.norm() < 1e-12, "{apart}");
    }
}

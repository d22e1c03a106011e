//! The joint runs behind its command in proportion to its speed.
//!
//! `d a = -T a'`: a position loop of gain Kv without feed-forward lags by `T = 1/Kv`.
//!
//! Signature: one joint in proportion to its own speed; nothing at rest. Size: Kv of 20 to 60 1/s is 17 to 50 ms;
//! feed-forward leaves a millisecond or less of it, of either sign.
//! Easily mistaken for: a clock offset (which all joints share), wind-up (by the sign of the speed alone).

use crate::geometry::real::Real;
use crate::model::linkage::actuators_from_numbers;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct ServoLag;

static META: EffectMeta = EffectMeta {
    id: "servo_lag",
    title: "joint runs behind its command",
    parameters: &[ParameterMeta { name: "lag", unit: "s", typical: 1e-3, plausible: (-0.02, 0.1) }],
    place: Place::Joint,
    needs: Needs { speed: true, ..Needs::NOTHING },
    signature: "one joint in proportion to its own speed",
    mistaken_for: &["time_offset", "friction_windup", "backlash", "inertial_deflection"],
    follows: Follows::OwnSpeed,
    told_apart_by: "the same path at half and at full speed, and back again",
};

impl Physics for ServoLag {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(joint), Some(speed), [lag]) = (at.joint_index(), &context.conditions.speed_rad_s, parameters) {
            response.turn(joint, *lag * T::constant(-actuators_from_numbers(context.robot, speed)[joint]));
        }
    }
}

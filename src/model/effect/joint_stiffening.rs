//! The drive train's spring is not straight: stiffer (or softer) as the torque grows.
//!
//! `d a = c (tau / tau_r)^3`, beside what `joint_compliance` adds in proportion: the leading odd term of any law that
//! treats both senses alike, be it the cubic spring `M = k x + k3 x^3` (then `c = -k3 tau_r^3 / k^4`) or the three
//! slopes `K1 < K2 < K3` of a harmonic drive's data sheet. `c < 0` stiffens, `c > 0` softens.
//!
//! `tau_r` is [`Context::largest_torque_nm`] of the joint: a constant of the robot file, so that `c` is the twist in rad that
//! the bend of the spring adds at the largest torque. A coefficient in rad/Nm^3 would span ten decades between arms.
//!
//! Signature: an odd function of the torque beyond the straight line; grows faster than the payload; blind to speed and
//! approach. Size: a tenth to a third of the twist itself, 20 to 500 urad at full torque.
//! Easily mistaken for: play that gravity picks (a step in the torque's sign), plain compliance where the torque varies
//! little. Two payloads separate them.

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct JointStiffening;

static META: EffectMeta = EffectMeta {
    id: "joint_stiffening",
    title: "drive train is stiffer or softer under more load",
    parameters: &[ParameterMeta { name: "cubic_twist", unit: "rad", typical: 2e-4, plausible: (-1e-2, 1e-2) }],
    place: Place::Joint,
    needs: Needs { gravity_model: true, ..Needs::NOTHING },
    signature: "an odd, bent function of the joint's load torque beyond the straight line",
    mistaken_for: &["joint_compliance", "backlash", "gravity_compensator", "payload_error"],
};

impl Physics for JointStiffening {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(joint), [cubic_twist]) = (at.joint_index(), parameters) else {
            return;
        };
        let largest_nm = context.largest_torque_nm[joint];
        if largest_nm > 0.0 {
            let share = context.statics.actuator_torque_nm[joint] / T::constant(largest_nm);
            response.turn(joint, *cubic_twist * share * share * share);
        }
    }
}

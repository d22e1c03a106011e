//! An angle error that repeats `order` times a joint revolution.
//!
//! `d a = S sin(k a) + C cos(k a)`, a = the actuator's own angle, k = [`Location::order`] (need not be whole: a line of
//! the input side falls where the gear ratio puts it).
//!
//! Signature: exactly periodic in its own joint, the same in every session, under any load and from either side. Size:
//! an encoder 10 um off centre at 25 mm radius gives 0.4 mrad once a turn; pole-pair lines 0.3 to 0.4 mrad rms at k = 9
//! to 30 (UR10 data); harmonic drive at twice the ratio 0.02 to 0.15 mrad; cycloidal gears below 70 arcsec.
//! Easily mistaken for: zero offset and lengths (k = 1), compliance under gravity (k = 2), gear ratio on a short range.

use num_dual::DualNum;

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct JointPeriodic;

static META: EffectMeta = EffectMeta {
    id: "joint_periodic",
    title: "gear or encoder error that repeats with the joint",
    parameters: &[
        ParameterMeta { name: "sine", unit: "rad", typical: 2e-4, plausible: (-5e-3, 5e-3) },
        ParameterMeta { name: "cosine", unit: "rad", typical: 2e-4, plausible: (-5e-3, 5e-3) },
    ],
    place: Place::JointOrder,
    needs: Needs::NOTHING,
    signature: "repeats exactly with the joint's own angle, under any load and from either side",
    mistaken_for: &["gravity_compensator", "joint_compliance", "gear_ratio", "axis_wobble"],
    follows: Follows::OwnPosition,
    told_apart_by: "turn that joint alone through its whole range in 72 stops, once with payload and once without",
};

impl Physics for JointPeriodic {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(joint), Some(order), [sine, cosine]) = (at.joint_index(), at.order, parameters) {
            let (sin, cos) = DualNum::sin_cos(&(context.actuators_rad[joint] * T::constant(order)));
            response.turn(joint, *sine * sin + *cosine * cos);
        }
    }
}

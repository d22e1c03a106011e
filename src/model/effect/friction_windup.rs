//! The joint stops short against friction: the drive train stays wound up by the friction torque it moved against.
//!
//! `d a = -w u`, u = the sense of approach (-1, 0 unknown, +1), whatever the load. The state after a long move in one
//! sense; shorter moves than the wind-up distance (0.5 to 5 deg) would need the history of motion, which no record has.
//!
//! Signature: two levels by the sense of approach, on joints that gravity loads as well. Size: 20 to 200 urad.
//! Easily mistaken for: backlash (on joints without gravity load the two are one), lag or clock offset in motion.

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct FrictionWindup;

static META: EffectMeta = EffectMeta {
    id: "friction_windup",
    title: "joint stops short against friction",
    parameters: &[ParameterMeta { name: "windup", unit: "rad", typical: 1e-4, plausible: (0.0, 2e-3) }],
    place: Place::Joint,
    needs: Needs { approach: true, ..Needs::NOTHING },
    signature: "two levels by the sense of approach, whatever the load",
    mistaken_for: &["backlash", "servo_lag", "time_offset"],
    follows: Follows::OwnPosition,
    told_apart_by: "stop at 10 poses from both sides of that joint, five with its axis tilted so that gravity loads it \
        (or push the arm by hand): play then takes the side of the load, wind-up stays with the approach",
};

impl Physics for FrictionWindup {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(joint), [windup]) = (at.joint_index(), parameters) {
            response.turn(joint, *windup * T::constant(-context.conditions.approach[joint]));
        }
    }
}

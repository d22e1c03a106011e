//! The joint turns by a little more or less than it is told, in proportion.
//!
//! `d a = e a`, a = the actuator's own angle from its zero (another zero would only be an offset).
//!
//! Signature: a straight line in its own joint, without bound over several turns. Size: 1e-6 to 1e-4 for counting and
//! belt errors; a tooth miscounted is 1e-2, gross.
//! Easily mistaken for: a once-a-turn encoder error on a short range, lengths of the next links.

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct GearRatio;

static META: EffectMeta = EffectMeta {
    id: "gear_ratio",
    title: "gear ratio differs from the controller's",
    parameters: &[ParameterMeta { name: "ratio_error", unit: "1", typical: 2e-4, plausible: (-2e-2, 2e-2) }],
    place: Place::Joint,
    needs: Needs::NOTHING,
    signature: "a straight line in the joint's own position",
    mistaken_for: &["joint_periodic", "joint_coupling", "gravity_compensator"],
    follows: Follows::OwnPosition,
    told_apart_by: "turn that joint alone through its whole range in 72 stops, once with payload and once without",
};

impl Physics for GearRatio {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(joint), [ratio_error]) = (at.joint_index(), parameters) {
            response.turn(joint, *ratio_error * context.actuators_rad[joint]);
        }
    }
}

//! A joint turns a little when another one does: a wrong entry in the wrist's coupling matrix, a shared drive.
//!
//! `d a_i = f a_j`, both actuators' own angles, j = [`Location::source_joint`].
//!
//! Signature: a straight line in another joint's position; found as a cross term, such as joint 5 against joint 4. Size:
//! 1e-5 to 1e-3 for a ratio in the matrix that is slightly off; hollow wrists with a wrong matrix far more.
//! Easily mistaken for: gear ratio where the two joints move together, twist of the axis between them.

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct JointCoupling;

static META: EffectMeta = EffectMeta {
    id: "joint_coupling",
    title: "joint follows another one",
    parameters: &[ParameterMeta { name: "factor", unit: "1", typical: 2e-4, plausible: (-5e-2, 5e-2) }],
    place: Place::JointPair,
    needs: Needs::NOTHING,
    signature: "a straight line in another joint's position",
    mistaken_for: &["gear_ratio", "joint_periodic"],
    follows: Follows::SourcePosition,
    told_apart_by: "turn that joint alone through its whole range in 72 stops, once with payload and once without",
};

impl Physics for JointCoupling {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(joint), Some(source), [factor]) = (at.joint_index(), at.source_index(), parameters) {
            response.turn(joint, *factor * context.actuators_rad[source]);
        }
    }
}

//! The drive train twists in proportion to its load torque.
//!
//! `d a_i = s_i tau_i` (Nguyen, Le and Kang 2019, equation 9), at equilibrium: tau is the torque in the pose that the
//! deflected arm takes.
//!
//! Signature: follows the load torque of its joint; scales with payload; blind to speed and to the sense of approach.
//! Easily mistaken for: a payload error (same levers), twice-a-turn gear errors, a zero offset (its mean).

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct JointCompliance;

static META: EffectMeta = EffectMeta {
    id: "joint_compliance",
    title: "drive train twists under load",
    parameters: &[ParameterMeta {
        name: "compliance",
        unit: "rad/Nm",
        typical: 1e-6,
        // From the stiffest heavy drive to a small harmonic drive (physics: 4e-8 to 3e-5).
        plausible: (0.0, 2e-4),
    }],
    place: Place::Joint,
    needs: Needs {
        gravity_model: true,
        approach: false,
        speed: false,
        acceleration: false,
        time: false,
        temperature: false,
    },
};

impl Physics for JointCompliance {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(joint), [compliance]) = (at.joint_index(), parameters) {
            response.turn(joint, *compliance * context.statics.actuator_torque_nm[joint]);
        }
    }
}

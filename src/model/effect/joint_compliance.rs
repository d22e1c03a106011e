//! The drive train twists in proportion to its load torque.
//!
//! `d a_i = s_i tau_i` (Nguyen, Le and Kang 2019, equation 9), at equilibrium: tau is the torque in the pose that the
//! deflected arm takes, Nm at the actuator, positive where it pushes the joint number up.
//!
//! Signature: follows the load torque of its joint; scales with payload; blind to speed and to the sense of approach.
//! Size: 4e-8 rad/Nm (800 kg arm, the same paper) to 1e-6 (KR240 class, Dumas 2011, Klimchik 2013), 1.5e-5 (UR10).
//! Easily mistaken for: a payload error (same levers), twice-a-turn gear errors, a zero offset (its mean).

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct JointCompliance;

static META: EffectMeta = EffectMeta {
    id: "joint_compliance",
    title: "drive train twists under load",
    parameters: &[ParameterMeta {
        name: "compliance",
        unit: "rad/Nm",
        typical: 1e-6,
        // From nothing to twice the smallest strain wave gear of a wrist (Harmonic Drive CSF-8: 900 Nm/rad); a spring that
        // gives way upwards does not exist.
        plausible: (0.0, 2e-3),
    }],
    place: Place::Joint,
    needs: Needs { gravity_model: true, ..Needs::NOTHING },
    signature: "in proportion to the joint's load torque, the same at any speed and from either side",
    mistaken_for: &[
        "payload_error",
        "joint_stiffening",
        "link_flexibility",
        "base_compliance",
        "gravity_compensator",
        "joint_periodic",
    ],
    follows: Follows::OwnTorque,
    told_apart_by: "15 poses twice, with the full payload and with none",
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

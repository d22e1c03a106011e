//! Free play: the output stands at one flank of the gear or at the other.
//!
//! Gravity picks the flank where it is strong enough, `d a = (b/2) sign(tau)`; where it is not, the joint lags its last
//! motion, `d a = -(b/2) u`. Between the two the weight of gravity grows smoothly with `|tau|` over the friction torque
//! that holds the flank, so that the value has derivatives everywhere.
//!
//! Signature: two levels, by the sense of approach on joints that gravity does not load, by the sign of the torque on
//! those it does. Size: 30 to 290 urad (Nabtesco RV catalogue: 0.3 to 1 arcmin lost motion).
//! Easily mistaken for: friction wind-up (never picked by gravity), stiffening (smooth in the torque).

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct Backlash;

/// Share of the largest static torque that the joint's links and load could make below which friction holds the flank.
const HOLDING_SHARE: f64 = 0.03;

static META: EffectMeta = EffectMeta {
    id: "backlash",
    title: "free play in the gear",
    parameters: &[ParameterMeta { name: "gap", unit: "rad", typical: 2e-4, plausible: (0.0, 3e-3) }],
    place: Place::Joint,
    needs: Needs {
        gravity_model: false,
        approach: true,
        speed: false,
        acceleration: false,
        time: false,
        temperature: false,
    },
};

impl Physics for Backlash {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(joint), [gap]) = (at.joint_index(), parameters) else {
            return;
        };
        let axis = &context.chain.axes[joint];
        let outboard = &context.statics.outboard[joint];
        // The torque if all that hangs on the joint were level with it: the size of what gravity can do there.
        let reach = outboard.first_moment_kg_m - axis.origin * outboard.mass_kg;
        let largest = reach.norm().value() * context.statics.gravity_m_s2.norm().value();
        let torque = context.statics.actuator_torque_nm[joint];
        let by_approach = T::constant(-context.conditions.approach[joint]);
        let side = if largest > 0.0 {
            let pull = torque / T::constant(HOLDING_SHARE * largest);
            let by_gravity = num_dual::DualNum::tanh(&pull);
            by_gravity + (T::one() - by_gravity * by_gravity) * by_approach
        } else {
            by_approach
        };
        response.turn(joint, *gap * T::constant(0.5) * side);
    }
}

//! Free play: the output stands at one flank of the gear or at the other.
//!
//! Gravity picks the flank where it is strong enough, `d a = (b/2) sign(tau)`; where it is not, the joint lags its last
//! motion, `d a = -(b/2) u` (u = the sense of approach, -1, 0 or +1). Between the two the flank passes over smoothly:
//! `d a = (b/2) (w sign(tau) - (1 - w) u)` with `w = p^16 / (1 + p^16)`, `p = tau / tau_f`: dry friction holds or it does
//! not, within a tenth of its torque. The two are mixed, never added, so that the output stays between the flanks; and the
//! value has derivatives in the pose everywhere.
//!
//! `tau_f`, the torque that friction holds, is [`HOLDING_SHARE`] of [`Context::largest_torque_nm`]: a property of the gear, not
//! of the pose. A location may state another one ([`Location::reference`], Nm): the friction of a gear is its own, and a
//! recording can show it. A robot without masses knows the approach alone.
//!
//! Signature: two levels, by the sense of approach on joints that gravity does not load, by the sign of the torque on
//! those it does. Size: 30 to 290 urad (Nabtesco RV catalogue: 0.3 to 1 arcmin lost motion); worn gears 1 mrad.
//! Easily mistaken for: friction wind-up (never picked by gravity), stiffening (smooth in the torque).

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct Backlash;

/// Share of the largest torque that friction holds: gear makers state lost motion at +-3 % of the rated torque, the
/// torque that just overcomes friction.
const HOLDING_SHARE: f64 = 0.03;

static META: EffectMeta = EffectMeta {
    id: "backlash",
    title: "free play in the gear",
    // From flank to flank. Three milliradians are ten arc minutes: a broken gear.
    parameters: &[ParameterMeta { name: "gap", unit: "rad", typical: 2e-4, plausible: (0.0, 3e-3) }],
    place: Place::Joint,
    needs: Needs { approach: true, ..Needs::NOTHING },
    signature: "two levels: by the sign of the load torque where gravity is strong, by the sense of approach elsewhere",
    mistaken_for: &["friction_windup", "joint_stiffening", "servo_lag", "time_offset"],
    follows: Follows::OwnPosition,
    told_apart_by: "stop at 10 poses from both sides of that joint, five with its axis tilted so that gravity loads it \
        (or push the arm by hand): play then takes the side of the load, wind-up stays with the approach",
};

impl Physics for Backlash {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(joint), [gap]) = (at.joint_index(), parameters) else {
            return;
        };
        let held_nm = at.reference.unwrap_or(HOLDING_SHARE * context.largest_torque_nm[joint]);
        let side = flank(context.statics.actuator_torque_nm[joint], held_nm, context.conditions.approach[joint]);
        response.turn(joint, *gap * T::constant(0.5) * side);
    }
}

/// Between which flanks the output stands: -1 to +1.
fn flank<T: Real>(torque_nm: T, held_nm: f64, approach: f64) -> T {
    let by_approach = T::constant(-approach);
    if held_nm <= 0.0 {
        return by_approach;
    }
    let by_gravity = T::constant(torque_nm.value().signum());
    // Far beyond the friction torque the weight is one to rounding, and its powers could overflow.
    if torque_nm.value().abs() > 20.0 * held_nm {
        return by_gravity;
    }
    let pull = torque_nm / T::constant(held_nm);
    let fourth = pull * pull * (pull * pull);
    let sixteenth = fourth * fourth * (fourth * fourth);
    let weight = sixteenth / (T::one() + sixteenth);
    by_approach + (by_gravity - by_approach) * weight
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gravity_picks_the_flank_where_it_can_and_the_approach_elsewhere() {
        for approach in [-1.0, 0.0, 1.0] {
            assert!((flank(300.0, 10.0, approach) - 1.0f64).abs() < 1e-5);
            assert!((flank(-300.0, 10.0, approach) + 1.0f64).abs() < 1e-5);
            assert!((flank(0.5, 10.0, approach) + approach).abs() < 1e-4);
            assert_eq!(flank(0.0, 0.0, approach), -approach);
            assert_eq!(flank(5.0, 0.0, approach), -approach);
        }
    }

    #[test]
    fn the_output_never_leaves_the_gap() {
        for step in -400..=400 {
            for approach in [-1.0, 0.0, 1.0] {
                let side = flank(f64::from(step), 10.0, approach);
                assert!(side.abs() <= 1.0, "{side} at {step} Nm");
            }
        }
        assert!(flank(1e300, 1e-300, 1.0).is_finite());
    }
}

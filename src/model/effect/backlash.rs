//! Free play: the output stands at one flank of the gear or at the other.
//!
//! Gravity picks the flank where it is strong enough, `d a = (b/2) sign(tau)`; where it is not, the joint lags its last
//! motion, `d a = -(b/2) u` (u = the sense of approach, -1, 0 or +1). Between the two the flank passes over smoothly:
//! `d a = (b/2) (w sign(tau) - (1 - w) u)` with `w = p^n / (1 + p^n)`, `p = |tau| / tau_f`. The two are mixed, never added,
//! so that the output stays between the flanks; and the value has derivatives in the pose everywhere.
//!
//! Dry friction holds or it does not: `n` is large ([`SHARPEST`]: all happens within a thirtieth of `tau_f`). Yet an arm that
//! falls through its play changes its torque, by up to `tau_r b` (`tau_r` the largest torque, which a joint takes on and loses
//! within a radian): passed over within less than that, the flank would have two equilibria or none. With
//! `n = 2 tau_f / (tau_r b)` a round towards the equilibrium contracts by a half at least: the slope of `w` is `n/4` at most.
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
/// Limits of the power by which a flank passes over.
const BLUNTEST: f64 = 4.0;
/// See [`BLUNTEST`].
const SHARPEST: f64 = 64.0;
/// Logarithm of odds beyond which there are none.
const DECIDED: f64 = 40.0;

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
        let largest_nm = context.largest_torque_nm[joint];
        let held_nm = at.reference.unwrap_or(HOLDING_SHARE * largest_nm);
        let torque_nm = context.statics.actuator_torque_nm[joint];
        let sharpness = sharpness(*gap, held_nm / largest_nm);
        let side = flank(torque_nm, held_nm, sharpness, context.conditions.approach[joint]);
        response.turn(joint, *gap * T::constant(0.5) * side);
    }
}

/// The power by which the flank passes over (see the module), from the part of the largest torque that friction holds.
fn sharpness<T: Real>(gap: T, held_share: f64) -> T {
    let steady = T::constant(2.0 * held_share) / (gap * T::constant(gap.value().signum()));
    match steady.value() {
        low if low < BLUNTEST => T::constant(BLUNTEST),
        between if between < SHARPEST => steady,
        _ => T::constant(SHARPEST),
    }
}

/// Between which flanks the output stands: -1 to +1.
fn flank<T: Real>(torque_nm: T, held_nm: f64, sharpness: T, approach: f64) -> T {
    let by_approach = T::constant(-approach);
    let by_gravity = T::constant(torque_nm.value().signum());
    if held_nm <= 0.0 || torque_nm.value() == 0.0 {
        return by_approach;
    }
    let beyond = sharpness * num_dual::DualNum::ln(&(torque_nm * by_gravity / T::constant(held_nm)));
    // Far from the friction torque the weight is zero or one to rounding, and the exponential could overflow.
    if beyond.value().abs() > DECIDED {
        return if beyond.value() > 0.0 { by_gravity } else { by_approach };
    }
    let weight = T::one() / (T::one() + num_dual::DualNum::exp(&-beyond));
    by_approach + (by_gravity - by_approach) * weight
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gravity_picks_the_flank_where_it_can_and_the_approach_elsewhere() {
        for approach in [-1.0, 0.0, 1.0] {
            for sharpness in [BLUNTEST, SHARPEST] {
                assert!((flank(300.0, 10.0, sharpness, approach) - 1.0f64).abs() < 1e-5);
                assert!((flank(-300.0, 10.0, sharpness, approach) + 1.0f64).abs() < 1e-5);
                assert!((flank(0.5, 10.0, sharpness, approach) + approach).abs() < 1e-4);
                assert_eq!(flank(0.0, 10.0, sharpness, approach), -approach);
                assert_eq!(flank(0.0, 0.0, sharpness, approach), -approach);
                assert_eq!(flank(5.0, 0.0, sharpness, approach), -approach);
            }
            assert!((flank(10.7, 10.0, SHARPEST, approach) - 1.0f64).abs() < 0.03);
            assert!((flank(9.3, 10.0, SHARPEST, approach) + approach).abs() < 0.03);
        }
    }

    #[test]
    fn the_larger_the_gap_the_blunter_the_flank() {
        // n = 2 tau_f / (tau_r b): 60 for a milliradian at 3 %, 20 for three.
        assert!((sharpness(1e-3, 0.03) - 60.0f64).abs() < 1e-9 && (sharpness(-3e-3, 0.03) - 20.0f64).abs() < 1e-9);
        assert_eq!([sharpness(0.0, 0.03), sharpness(1e-5, 0.03), sharpness(1.0, 0.03)], [SHARPEST, SHARPEST, BLUNTEST]);
        assert_eq!(sharpness(1e-4, f64::NAN), SHARPEST);
    }

    #[test]
    fn the_output_never_leaves_the_gap() {
        for step in -400..=400 {
            for approach in [-1.0, 0.0, 1.0] {
                for sharpness in [BLUNTEST, 16.0, SHARPEST] {
                    let side = flank(f64::from(step), 10.0, sharpness, approach);
                    assert!(side.abs() <= 1.0, "{side} at {step} Nm");
                }
            }
        }
        assert!(flank(1e300, 1e-300, SHARPEST, 1.0).is_finite());
        assert!(flank(1e-300, 1e300, SHARPEST, 1.0).is_finite());
    }
}

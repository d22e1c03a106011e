//! The drive train's spring is not straight: stiffer (or softer) as the torque grows.
//!
//! `d a = c (u - tanh u) / (u_r - tanh u_r)`, `u = tau / tau_k`, `u_r = tau_r / tau_k`, beside what `joint_compliance` adds
//! in proportion: soft below the knee `tau_k` ([`Location::reference`], Nm) and stiff beyond it, or the other way round, as
//! the slopes `K1 < K2 < K3` of a harmonic drive's data sheet have it, rounded. Without a knee it is that law's limit for a
//! knee beyond all torques, `d a = c (tau / tau_r)^3`: the leading odd term of any law that treats both senses alike, such
//! as the cubic spring `M = k x + k3 x^3` (then `c = -k3 tau_r^3 / k^4`). `c < 0` stiffens, `c > 0` softens.
//!
//! `tau_r` is [`Context::largest_torque_nm`] of the joint: a constant of the robot file, so that `c` is the twist in rad that
//! the bend of the spring adds at the largest torque. A coefficient in rad/Nm^3 would span ten decades between arms.
//!
//! Signature: an odd function of the torque beyond the straight line; grows faster than the payload; blind to speed and
//! approach. Size: a tenth to a third of the twist itself, 20 to 500 urad at full torque.
//! Easily mistaken for: play that gravity picks (a step in the torque's sign), plain compliance where the torque varies
//! little. Two payloads separate them.

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct JointStiffening;

static META: EffectMeta = EffectMeta {
    id: "joint_stiffening",
    title: "drive train is stiffer or softer under more load",
    parameters: &[ParameterMeta { name: "cubic_twist", unit: "rad", typical: 2e-4, plausible: (-2e-2, 2e-2) }],
    place: Place::Joint,
    needs: Needs { gravity_model: true, ..Needs::NOTHING },
    signature: "an odd, bent function of the joint's load torque beyond the straight line",
    mistaken_for: &["joint_compliance", "backlash", "gravity_compensator", "payload_error"],
    follows: Follows::OwnTorque,
    told_apart_by: "15 poses twice, with the full payload and with none",
};

impl Physics for JointStiffening {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(joint), [bent_twist]) = (at.joint_index(), parameters) else {
            return;
        };
        let largest_nm = context.largest_torque_nm[joint];
        if largest_nm > 0.0 {
            let torque_nm = context.statics.actuator_torque_nm[joint];
            response.turn(joint, *bent_twist * beyond_straight(torque_nm, largest_nm, at.reference));
        }
    }
}

/// Knees, in parts of the torque looked at, beyond which the law is its cubic limit to rounding.
const NEARLY_CUBIC: f64 = 0.02;

/// The bend of the spring as a part of what it is at the largest torque: -1 to 1.
fn beyond_straight<T: Real>(torque_nm: T, largest_nm: f64, knee_nm: Option<f64>) -> T {
    let share = torque_nm / T::constant(largest_nm);
    match knee_nm.map(|knee_nm| largest_nm / knee_nm) {
        Some(largest) if largest > NEARLY_CUBIC && largest.is_finite() => {
            let bend = bent(share * T::constant(largest));
            bend / T::constant(bent(largest))
        }
        _ => share * share * share,
    }
}

/// `u - tanh u`, by its series where the difference would lose its digits.
fn bent<T: Real>(u: T) -> T {
    if u.value().abs() > NEARLY_CUBIC {
        return u - num_dual::DualNum::tanh(&u);
    }
    let square = u * u;
    u * square * (T::constant(1.0 / 3.0) - square * T::constant(2.0 / 15.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soft_below_the_knee_and_straight_beyond() {
        let at = |torque: f64| beyond_straight(torque, 1000.0, Some(100.0));
        assert!((at(1000.0) - 1.0).abs() < 1e-15 && (at(-1000.0) + 1.0).abs() < 1e-15);
        // Ten knees: u - 1 beyond it, hardly anything below.
        assert!((at(500.0) - 4.0 / 9.0).abs() < 1e-3, "{}", at(500.0));
        assert!(at(50.0) < 0.01);
        // A knee far away is the cubic law; the two ways of computing meet.
        for torque in [-700.0, 3.0, 400.0, 1000.0f64] {
            let cubic = (torque / 1000.0).powi(3);
            assert!((beyond_straight(torque, 1000.0, Some(4e4)) - cubic).abs() < 1e-3);
            assert!((beyond_straight(torque, 1000.0, None) - cubic).abs() < 1e-15);
        }
        let (below, above) = (bent(NEARLY_CUBIC * 0.999_999), bent(NEARLY_CUBIC * 1.000_001));
        assert!((above / below - 1.0).abs() < 1e-5, "{below} {above}");
    }
}

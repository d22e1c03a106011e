//! The drive train's spring is not straight: stiffer (or softer) as the torque grows.
//!
//! `d a = c g(tau / tau_k) / g(tau_r / tau_k)` beside what `joint_compliance` adds in proportion, with an odd bend `g`; the
//! knee `tau_k` is [`Location::reference`], Nm. `c < 0` stiffens, `c > 0` softens. What makes the bend is
//! [`Location::law`]:
//!
//! - none: `g(u) = u - tanh u`, soft below the knee and stiff beyond it, rounded, as the slopes `K1 < K2 < K3` of a harmonic
//!   drive's data sheet run into each other;
//! - [`SpringLaw::Knee`]: `g(u) = u - 1` beyond the knee and nothing below it, the corner rounded over a twentieth of it:
//!   compliance piecewise linear in the torque, with a transition torque (Zhou, Nguyen and Kang 2015);
//! - [`SpringLaw::Cubic`]: `g(u) = u - h`, `h + h^3 = u`: the spring `tau = k x + k3 x^3` with `tau_k = k sqrt(k/k3)`, whose
//!   twist is the root of a cubic (Cardano; Viete's form with hyperbolic functions).
//!
//! Without a knee it is the limit of the first and the last for a knee beyond all torques, `d a = c (tau / tau_r)^3`: the
//! leading odd term of any law that treats both senses alike.
//!
//! `tau_r` is [`Context::largest_torque_nm`] of the joint: a constant of the robot file, so that `c` is the twist in rad that
//! the bend of the spring adds at the largest torque. A coefficient in rad/Nm^3 would span ten decades between arms.
//!
//! Signature: an odd function of the torque beyond the straight line; grows faster than the payload; blind to speed and
//! approach. Size: a tenth to a third of the twist itself, 20 to 500 urad at full torque.
//! Easily mistaken for: play that gravity picks (a step in the torque's sign), plain compliance where the torque varies
//! little. Two payloads separate them.

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response, SpringLaw};

/// See the module.
pub struct JointStiffening;

static META: EffectMeta = EffectMeta {
    id: "joint_stiffening",
    title: "drive train is stiffer or softer under more load",
    parameters: &[ParameterMeta { name: "bend_twist", unit: "rad", typical: 2e-4, plausible: (-2e-2, 2e-2) }],
    place: Place::JointLaw,
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
            response.turn(joint, *bent_twist * beyond_straight(torque_nm, largest_nm, at.law, at.reference));
        }
    }
}

/// Torques, in knees, below which the rounded laws are their cubic limit, to be computed by its series.
const NEARLY_CUBIC: f64 = 0.02;
/// The corner of a sharp knee is rounded over this part of it, so that the model has derivatives.
const CORNER: f64 = 0.05;
/// A sharp knee beyond the largest torque has no bend there to be counted in: the bend this far beyond the knee stands for it.
const BEYOND_KNEE: f64 = 1.1;

/// The bend of the spring as a part of what it is at the largest torque: -1 to 1.
fn beyond_straight<T: Real>(torque_nm: T, largest_nm: f64, law: Option<SpringLaw>, knee_nm: Option<f64>) -> T {
    let share = torque_nm / T::constant(largest_nm);
    let Some(largest) = knee_nm.map(|knee_nm| largest_nm / knee_nm).filter(|largest| largest.is_finite()) else {
        return share * share * share;
    };
    let whole = match law {
        Some(SpringLaw::Knee) => largest.max(BEYOND_KNEE),
        _ if largest <= NEARLY_CUBIC => return share * share * share,
        _ => largest,
    };
    bent(share * T::constant(largest), law) / T::constant(bent(whole, law))
}

/// What a spring's twist lacks (or has too much) at a torque of `u` knees, odd in `u`: a spring that is straight below.
fn bent<T: Real>(u: T, law: Option<SpringLaw>) -> T {
    let near = u.value().abs() <= NEARLY_CUBIC;
    let square = u * u;
    match law {
        // By their series where the difference would lose its digits.
        None if near => u * square * (T::constant(1.0 / 3.0) - square * T::constant(2.0 / 15.0)),
        None => u - num_dual::DualNum::tanh(&u),
        Some(SpringLaw::Cubic) if near => u * square * (T::one() - square * T::constant(3.0)),
        Some(SpringLaw::Cubic) => u - root_of_cubic(u),
        Some(SpringLaw::Knee) => over_corner(u - T::one()) - over_corner(-u - T::one()),
    }
}

/// The real `h` of `h + h^3 = u`.
fn root_of_cubic<T: Real>(u: T) -> T {
    let angle = num_dual::DualNum::asinh(&(u * T::constant(1.5 * 3f64.sqrt()))) / T::constant(3.0);
    num_dual::DualNum::sinh(&angle) * T::constant(2.0 / 3f64.sqrt())
}

/// `max(x, 0)` with a rounded corner.
fn over_corner<T: Real>(x: T) -> T {
    /// Corners beyond which the rounding is nothing (and its exponential too large or too small).
    const FAR: f64 = 36.0;
    let corners = x / T::constant(CORNER);
    if corners.value() > FAR {
        return x;
    }
    if corners.value() < -FAR {
        return T::zero();
    }
    num_dual::DualNum::ln_1p(&num_dual::DualNum::exp(&corners)) * T::constant(CORNER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soft_below_the_knee_and_straight_beyond() {
        for law in [None, Some(SpringLaw::Knee)] {
            let at = |torque: f64| beyond_straight(torque, 1000.0, law, Some(100.0));
            assert!((at(1000.0) - 1.0).abs() < 1e-15 && (at(-1000.0) + 1.0).abs() < 1e-15);
            // Ten knees: u - 1 beyond it, hardly anything below.
            assert!((at(500.0) - 4.0 / 9.0).abs() < 1e-3, "{}", at(500.0));
            assert!(at(50.0) < 0.01 && at(-50.0) > -0.01);
        }
    }

    #[test]
    fn a_cubic_spring_is_the_solution_of_its_equation() {
        // tau = k x + k3 x^3 by bisection, the bend beside the straight spring k.
        let (k, k3) = (4e5, 3e9);
        let twist = |torque: f64| {
            let (mut low, mut high) = (-1.0f64, 1.0);
            for _ in 0..200 {
                let x = 0.5 * (low + high);
                if k * x + k3 * x.powi(3) < torque { low = x } else { high = x }
            }
            0.5 * (low + high)
        };
        let knee_nm = k * (k / k3).sqrt();
        let (largest, bend) = (6000.0, |torque: f64| twist(torque) - torque / k);
        for torque in [-6000.0, -900.0, 150.0, 2500.0] {
            let share = beyond_straight(torque, largest, Some(SpringLaw::Cubic), Some(knee_nm));
            assert!((share - bend(torque) / bend(largest)).abs() < 1e-9, "{share} at {torque} Nm");
        }
    }

    #[test]
    fn a_knee_far_away_is_the_cubic_limit_and_the_ways_of_computing_meet() {
        for law in [None, Some(SpringLaw::Cubic)] {
            for torque in [-700.0, 3.0, 400.0, 1000.0f64] {
                let cubic = (torque / 1000.0).powi(3);
                assert!((beyond_straight(torque, 1000.0, law, Some(4e4)) - cubic).abs() < 2e-3);
                assert!((beyond_straight(torque, 1000.0, law, None) - cubic).abs() < 1e-15);
            }
            let (below, above) = (bent(NEARLY_CUBIC * 0.999_999, law), bent(NEARLY_CUBIC * 1.000_001, law));
            assert!((above / below - 1.0).abs() < 1e-5, "{below} {above}");
        }
        // A sharp knee that no torque reaches bends nothing and stays finite.
        let unreached = beyond_straight(1000.0, 1000.0, Some(SpringLaw::Knee), Some(5000.0));
        assert!(unreached.abs() < 1e-3, "{unreached}");
    }
}

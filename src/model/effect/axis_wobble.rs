//! The joint's axis tilts as the joint turns: run-out of its bearing, an oval race.
//!
//! `R = exp([e_x, e_y, 0])` before the joint's turn, in the frame in which it turns about z and which does not turn
//! with it: `e_x = S_x sin(k a) + C_x cos(k a)`, `e_y` alike, a = the actuator's own angle. k = [`Location::order`],
//! twice a turn where a location names none: a tilt that stands still or turns with the joint once a turn is a twist of
//! the rows before and after, which is geometry.
//!
//! Signature: the arm leaves the plane in which the joint moves it, along the axis and not along the turn: no error of
//! a joint angle does that. Size: 5 to 50 urad (bearing run-out 10 um over 0.3 m).
//! Easily mistaken for: an anisotropic base (joint 1), a periodic angle error of the next joint.

use nalgebra::Vector3;
use num_dual::DualNum;

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct AxisWobble;

/// The order of a location that names none.
const USUAL_ORDER: f64 = 2.0;

const fn tilt(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "rad", typical: 3e-5, plausible: (-2e-3, 2e-3) }
}

static META: EffectMeta = EffectMeta {
    id: "axis_wobble",
    title: "joint axis tilts as it turns",
    parameters: &[tilt("sine_x"), tilt("cosine_x"), tilt("sine_y"), tilt("cosine_y")],
    place: Place::JointOwnOrder,
    needs: Needs::NOTHING,
    signature: "movement along the joint's own axis that repeats twice a turn or more often",
    mistaken_for: &["base_compliance", "joint_periodic"],
    follows: Follows::Several,
    told_apart_by: "turn that joint alone through its whole range in 72 stops, the arm stretched out, then folded",
};

impl Physics for AxisWobble {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(joint), [sine_x, cosine_x, sine_y, cosine_y]) = (at.joint_index(), parameters) {
            let order = T::constant(at.order.unwrap_or(USUAL_ORDER));
            let (sin, cos) = DualNum::sin_cos(&(context.actuators_rad[joint] * order));
            let tilt = Vector3::new(*sine_x * sin + *cosine_x * cos, *sine_y * sin + *cosine_y * cos, T::zero());
            response.tilt_axis(joint, tilt);
        }
    }
}

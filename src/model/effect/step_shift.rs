//! A frame moved once: the tracker was bumped, the reflector reseated, the tool slipped.
//!
//! The displacement holds from [`Location::at_s`] on: of the robot base against the tracker (in the base frame), or of
//! the measured point against the flange (in the tool frame).
//!
//! Signature: a jump at one moment, constant in the frame that moved before and after it. Size: 0.02 mm (reflector
//! reseated) to millimetres (collision).
//! Easily mistaken for: drift, thermal growth, a cluster of outliers.

use crate::geometry::real::Real;
use crate::model::parameters::Displacement;

use super::{CONTROL_POSES, Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct StepShift;

const fn shift(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "m", typical: 2e-4, plausible: (-2e-2, 2e-2) }
}

const fn turn(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "rad", typical: 1e-4, plausible: (-1e-2, 1e-2) }
}

static META: EffectMeta = EffectMeta {
    id: "step_shift",
    title: "something moved once",
    parameters: &[shift("x"), shift("y"), shift("z"), turn("about_x"), turn("about_y"), turn("about_z")],
    place: Place::FrameMoment,
    needs: Needs { time: true, ..Needs::NOTHING },
    signature: "a jump at one moment, constant in one frame before and after it",
    mistaken_for: &["drift", "thermal_growth"],
    follows: Follows::Time,
    told_apart_by: CONTROL_POSES,
};

impl Physics for StepShift {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(frame), Some(at_s), Some(time_s)) = (at.frame, at.at_s, context.conditions.time_s) else {
            return;
        };
        if let (true, Ok(displacement)) = (time_s >= at_s, Displacement::<T>::try_from(parameters)) {
            response.move_frame(frame, &displacement);
        }
    }
}

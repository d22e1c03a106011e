//! A frame moves slowly during the recording: steadily, or ever more slowly until it stands.
//!
//! Displacement `t r` with six rates r: of the whole robot base against the tracker (in the base frame), or of the measured
//! point against the flange (in the tool frame). What warms up levels off: with a time constant T ([`Location::reference`],
//! s) it is `T (1 - exp(-t/T)) r`, r the rates at the start (a body of one heat capacity). A tracker that drifts is a base
//! that drifts the other way.
//!
//! Signature: follows time and no joint; constant in the frame that moves. Size: 0.03 to 0.1 mm an hour for a warm
//! station, tenths of a millimetre in a tracker's first two hours (Leica AT960).
//! Easily mistaken for: thermal growth, where poses are not revisited; a step, where the recording is short.

use crate::geometry::real::Real;
use crate::model::parameters::Displacement;

use super::{CONTROL_POSES, Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct Drift;

/// 0.1 mm an hour, at most 20.
const fn rate(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "m/s", typical: 1e-4 / 3600.0, plausible: (-2e-2 / 3600.0, 2e-2 / 3600.0) }
}

/// 50 urad an hour, at most 10 mrad.
const fn turning(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "rad/s", typical: 5e-5 / 3600.0, plausible: (-1e-2 / 3600.0, 1e-2 / 3600.0) }
}

static META: EffectMeta = EffectMeta {
    id: "drift",
    title: "frame drifts in time",
    parameters: &[rate("x"), rate("y"), rate("z"), turning("about_x"), turning("about_y"), turning("about_z")],
    place: Place::Frame,
    needs: Needs { time: true, ..Needs::NOTHING },
    signature: "grows with time, steadily or until it levels off, the same for every joint position",
    mistaken_for: &["thermal_growth", "step_shift"],
    follows: Follows::Time,
    told_apart_by: CONTROL_POSES,
};

impl Physics for Drift {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(frame), Some(time_s)) = (at.frame, context.conditions.time_s) else {
            return;
        };
        if let Ok(rates) = Displacement::<T>::try_from(parameters) {
            let elapsed_s = match at.reference {
                Some(levelling_s) if levelling_s > 0.0 => levelling_s * -(-time_s / levelling_s).exp_m1(),
                _ => time_s,
            };
            let elapsed = T::constant(elapsed_s);
            response.move_frame(frame, &rates.map(|rate| rate * elapsed));
        }
    }
}

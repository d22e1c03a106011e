//! Foundation or pedestal tilts under the arm's overturning moment.
//!
//! `v = (c_x M_x, c_y M_y, 0)`, a rotation vector of the whole arm about the origin of the robot base, M = moment of
//! all weights about that origin, Nm, in the base. Equal values are a foundation alike in all directions.
//!
//! Signature: the whole arm tilts with the reach of its load; unequal values show twice a turn of joint 1. Size: 0.05
//! to 0.6 mrad under 30 kNm, 2e-9 to 2e-8 rad/Nm, a poor plinth 1e-7; small arms on tables 1e-6 and more.
//! Easily mistaken for: compliance of joint 2 (alike but for where the turn has its centre, where c_x = c_y), wobble of
//! axis 1. A reflector on the base separates them.

use nalgebra::Vector3;

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct BaseCompliance;

const fn about(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "rad/Nm", typical: 2e-8, plausible: (0.0, 2e-5) }
}

static META: EffectMeta = EffectMeta {
    id: "base_compliance",
    title: "foundation tilts under the arm",
    parameters: &[about("about_x"), about("about_y")],
    place: Place::Base,
    needs: Needs { gravity_model: true, ..Needs::NOTHING },
    signature: "the whole arm tilts about its foot in proportion to the overturning moment",
    mistaken_for: &["joint_compliance", "link_flexibility", "gravity_tilt", "axis_wobble"],
    follows: Follows::Several,
    told_apart_by: "put a reflector on the base and measure it with the arm stretched out in four directions",
};

impl Physics for BaseCompliance {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        if let (Some(true), [about_x, about_y]) = (at.base, parameters) {
            let statics = context.statics;
            let moment = statics.outboard[0].moment_about(&Vector3::zeros(), &statics.gravity_m_s2);
            let tilt = Vector3::new(*about_x * moment.x, *about_y * moment.y, T::zero());
            response.move_base(Vector3::zeros(), tilt);
        }
    }
}

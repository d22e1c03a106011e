//! What the flange carries is not what was declared.
//!
//! Mass `m + dm`, first moment in the flange `(m + dm) c + dM` with the declared mass m and centre c: dm is extra mass
//! at the declared centre, dM moves the centre by `dM / (m + dm)`. Torques are linear in all four. It reaches the pose
//! through whatever compliance the model has.
//!
//! A record that declares an empty flange on a robot that otherwise carries something has no payload to be wrong about.
//!
//! Signature: the levers of joint compliance, all joints at once; gone without payload; a centre that lies beside shows
//! where the wrist flips. Size: tens of kilograms on heavy arms (hoses, dress packs), a tenth of the payload.
//! Easily mistaken for: compliances in error together (only the product of compliance and mass shows with one payload),
//! a tilted gravity.

use nalgebra::Vector3;

use crate::geometry::real::Real;
use crate::model::statics::Load;

use super::{EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Setting};

/// See the module.
pub struct PayloadError;

const fn moment(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "kg m", typical: 5.0, plausible: (-500.0, 500.0) }
}

static META: EffectMeta = EffectMeta {
    id: "payload_error",
    title: "payload differs from the declared one",
    parameters: &[
        ParameterMeta { name: "mass", unit: "kg", typical: 30.0, plausible: (-1000.0, 1000.0) },
        moment("moment_x"),
        moment("moment_y"),
        moment("moment_z"),
    ],
    place: Place::Payload,
    needs: Needs { gravity_model: true, ..Needs::NOTHING },
    signature: "every soft joint gives way as to a further load at the flange",
    mistaken_for: &["joint_compliance", "gravity_tilt", "link_flexibility", "base_compliance"],
    follows: Follows::Several,
    told_apart_by: "15 poses twice, with the full payload and with none",
};

impl Physics for PayloadError {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn load<T: Real>(&self, at: &Location, parameters: &[T], setting: &Setting<'_, T>, load: &mut Load<T>) {
        let (Some(true), [mass, x, y, z]) = (at.payload, parameters) else {
            return;
        };
        let usual = &setting.robot.payload;
        let declared = setting.conditions.payload.as_ref().unwrap_or(usual);
        if declared.mass_kg == 0.0 && usual.mass_kg > 0.0 {
            return;
        }
        load.payload_kg += *mass;
        load.payload_moment_kg_m += declared.center_of_mass_m.map(T::constant) * *mass + Vector3::new(*x, *y, *z);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::conditions::Conditions;
    use crate::model::fixture;
    use crate::model::robot::{DOF, Mass};

    fn loaded(conditions: &Conditions) -> Load<f64> {
        let robot = fixture::looped_with_masses();
        let mut load = Load::declared(&robot, conditions.payload.as_ref());
        let setting = Setting { robot: &robot, conditions, actuators_rad: &[0.0; DOF] };
        let at = Location { payload: Some(true), ..Location::default() };
        PayloadError.load(&at, &[20.0, 3.0, 0.0, -1.0], &setting, &mut load);
        load
    }

    #[test]
    fn it_is_the_load_of_the_right_declaration() {
        let load = loaded(&Conditions::default());
        // 80 kg at (40, 20, 280) mm and 20 kg more there, then the moment.
        assert!((load.payload_kg - 100.0).abs() < 1e-12);
        let expected = Vector3::new(100.0 * 0.04 + 3.0, 100.0 * 0.02, 100.0 * 0.28 - 1.0) / 100.0;
        assert!((load.payload_com_m() - expected).norm() < 1e-12);
    }

    #[test]
    fn an_empty_flange_has_no_payload_error() {
        let load = loaded(&Conditions { payload: Some(Mass::NONE), ..Conditions::default() });
        assert_eq!(load.payload_kg, 0.0);
        assert_eq!(load.payload_moment_kg_m, Vector3::zeros());
    }
}

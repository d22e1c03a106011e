//! A link grows with its temperature.
//!
//! `shift = alpha (T - T0) (far - near)`: the far end of the link moves away from its own axis frame along the line
//! between the two (see [`Context::link_ends_m`]). T is the record's temperature, T0 = [`Location::reference`], 20 deg C
//! (ISO 1) where a location has none. Without a thermometer the time since the start stands in for it: the link is
//! taken to warm by [`WARM_UP_K`] as `1 - exp(-t / tau)`, and alpha then is the growth per kelvin of that guess.
//!
//! The rods of a parallelogram lie beside the arm and warm with it: the loop stays parallel.
//!
//! Signature: one length times a monotone function of temperature or time, none of the joint angles'. Size: 11e-6 /K
//! (iron and steel), 23e-6 (aluminium): 10 K on 2.5 m are 0.29 mm; tau 20 to 90 min.
//! Easily mistaken for: drift of base or tool where poses are not revisited, another link that points the same way.

use crate::geometry::real::Real;

use super::{CONTROL_POSES, Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct ThermalGrowth;

/// Temperature at which lengths hold where nothing else is said, deg C.
const USUAL_REFERENCE_C: f64 = 20.0;
/// Final warm-up that stands in for an unknown temperature, K.
const WARM_UP_K: f64 = 10.0;
/// Its time constant, s: three quarters of an hour, the middle of what gears and castings show.
const WARM_UP_S: f64 = 2700.0;

static META: EffectMeta = EffectMeta {
    id: "thermal_growth",
    title: "link grows as it warms",
    // Nothing that arms are made of grows by more than aluminium does; what a warm gear adds is allowed for.
    parameters: &[ParameterMeta { name: "expansion", unit: "1/K", typical: 1.2e-5, plausible: (0.0, 4e-5) }],
    place: Place::Link,
    needs: Needs { warmth: true, ..Needs::NOTHING },
    signature: "one length follows temperature or warm-up time",
    mistaken_for: &["drift", "step_shift"],
    follows: Follows::Warmth,
    told_apart_by: CONTROL_POSES,
};

impl Physics for ThermalGrowth {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(link), [expansion]) = (at.link_index(), parameters) else {
            return;
        };
        let conditions = context.conditions;
        let Some(warmer_k) = warmer_k(conditions.temperature_c, conditions.time_s, at.reference) else {
            return;
        };
        let (near, far) = context.link_ends_m(link);
        let longer = (far - near) * (*expansion * T::constant(warmer_k));
        context.move_far_end(link, &longer, &nalgebra::Vector3::zeros(), response);
    }
}

/// By how much the link is warmer than where its length holds, K.
fn warmer_k(temperature_c: Option<f64>, time_s: Option<f64>, reference_c: Option<f64>) -> Option<f64> {
    let by_temperature = temperature_c.map(|temperature| temperature - reference_c.unwrap_or(USUAL_REFERENCE_C));
    by_temperature.or_else(|| time_s.map(|time| -WARM_UP_K * (-time.max(0.0) / WARM_UP_S).exp_m1()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::arm::{ArmModel, EffectInstance};
    use crate::model::conditions::Conditions;
    use crate::model::fixture;
    use crate::model::robot::{Convention, DOF};

    const POSE: [f64; DOF] = [0.4, -0.3, 0.2, 1.1, -0.7, 2.0];

    #[test]
    fn a_warm_arm_is_a_longer_arm() {
        let rows = fixture::LOOPED;
        for convention in [Convention::Standard, Convention::Modified] {
            let mut model = ArmModel::controller(fixture::bare(convention, &rows));
            for link in 0..DOF {
                let location = Location { link: Some(link + 1), reference: Some(22.0), ..Location::default() };
                model.effects.push(EffectInstance { effect: &ThermalGrowth, location });
                model.parameters.effects.push(vec![1.2e-5]);
            }
            let conditions = Conditions { temperature_c: Some(32.0), ..Conditions::default() };
            let grown = model.prepared().at(&POSE, &conditions, None).expect("a pose").base_t_flange;
            // Every length of the table by 120 ppm: the same arm, scaled about its foot. A modified row's first `a`
            // is the base's, not a link's; here it is what the scaled arm must keep.
            let mut scaled = fixture::bare(convention, &rows);
            for (index, row) in scaled.joints.iter_mut().enumerate() {
                row.d_m *= 1.00012;
                if !(convention == Convention::Modified && index == 0) {
                    row.a_m *= 1.00012;
                }
            }
            let expected =
                ArmModel::controller(scaled).prepared().at(&POSE, &Conditions::default(), None).expect("a pose");
            // The grown length itself is what grows: second order, 0.03 um here beside half a millimetre.
            assert!((grown.translation - expected.base_t_flange.translation).norm() < 1e-7);
        }
    }

    #[test]
    fn without_a_thermometer_it_warms_towards_ten_kelvin() {
        assert_eq!(warmer_k(None, Some(0.0), None), Some(0.0));
        let late = warmer_k(None, Some(1e6), None).expect("a guess");
        assert!((late - WARM_UP_K).abs() < 1e-9);
        let at_tau = warmer_k(None, Some(WARM_UP_S), None).expect("a guess");
        assert!((at_tau - 6.321_205_588).abs() < 1e-6);
        assert_eq!(warmer_k(Some(25.0), Some(9.0), None), Some(5.0));
        assert_eq!(warmer_k(None, None, Some(22.0)), None);
    }
}

//! A spring or gas balancer between two points about a joint adds a torque that depends on the joint's own angle alone.
//!
//! The device between a point at radius `r` on the turning side and one at distance `h` on the standing side is
//! `s(a) = sqrt(r^2 + h^2 + 2 r h cos(a0 + a))` long; a spring of rate K and rest length s0 has the energy
//! `K (s - s0)^2 / 2` and adds the torque `-dU/da = K r h (1 - s0/s) sin(a0 + a)` (arXiv
//! 1311.6674). It loads the drive like gravity does, and shows in the pose only through the drive's compliance:
//! `d a = s_j (tau_gravity + tau_device)`.
//!
//! K, r, h, s0 and a0 cannot be told apart in a recording: over the range of a real joint the law is, to better than 2 %
//! of its swing, its first two harmonics and a constant, and the constant is a zero offset. So the parameters are
//! those harmonics, `tau = S1 sin a + C1 cos a + S2 sin 2a + C2 cos 2a`, Nm at the actuator: linear, zero for no device,
//! with a derivative there. They are identifiable as far as the joint's compliance is known or identified from
//! gravity beside them; on a joint that the model has stiff the device does nothing and has no derivative.
//!
//! Signature: an error of its joint that follows the joint's own angle and no payload. Size: 1 to 20 kNm on joint 2 of
//! a heavy arm (KR270: r = 185 mm, h = 696 mm, s0 = 458 mm).
//! Easily mistaken for: a periodic error of the same joint (the very same shape through a linear spring; only
//! stiffening, or both harmonics at once, speak for the device), a wrong mass of the link (first harmonic). What swings
//! more twice a turn than once is none: weight, which it balances, is a first harmonic.

use num_dual::DualNum;

use crate::geometry::real::Real;
use crate::model::statics::Load;

use super::{EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Setting};

/// See the module.
pub struct GravityCompensator;

const fn harmonic(name: &'static str) -> ParameterMeta {
    ParameterMeta { name, unit: "Nm", typical: 1e3, plausible: (-6e4, 6e4) }
}

static META: EffectMeta = EffectMeta {
    id: "gravity_compensator",
    title: "spring or gas balancer that the model does not have",
    parameters: &[harmonic("sine_1"), harmonic("cosine_1"), harmonic("sine_2"), harmonic("cosine_2")],
    place: Place::Joint,
    needs: Needs::NOTHING,
    signature: "a torque that follows the joint's own angle and no payload",
    mistaken_for: &["joint_periodic", "joint_compliance", "joint_stiffening", "gear_ratio"],
    follows: Follows::OwnPosition,
    told_apart_by: "turn that joint alone through its whole range in 72 stops, once with payload and once without",
};

impl Physics for GravityCompensator {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn load<T: Real>(&self, at: &Location, parameters: &[T], setting: &Setting<'_, T>, load: &mut Load<T>) {
        if let Some(joint) = at.joint_index() {
            load.device_torque_nm[joint] += torque_nm(parameters, setting.actuators_rad[joint]);
        }
    }

    /// Weight is a first harmonic. What swings more twice a turn than once balances nothing.
    fn is_believable(&self, parameters: &[f64], sigmas: &[f64]) -> bool {
        /// Standard uncertainties within which a swing may lie.
        const SLACK: f64 = 2.5;
        let swing = |pair: std::ops::Range<usize>| {
            let size = parameters[pair.clone()].iter().fold(0.0, |size: f64, value| size.hypot(*value));
            let slack = SLACK * sigmas[pair].iter().fold(0.0, |size: f64, sigma| size.hypot(*sigma));
            (size, slack)
        };
        let ((first, first_slack), (second, second_slack)) = (swing(0..2), swing(2..4));
        second - second_slack <= first + first_slack
    }
}

/// Sum of the harmonics, `[sine_1, cosine_1, sine_2, cosine_2, ...]`.
fn torque_nm<T: Real>(harmonics: &[T], angle_rad: T) -> T {
    let mut torque = T::zero();
    let mut order = T::zero();
    for pair in harmonics.chunks_exact(2) {
        order += T::one();
        let (sin, cos) = DualNum::sin_cos(&(angle_rad * order));
        torque += pair[0] * sin + pair[1] * cos;
    }
    torque
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// A spring beside joint 2 in the size of a KR270's.
    struct Spring {
        rate_n_m: f64,
        moving_m: f64,
        fixed_m: f64,
        rest_m: f64,
        angle_rad: f64,
    }

    impl Spring {
        fn energy_j(&self, angle_rad: f64) -> f64 {
            let (sin, cos) = (self.angle_rad + angle_rad).sin_cos();
            let length = (self.moving_m * cos + self.fixed_m).hypot(self.moving_m * sin);
            0.5 * self.rate_n_m * (length - self.rest_m).powi(2)
        }

        fn torque_nm(&self, angle_rad: f64) -> f64 {
            let step = 1e-5;
            (self.energy_j(angle_rad - step) - self.energy_j(angle_rad + step)) / (2.0 * step)
        }
    }

    #[test]
    fn two_harmonics_and_an_offset_are_the_spring() {
        let spring = Spring { rate_n_m: 5e4, moving_m: 0.185, fixed_m: 0.696, rest_m: 0.458, angle_rad: 0.3 };
        let angles: Vec<f64> = (0..=120).map(|degrees| f64::from(degrees - 55).to_radians()).collect();
        let truth = DVector::from_iterator(angles.len(), angles.iter().map(|&angle| spring.torque_nm(angle)));
        let columns = DMatrix::from_fn(angles.len(), 5, |row, column| {
            let mut unit = [0.0; 4];
            match unit.get_mut(column) {
                Some(one) => {
                    *one = 1.0;
                    torque_nm(&unit, angles[row])
                }
                None => 1.0,
            }
        });
        let solved = columns.clone().svd(true, true).solve(&truth, 1e-12).expect("a solution");
        let rest = &truth - columns * solved;
        let swing = truth.max() - truth.min();
        assert!(swing > 1e3, "a spring worth the name: {swing} Nm");
        assert!(rest.amax() < 0.02 * swing, "{} of {swing} Nm", rest.amax());
    }
}

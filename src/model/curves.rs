//! Joint errors as sums of smooth functions of one variable: what gears, encoders, friction and loads leave.
//!
//! A generic function of six joints needs more poses than anyone measures. A transmission does not know the other
//! joints: its error is a function of its own angle, its own load, its own sense of approach. Such functions are
//! learned from a few hundred poses, down to waves of some degrees.

use serde::{Deserialize, Serialize};

use crate::geometry::real::Real;

use super::conditions::Conditions;
use super::robot::DOF;

/// The variable of a curve. Joints count from one, as in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Variable {
    /// Actuator angle, rad.
    Angle(usize),
    /// Sum of two actuator angles, rad.
    Sum(usize, usize),
    /// Load torque of an actuator, Nm.
    Torque(usize),
}

/// A function of one variable that turns one actuator: a cubic B-spline on equal steps.
///
/// Its value is `sum_k c_k B((x - start)/step - k)` with the cardinal cubic B-spline (Schoenberg 1946; Unser 1999). Beyond
/// its ends all coefficients count as zero: two steps outside, the curve has gone to nothing, twice differentiable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Curve {
    /// The actuator that it turns, from one.
    pub turns: usize,
    /// What it is a function of.
    pub along: Variable,
    /// The joint whose sense of approach (-1, 0, 1) it is multiplied with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sense_of: Option<usize>,
    /// Where the first coefficient stands, in the unit of the variable.
    pub start: f64,
    /// Distance of the coefficients.
    pub step: f64,
    /// The coefficients, rad.
    pub coefficients_rad: Vec<f64>,
    /// Standard uncertainty of the curve on equal steps from its first to its last coefficient, rad.
    #[serde(default)]
    pub sigma_rad: Vec<f64>,
}

/// Curves that add up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointCurves {
    /// The curves, in any order.
    pub curves: Vec<Curve>,
}

/// What is wrong with a curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("curve {curve}: {what}")]
pub struct CurveError {
    /// Which, from one.
    pub curve: usize,
    /// What about it.
    pub what: &'static str,
}

impl Variable {
    /// The value in a pose.
    pub fn value<T: Real>(self, actuators_rad: &[T; DOF], actuator_torque_nm: &[T; DOF]) -> T {
        let joint = |from_one: usize| from_one.clamp(1, DOF) - 1;
        match self {
            Variable::Angle(at) => actuators_rad[joint(at)],
            Variable::Sum(one, other) => actuators_rad[joint(one)] + actuators_rad[joint(other)],
            Variable::Torque(at) => actuator_torque_nm[joint(at)],
        }
    }

    fn joints_exist(self) -> bool {
        let exists = |joint: usize| (1..=DOF).contains(&joint);
        match self {
            Variable::Angle(joint) | Variable::Torque(joint) => exists(joint),
            Variable::Sum(one, other) => exists(one) && exists(other),
        }
    }
}

impl Curve {
    /// The curve at `x`, without the sense of approach, rad.
    pub fn value<T: Real>(&self, x: T) -> T {
        let place = (x - T::constant(self.start)) / T::constant(self.step);
        let cell = place.value().floor();
        let count = self.coefficients_rad.len() as f64;
        // Written so that no number is outside too.
        if !(cell >= -2.0 && cell < count + 1.0) {
            return T::zero();
        }
        let coefficient = |offset: f64| {
            let index = cell + offset;
            // Negative indices saturate at zero when cast.
            let known = if index < 0.0 { None } else { self.coefficients_rad.get(index as usize) };
            T::constant(known.copied().unwrap_or(0.0))
        };
        let t = place - T::constant(cell);
        let s = T::one() - t;
        let sixth = T::constant(1.0 / 6.0);
        let (four, three) = (T::constant(4.0), T::constant(3.0));
        let two = T::constant(2.0);
        // Weights of the cubic B-spline at offsets -1, 0, 1, 2.
        let middle = |u: T| four - u * u * (two - u) * three;
        (coefficient(-1.0) * s * s * s
            + coefficient(0.0) * middle(t)
            + coefficient(1.0) * middle(s)
            + coefficient(2.0) * t * t * t)
            * sixth
    }

    /// Standard uncertainty of the curve at `x`, rad; the value at the nearer end beyond the ends.
    pub fn sigma(&self, x: f64) -> f64 {
        let (Some(&first), Some(&last)) = (self.sigma_rad.first(), self.sigma_rad.last()) else { return 0.0 };
        let length = self.step * (self.coefficients_rad.len().max(2) - 1) as f64;
        let place = (x - self.start) / length * (self.sigma_rad.len() - 1) as f64;
        if place.is_nan() || place <= 0.0 {
            return first;
        }
        let cell = place.floor() as usize;
        match (self.sigma_rad.get(cell), self.sigma_rad.get(cell.saturating_add(1))) {
            (Some(&left), Some(&right)) => left + (right - left) * place.fract(),
            _ => last,
        }
    }
}

impl JointCurves {
    /// Checks that the numbers make sense.
    ///
    /// # Errors
    /// [`CurveError`] with the first curve that does not.
    pub fn check(&self) -> Result<(), CurveError> {
        for (index, curve) in self.curves.iter().enumerate() {
            let wrong = |what| Err(CurveError { curve: index + 1, what });
            let joints = [Some(curve.turns), curve.sense_of];
            if !joints.into_iter().flatten().all(|joint| (1..=DOF).contains(&joint)) || !curve.along.joints_exist() {
                return wrong("names a joint that the arm does not have; joints are 1 to 6");
            }
            let finite = curve.start.is_finite() && curve.step.is_finite();
            if !finite || curve.step <= 0.0 || curve.coefficients_rad.is_empty() {
                return wrong("needs a finite start, a positive step and at least one coefficient");
            }
            if !curve.coefficients_rad.iter().all(|number| number.is_finite()) {
                return wrong("has a coefficient that is not finite");
            }
            if !curve.sigma_rad.iter().all(|&number| number >= 0.0 && number.is_finite()) {
                return wrong("has an uncertainty that is not a finite positive number");
            }
        }
        Ok(())
    }

    /// What each actuator is turned by, rad.
    pub fn outputs<T: Real>(
        &self,
        actuators_rad: &[T; DOF],
        actuator_torque_nm: &[T; DOF],
        conditions: &Conditions,
    ) -> [T; DOF] {
        let mut out = [T::zero(); DOF];
        for curve in &self.curves {
            let sense = sense(curve, conditions);
            if sense != 0.0 {
                let value = curve.value(curve.along.value(actuators_rad, actuator_torque_nm));
                out[curve.turns.clamp(1, DOF) - 1] += value * T::constant(sense);
            }
        }
        out
    }

    /// Standard uncertainty of what each actuator is turned by, rad: the curves' own, taken as independent.
    pub fn sigma_rad(
        &self,
        actuators_rad: &[f64; DOF],
        actuator_torque_nm: &[f64; DOF],
        conditions: &Conditions,
    ) -> [f64; DOF] {
        let mut squares = [0.0; DOF];
        for curve in &self.curves {
            let sigma = curve.sigma(curve.along.value(actuators_rad, actuator_torque_nm)) * sense(curve, conditions);
            squares[curve.turns.clamp(1, DOF) - 1] += sigma * sigma;
        }
        squares.map(f64::sqrt)
    }
}

fn sense(curve: &Curve, conditions: &Conditions) -> f64 {
    curve.sense_of.map_or(1.0, |joint| conditions.approach[joint.clamp(1, DOF) - 1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::real::{derivatives, seeded};

    /// The cardinal cubic B-spline by its textbook cases.
    fn b_spline(x: f64) -> f64 {
        let x = x.abs();
        if x < 1.0 {
            2.0 / 3.0 - x * x + x * x * x / 2.0
        } else if x < 2.0 {
            (2.0 - x).powi(3) / 6.0
        } else {
            0.0
        }
    }

    fn curve() -> Curve {
        Curve {
            turns: 2,
            along: Variable::Sum(2, 3),
            sense_of: None,
            start: -0.4,
            step: 0.2,
            coefficients_rad: vec![1.0, -2.0, 0.5, 3.0],
            sigma_rad: vec![0.1, 0.3],
        }
    }

    #[test]
    fn the_value_is_the_sum_of_splines_and_nothing_two_steps_outside() {
        let curve = curve();
        for index in -60..60 {
            let x = f64::from(index) * 0.0313;
            let place = (x + 0.4) / 0.2;
            let expected: f64 =
                curve.coefficients_rad.iter().enumerate().map(|(k, c)| c * b_spline(place - k as f64)).sum();
            assert!((curve.value(x) - expected).abs() < 1e-14, "{x}: {} {expected}", curve.value(x));
        }
        assert_eq!(curve.value(-0.81), 0.0);
        assert_eq!(curve.value(0.61), 0.0);
        assert_eq!(curve.value(f64::NAN), 0.0);
        assert_eq!(curve.value(1e300), 0.0);
    }

    #[test]
    fn derivatives_are_those_of_the_curve() {
        let curve = curve();
        let slope = derivatives(&curve.value(seeded(0.05, 0)))[0];
        let expected = (curve.value(0.05 + 1e-6) - curve.value(0.05 - 1e-6)) / 2e-6;
        assert!((slope - expected).abs() < 1e-7);
    }

    #[test]
    fn curves_turn_their_actuator_by_the_sense_of_approach() {
        let mut curve = curve();
        let plain = JointCurves { curves: vec![curve.clone()] };
        curve.sense_of = Some(4);
        let sensed = JointCurves { curves: vec![curve] };
        let angles = [0.0, 0.1, -0.2, 0.0, 0.0, 0.0];
        let mut conditions = Conditions::default();
        let turned = plain.outputs(&angles, &[0.0; DOF], &conditions);
        assert_eq!(turned[1], plain.curves[0].value(-0.1));
        assert_eq!(turned[2], 0.0);
        assert_eq!(sensed.outputs(&angles, &[0.0; DOF], &conditions), [0.0; DOF]);
        conditions.approach[3] = -1.0;
        assert_eq!(sensed.outputs(&angles, &[0.0; DOF], &conditions)[1], -turned[1]);
        // 0.3 of 0.6 along: half way between the two uncertainties.
        assert!((plain.sigma_rad(&angles, &[0.0; DOF], &conditions)[1] - 0.2).abs() < 1e-12);
    }

    #[test]
    fn nonsense_is_told() {
        for spoil in [
            (|c: &mut Curve| c.turns = 7) as fn(&mut Curve),
            |c| c.along = Variable::Angle(0),
            |c| c.step = 0.0,
            |c| c.coefficients_rad[1] = f64::NAN,
            |c| c.sigma_rad[0] = -1.0,
        ] {
            let mut curves = JointCurves { curves: vec![curve(), curve()] };
            assert_eq!(curves.check(), Ok(()));
            spoil(&mut curves.curves[1]);
            assert_eq!(curves.check().expect_err("nonsense").curve, 2);
        }
    }
}

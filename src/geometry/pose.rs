//! Rigid motions. `base_T_flange` maps flange coordinates to base coordinates: `p_base = base_T_flange * p_flange`.

use nalgebra::{Matrix3, Vector3};

use super::real::Real;

/// A position and an orientation of one frame in another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T: Real = f64> {
    /// The orientation: columns are the axes of the inner frame in the outer one.
    pub rotation: Matrix3<T>,
    /// The origin of the inner frame in the outer one, metres.
    pub translation: Vector3<T>,
}

impl<T: Real> Pose<T> {
    /// The pose of a frame in itself.
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), translation: Vector3::zeros() }
    }

    /// A shift without a turn, metres.
    pub fn from_translation(translation: Vector3<T>) -> Self {
        Self { rotation: Matrix3::identity(), translation }
    }

    /// A turn without a shift.
    pub fn from_rotation(rotation: Matrix3<T>) -> Self {
        Self { rotation, translation: Vector3::zeros() }
    }

    /// The pose of the outer frame in the inner one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, translation: -rotated(&rotation, &self.translation) }
    }

    /// A point of the inner frame, in coordinates of the outer one.
    pub fn transform_point(&self, point: &Vector3<T>) -> Vector3<T> {
        rotated(&self.rotation, point) + self.translation
    }

    /// A pose of dual or plain numbers from plain ones.
    pub fn constant(pose: &Pose<f64>) -> Self {
        Self { rotation: pose.rotation.map(T::constant), translation: pose.translation.map(T::constant) }
    }
}

impl<T: Real> std::ops::Mul for Pose<T> {
    type Output = Pose<T>;

    fn mul(self, inner: Pose<T>) -> Pose<T> {
        Pose {
            rotation: composed(&self.rotation, &inner.rotation),
            translation: self.transform_point(&inner.translation),
        }
    }
}

/// `rotation * vector`, written out: the general product of nalgebra is a call for each column, and a model is made of these.
pub fn rotated<T: Real>(rotation: &Matrix3<T>, vector: &Vector3<T>) -> Vector3<T> {
    let row = |i: usize| rotation[(i, 0)] * vector.x + rotation[(i, 1)] * vector.y + rotation[(i, 2)] * vector.z;
    Vector3::new(row(0), row(1), row(2))
}

/// `outer * inner`, written out as [`rotated`] is.
pub fn composed<T: Real>(outer: &Matrix3<T>, inner: &Matrix3<T>) -> Matrix3<T> {
    let column = |j: usize| rotated(outer, &inner.column(j).clone_owned());
    Matrix3::from_columns(&[column(0), column(1), column(2)])
}

/// A turn about the x axis by `angle` radians.
pub fn rotation_x<T: Real>(angle: T) -> Matrix3<T> {
    let (sin, cos) = num_dual::DualNum::sin_cos(&angle);
    let (zero, one) = (T::zero(), T::one());
    Matrix3::new(one, zero, zero, zero, cos, -sin, zero, sin, cos)
}

/// A turn about the y axis by `angle` radians.
pub fn rotation_y<T: Real>(angle: T) -> Matrix3<T> {
    let (sin, cos) = num_dual::DualNum::sin_cos(&angle);
    let (zero, one) = (T::zero(), T::one());
    Matrix3::new(cos, zero, sin, zero, one, zero, -sin, zero, cos)
}

/// A turn about the z axis by `angle` radians.
pub fn rotation_z<T: Real>(angle: T) -> Matrix3<T> {
    let (sin, cos) = num_dual::DualNum::sin_cos(&angle);
    let (zero, one) = (T::zero(), T::one());
    Matrix3::new(cos, -sin, zero, sin, cos, zero, zero, zero, one)
}

/// The matrix of the cross product: `skew(a) * b = a x b`.
pub fn skew<T: Real>(v: &Vector3<T>) -> Matrix3<T> {
    let zero = T::zero();
    Matrix3::new(zero, -v.z, v.y, v.z, zero, -v.x, -v.y, v.x, zero)
}

/// The turn by the rotation vector `v` (axis times angle in radians): Rodrigues' formula.
///
/// Below 1e-4 rad the series to fourth order is used, which is exact to rounding there and has derivatives at zero.
pub fn rotation_from_vector<T: Real>(v: &Vector3<T>) -> Matrix3<T> {
    let angle_squared = v.dot(v);
    let (sinc, cosc) = if angle_squared.value() < 1e-8 {
        (
            T::one() - angle_squared * T::constant(1.0 / 6.0)
                + angle_squared * angle_squared * T::constant(1.0 / 120.0),
            T::constant(0.5) - angle_squared * T::constant(1.0 / 24.0),
        )
    } else {
        let angle = num_dual::DualNum::sqrt(&angle_squared);
        let (sin, cos) = num_dual::DualNum::sin_cos(&angle);
        (sin / angle, (T::one() - cos) / angle_squared)
    };
    // `1 + sinc K + cosc K K` with `K K = v v' - v'v`.
    let (turn, part) = (v * sinc, v * cosc);
    let level = T::one() - angle_squared * cosc;
    Matrix3::new(
        part.x * v.x + level,
        part.x * v.y - turn.z,
        part.x * v.z + turn.y,
        part.y * v.x + turn.z,
        part.y * v.y + level,
        part.y * v.z - turn.x,
        part.z * v.x - turn.y,
        part.z * v.y + turn.x,
        part.z * v.z + level,
    )
}

/// The rotation vector (axis times angle, radians, angle at most pi) of a rotation matrix.
///
/// Through the quaternion, which stays accurate for small turns and for turns near pi alike.
pub fn vector_from_rotation(rotation: &Matrix3<f64>) -> Vector3<f64> {
    let [w, x, y, z] = super::orientation::quaternion_from_rotation(rotation);
    let (w, v) = if w < 0.0 { (-w, Vector3::new(-x, -y, -z)) } else { (w, Vector3::new(x, y, z)) };
    let sine = v.norm();
    if sine < 1e-12 { v * 2.0 } else { v * (2.0 * sine.atan2(w) / sine) }
}

/// Position difference in metres and rotation vector in radians that carry `from` to `to`, both in the outer frame.
pub fn pose_difference(to: &Pose, from: &Pose) -> (Vector3<f64>, Vector3<f64>) {
    (to.translation - from.translation, vector_from_rotation(&(to.rotation * from.rotation.transpose())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    #[test]
    fn composition_inverse_and_points_agree() {
        let a = Pose { rotation: rotation_z(0.3) * rotation_x(-1.1), translation: Vector3::new(0.1, 0.2, -0.3) };
        let b = Pose { rotation: rotation_y(0.7), translation: Vector3::new(-1.0, 0.0, 2.0) };
        let point = Vector3::new(0.4, -0.5, 0.6);
        let through = a.transform_point(&b.transform_point(&point));
        assert_abs_diff_eq!((a * b).transform_point(&point), through, epsilon = 1e-15);
        let unit = a * a.inverse();
        assert_abs_diff_eq!(unit.rotation, Matrix3::identity(), epsilon = 1e-15);
        assert_abs_diff_eq!(unit.translation, Vector3::zeros(), epsilon = 1e-15);
    }

    #[test]
    fn rotation_vectors_go_round() {
        for v in [
            Vector3::new(0.0, 0.0, 0.0),
            Vector3::new(1e-9, -2e-9, 1e-10),
            Vector3::new(5e-5, 5e-5, 0.0),
            Vector3::new(0.3, -0.2, 1.0),
            Vector3::new(3.1, 0.1, -0.1),
        ] {
            assert_abs_diff_eq!(vector_from_rotation(&rotation_from_vector(&v)), v, epsilon = 1e-12);
        }
    }
}

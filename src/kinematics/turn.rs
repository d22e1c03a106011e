//! Turns about an axis as pairs of cosine and sine, and the two subproblems that the closed forms are made of.
//!
//! The closed forms stay in pairs to the end: each angle costs one arc tangent and no sine. An angle that is found from
//! the frame left by the angles before it takes up their rounding, so that the pose stays exact where single angles are
//! badly determined (near a straight wrist).

use nalgebra::{Matrix3, Vector3};

/// A turn by an angle, as its cosine and sine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Cosine of the angle.
    pub cos: f64,
    /// Sine of the angle.
    pub sin: f64,
}

impl Turn {
    /// No turn.
    pub const NONE: Turn = Turn { cos: 1.0, sin: 0.0 };

    /// The turn by `angle_rad`.
    pub fn by(angle_rad: f64) -> Self {
        let (sin, cos) = angle_rad.sin_cos();
        Self { cos, sin }
    }

    /// The turn towards the direction (x, y); none when both vanish.
    pub fn toward(x: f64, y: f64) -> Self {
        let length = (x * x + y * y).sqrt();
        if length > 0.0 { Self { cos: x / length, sin: y / length } } else { Self::NONE }
    }

    /// Its angle, -pi to pi.
    pub fn angle_rad(self) -> f64 {
        self.sin.atan2(self.cos)
    }

    /// The turn the other way.
    #[must_use]
    pub fn back(self) -> Self {
        Self { cos: self.cos, sin: -self.sin }
    }

    /// This turn and then `other` about the same axis.
    #[must_use]
    pub fn then(self, other: Turn) -> Self {
        Self { cos: self.cos * other.cos - self.sin * other.sin, sin: self.sin * other.cos + self.cos * other.sin }
    }

    /// The same turn about an axis that points the other way when `sense` is -1.
    #[must_use]
    pub fn seen(self, sense: f64) -> Self {
        Self { cos: self.cos, sin: self.sin * sense }
    }

    /// `vector` turned about the unit vector `axis` (Rodrigues' formula).
    pub fn rotate(self, axis: &Vector3<f64>, vector: &Vector3<f64>) -> Vector3<f64> {
        let along = axis.dot(vector) * (1.0 - self.cos);
        vector * self.cos + axis.cross(vector) * self.sin + axis * along
    }

    /// The rotation matrix about the unit vector `axis`.
    pub fn matrix(self, axis: &Vector3<f64>) -> Matrix3<f64> {
        let [x, y, z] = [axis.x, axis.y, axis.z];
        let (c, s, v) = (self.cos, self.sin, 1.0 - self.cos);
        Matrix3::new(
            c + v * x * x,
            v * x * y - s * z,
            v * x * z + s * y,
            v * x * y + s * z,
            c + v * y * y,
            v * y * z - s * x,
            v * x * z - s * y,
            v * y * z + s * x,
            c + v * z * z,
        )
    }
}

/// The turn about `axis` that brings `from` nearest to `to` (Paden and Kahan's first subproblem, in the least-squares
/// form of Elias and Wen 2022, subproblem 1).
pub fn turn_between(axis: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> Turn {
    let across = axis.cross(from);
    let cos = from.dot(to) - axis.dot(from) * axis.dot(to);
    Turn::toward(cos, across.dot(to))
}

/// Solutions of `plane . (R(axis, -angle) vector) = height` for the angle (Elias and Wen 2022, subproblem 4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Circle {
    /// Two turns; equal where the circle only touches.
    Two([Turn; 2]),
    /// Every turn solves it, or the vector is so near to the axis that rounding decides.
    Free,
    /// None: the vector stays this far below the height, in the unit of `vector`.
    Short(f64),
}

/// The part of [`Circle`]'s problem that does not depend on the vector.
#[derive(Clone, Copy, Debug)]
pub struct CircleFrame {
    axis: Vector3<f64>,
    first: Vector3<f64>,
    second: Vector3<f64>,
    along: f64,
    across: f64,
}

impl CircleFrame {
    /// For turns about `axis` and heights along `plane` (unit vectors); `None` when the two are parallel.
    pub fn new(axis: Vector3<f64>, plane: Vector3<f64>) -> Option<Self> {
        let along = axis.dot(&plane);
        let flat = plane - axis * along;
        let across = flat.norm();
        if across < 1e-3 {
            return None;
        }
        let first = flat / across;
        Some(Self { axis, first, second: axis.cross(&first), along, across })
    }

    /// The two coordinates of `vector` across the axis.
    pub fn across(&self, vector: &Vector3<f64>) -> (f64, f64) {
        (self.first.dot(vector), self.second.dot(vector))
    }

    /// Solves for the turn. Vectors nearer to the axis than `free_below` leave it free; a height out of reach by less
    /// than `slack` counts as touched.
    pub fn solve(&self, vector: &Vector3<f64>, height: f64, free_below: f64, slack: f64) -> Circle {
        let (x, y) = self.across(vector);
        let wanted = (height - self.along * self.axis.dot(vector)) / self.across;
        let squared = x * x + y * y;
        let radius = squared.sqrt();
        if radius < free_below && wanted.abs() < free_below {
            return Circle::Free;
        }
        let over = wanted.abs() - radius;
        if over > slack || radius == 0.0 {
            return Circle::Short(over * self.across);
        }
        let wanted = wanted.clamp(-radius, radius);
        let rest = (squared - wanted * wanted).max(0.0).sqrt();
        Circle::Two([
            Turn { cos: (x * wanted - y * rest) / squared, sin: (y * wanted + x * rest) / squared },
            Turn { cos: (x * wanted + y * rest) / squared, sin: (y * wanted - x * rest) / squared },
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::pose::rotation_from_vector;

    #[test]
    fn turns_are_the_rotations_of_their_vectors() {
        let axis = Vector3::new(0.6, -0.64, 0.48);
        let axis = axis / axis.norm();
        let vector = Vector3::new(0.3, 2.0, -1.1);
        let matrix = rotation_from_vector(&(axis * 0.8));
        assert!((Turn::by(0.8).rotate(&axis, &vector) - matrix * vector).norm() < 1e-15);
        assert!((Turn::by(0.8).matrix(&axis) - matrix).norm() < 1e-15);
        assert!((Turn::by(0.8).then(Turn::by(-1.1)).angle_rad() + 0.3).abs() < 1e-15);
        assert!((turn_between(&axis, &vector, &(matrix * vector)).angle_rad() - 0.8).abs() < 1e-15);
    }

    #[test]
    fn both_turns_reach_the_height_and_none_is_said_to_fall_short() {
        let axis = Vector3::new(0.0, 0.6, 0.8);
        let plane = Vector3::new(0.8, 0.6, 0.0);
        let frame = CircleFrame::new(axis, plane).expect("axes that cross");
        let vector = Vector3::new(1.0, -0.2, 0.5);
        let Circle::Two(turns) = frame.solve(&vector, 0.3, 1e-9, 1e-12) else { panic!("two turns") };
        for turn in turns {
            assert!((plane.dot(&turn.back().rotate(&axis, &vector)) - 0.3).abs() < 1e-15);
        }
        assert!((turns[0].angle_rad() - turns[1].angle_rad()).abs() > 0.1);
        let Circle::Short(by) = frame.solve(&vector, 3.0, 1e-9, 1e-12) else { panic!("too high") };
        let highest = (0..3600).map(|step| plane.dot(&Turn::by(f64::from(step) / 572.9).rotate(&axis, &vector)));
        assert!((by - (3.0 - highest.fold(f64::MIN, f64::max))).abs() < 1e-5);
        assert_eq!(frame.solve(&(axis * 1e-12), 0.0, 1e-9, 1e-12), Circle::Free);
    }
}

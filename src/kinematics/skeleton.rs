//! The axes of the arm at row angles zero: what kind of arm it is follows from them alone.

use nalgebra::Vector3;

use crate::geometry::pose::Pose;
use crate::model::chain::{Axis, Chain};
use crate::model::robot::DOF;

/// Axes and flange at row angles zero, in the base.
#[derive(Clone, Copy, Debug)]
pub struct Skeleton {
    /// A point on each axis, m.
    pub points: [Vector3<f64>; DOF],
    /// The direction of each axis, unit length.
    pub directions: [Vector3<f64>; DOF],
    /// `base_T_flange`.
    pub flange: Pose,
    /// The point on axis 5 that is nearest to axis 6: the wrist centre, m.
    pub wrist_center: Vector3<f64>,
    /// Sum of the distances between the axes: a length that the arm cannot exceed, m.
    pub size_m: f64,
}

impl Skeleton {
    /// From the chain at row angles zero.
    pub fn of(chain: &Chain<f64>) -> Self {
        let points = chain.axes.map(|axis| axis.origin);
        let directions = chain.axes.map(|axis| axis.direction);
        let flange = chain.flange();
        let ends = points.iter().skip(1).copied().chain([flange.translation]);
        let size_m = points.iter().zip(ends).map(|(point, next)| (next - point).norm()).sum();
        let wrist_center = nearest_point(&chain.axes[4], &chain.axes[5]);
        Self { points, directions, flange, wrist_center, size_m }
    }

    /// Distance of the wrist centre from an axis, m.
    pub fn center_from_axis(&self, joint: usize) -> f64 {
        self.directions[joint].cross(&(self.wrist_center - self.points[joint])).norm()
    }

    /// Sine of the angle between two axes.
    pub fn crossing_sin(&self, joint: usize, other: usize) -> f64 {
        self.directions[joint].cross(&self.directions[other]).norm()
    }

    /// +1 when axis `joint` points as axis 2 does, -1 when it points the other way.
    pub fn sense(&self, joint: usize) -> f64 {
        1.0f64.copysign(self.directions[1].dot(&self.directions[joint]))
    }
}

/// The point on `axis` nearest to `other`; its origin when they are parallel.
fn nearest_point(axis: &Axis<f64>, other: &Axis<f64>) -> Vector3<f64> {
    let between = other.origin - axis.origin;
    let along = axis.direction.dot(&other.direction);
    let square = 1.0 - along * along;
    if square < 1e-9 {
        return axis.origin;
    }
    let distance = (between.dot(&axis.direction) - along * between.dot(&other.direction)) / square;
    axis.origin + axis.direction * distance
}

//! Two links in a plane: what the shoulder and the elbow do once axis 1 is known.

use nalgebra::{Vector2, Vector3};

use super::turn::Turn;

/// The plane across axis 2 with shoulder, elbow and the point that they carry, at row angles zero.
#[derive(Clone, Copy, Debug)]
pub struct Planar {
    /// A point on axis 2, m, at row angles zero.
    pub shoulder: Vector3<f64>,
    /// Along the lower arm at row angles zero, and across it.
    first: Vector3<f64>,
    second: Vector3<f64>,
    lower_m: f64,
    upper_m: f64,
    /// The turn from the lower to the upper arm at row angles zero.
    bend: Turn,
    /// +1 when axis 3 points as axis 2 does, -1 when it points the other way.
    pub third_sense: f64,
}

/// One way to reach a point in the plane.
#[derive(Clone, Copy, Debug)]
pub struct PlanarSolution {
    /// Turn of row 2.
    pub second: Turn,
    /// Turn of row 3.
    pub third: Turn,
    /// Sine of the bend about axis 2 between lower and upper arm: zero when stretched or folded.
    pub bend_sin: f64,
}

impl Planar {
    /// The plane across the unit vector `axis`; `None` when a link has no length.
    pub fn new(
        axis: &Vector3<f64>,
        third_sense: f64,
        shoulder: Vector3<f64>,
        elbow: &Vector3<f64>,
        carried: &Vector3<f64>,
    ) -> Option<Self> {
        let lower = elbow - shoulder;
        let lower = lower - axis * axis.dot(&lower);
        let lower_m = lower.norm();
        if lower_m < 1e-6 {
            return None;
        }
        let first = lower / lower_m;
        let second = axis.cross(&first);
        let upper = carried - elbow;
        let upper = Vector2::new(first.dot(&upper), second.dot(&upper));
        let upper_m = upper.norm();
        let bend = Turn::toward(upper.x, upper.y);
        let plane = Self { shoulder, first, second, lower_m, upper_m, bend, third_sense };
        (upper_m > 1e-6).then_some(plane)
    }

    /// Coordinates of a point in the plane, from the shoulder, m.
    pub fn coordinates(&self, point: &Vector3<f64>) -> Vector2<f64> {
        self.components(&(point - self.shoulder))
    }

    /// Components of a vector in the plane.
    pub fn components(&self, vector: &Vector3<f64>) -> Vector2<f64> {
        Vector2::new(self.first.dot(vector), self.second.dot(vector))
    }

    /// The turn nearest to `turn` at which `center - R(turn) arm` (all in the plane) comes into reach; `None` when no
    /// turn brings it there.
    pub fn turn_into_reach(&self, center: &Vector2<f64>, arm: &Vector2<f64>, turn: Turn) -> Option<Turn> {
        let (distance, length) = (center.norm(), arm.norm());
        let product = 2.0 * distance * length;
        if product < 1e-12 {
            return None;
        }
        // The law of cosines: |center - R arm|^2 = distance^2 + length^2 - product cos(angle between the two).
        let cos_at = |reach: f64| (distance * distance + length * length - reach * reach) / product;
        let (least, most) = (cos_at(self.lower_m + self.upper_m), cos_at(self.lower_m - self.upper_m));
        if least > 1.0 || most < -1.0 {
            return None;
        }
        let aligned = Turn::toward(center.x, center.y).then(Turn::toward(arm.x, arm.y).back());
        let apart = turn.then(aligned.back());
        let cos = apart.cos.min(most.min(1.0)).max(least.max(-1.0));
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt().copysign(apart.sin);
        Some(aligned.then(Turn { cos, sin }))
    }

    /// The two ways to reach `point` (from the shoulder, m), or by how many metres it is out of reach.
    ///
    /// A point beyond reach by less than `slack_m` is reached with the arm stretched.
    pub fn solve(&self, point: &Vector2<f64>, slack_m: f64) -> Result<[PlanarSolution; 2], f64> {
        let squared = point.dot(point);
        let distance = squared.sqrt();
        let (lower, upper) = (self.lower_m, self.upper_m);
        let over = (distance - (lower + upper)).max((lower - upper).abs() - distance);
        if over > slack_m {
            return Err(over);
        }
        let cos = ((squared - lower * lower - upper * upper) / (2.0 * lower * upper)).clamp(-1.0, 1.0);
        let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
        let toward = Turn::toward(point.x, point.y);
        let solution = |sin: f64| {
            let opening = Turn::toward(lower + upper * cos, upper * sin);
            PlanarSolution {
                second: toward.then(opening.back()),
                third: Turn { cos, sin }.then(self.bend.back()).seen(self.third_sense),
                bend_sin: sin,
            }
        };
        Ok([solution(sin), solution(-sin)])
    }
}

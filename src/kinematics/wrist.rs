//! Three turns that make a given rotation: a wrist, or the forearm and wrist of an arm with three parallel axes.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};

use super::turn::{Circle, CircleFrame, Turn, turn_between};

/// Three axes in turn, unit vectors at row angles zero.
#[derive(Clone, Copy, Debug)]
pub struct Wrist {
    first: Vector3<f64>,
    middle: Vector3<f64>,
    last: Vector3<f64>,
    /// Any unit vector across `last`.
    mark: Vector3<f64>,
    frame: CircleFrame,
    middle_to_last: f64,
    /// Twice the middle angle of the straight wrist, where the axes are square: there the second way to make a
    /// rotation is the mirror image of the first.
    mirror_rad: Option<f64>,
}

/// The turn that is given where the rotation leaves one free.
#[derive(Clone, Copy, Debug)]
pub enum Pin {
    /// That about the first axis.
    First(Turn),
    /// That about the last axis.
    Last(Turn),
}

/// One way to make the rotation.
#[derive(Clone, Copy, Debug)]
pub struct WristSolution {
    /// Turn about the first axis.
    pub first: Turn,
    /// Angles about the three axes, rad.
    pub angles_rad: [f64; 3],
    /// Sine of the angle between first and last axis: zero when only their sum or difference counts.
    pub opening_sin: f64,
    /// What is missing, rad.
    pub misfit_rad: f64,
}

/// At most two ways to make a rotation.
pub type WristSolutions = [Option<WristSolution>; 2];

/// How much further than the axes allow the last axis may point away, rad: rounding only.
const SLACK: f64 = 1e-12;
/// Cosine up to which two axes are square: rounding only.
const SQUARE: f64 = 1e-14;

impl Wrist {
    /// A wrist with these axes; `None` when two neighbours are parallel.
    pub fn new(first: Vector3<f64>, middle: Vector3<f64>, last: Vector3<f64>) -> Option<Self> {
        let across = middle - last * last.dot(&middle);
        let width = across.norm();
        if width < 1e-3 {
            return None;
        }
        let frame = CircleFrame::new(first, middle)?;
        let middle_to_last = middle.dot(&last);
        let square = middle_to_last.abs() < SQUARE && first.dot(&middle).abs() < SQUARE;
        let mirror_rad = square.then(|| 2.0 * turn_between(&middle, &last, &first).angle_rad());
        Some(Self { first, middle, last, mark: across / width, frame, middle_to_last, mirror_rad })
    }

    /// The turns that make `rotation`. Openings below `straight_below_rad` count as straight: there `pin` decides.
    ///
    /// # Errors
    /// By how many radians the axes cannot be bent far enough; wrists with square axes reach every rotation.
    pub fn solve(&self, rotation: &Matrix3<f64>, pin: Pin, straight_below_rad: f64) -> Result<WristSolutions, f64> {
        let last = rotation * self.last;
        let (x, y) = self.frame.across(&last);
        let opening_sin = (x * x + y * y).sqrt();
        let solution = |first: Turn| Some(self.with_first(rotation, first, opening_sin));
        match self.frame.solve(&last, self.middle_to_last, straight_below_rad, SLACK) {
            Circle::Two([one, other]) => {
                let given = solution(one);
                let mirrored = given.zip(self.mirror_rad).map(|(given, mirror_rad)| given.mirrored(mirror_rad));
                Ok([given, mirrored.or_else(|| solution(other))])
            }
            Circle::Short(by) => Err(by),
            Circle::Free => Ok([solution(self.pinned_first(rotation, pin)), None]),
        }
    }

    fn pinned_first(&self, rotation: &Matrix3<f64>, pin: Pin) -> Turn {
        match pin {
            Pin::First(turn) => turn,
            Pin::Last(turn) => {
                let middle = rotation * turn.back().rotate(&self.last, &self.middle);
                turn_between(&self.first, &self.middle, &middle)
            }
        }
    }

    /// Middle and last turn for a given first one, each from what the turns before it leave.
    pub fn with_first(&self, rotation: &Matrix3<f64>, first: Turn, opening_sin: f64) -> WristSolution {
        let last = rotation * self.last;
        let left = first.back().rotate(&self.first, &last);
        let middle = turn_between(&self.middle, &self.last, &left);
        let marked = rotation * self.mark;
        let marked = middle.back().rotate(&self.middle, &first.back().rotate(&self.first, &marked));
        let turn = turn_between(&self.last, &self.mark, &marked);
        let misfit_rad = (middle.rotate(&self.middle, &self.last) - left).norm()
            + (turn.rotate(&self.last, &self.mark) - marked).norm();
        WristSolution { first, angles_rad: [first, middle, turn].map(Turn::angle_rad), opening_sin, misfit_rad }
    }
}

impl WristSolution {
    /// The other way to make the same rotation with square axes.
    fn mirrored(&self, mirror_rad: f64) -> Self {
        let [first, middle, last] = self.angles_rad;
        Self {
            first: Turn { cos: -self.first.cos, sin: -self.first.sin },
            angles_rad: [first + PI, mirror_rad - middle, last + PI].map(within_half_turn),
            ..*self
        }
    }
}

/// The same angle, -pi to pi; for angles of less than three half turns.
fn within_half_turn(angle_rad: f64) -> f64 {
    if angle_rad > PI {
        angle_rad - TAU
    } else if angle_rad < -PI {
        angle_rad + TAU
    } else {
        angle_rad
    }
}

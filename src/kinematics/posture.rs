//! Which way an arm stands in a pose: in front or behind, elbow up or down, wrist to one side or the other.
//!
//! The three answers are geometry, not a maker's bits; dialects translate. They agree with ABB's cfx (4 = `rear`,
//! 2 = `elbow_down`, 1 = `wrist_negative`), with FANUC's letters B and D, and with bits 0 (`rear`) and 2
//! (`wrist_negative`) of KUKA's S. Bit 1 of KUKA's S is set in the usual bend: where `elbow_down` is false.

use nalgebra::Vector3;

use crate::model::robot::{DOF, Robot};

use super::skeleton::Skeleton;
use super::turn::{Turn, turn_between};

/// How an arm stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Posture {
    /// The wrist centre lies behind axis 1, seen in the direction in which the arm reaches forward at this turn of
    /// axis 1. Forward is the side to which axis 2 is offset from axis 1; without offset, the side of the wrist
    /// centre at the controller's zero, or base x where it stands upright there.
    pub rear: bool,
    /// The elbow is bent against its usual sense: the wrist centre lies behind the lower arm. In the usual sense an
    /// upright lower arm has the wrist centre in front of it. Arms with three parallel axes: axis 4 stands for the
    /// wrist centre.
    pub elbow_down: bool,
    /// The controller's number of axis 5 lies below that of the straight wrist, by less than half a turn. Straight is
    /// where axes 4 and 6 (three parallel axes: 2 and 6) are parallel, at the number nearest to zero.
    pub wrist_negative: bool,
}

/// How far an arm stands from the three places where postures meet and the arm loses a freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Singularity {
    /// Distance of the wrist centre from the plane through axis 1 along axis 2, m.
    pub shoulder_m: f64,
    /// Sine of the bend between lower and upper arm.
    pub elbow_sin: f64,
    /// Sine of the angle between the axes that coincide at a straight wrist.
    pub wrist_sin: f64,
}

/// What postures are measured against.
#[derive(Clone, Copy, Debug)]
pub struct PostureFrame {
    /// Direction in which the arm reaches at row angle 1 zero.
    forward: Vector3<f64>,
    /// Sense of the usual bend of the elbow about axis 2.
    elbow_sense: f64,
    straight: Turn,
    wrist_sense: f64,
}

impl PostureFrame {
    /// Reads the frame off the arm.
    ///
    /// # Arguments
    /// * `theta_at_zero_rad` - row angles at the controller's zero
    /// * `center_at_zero_m` - the wrist centre there
    /// * `wrist_axis` - the axis that axis 6 is parallel to when the wrist is straight, from zero
    pub fn new(
        robot: &Robot,
        skeleton: &Skeleton,
        theta_at_zero_rad: &[f64; DOF],
        center_at_zero_m: &Vector3<f64>,
        wrist_axis: usize,
    ) -> Self {
        let [base, shoulder, ..] = skeleton.points;
        let [first, second, _, _, fifth, sixth] = skeleton.directions;
        let across = second.cross(&first);
        let across = if across.norm() > 1e-6 { across.normalize() } else { Vector3::x() };
        let back_to_row_zero = |vector: &Vector3<f64>| Turn::by(-theta_at_zero_rad[0]).rotate(&first, vector);
        let offset_m = across.dot(&(shoulder - base));
        let reach_m = across.dot(&back_to_row_zero(&(center_at_zero_m - base)));
        let base_x = across.dot(&back_to_row_zero(&Vector3::x()));
        let forward = if offset_m.abs() > 1e-6 {
            across * 1.0f64.copysign(offset_m)
        } else if reach_m.abs() > 1e-3 * skeleton.size_m {
            across * 1.0f64.copysign(reach_m)
        } else {
            across * 1.0f64.copysign(base_x)
        };
        let up = first * 1.0f64.copysign(first.z);
        let (straight, wrist_sense) = straight_wrist(robot, &fifth, &sixth, &skeleton.directions[wrist_axis]);
        Self { forward, elbow_sense: 1.0f64.copysign(up.cross(&forward).dot(&second)), straight, wrist_sense }
    }

    /// Posture and distance from the singular ones.
    ///
    /// # Arguments
    /// * `swung_m` - from axis 1 to the wrist centre, turned back to row angle zero
    /// * `bend_sin` - sine of the bend between lower and upper arm about axis 2
    /// * `fifth_rad` - row angle 5
    /// * `opening_sin` - sine of the angle between the axes that coincide at a straight wrist
    pub fn read(
        &self,
        swung_m: &Vector3<f64>,
        bend_sin: f64,
        fifth_rad: f64,
        opening_sin: f64,
    ) -> (Posture, Singularity) {
        let ahead_m = self.forward.dot(swung_m);
        let bent = Turn::by(fifth_rad).then(self.straight.back());
        let posture = Posture {
            rear: ahead_m < 0.0,
            elbow_down: bend_sin * self.elbow_sense < 0.0,
            wrist_negative: bent.sin * self.wrist_sense < 0.0,
        };
        let singularity =
            Singularity { shoulder_m: ahead_m.abs(), elbow_sin: bend_sin.abs(), wrist_sin: opening_sin.abs() };
        (posture, singularity)
    }
}

/// The row angle of the straight wrist whose number is nearest to zero (on a tie, to the middle of its limits), and
/// the sense of that number.
fn straight_wrist(robot: &Robot, fifth: &Vector3<f64>, sixth: &Vector3<f64>, anchor: &Vector3<f64>) -> (Turn, f64) {
    let joint = &robot.joints[4];
    let along = turn_between(fifth, sixth, anchor);
    let against = Turn { cos: -along.cos, sin: -along.sin };
    let number_at = |turn: Turn| turn.then(Turn::by(-joint.theta_rad)).seen(joint.sign);
    let from_zero = |turn: Turn| number_at(turn).angle_rad().abs();
    let middle = Turn::by(-0.5 * (joint.min_rad + joint.max_rad));
    let from_middle = |turn: Turn| number_at(turn).then(middle).angle_rad().abs();
    let difference = from_zero(along) - from_zero(against);
    let tie = difference.abs() < 1e-6;
    let chosen =
        if (tie && from_middle(along) <= from_middle(against)) || (!tie && difference < 0.0) { along } else { against };
    (chosen, joint.sign)
}

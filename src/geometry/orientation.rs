//! The ways in which robot languages write an orientation, and the way back.
//!
//! Angles here are radians; files mostly hold degrees, which their dialect converts at the edge.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::pose::{rotation_from_vector, rotation_x, rotation_y, rotation_z, vector_from_rotation};

/// How an orientation is written down. The listed order is the order of the numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrientationConvention {
    /// w, x, y, z (ABB).
    QuaternionWxyz,
    /// x, y, z, w.
    QuaternionXyzw,
    /// rx, ry, rz about fixed axes: R = Rz(rz) Ry(ry) Rx(rx) (Hyundai, FANUC, Yaskawa, this project's own files).
    FixedXyz,
    /// a, b, c: R = Rz(a) Ry(b) Rx(c) (KUKA).
    EulerZyx,
    /// rx, ry, rz about moving axes: R = Rx(rx) Ry(ry) Rz(rz) (Staubli).
    EulerXyz,
    /// R = Rz(first) Ry(second) Rz(third) (Kawasaki, Comau).
    EulerZyz,
    /// Axis times angle (Universal Robots).
    RotationVector,
    /// i, j, k: the tool's axis, from its tip to its holder (APT, ISO 4343). The tool's Z points the other way. How the
    /// tool is turned about the axis is not written; a rule says it.
    ToolAxis(SpinRule),
}

/// How the tool is turned about a tool axis: its X axis points as far as it can along one axis of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpinRule {
    /// 0, 1, 2 for X, Y, Z of the frame.
    pub axis: u8,
    /// It points against that axis.
    pub against: bool,
}

/// Sine of the angle between the tool's axis and the direction of a rule below which the rule says nothing.
const RULE_SAYS_NOTHING: f64 = 1e-6;

impl SpinRule {
    /// The orientation of a tool with this axis; `None` for an axis without length, or along the rule's direction.
    fn rotation(self, tool_axis: &[f64]) -> Option<Matrix3<f64>> {
        let z = -Vector3::new(tool_axis[0], tool_axis[1], tool_axis[2]).try_normalize(1e-6)?;
        let mut direction = Vector3::zeros();
        *direction.get_mut(usize::from(self.axis))? = if self.against { -1.0 } else { 1.0 };
        let x = (direction - z * direction.dot(&z)).try_normalize(RULE_SAYS_NOTHING)?;
        Some(Matrix3::from_columns(&[x, z.cross(&x), z]))
    }
}

/// The three or four numbers of an orientation, without allocation: used as a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientationNumbers {
    numbers: [f64; 4],
    count: usize,
}

impl OrientationNumbers {
    /// The same numbers, each changed by `change`.
    #[must_use]
    pub fn map(self, change: impl FnMut(f64) -> f64) -> Self {
        Self { numbers: self.numbers.map(change), ..self }
    }

    /// The numbers with zeros behind them.
    pub fn padded(&self) -> [f64; 4] {
        self.numbers
    }
}

impl From<[f64; 4]> for OrientationNumbers {
    fn from(numbers: [f64; 4]) -> Self {
        Self { numbers, count: 4 }
    }
}

impl From<[f64; 3]> for OrientationNumbers {
    fn from([a, b, c]: [f64; 3]) -> Self {
        Self { numbers: [a, b, c, 0.0], count: 3 }
    }
}

/// Of more than four numbers only the first four are taken.
impl FromIterator<f64> for OrientationNumbers {
    fn from_iter<I: IntoIterator<Item = f64>>(numbers: I) -> Self {
        let mut all = Self { numbers: [0.0; 4], count: 0 };
        for (place, number) in all.numbers.iter_mut().zip(numbers) {
            *place = number;
            all.count += 1;
        }
        all
    }
}

impl std::ops::Deref for OrientationNumbers {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

impl OrientationConvention {
    /// How many numbers it takes.
    pub fn count(self) -> usize {
        match self {
            Self::QuaternionWxyz | Self::QuaternionXyzw => 4,
            _ => 3,
        }
    }

    /// True for the two quaternion orders, whose numbers are not angles.
    pub fn is_quaternion(self) -> bool {
        self.count() == 4
    }

    /// True when the numbers are angles, in the unit of the file.
    pub fn has_angles(self) -> bool {
        !self.is_quaternion() && self.spin_rule().is_none()
    }

    /// The rule by which a tool axis is completed, where the numbers are a tool axis.
    pub fn spin_rule(self) -> Option<SpinRule> {
        match self {
            Self::ToolAxis(rule) => Some(rule),
            _ => None,
        }
    }

    /// True when `numbers` stand for a rotation: the right count, all finite, a quaternion with length.
    pub fn is_rotation(self, numbers: &[f64]) -> bool {
        let finite = numbers.len() == self.count() && numbers.iter().all(|number| number.is_finite());
        if let Some(rule) = self.spin_rule() {
            return finite && rule.rotation(numbers).is_some();
        }
        finite && (!self.is_quaternion() || numbers.iter().map(|number| number * number).sum::<f64>() > 1e-12)
    }

    /// The rotation matrix that `numbers` stand for. A quaternion is normalised first.
    ///
    /// Returns `None` when the count is wrong, a number is not finite, or a quaternion has no length.
    pub fn rotation(self, numbers: &[f64]) -> Option<Matrix3<f64>> {
        if !self.is_rotation(numbers) {
            return None;
        }
        Some(match self {
            Self::QuaternionWxyz => rotation_from_quaternion([numbers[0], numbers[1], numbers[2], numbers[3]])?,
            Self::QuaternionXyzw => rotation_from_quaternion([numbers[3], numbers[0], numbers[1], numbers[2]])?,
            Self::FixedXyz => rotation_z(numbers[2]) * rotation_y(numbers[1]) * rotation_x(numbers[0]),
            Self::EulerZyx => rotation_z(numbers[0]) * rotation_y(numbers[1]) * rotation_x(numbers[2]),
            Self::EulerXyz => rotation_x(numbers[0]) * rotation_y(numbers[1]) * rotation_z(numbers[2]),
            Self::EulerZyz => rotation_z(numbers[0]) * rotation_y(numbers[1]) * rotation_z(numbers[2]),
            Self::RotationVector => rotation_from_vector(&Vector3::new(numbers[0], numbers[1], numbers[2])),
            Self::ToolAxis(rule) => rule.rotation(numbers)?,
        })
    }

    /// The numbers for `rotation` that lie nearest to `near`: same sign of a quaternion, same turn of an angle, same
    /// one of the two Euler solutions.
    ///
    /// At a singularity of the angles (second angle at its limit) the first number of `near` is kept.
    pub fn numbers(self, rotation: &Matrix3<f64>, near: &[f64]) -> OrientationNumbers {
        match self {
            Self::QuaternionWxyz => quaternion_near(rotation, [0, 1, 2, 3], near).into(),
            Self::QuaternionXyzw => quaternion_near(rotation, [3, 0, 1, 2], near).into(),
            Self::FixedXyz => {
                let [x, y, z] = first_three(near);
                let [a, b, c] = zyx_near(rotation, &[z, y, x]);
                [c, b, a].into()
            }
            Self::EulerZyx => zyx_near(rotation, &first_three(near)).into(),
            Self::EulerXyz => {
                // R = Rx(a) Ry(b) Rz(c)  <=>  R' = Rz(-c) Ry(-b) Rx(-a)
                let [a, b, c] = first_three(near);
                let [c, b, a] = zyx_near(&rotation.transpose(), &[-c, -b, -a]);
                [-a, -b, -c].into()
            }
            Self::EulerZyz => zyz_near(rotation, &first_three(near)).into(),
            Self::RotationVector => vector_near(rotation, &first_three(near)).into(),
            Self::ToolAxis(_) => {
                // An axis that was written with another length keeps it.
                let length = Vector3::from(first_three(near)).norm();
                let axis = -rotation.column(2) * if length > 0.0 { length } else { 1.0 };
                [axis[0], axis[1], axis[2]].into()
            }
        }
    }
}

/// The first three of some numbers, zero where there are fewer.
fn first_three(numbers: &[f64]) -> [f64; 3] {
    std::array::from_fn(|at| numbers.get(at).copied().unwrap_or(0.0))
}

/// w, x, y, z of a rotation matrix, unit length; the sign is arbitrary.
pub fn quaternion_from_rotation(rotation: &Matrix3<f64>) -> [f64; 4] {
    // Shepperd (1978): divide by the largest of the four components.
    let m = |row: usize, column: usize| rotation[(row, column)];
    let trace = rotation.trace();
    let candidates = [trace, m(0, 0), m(1, 1), m(2, 2)];
    let largest = (0..4).fold(0, |best, index| if candidates[index] > candidates[best] { index } else { best });
    let q = match largest {
        0 => [1.0 + trace, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)],
        1 => [m(2, 1) - m(1, 2), 1.0 + 2.0 * m(0, 0) - trace, m(0, 1) + m(1, 0), m(0, 2) + m(2, 0)],
        2 => [m(0, 2) - m(2, 0), m(0, 1) + m(1, 0), 1.0 + 2.0 * m(1, 1) - trace, m(1, 2) + m(2, 1)],
        _ => [m(1, 0) - m(0, 1), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), 1.0 + 2.0 * m(2, 2) - trace],
    };
    let norm = q.iter().map(|component| component * component).sum::<f64>().sqrt();
    q.map(|component| component / norm)
}

fn rotation_from_quaternion(wxyz: [f64; 4]) -> Option<Matrix3<f64>> {
    let q = nalgebra::Quaternion::new(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    let unit = UnitQuaternion::try_new(q, 1e-6)?;
    Some(Rotation3::from(unit).into_inner())
}

fn quaternion_near(rotation: &Matrix3<f64>, order: [usize; 4], near: &[f64]) -> [f64; 4] {
    let wxyz = quaternion_from_rotation(rotation);
    let mut out = [0.0; 4];
    for (component, place) in wxyz.into_iter().zip(order) {
        out[place] = component;
    }
    let agreement: f64 = out.iter().zip(near).map(|(a, b)| a * b).sum();
    let sign = if agreement < 0.0 { -1.0 } else { 1.0 };
    out.map(|component| component * sign)
}

/// The angle equal to `angle` modulo a full turn that lies nearest to `near`.
pub fn angle_near(angle: f64, near: f64) -> f64 {
    let apart = near - angle;
    // What is near already is not turned: the common case, and rounding is a call.
    if apart.abs() < std::f64::consts::PI {
        return angle;
    }
    let turn = std::f64::consts::TAU;
    angle + turn * (apart / turn).round()
}

fn nearest_of(candidates: [[f64; 3]; 2], near: &[f64; 3]) -> [f64; 3] {
    let placed = candidates.map(|angles| {
        let mut placed = angles;
        for (angle, &wanted) in placed.iter_mut().zip(near) {
            *angle = angle_near(*angle, wanted);
        }
        placed
    });
    let distance = |angles: &[f64; 3]| angles.iter().zip(near).map(|(a, b)| (a - b).abs()).sum::<f64>();
    if distance(&placed[0]) <= distance(&placed[1]) { placed[0] } else { placed[1] }
}

/// a, b, c with R = Rz(a) Ry(b) Rx(c), nearest to `near`.
fn zyx_near(rotation: &Matrix3<f64>, near: &[f64; 3]) -> [f64; 3] {
    let sin_b = -rotation[(2, 0)];
    let cos_b = rotation[(0, 0)].hypot(rotation[(1, 0)]);
    let b = sin_b.atan2(cos_b);
    if cos_b < 1e-9 {
        // Only a - c (or a + c) is determined: keep the a that was written.
        let a = near[0];
        let rest = rotation_y(-b) * rotation_z(-a) * rotation;
        let c = rest[(2, 1)].atan2(rest[(1, 1)]);
        return nearest_of([[a, b, c], [a, b, c]], near);
    }
    let a = rotation[(1, 0)].atan2(rotation[(0, 0)]);
    let c = rotation[(2, 1)].atan2(rotation[(2, 2)]);
    let pi = std::f64::consts::PI;
    nearest_of([[a, b, c], [a + pi, pi - b, c + pi]], near)
}

/// o, a, t with R = Rz(o) Ry(a) Rz(t), nearest to `near`.
fn zyz_near(rotation: &Matrix3<f64>, near: &[f64; 3]) -> [f64; 3] {
    let sin_a = rotation[(0, 2)].hypot(rotation[(1, 2)]);
    let a = sin_a.atan2(rotation[(2, 2)]);
    if sin_a < 1e-9 {
        let o = near[0];
        let rest = rotation_y(-a) * rotation_z(-o) * rotation;
        let t = rest[(1, 0)].atan2(rest[(0, 0)]);
        return nearest_of([[o, a, t], [o, a, t]], near);
    }
    let o = rotation[(1, 2)].atan2(rotation[(0, 2)]);
    let t = rotation[(2, 1)].atan2(-rotation[(2, 0)]);
    let pi = std::f64::consts::PI;
    nearest_of([[o, a, t], [o + pi, -a, t + pi]], near)
}

/// The rotation vector, continued past half a turn when `near` is.
fn vector_near(rotation: &Matrix3<f64>, near: &[f64; 3]) -> [f64; 3] {
    let v = vector_from_rotation(rotation);
    let wanted = Vector3::from(*near);
    let angle = v.norm();
    if angle < 1e-9 {
        return v.into();
    }
    let axis = v / angle;
    let along = axis.dot(&wanted);
    (axis * angle_near(angle, along)).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    const ALL: [OrientationConvention; 7] = [
        OrientationConvention::QuaternionWxyz,
        OrientationConvention::QuaternionXyzw,
        OrientationConvention::FixedXyz,
        OrientationConvention::EulerZyx,
        OrientationConvention::EulerXyz,
        OrientationConvention::EulerZyz,
        OrientationConvention::RotationVector,
    ];

    #[test]
    fn every_convention_goes_round_and_stays_near_what_was_written() {
        let written = [0.5, -2.9, 1.2, 0.7];
        for convention in ALL {
            let mut near = written[..convention.count()].to_vec();
            if convention.is_quaternion() {
                let norm = near.iter().map(|x| x * x).sum::<f64>().sqrt();
                near.iter_mut().for_each(|x| *x /= norm);
            }
            let rotation = convention.rotation(&near).expect("finite numbers");
            let back = convention.numbers(&rotation, &near);
            for (a, b) in back.iter().zip(&near) {
                assert_abs_diff_eq!(a, b, epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn a_tool_axis_points_from_tip_to_holder_and_a_rule_turns_the_tool() {
        let along_x = OrientationConvention::ToolAxis(SpinRule { axis: 0, against: false });
        // A spindle that stands upright over the work: tool Z down, tool X along work X.
        let upright = along_x.rotation(&[0.0, 0.0, 1.0]).expect("an orientation");
        assert_abs_diff_eq!(upright, Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)), epsilon = 1e-15);
        // Tilted by 30 degrees in the plane of X and Z: tool X stays in that plane.
        let (sin, cos) = 30f64.to_radians().sin_cos();
        let tilted = along_x.rotation(&[sin, 0.0, cos]).expect("an orientation");
        assert_abs_diff_eq!(tilted.column(0).into_owned(), Vector3::new(cos, 0.0, -sin), epsilon = 1e-15);
        assert_abs_diff_eq!(tilted.determinant(), 1.0, epsilon = 1e-15);
        let back = along_x.numbers(&tilted, &[0.5, 0.0, 0.866]);
        let length = 0.5f64.hypot(0.866);
        assert_abs_diff_eq!(back[0], sin * length, epsilon = 1e-15);
        let against_y = OrientationConvention::ToolAxis(SpinRule { axis: 1, against: true });
        let turned = against_y.rotation(&[0.0, 0.0, 2.0]).expect("an orientation");
        assert_abs_diff_eq!(turned.column(0).into_owned(), -Vector3::y(), epsilon = 1e-15);
        // Along the rule's own direction there is no orientation.
        assert!(along_x.rotation(&[1.0, 0.0, 0.0]).is_none() && !along_x.is_rotation(&[-2.0, 0.0, 0.0]));
        assert!(along_x.rotation(&[0.0, 0.0, 0.0]).is_none());
    }

    #[test]
    fn singular_angles_still_give_the_rotation() {
        let half_pi = std::f64::consts::FRAC_PI_2;
        for convention in
            [OrientationConvention::FixedXyz, OrientationConvention::EulerZyx, OrientationConvention::EulerXyz]
        {
            let rotation = convention.rotation(&[0.4, half_pi, -0.3]).expect("finite numbers");
            let back = convention.numbers(&rotation, &[0.4, half_pi, -0.3]);
            let again = convention.rotation(&back).expect("finite numbers");
            assert_abs_diff_eq!(again, rotation, epsilon = 1e-9);
        }
        let rotation = OrientationConvention::EulerZyz.rotation(&[0.4, 0.0, -0.3]).expect("finite numbers");
        let back = OrientationConvention::EulerZyz.numbers(&rotation, &[0.4, 0.0, -0.3]);
        assert_abs_diff_eq!(back[2], -0.3, epsilon = 1e-12);
    }

    #[test]
    fn the_hyundai_sample_pose_has_its_yaw_in_the_arm_plane() {
        // Evidence for R = Rz Ry Rx: a pose in one plane has rz = atan2(y, x) when rx = 0.
        let rotation = OrientationConvention::FixedXyz
            .rotation(&[0.0, 73.248f64.to_radians(), -0.69f64.to_radians()])
            .expect("finite numbers");
        let approach = rotation.column(2);
        assert_abs_diff_eq!(approach[1].atan2(approach[0]), -0.69f64.to_radians(), epsilon = 1e-12);
    }

    #[test]
    fn a_quaternion_without_length_is_no_rotation() {
        assert!(OrientationConvention::QuaternionWxyz.rotation(&[0.0; 4]).is_none());
        assert!(OrientationConvention::QuaternionWxyz.rotation(&[f64::NAN, 0.0, 0.0, 1.0]).is_none());
        assert!(OrientationConvention::FixedXyz.rotation(&[0.0; 4]).is_none());
    }
}

//! From a written pose to what the rest of the program calls a target.

use crate::geometry::orientation::OrientationConvention;
use crate::geometry::pose::Pose;
use crate::program::number::NumberField;
use crate::program::target::{CartesianNumbers, ExternalAxis, JointNumbers, Target, TargetValue, Units};

use super::written_pose::{Coordinates, WrittenPose};

/// Axes of the arm itself.
pub(super) const ROBOT_AXES: usize = 6;

/// The target that a written pose is; it has no uses yet.
pub(super) fn target(file: usize, name: Option<String>, pose: &WrittenPose) -> Target {
    let mut computed = pose.qualifier.as_ref().map(|text| format!("the pose depends on `{text}`"));
    let value = match (pose.coordinates.clone(), six(&pose.axes)) {
        (Coordinates::Encoder, _) => {
            computed.get_or_insert_with(|| "encoder counts, which only the controller can turn into angles".to_owned());
            TargetValue::Counts
        }
        (Coordinates::Tool, _) => {
            computed.get_or_insert_with(|| "tool coordinates: relative to where the arm stands".to_owned());
            TargetValue::Unwritten
        }
        (_, None) => {
            computed.get_or_insert_with(|| format!("the pose has {} values, an arm needs six", pose.axes.len()));
            TargetValue::Unwritten
        }
        (Coordinates::Joint, Some(joints)) => {
            TargetValue::Joint(Box::new(JointNumbers { joints, units: Units::MM_DEG }))
        }
        (_, Some(numbers)) => TargetValue::Cartesian(Box::new(cartesian(numbers))),
    };
    let additional = pose.axes.iter().enumerate().skip(ROBOT_AXES);
    Target {
        file,
        name,
        span: pose.span,
        value,
        computed,
        configuration: pose.configuration.clone().unwrap_or_default().into_shared(),
        external_axes: additional
            .map(|(index, axis)| ExternalAxis { name: format!("J{}", index + 1), value: axis.value })
            .collect(),
        rides_along: pose.coordinates == Coordinates::Robot,
        uses: Vec::new(),
    }
}

/// The frame or tool that six numbers describe, if there are six.
pub(super) fn pose_of(axes: &[NumberField]) -> Option<Pose> {
    cartesian(six(axes)?).pose()
}

fn cartesian([x, y, z, rx, ry, rz]: [NumberField; ROBOT_AXES]) -> CartesianNumbers {
    CartesianNumbers {
        position: [x, y, z],
        orientation: [rx, ry, rz].into(),
        convention: OrientationConvention::FixedXyz,
        units: Units::MM_DEG,
    }
}

fn six(axes: &[NumberField]) -> Option<[NumberField; ROBOT_AXES]> {
    axes.get(..ROBOT_AXES)?.to_vec().try_into().ok()
}

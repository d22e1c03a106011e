//! Aggregates that are positions: `POS`, `E6POS`, `FRAME` by X to C, `AXIS`, `E6AXIS` by A1 to A6.

use crate::base::text::Span;
use crate::base::units::m_from_mm;
use crate::geometry::orientation::OrientationConvention;
use crate::geometry::pose::Pose;
use crate::program::number::NumberField;
use crate::program::target::{CartesianNumbers, Configuration, ExternalAxis, JointNumbers, TargetValue, Units};

use super::aggregate::{Aggregate, Value};
use super::configuration::configuration;

const CARTESIAN: [&str; 6] = ["x", "y", "z", "a", "b", "c"];
const AXES: [&str; 6] = ["a1", "a2", "a3", "a4", "a5", "a6"];
const EXTERNAL: [&str; 6] = ["e1", "e2", "e3", "e4", "e5", "e6"];

/// A position as it is written.
#[derive(Clone, Debug)]
pub(super) struct WrittenPosition {
    /// From brace to brace.
    pub span: Span,
    /// Its numbers; unwritten where some are missing.
    pub value: TargetValue,
    /// Why its numbers do not make a target, if they do not.
    pub incomplete: Option<String>,
    /// Status and turn.
    pub configuration: Configuration,
    /// E1 to E6.
    pub external_axes: Vec<ExternalAxis>,
}

/// Reads a position; `None` for aggregates that are something else.
pub(super) fn position(bytes: &[u8], aggregate: &Aggregate) -> Option<WrittenPosition> {
    let has = |names: &[&str]| names.iter().any(|name| aggregate.get(name).is_some());
    let names = match (has(&AXES), has(&CARTESIAN), has(&EXTERNAL)) {
        (true, _, _) => AXES,
        (false, true, _) => CARTESIAN,
        // `{E1 500}` moves an external axis alone; the arm stays where it is.
        (false, false, true) => CARTESIAN,
        (false, false, false) => return None,
    };
    let (value, incomplete) = match fields(bytes, aggregate, names) {
        Ok([x, y, z, a, b, c]) if names == CARTESIAN => {
            let numbers = CartesianNumbers {
                position: [x, y, z],
                orientation: [a, b, c].into(),
                convention: OrientationConvention::EulerZyx,
                units: Units::MM_DEG,
            };
            (TargetValue::Cartesian(Box::new(numbers)), None)
        }
        Ok(joints) => (TargetValue::Joint(Box::new(JointNumbers { joints, units: Units::MM_DEG })), None),
        Err(reason) => (TargetValue::Unwritten, Some(reason)),
    };
    let external = |name: &&str| Some(ExternalAxis { name: name.to_uppercase(), value: aggregate.number(name)? });
    Some(WrittenPosition {
        span: aggregate.span,
        value,
        incomplete,
        configuration: configuration(aggregate.integer("s"), aggregate.integer("t")),
        external_axes: EXTERNAL.iter().filter_map(external).collect(),
    })
}

/// The pose of a frame, tool or base, which holds all six components; what a frame that was taken over from a position
/// holds besides is passed over.
pub(super) fn pose(aggregate: &Aggregate) -> Option<Pose> {
    let mut numbers = [0.0; 6];
    for (number, name) in numbers.iter_mut().zip(CARTESIAN) {
        *number = aggregate.number(name)?;
    }
    let [x, y, z, a, b, c] = numbers;
    let rotation = OrientationConvention::EulerZyx.rotation(&[a, b, c].map(f64::to_radians))?;
    Some(Pose { rotation, translation: nalgebra::Vector3::new(x, y, z).map(m_from_mm) })
}

fn fields(bytes: &[u8], aggregate: &Aggregate, names: [&str; 6]) -> Result<[NumberField; 6], String> {
    let mut found = Vec::with_capacity(6);
    let mut missing = Vec::new();
    for name in names {
        match aggregate.get(name) {
            Some(Value::Number(field)) => found.push(field.clone()),
            Some(Value::Other(span)) => {
                let text = String::from_utf8_lossy(&bytes[span.start..span.end]);
                return Err(format!("its {} is `{text}`", name.to_uppercase()));
            }
            Some(_) => return Err(format!("its {} is no number", name.to_uppercase())),
            None => missing.push(name.to_uppercase()),
        }
    }
    found.try_into().map_err(|_| format!("{} stay as they are when the arm comes there", missing.join(", ")))
}

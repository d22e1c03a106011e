//! Targets of locations, and what displaces a location.

use crate::program::gather::plain;
use crate::program::number::NumberField;
use crate::program::target::{Displacement, DisplacementKind, Target, TargetValue, Units, Use};

use super::expression::Number;
use super::value::Value;

/// The target of a value; `kept` says why it must keep its numbers.
pub(super) fn of_value(value: &Value, kept: Option<&String>, name: Option<String>) -> Target {
    Target {
        name,
        computed: value.computed.as_ref().or(kept).cloned(),
        external_axes: value.external_axes.clone(),
        ..plain(value.file, value.span, value.value.clone())
    }
}

/// What displaces a location.
#[derive(Debug)]
pub(super) struct Displaced {
    /// The number of the location's value.
    pub base: usize,
    /// From the first to the last number, with the word before them.
    pub span: crate::base::text::Span,
    /// In which frame.
    pub kind: DisplacementKind,
    /// x, y, z.
    pub position: [NumberField; 3],
    /// The turn.
    pub rotation: nalgebra::Matrix3<f64>,
}

impl Displaced {
    /// The target of a motion to a displaced location.
    pub fn target(self, shown: &str, one: Use) -> Target {
        let value = TargetValue::Displaced(Box::new(Displacement {
            base: self.base,
            kind: self.kind,
            position: self.position,
            rotation: self.rotation,
            units: Units::MM_DEG,
        }));
        let file = one.file;
        Target { name: Some(shown.to_owned()), uses: vec![one], ..plain(file, self.span, value) }
    }
}

/// Three written numbers, if these are three or more.
pub(super) fn three(numbers: &[Number]) -> Option<[NumberField; 3]> {
    let written = numbers.iter().take(3).filter_map(|number| match number {
        Number::Written(field) => Some(field.clone()),
        _ => None,
    });
    written.collect::<Vec<_>>().try_into().ok()
}

//! Targets in the making: values that motions go to, and locations written in motions.

use std::collections::HashMap;

use crate::base::text::Span;
use crate::program::target::{Configuration, Displacement, DisplacementKind, Program, Target, TargetValue, Units, Use};

use super::expression::Number;
use super::value::Value;

/// Longest name that is shown of an expression.
const LONGEST: usize = 60;

/// The targets of a job.
#[derive(Debug, Default)]
pub(super) struct Targets {
    made: Vec<Made>,
    by_value: HashMap<usize, usize>,
    by_text: HashMap<(usize, String), usize>,
}

#[derive(Debug)]
struct Made {
    target: Target,
    /// What `ABOVE` and `BELOW` say at each of its uses.
    elbows: Vec<Option<bool>>,
}

impl Targets {
    /// A motion to a variable; `kept` says why it must keep its numbers.
    pub fn to_value(&mut self, index: usize, value: &Value, kept: Option<&String>, one: Use, elbow: Option<bool>) {
        let slot = *self.by_value.entry(index).or_insert_with(|| {
            self.made.push(Made { target: of_value(value, kept, Some(value.shown.clone())), elbows: Vec::new() });
            self.made.len() - 1
        });
        self.made[slot].target.uses.push(one);
        self.made[slot].elbows.push(elbow);
    }

    /// A motion to a location that it writes out.
    pub fn to_literal(&mut self, value: &Value, one: Use, elbow: Option<bool>) {
        let mut target = of_value(value, None, None);
        target.uses.push(one);
        self.made.push(Made { target, elbows: vec![elbow] });
    }

    /// A motion to a location displaced from a variable; `base` is that variable's value.
    pub fn to_displaced(&mut self, base: usize, span: Span, displaced: Displaced, one: Use) {
        let value = TargetValue::Displaced(Box::new(Displacement {
            base,
            kind: displaced.kind,
            position: displaced.position,
            rotation: displaced.rotation,
            units: Units::MM_DEG,
        }));
        let target = Target {
            file: one.file,
            name: Some(displaced.shown),
            span,
            value,
            computed: None,
            configuration: Configuration::default(),
            external_axes: Vec::new(),
            uses: vec![one],
        };
        self.made.push(Made { target, elbows: Vec::new() });
    }

    /// A motion to something that the text does not hold.
    pub fn to_unwritten(&mut self, text: &str, span: Span, reason: String, one: Use) {
        let name: String = text.chars().take(LONGEST).collect();
        let slot = *self.by_text.entry((one.file, name.clone())).or_insert_with(|| {
            let target = Target {
                file: one.file,
                name: Some(name),
                span,
                value: TargetValue::Unwritten,
                computed: Some(reason),
                configuration: Configuration::default(),
                external_axes: Vec::new(),
                uses: Vec::new(),
            };
            self.made.push(Made { target, elbows: Vec::new() });
            self.made.len() - 1
        });
        self.made[slot].target.uses.push(one);
    }

    /// All targets in the order of the text.
    pub fn finish(mut self, program: &mut Program) {
        for made in &mut self.made {
            let first = made.elbows.first().copied().flatten();
            if made.elbows.iter().all(|elbow| *elbow == first) {
                made.target.configuration.elbow_down = first;
            }
        }
        let mut order: Vec<usize> = (0..self.made.len()).collect();
        order.sort_by_key(|&slot| (self.made[slot].target.file, self.made[slot].target.span));
        let mut place = vec![0; order.len()];
        for (index, &slot) in order.iter().enumerate() {
            place[slot] = index;
        }
        for made in &mut self.made {
            if let TargetValue::Displaced(displacement) = &mut made.target.value {
                match self.by_value.get(&displacement.base) {
                    Some(&slot) => displacement.base = place[slot],
                    None => {
                        made.target.value = TargetValue::Unwritten;
                        made.target.computed = Some("displaced from a location that no motion goes to".into());
                    }
                }
            }
        }
        let mut targets: Vec<Option<Target>> = self.made.into_iter().map(|made| Some(made.target)).collect();
        program.targets = order.into_iter().filter_map(|slot| targets[slot].take()).collect();
    }
}

/// What displaces a location.
#[derive(Debug)]
pub(super) struct Displaced {
    /// In which frame.
    pub kind: DisplacementKind,
    /// x, y, z.
    pub position: [crate::program::number::NumberField; 3],
    /// The turn.
    pub rotation: nalgebra::Matrix3<f64>,
    /// The whole expression.
    pub shown: String,
}

/// Three written numbers, if these are three or more.
pub(super) fn three(numbers: &[Number]) -> Option<[crate::program::number::NumberField; 3]> {
    let fields: Vec<_> = numbers
        .iter()
        .take(3)
        .filter_map(|number| match number {
            Number::Written(field) => Some(field.clone()),
            _ => None,
        })
        .collect();
    fields.try_into().ok()
}

fn of_value(value: &Value, kept: Option<&String>, name: Option<String>) -> Target {
    Target {
        file: value.file,
        name,
        span: value.span,
        value: value.value.clone(),
        computed: value.computed.as_ref().or(kept).cloned(),
        configuration: Configuration::default(),
        external_axes: value.external_axes.clone(),
        uses: Vec::new(),
    }
}

//! Literals: `p[x,y,z,rx,ry,rz]` in metres and radians, `[q1,..,q6]` in radians.

use std::ops::Range;

use crate::geometry::orientation::OrientationConvention;
use crate::program::number::{NumberField, number_at};
use crate::program::target::{CartesianNumbers, JointNumbers, Units};

use super::token::{Kind, Text};

/// A literal list.
#[derive(Clone, Debug)]
pub(super) enum Literal {
    /// `p[..]`.
    Pose(Box<CartesianNumbers>),
    /// `[..]`.
    Joints(Box<JointNumbers>),
    /// A list with an element that is no plain number.
    Expression(usize),
    /// So many numbers instead of six.
    Count(usize),
}

/// Reads the tokens of `range` as one literal; `None` when they are anything else.
pub(super) fn literal(text: Text<'_>, range: &Range<usize>) -> Option<Literal> {
    let pose = text.word(range.start) == b"p";
    let open = range.start + usize::from(pose);
    if !text.is(open, b'[') {
        return None;
    }
    let (parts, close) = text.parts(open, range.end)?;
    if close + 1 != range.end {
        return None;
    }
    let fields: Vec<NumberField> = parts.iter().map_while(|part| number(text, part)).collect();
    if fields.len() != parts.len() {
        return Some(Literal::Expression(parts[fields.len()].start));
    }
    let count = fields.len();
    let six: Result<[NumberField; 6], _> = fields.try_into();
    Some(match six {
        Err(_) => Literal::Count(count),
        Ok([x, y, z, rx, ry, rz]) if pose => Literal::Pose(Box::new(CartesianNumbers {
            position: [x, y, z],
            orientation: [rx, ry, rz].into(),
            convention: OrientationConvention::RotationVector,
            units: Units::M_RAD,
        })),
        Ok(joints) => Literal::Joints(Box::new(JointNumbers { joints, units: Units::M_RAD })),
    })
}

/// A number with a sign directly before it.
pub(super) fn number(text: Text<'_>, part: &Range<usize>) -> Option<NumberField> {
    let signed = part.len() == 2 && (text.is(part.start, b'-') || text.is(part.start, b'+'));
    if !(signed || part.len() == 1) {
        return None;
    }
    let last = text.tokens.get(part.end - 1).filter(|token| token.kind == Kind::Number)?;
    let field = number_at(text.source.bytes(), text.tokens[part.start].span.start)?;
    (field.span().end == last.span.end).then_some(field)
}

/// Three numbers in brackets.
pub(super) fn vector(text: Text<'_>, range: &Range<usize>) -> Option<[f64; 3]> {
    let (parts, close) = text.is(range.start, b'[').then(|| text.parts(range.start, range.end)).flatten()?;
    let values: Option<Vec<f64>> = parts.iter().map(|part| number(text, part).map(|field| field.value)).collect();
    (close + 1 == range.end).then_some(values?)?.try_into().ok()
}

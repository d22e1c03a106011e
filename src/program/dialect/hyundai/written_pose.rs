//! A pose as the text holds it: `(x,y,z,rx,ry,rz,..,cfg)U1`, `(j1,..,j6)A`, `[j1,..]`, `Pose(x,..,"base","nf")`.

use crate::base::text::Span;
use crate::program::number::NumberField;
use crate::program::scan::Cursor;
use crate::program::target::Configuration;

use super::configuration;
use super::elements::{Element, Unclosed, elements};

/// In which coordinates a pose is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Coordinates {
    /// Axis values.
    Joint,
    /// Base coordinates.
    Base,
    /// Robot coordinates: base coordinates that travel with the robot.
    Robot,
    /// A user frame by number; without one, the frame that is selected.
    User(Option<u32>),
    /// Encoder counts.
    Encoder,
    /// Tool coordinates, which only displacements and tool data have.
    Tool,
}

/// A pose whose values stand in the text.
#[derive(Clone, Debug)]
pub(super) struct WrittenPose {
    /// From the first byte to the last, suffix and constructor included.
    pub span: Span,
    /// What the numbers mean.
    pub coordinates: Coordinates,
    /// x, y, z, rx, ry, rz or joint values, then additional axes. Empty for encoder counts.
    pub axes: Vec<NumberField>,
    /// Which solution it asks for; `None` when no configuration is written.
    pub configuration: Option<Configuration>,
    /// A further condition on the pose that is settled at run time, as written: `sync(20.5,-12.0)`.
    pub qualifier: Option<String>,
}

/// Why no pose could be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum PoseFault {
    /// The text stops before the bracket closes.
    Unclosed(Span),
    /// Something that is no constant stands in it.
    NotConstant(Span),
}

impl From<Unclosed> for PoseFault {
    fn from(unclosed: Unclosed) -> Self {
        PoseFault::Unclosed(unclosed.0)
    }
}

/// Reads `(..)` with its suffix. `total_axes` tells a configuration written as a decimal from an additional axis.
///
/// # Errors
/// [`PoseFault`] when a bracket or a constant is missing.
pub(super) fn tuple(cursor: &mut Cursor<'_>, total_axes: Option<usize>) -> Result<WrittenPose, PoseFault> {
    let start = cursor.offset();
    let found = elements(cursor)?;
    let suffix = cursor.skip_while(|byte| byte.is_ascii_alphanumeric());
    let span = Span::new(start, cursor.offset());
    let coordinates = coordinates_of_suffix(cursor.slice(suffix)).ok_or(PoseFault::NotConstant(span))?;
    if coordinates == Coordinates::Encoder {
        return Ok(WrittenPose { span, coordinates, axes: Vec::new(), configuration: None, qualifier: None });
    }
    let mut axes = Vec::with_capacity(found.len());
    let mut configuration = None;
    let last = found.len().saturating_sub(1);
    for (index, element) in found.into_iter().enumerate() {
        match element {
            Element::Number(number) => axes.push(number),
            Element::Radix(value) if index == last && index >= 6 && coordinates != Coordinates::Joint => {
                configuration = Some(configuration::from_number(value));
            }
            _ => return Err(PoseFault::NotConstant(span)),
        }
    }
    if configuration.is_none()
        && coordinates != Coordinates::Joint
        && axes.len() == total_axes.unwrap_or(6) + 1
        && let Some(number) = axes.pop_if(|last| last.decimals() == 0 && (0.0..=65535.0).contains(&last.value))
    {
        configuration = Some(configuration::from_number(number.value as u64));
    }
    Ok(WrittenPose { span, coordinates, axes, configuration, qualifier: None })
}

fn coordinates_of_suffix(suffix: &[u8]) -> Option<Coordinates> {
    match suffix.to_ascii_uppercase().as_slice() {
        b"" => Some(Coordinates::Base),
        b"A" => Some(Coordinates::Joint),
        b"E" => Some(Coordinates::Encoder),
        b"R" => Some(Coordinates::Robot),
        b"T" => Some(Coordinates::Tool),
        [b'U', digits @ ..] => user_frame(digits),
        _ => None,
    }
}

fn user_frame(digits: &[u8]) -> Option<Coordinates> {
    if digits.is_empty() {
        return Some(Coordinates::User(None));
    }
    let number = std::str::from_utf8(digits).ok()?.parse().ok()?;
    Some(Coordinates::User(Some(number)))
}

/// Reads a list `[..]` of numbers and then, in strings, coordinate system and configuration.
///
/// # Errors
/// [`PoseFault`] when a bracket or a constant is missing.
pub(super) fn list(cursor: &mut Cursor<'_>) -> Result<WrittenPose, PoseFault> {
    let start = cursor.offset();
    let found = elements(cursor)?;
    let span = Span::new(start, cursor.offset());
    from_elements(cursor, found, span)
}

/// Reads a constructor `Pose(..)` or `Shift(..)`; the cursor stands on its name.
///
/// # Errors
/// [`PoseFault`] when a bracket or a constant is missing.
pub(super) fn constructor(cursor: &mut Cursor<'_>) -> Result<WrittenPose, PoseFault> {
    let start = cursor.offset();
    cursor.name();
    cursor.skip_blanks();
    let found = elements(cursor)?;
    let span = Span::new(start, cursor.offset());
    if let [Element::Text(inside)] = found.as_slice() {
        let mut inner = *cursor;
        inner.seek(inside.start);
        inner.skip_blanks();
        if inner.peek() != Some(b'[') {
            return Err(PoseFault::NotConstant(span));
        }
        return list(&mut inner).map(|pose| WrittenPose { span, ..pose });
    }
    from_elements(cursor, found, span)
}

fn from_elements(cursor: &Cursor<'_>, found: Vec<Element>, span: Span) -> Result<WrittenPose, PoseFault> {
    let mut axes = Vec::with_capacity(found.len());
    let mut strings = Vec::new();
    for element in found {
        match element {
            Element::Number(number) if strings.is_empty() => axes.push(number),
            Element::Text(text) if strings.len() < 2 => strings.push(String::from_utf8_lossy(cursor.slice(text))),
            _ => return Err(PoseFault::NotConstant(span)),
        }
    }
    if axes.is_empty() {
        return Err(PoseFault::NotConstant(span));
    }
    let mut coordinates = Coordinates::Joint;
    let mut qualifier = None;
    for word in strings.first().into_iter().flat_map(|text| words(text)) {
        match coordinates_of_word(word) {
            Some(found) => coordinates = found,
            None => qualifier = Some(word.to_owned()),
        }
    }
    let configuration = strings.get(1).map(|flags| configuration::from_flags(flags));
    if coordinates == Coordinates::Encoder {
        axes.clear();
    }
    Ok(WrittenPose { span, coordinates, axes, configuration, qualifier })
}

/// The comma-divided items of a coordinate string, those inside of brackets kept together.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let mut depth = 0_usize;
    text.split(move |sign| {
        match sign {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        sign == ',' && depth == 0
    })
    .map(str::trim)
    .filter(|word| !word.is_empty())
}

fn coordinates_of_word(word: &str) -> Option<Coordinates> {
    match word.to_lowercase().as_str() {
        "joint" => Some(Coordinates::Joint),
        "base" => Some(Coordinates::Base),
        "robot" => Some(Coordinates::Robot),
        "encoder" => Some(Coordinates::Encoder),
        "tool" => Some(Coordinates::Tool),
        other => other.strip_prefix('u').and_then(|digits| user_frame(digits.as_bytes())),
    }
}

//! The position section: modal lines and positions.

use std::collections::HashMap;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Span;
use crate::geometry::orientation::OrientationConvention;
use crate::program::number::NumberField;
use crate::program::scan::Cursor;
use crate::program::target::{CartesianNumbers, Configuration, ExternalAxis, Reference, TargetValue, Units};

use super::configuration::configuration;

/// Which positions there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Kind {
    /// `C`: the position of a step.
    Step,
    /// `P`, `LP`: a variable.
    Variable,
}

/// A position of the robot.
#[derive(Clone, Debug)]
pub(super) struct Position {
    /// Step or variable.
    pub kind: Kind,
    /// Its number.
    pub number: u32,
    /// As written: `C00012`.
    pub name: String,
    /// From the name to the last number.
    pub span: Span,
    /// Its numbers.
    pub value: TargetValue,
    /// Why they cannot be used, if so.
    pub computed: Option<String>,
    /// From `///RCONF`.
    pub configuration: Configuration,
    /// Base and station axes of the same step.
    pub external_axes: Vec<ExternalAxis>,
    /// From `///TOOL`.
    pub tool: Reference,
    /// From `///POSTYPE` and `///USER`.
    pub frame: Reference,
    /// In the robot's own coordinates, which a base axis carries along.
    pub rides_along: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Coordinates {
    Pulse,
    Robot,
    Base,
    User,
    Other,
}

/// Reads positions line by line; the state is what the modal lines set.
#[derive(Debug)]
pub(super) struct PositionReader {
    coordinates: Coordinates,
    tool: Reference,
    user: Option<u32>,
    configuration: Configuration,
    /// What has been read.
    pub positions: Vec<Position>,
    /// Values of base axes (true) and station axes by kind and number.
    others: HashMap<(bool, Kind, u32), Vec<f64>>,
}

impl PositionReader {
    /// At the start of the section nothing is set; steps are pulses unless the job says otherwise.
    pub fn new() -> Self {
        Self {
            coordinates: Coordinates::Pulse,
            tool: Reference::Unnamed,
            user: None,
            configuration: Configuration::default(),
            positions: Vec::new(),
            others: HashMap::new(),
        }
    }

    /// One line of the section.
    pub fn line(&mut self, bytes: &[u8], file: usize, line: Span, diagnostics: &mut Vec<Diagnostic>) {
        let mut cursor = Cursor::new(bytes, line);
        if cursor.eat(b'/') {
            cursor.skip_while(|byte| byte == b'/');
            self.modal(&mut cursor);
        } else if let Some(name) = cursor.name() {
            let Some((letters, number)) = split(cursor.slice(name)) else { return };
            cursor.skip_blanks();
            if cursor.eat(b'=') {
                let read = numbers(&mut cursor);
                let span = Span::new(
                    name.start,
                    read.as_ref().ok().and_then(|all| all.last()).map_or(line.end, |last| last.span().end),
                );
                if read.is_err() {
                    let message = "a position that is no list of numbers";
                    diagnostics.push(Diagnostic::error("broken-position", message).at(file, line, ""));
                }
                let name = String::from_utf8_lossy(cursor.slice(name)).into_owned();
                self.position(name, &letters, number, span, read.unwrap_or_default());
            }
        }
    }

    fn modal(&mut self, cursor: &mut Cursor<'_>) {
        let Some(name) = cursor.name() else { return };
        let name = cursor.slice(name);
        cursor.skip_blanks();
        let rest = cursor.rest().trim_ascii();
        let number = || std::str::from_utf8(rest).ok().and_then(|text| text.parse::<u32>().ok());
        match name {
            b"TOOL" => {
                self.tool = match number() {
                    Some(number) => Reference::Named(number.to_string().into()),
                    None => Reference::Runtime("the tool number behind ///TOOL cannot be read".into()),
                };
            }
            b"USER" => self.user = number(),
            b"RCONF" => self.configuration = configuration(rest),
            b"PULSE" => self.coordinates = Coordinates::Pulse,
            b"POSTYPE" => {
                self.coordinates = match rest {
                    b"PULSE" => Coordinates::Pulse,
                    b"ROBOT" => Coordinates::Robot,
                    b"BASE" => Coordinates::Base,
                    b"USER" => Coordinates::User,
                    _ => Coordinates::Other,
                };
            }
            b"RECTAN" if self.coordinates == Coordinates::Pulse => self.coordinates = Coordinates::Other,
            _ => {}
        }
    }

    fn position(&mut self, name: String, letters: &str, number: u32, span: Span, fields: Vec<NumberField>) {
        let kind = match letters {
            "C" => Kind::Step,
            "P" | "LP" => Kind::Variable,
            "BC" | "EC" | "BP" | "EX" => {
                let kind = if letters.ends_with('C') { Kind::Step } else { Kind::Variable };
                let values = fields.iter().map(|field| field.value).collect();
                self.others.insert((letters.starts_with('B'), kind, number), values);
                return;
            }
            _ => return,
        };
        let count = fields.len();
        let six: Result<[NumberField; 6], _> = fields.try_into();
        let (value, computed) = match (self.coordinates, six) {
            (Coordinates::Pulse, _) => (
                TargetValue::Counts,
                Some("pulse counts: the robot file does not hold the pulses of a degree".to_owned()),
            ),
            (Coordinates::Other, _) => (
                TargetValue::Unwritten,
                Some("its coordinates (///POSTYPE) are relative to a tool, or not known".to_owned()),
            ),
            (_, Err(_)) => (TargetValue::Unwritten, Some(format!("the position has {count} values, an arm needs six"))),
            (_, Ok([x, y, z, rx, ry, rz])) => {
                let numbers = CartesianNumbers {
                    position: [x, y, z],
                    orientation: [rx, ry, rz].into(),
                    convention: OrientationConvention::FixedXyz,
                    units: Units::MM_DEG,
                };
                (TargetValue::Cartesian(Box::new(numbers)), None)
            }
        };
        let frame = match (self.coordinates, self.user) {
            (Coordinates::User, Some(user)) => Reference::Named(user.to_string().into()),
            (Coordinates::User, None) => Reference::Runtime("no ///USER stands before the position".into()),
            _ => Reference::Unnamed,
        };
        let configuration = self.configuration.clone();
        let tool = self.tool.clone();
        let external_axes = Vec::new();
        let rides_along = self.coordinates == Coordinates::Robot;
        let position = Position {
            kind,
            number,
            name,
            span,
            value,
            computed,
            configuration,
            external_axes,
            tool,
            frame,
            rides_along,
        };
        self.positions.push(position);
    }

    /// All positions, with the axes that belong to them.
    pub fn finish(mut self) -> Vec<Position> {
        for position in &mut self.positions {
            for (base, letters) in [(true, "B"), (false, "E")] {
                let Some(values) = self.others.get(&(base, position.kind, position.number)) else { continue };
                for (axis, &value) in values.iter().enumerate() {
                    position.external_axes.push(ExternalAxis { name: format!("{letters}{}", axis + 1), value });
                }
            }
        }
        self.positions
    }
}

/// `C00012` into letters and number.
pub(super) fn split(name: &[u8]) -> Option<(String, u32)> {
    let digits = name.iter().position(u8::is_ascii_digit)?;
    let (letters, number) = name.split_at(digits);
    let number = std::str::from_utf8(number).ok()?.parse().ok()?;
    Some((String::from_utf8_lossy(letters).to_ascii_uppercase(), number))
}

fn numbers(cursor: &mut Cursor<'_>) -> Result<Vec<NumberField>, ()> {
    let mut fields = Vec::new();
    loop {
        cursor.skip_blanks();
        fields.push(cursor.number().ok_or(())?);
        cursor.skip_blanks();
        if cursor.at_end() {
            return Ok(fields);
        }
        if !cursor.eat(b',') {
            return Err(());
        }
    }
}

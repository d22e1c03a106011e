//! The data file: values of points, joint positions, frames and tools.

use std::collections::{BTreeMap, HashMap};

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::orientation::OrientationConvention;
use crate::program::number::{Insertion, NumberField, number_at};
use crate::program::target::{CartesianNumbers, Configuration, JointNumbers, Program, TargetValue, Units};

use super::older;
use super::xml::{Part, Tag, parts};

const POSE: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
const JOINTS: [&str; 6] = ["j1", "j2", "j3", "j4", "j5", "j6"];

/// What kind of data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `pointRx`, and `point` of older versions.
    Point,
    /// `jointRx`, `joint`.
    Joint,
    /// `frame`.
    Frame,
    /// `tool`.
    Tool,
}

/// One value of a variable.
#[derive(Clone, Debug)]
pub(super) struct Value {
    /// File of the job.
    pub file: usize,
    /// The whole element.
    pub span: Span,
    /// `pPick`, or `pPick[2]`.
    pub shown: String,
    /// Its numbers; [`TargetValue::Unwritten`] when they cannot be read.
    pub numbers: TargetValue,
    /// Shoulder, elbow, wrist.
    pub configuration: Configuration,
    /// The father as written.
    pub father: Option<String>,
    /// Why the numbers cannot be used.
    pub broken: Option<String>,
}

/// A variable.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// Its type.
    pub kind: Kind,
    /// Its values by key: `0`, `1,2`, `home`.
    pub values: BTreeMap<String, Value>,
}

/// All data of a job, by name.
#[derive(Debug, Default)]
pub(super) struct Data(pub HashMap<String, Variable>);

/// Reads a data file; anything else gives nothing.
pub(super) fn read(source: &Source, file: usize, data: &mut Data, program: &mut Program) {
    let bytes = source.bytes();
    let (parts, whole) = parts(bytes);
    if !whole {
        let end = Span::new(bytes.len(), bytes.len());
        let message = "the file stops inside of a tag: it may have been cut off";
        program.diagnostics.push(Diagnostic::error("truncated", message).at(file, end, "the text stops here"));
    }
    let mut current: Option<(String, Kind)> = None;
    let mut depth_of_fields = 0_usize;
    let mut older = older::Reader::default();
    for part in &parts {
        match part {
            Part::Open(tag) => match &bytes[tag.name.start..tag.name.end] {
                b"Data" => {
                    current = variable(bytes, tag).filter(|_| !tag.empty);
                    depth_of_fields = 0;
                    if let Some((name, kind)) = variable(bytes, tag) {
                        data.0.entry(name).or_insert(Variable { kind, values: BTreeMap::new() });
                    }
                }
                b"Field" if !tag.empty => depth_of_fields += 1,
                b"Value" if depth_of_fields == 0 => {
                    let Some((name, kind)) = &current else { continue };
                    let key = normal(&tag.text(bytes, "key").unwrap_or_else(|| "0".into()));
                    let value = value(source, file, name, *kind, &key, tag);
                    add(data, Element { name: name.clone(), kind: *kind, key }, value, program);
                }
                _ => {
                    if let Some((name, value)) = older.open(source, file, tag) {
                        add(data, name, value, program);
                    }
                    older.configure(bytes, tag, data);
                }
            },
            Part::Close(name) => match &bytes[name.start..name.end] {
                b"Data" => current = None,
                b"Field" => depth_of_fields = depth_of_fields.saturating_sub(1),
                _ => {}
            },
            Part::Text(..) => {}
        }
    }
}

/// A key without blanks around its parts: `1, 2` is `1,2`.
pub(super) fn normal(key: &str) -> String {
    key.split(',').map(str::trim).collect::<Vec<_>>().join(",")
}

/// Which element of which variable.
#[derive(Clone, Debug)]
pub(super) struct Element {
    /// The variable.
    pub name: String,
    /// Its type.
    pub kind: Kind,
    /// The key.
    pub key: String,
}

fn add(data: &mut Data, element: Element, value: Value, program: &mut Program) {
    if let Some(reason) = &value.broken {
        let message = format!("`{}`: {reason}", value.shown);
        program.diagnostics.push(Diagnostic::error("broken-value", message).at(value.file, value.span, ""));
    }
    let Element { name, kind, key } = element;
    let variable = data.0.entry(name).or_insert(Variable { kind, values: BTreeMap::new() });
    variable.values.insert(key, value);
}

/// Name and kind that a `Data` tag declares.
fn variable(bytes: &[u8], tag: &Tag) -> Option<(String, Kind)> {
    let name = tag.text(bytes, "name")?;
    let kind = match tag.text(bytes, "type")?.as_str() {
        "pointRx" | "point" => Kind::Point,
        "jointRx" | "joint" => Kind::Joint,
        "frame" => Kind::Frame,
        "tool" => Kind::Tool,
        _ => return None,
    };
    Some((name, kind))
}

/// The value whose numbers stand in a tag.
pub(super) fn value(source: &Source, file: usize, name: &str, kind: Kind, key: &str, tag: &Tag) -> Value {
    let bytes = source.bytes();
    let shown = if key == "0" { name.to_owned() } else { format!("{name}[{key}]") };
    let names = if kind == Kind::Joint { JOINTS } else { POSE };
    let (numbers, broken) = match fields(bytes, tag, names) {
        Ok(joints) if kind == Kind::Joint => {
            (TargetValue::Joint(Box::new(JointNumbers { joints, units: Units::MM_DEG })), None)
        }
        Ok(fields) => (TargetValue::Cartesian(Box::new(pose(fields))), None),
        Err(attribute) => (TargetValue::Unwritten, Some(format!("`{attribute}` is no number"))),
    };
    let configuration = configuration(|attribute| tag.text(bytes, attribute));
    Value { file, span: tag.span, shown, numbers, configuration, father: tag.text(bytes, "fatherId"), broken }
}

/// Six numbers of which those that are zero may be absent; the name of the first that is broken.
fn fields(bytes: &[u8], tag: &Tag, names: [&'static str; 6]) -> Result<[NumberField; 6], &'static str> {
    // An absent number goes behind the attribute before it, or else behind the key, or the tag's name.
    let behind = |value: Span| value.end + 1;
    let mut place = tag.attribute(bytes, "key").map_or(tag.name.end, behind);
    let mut found = Vec::with_capacity(names.len());
    for name in names {
        found.push(match tag.attribute(bytes, name) {
            Some(span) => {
                let text = &bytes[span.start..span.end];
                let field = number_at(text, 0).filter(|field| field.span().len() == text.len()).ok_or(name)?;
                place = behind(span);
                field.at(span.start)
            }
            None => {
                let before = format!(" {name}=\"");
                NumberField::left_out(place, 0.0, 0, Insertion { before, after: "\"".into(), repeats: false })
            }
        });
    }
    found.try_into().map_err(|_| names[0])
}

/// x, y, z, rx, ry, rz.
pub(super) fn pose(fields: [NumberField; 6]) -> CartesianNumbers {
    let [x, y, z, rx, ry, rz] = fields;
    CartesianNumbers {
        position: [x, y, z],
        orientation: [rx, ry, rz].into(),
        convention: OrientationConvention::EulerXyz,
        units: Units::MM_DEG,
    }
}

/// What the words of shoulder, elbow and wrist ask for.
pub(super) fn configuration(word: impl Fn(&str) -> Option<String>) -> Configuration {
    let mut asked = Configuration::default();
    match word("shoulder").as_deref() {
        Some("lefty") => asked.rear = Some(false),
        Some("righty") => asked.rear = Some(true),
        _ => {}
    }
    match word("elbow").as_deref() {
        Some("epositive") => asked.elbow_down = Some(false),
        Some("enegative") => asked.elbow_down = Some(true),
        _ => {}
    }
    match word("wrist").as_deref() {
        Some("wpositive") => asked.wrist_negative = Some(false),
        Some("wnegative") => asked.wrist_negative = Some(true),
        _ => {}
    }
    asked
}

//! Tools and user frames that a job defines itself: `Tool1=(..)T`, `_tool[1]=Shift(..,"tool")`, `_tool[1].mass=..`,
//! `MKUCRD 1,(..)`, `mkucs(1,p_origin,p_xaxis,p_xyplane)`.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use crate::base::text::Span;
use crate::base::units::m_from_mm;
use crate::geometry::pose::Pose;
use crate::program::number::{number_at, starts_with_word};
use crate::program::scan::Cursor;
use crate::program::target::{Definition, FrameData, LoadData, Program, ToolData};

use super::expression::{Goal, goal};
use super::target::pose_of;
use super::variable::{Assignment, Variables};
use super::written_pose::{Coordinates, WrittenPose, constructor};

/// Where a definition stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// File of the job.
    pub file: usize,
    /// The statement.
    pub span: Span,
    /// Its line, for people.
    pub line: usize,
}

/// Everything that the job says about its tools and frames, in the order of the text.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    tools: BTreeMap<String, ToolParts>,
    frames: BTreeMap<String, Vec<(Place, Vec<Origin>)>>,
    /// Statements that set a tool or frame whose number is not in the text.
    pub unnumbered: Vec<Place>,
}

#[derive(Debug, Default)]
struct ToolParts {
    poses: Vec<(Place, Option<Pose>)>,
    load: BTreeMap<String, Vec<(Place, Option<f64>)>>,
}

/// A pose from which a frame is made.
#[derive(Debug)]
enum Origin {
    Written(WrittenPose),
    Named(String),
    Unknown,
}

impl Definitions {
    /// Takes an assignment to a tool or a `mkucs` call; false when it is neither.
    pub fn assign(&mut self, bytes: &[u8], place: Place, assignment: &Assignment) -> bool {
        let value = Cursor::new(bytes, assignment.value).rest().trim_ascii_start();
        if starts_with_word(value, "mkucs") {
            self.mkucs(bytes, place, assignment.value);
            return true;
        }
        let key = &assignment.name.key;
        let Some(number) = key.strip_prefix("_tool").or_else(|| key.strip_prefix("tool")) else { return false };
        let number = number.trim_start_matches('[').trim_end_matches(']');
        let Ok(number) = number.parse::<u32>() else {
            let any_tool = key == "_tool";
            if any_tool {
                self.unnumbered.push(place);
            }
            return any_tool;
        };
        let parts = self.tools.entry(number.to_string()).or_default();
        match assignment.part.as_deref().map(|part| part.rsplit('.').next().unwrap_or(part).to_lowercase()) {
            None => parts.poses.push((place, tool_pose(bytes, assignment.value))),
            Some(part) => {
                parts.load.entry(part).or_default().push((place, constant(bytes, assignment.value)));
            }
        }
        true
    }

    /// Takes a `MKUCRD n,pose[,pose,pose]` statement; false when it is none.
    pub fn mkucrd(&mut self, bytes: &[u8], place: Place, body: Span) -> bool {
        let mut cursor = Cursor::new(bytes, body);
        if !cursor.eat_word("MKUCRD") {
            return false;
        }
        self.frame(bytes, place, Span::new(cursor.offset(), body.end));
        true
    }

    fn mkucs(&mut self, bytes: &[u8], place: Place, value: Span) {
        let mut cursor = Cursor::new(bytes, value);
        cursor.skip_blanks();
        cursor.name();
        cursor.skip_blanks();
        let closed = bytes[..value.end].trim_ascii_end().len();
        if cursor.eat(b'(') && closed > cursor.offset() && bytes[closed - 1] == b')' {
            self.frame(bytes, place, Span::new(cursor.offset(), closed - 1));
        } else {
            self.unnumbered.push(place);
        }
    }

    fn frame(&mut self, bytes: &[u8], place: Place, span: Span) {
        let arguments = arguments(bytes, span);
        let Some((number, poses)) = arguments.split_first() else { return self.unnumbered.push(place) };
        let number = String::from_utf8_lossy(&bytes[number.start..number.end]);
        let Ok(number) = number.trim().parse::<u32>() else { return self.unnumbered.push(place) };
        let origins = poses.iter().map(|&span| match goal(bytes, span, None) {
            Goal::Written(pose) => Origin::Written(pose),
            Goal::Named(name) => Origin::Named(name.key),
            _ => Origin::Unknown,
        });
        self.frames.entry(number.to_string()).or_default().push((place, origins.collect()));
    }

    /// Writes what is known into the program.
    pub fn finish(self, variables: &Variables, program: &mut Program) {
        for (number, parts) in self.tools {
            let place = parts.poses.first().map(|(place, _)| *place);
            let Some(place) = place.or_else(|| parts.load.values().flatten().next().map(|(place, _)| *place)) else {
                continue;
            };
            let value = tool(&parts);
            program.tools.insert(number, Definition { file: place.file, span: place.span, value });
        }
        for (number, made) in self.frames {
            let Some((place, _)) = made.first() else { continue };
            let value =
                single(made.iter().map(|(place, origins)| (*place, frame_pose(variables, place.file, origins))))
                    .map(|pose| FrameData { pose, held_by_robot: false, on: None });
            program.frames.insert(number, Definition { file: place.file, span: place.span, value });
        }
    }
}

/// The one value of several definitions, or why there is none.
fn single<T: PartialEq>(made: impl Iterator<Item = (Place, Option<T>)>) -> Result<T, String> {
    let mut first: Option<(Place, T)> = None;
    for (place, value) in made {
        let value =
            value.ok_or_else(|| format!("line {} sets it to something that is no constant of the text", place.line))?;
        match &first {
            Some((earlier, same)) if *same != value => {
                return Err(format!("it is set differently in lines {} and {}", earlier.line, place.line));
            }
            Some(_) => {}
            None => first = Some((place, value)),
        }
    }
    first.map(|(_, value)| value).ok_or_else(|| "its pose is not in the program".to_owned())
}

fn tool(parts: &ToolParts) -> Result<ToolData, String> {
    let pose = single(parts.poses.iter().map(|(place, pose)| (*place, *pose)));
    if parts.load.is_empty() {
        return pose.map(|pose| ToolData { pose, held_by_robot: true, load: None });
    }
    let part = |name: &str| match parts.load.get(name) {
        Some(made) => {
            single(made.iter().map(|(place, value)| (*place, *value))).map_err(|why| format!("{name}: {why}"))
        }
        None => Err(format!("its load is changed, and `{name}` is not in the program")),
    };
    // Members other than these (inertia) do not bear on a pose at rest.
    if !["mass", "cx", "cy", "cz"].iter().any(|&name| parts.load.contains_key(name)) {
        return pose.map(|pose| ToolData { pose, held_by_robot: true, load: None });
    }
    let center_of_mass_m = [m_from_mm(part("cx")?), m_from_mm(part("cy")?), m_from_mm(part("cz")?)];
    let load = LoadData { mass_kg: part("mass")?, center_of_mass_m };
    Ok(ToolData { pose: pose?, held_by_robot: true, load: Some(load) })
}

/// The pose of `(..)T` or `Shift(..,"tool")`.
fn tool_pose(bytes: &[u8], value: Span) -> Option<Pose> {
    let mut cursor = Cursor::new(bytes, value);
    cursor.skip_blanks();
    let written = if starts_with_word(cursor.rest(), "Shift") {
        let written = constructor(&mut cursor).ok()?;
        cursor.rest().trim_ascii().is_empty().then_some(written)?
    } else {
        match goal(bytes, value, None) {
            Goal::Written(pose) => pose,
            _ => return None,
        }
    };
    (written.coordinates == Coordinates::Tool).then(|| pose_of(&written.axes)).flatten()
}

fn constant(bytes: &[u8], value: Span) -> Option<f64> {
    let text = Cursor::new(bytes, value).rest();
    let blanks = text.len() - text.trim_ascii_start().len();
    let number = number_at(&bytes[..value.end], value.start + blanks)?;
    bytes[number.span().end..value.end].trim_ascii().is_empty().then_some(number.value)
}

/// The frame that one pose is, or that three points span: origin, on the x axis, in the xy plane.
fn frame_pose(variables: &Variables, file: usize, origins: &[Origin]) -> Option<Pose> {
    let poses: Option<Vec<Pose>> = origins
        .iter()
        .map(|origin| match origin {
            Origin::Written(pose) => base_pose(pose),
            Origin::Named(key) => match variables.get(file, key)? {
                (variable, None) => match variable.poses.as_slice() {
                    [(_, pose)] => base_pose(pose),
                    _ => None,
                },
                _ => None,
            },
            Origin::Unknown => None,
        })
        .collect();
    match poses?.as_slice() {
        [origin] => Some(*origin),
        [origin, on_x, in_plane] => three_points(origin.translation, on_x.translation, in_plane.translation),
        _ => None,
    }
}

fn base_pose(written: &WrittenPose) -> Option<Pose> {
    let in_base = matches!(written.coordinates, Coordinates::Base | Coordinates::Robot);
    (in_base && written.qualifier.is_none()).then(|| pose_of(&written.axes)).flatten()
}

/// `None` for points in one place or on one line.
fn three_points(origin: Vector3<f64>, on_x: Vector3<f64>, in_plane: Vector3<f64>) -> Option<Pose> {
    let x = (on_x - origin).try_normalize(1e-9)?;
    let z = x.cross(&(in_plane - origin)).try_normalize(1e-9)?;
    Some(Pose { rotation: Matrix3::from_columns(&[x, z.cross(&x), z]), translation: origin })
}

/// The ranges between commas outside of brackets and strings.
fn arguments(bytes: &[u8], span: Span) -> Vec<Span> {
    let mut found = Vec::new();
    let (mut depth, mut in_string, mut start) = (0_usize, false, span.start);
    for (&byte, at) in bytes[span.start..span.end].iter().zip(span.start..) {
        match byte {
            b'"' => in_string = !in_string,
            _ if in_string => {}
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth = depth.saturating_sub(1),
            b',' if depth == 0 => {
                found.push(Span::new(start, at));
                start = at + 1;
            }
            _ => {}
        }
    }
    found.push(Span::new(start, span.end));
    found
}

//! Additional axes in cell files: what a track or a turntable moves, and how.

use nalgebra::{Rotation3, Unit, Vector3};
use serde::Deserialize;

use crate::base::units::{m_from_mm, rad_from_deg};
use crate::geometry::pose::Pose;

/// An additional axis of the cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellAxis {
    /// The language's name for it, lower case: `eax_a`, `e1`, `j7`.
    pub name: String,
    /// What it moves.
    pub moves: Moves,
    /// How it moves that.
    pub path: AxisPath,
    /// The value at which the poses of the cell file and of programs hold, as programs write it.
    pub zero: f64,
    /// Millimetres or degrees of one written unit.
    pub per_unit: f64,
}

/// What an axis moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Moves {
    /// The robot.
    Base,
    /// Frames (or mechanical units of frames), by name in lower case.
    Frames(Vec<String>),
    /// Nothing that a target depends on: a gun, a torch feeder.
    Nothing,
}

/// How an axis moves. Coordinates are those of the robot base with all axes at their zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxisPath {
    /// Along a direction.
    Linear(Unit<Vector3<f64>>),
    /// About a line through a point, m.
    Rotary(Vector3<f64>, Unit<Vector3<f64>>),
    /// Not at all.
    Still,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Linear,
    Rotary,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum MovesEntry {
    One(String),
    Several(Vec<String>),
}

/// An entry of `axes` as the file has it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AxisEntry {
    name: String,
    moves: MovesEntry,
    kind: Option<Kind>,
    direction: Option<[f64; 3]>,
    point_mm: Option<[f64; 3]>,
    #[serde(default)]
    zero: f64,
    #[serde(default = "one")]
    per_unit: f64,
}

fn one() -> f64 {
    1.0
}

impl AxisEntry {
    /// The axis, or what is wrong with it.
    pub(super) fn axis(self) -> Result<CellAxis, String> {
        let moves = match &self.moves {
            MovesEntry::One(word) if word == "base" => Moves::Base,
            MovesEntry::One(word) if word == "nothing" => Moves::Nothing,
            MovesEntry::One(frame) => Moves::Frames(vec![frame.to_lowercase()]),
            MovesEntry::Several(frames) => Moves::Frames(frames.iter().map(|frame| frame.to_lowercase()).collect()),
        };
        let is_finite = [self.zero, self.per_unit].iter().all(|number| number.is_finite());
        if !is_finite || self.per_unit == 0.0 {
            return Err(format!("axis `{}` has a `zero` or `per_unit` that is no use", self.name));
        }
        let path = match moves {
            Moves::Nothing => AxisPath::Still,
            _ => self.path()?,
        };
        Ok(CellAxis { name: self.name.to_lowercase(), moves, path, zero: self.zero, per_unit: self.per_unit })
    }

    fn path(&self) -> Result<AxisPath, String> {
        let name = &self.name;
        let direction = self.direction.map(Vector3::from).and_then(|direction| Unit::try_new(direction, 1e-9));
        let Some(direction) = direction.filter(|direction| direction.iter().all(|x| x.is_finite())) else {
            return Err(format!("axis `{name}` needs `direction: [x, y, z]`, which has a length"));
        };
        match (self.kind, self.point_mm) {
            (Some(Kind::Linear), None) => Ok(AxisPath::Linear(direction)),
            (Some(Kind::Rotary), Some(point)) if point.iter().all(|x| x.is_finite()) => {
                Ok(AxisPath::Rotary(Vector3::from(point.map(m_from_mm)), direction))
            }
            (Some(Kind::Rotary), _) => Err(format!("axis `{name}` turns about a line: it needs `point_mm: [x, y, z]`")),
            (Some(Kind::Linear), Some(_)) => Err(format!("axis `{name}` is linear: `point_mm` says nothing of it")),
            (None, _) => Err(format!("axis `{name}` needs `kind: linear` or `kind: rotary`")),
        }
    }
}

impl CellAxis {
    /// The displacement of what the axis carries, from its zero to a written value, in the coordinates of
    /// [`AxisPath`].
    pub fn displacement(&self, value: f64) -> Pose {
        let amount = (value - self.zero) * self.per_unit;
        match self.path {
            AxisPath::Still => Pose::identity(),
            AxisPath::Linear(direction) => {
                Pose { translation: direction.into_inner() * m_from_mm(amount), ..Pose::identity() }
            }
            AxisPath::Rotary(point, direction) => {
                let rotation = Rotation3::from_axis_angle(&direction, rad_from_deg(amount)).into_inner();
                Pose { rotation, translation: point - rotation * point }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(text: &str) -> Result<CellAxis, String> {
        let entry: AxisEntry = serde_yaml::from_str(text).map_err(|error| error.to_string())?;
        entry.axis()
    }

    #[test]
    fn tracks_shift_and_tables_turn() {
        let track = axis("{name: E1, kind: linear, moves: base, direction: [0, -2, 0], zero: 100}").expect("sound");
        assert_eq!((track.name.as_str(), &track.moves), ("e1", &Moves::Base));
        assert!((track.displacement(600.0).translation - Vector3::new(0.0, -0.5, 0.0)).norm() < 1e-15);
        let table = "{name: eax_b, kind: rotary, moves: [Table], direction: [0, 0, 1], point_mm: [1000, 0, 0]}";
        let table = axis(table).expect("sound");
        let quarter = table.displacement(90.0);
        // The point at x = 1.2 m, beside the axis, goes to y = 0.2 m; the axis itself stays.
        assert!((quarter.transform_point(&Vector3::new(1.2, 0.0, 0.3)) - Vector3::new(1.0, 0.2, 0.3)).norm() < 1e-12);
        assert!((quarter.transform_point(&Vector3::new(1.0, 0.0, 9.0)) - Vector3::new(1.0, 0.0, 9.0)).norm() < 1e-12);
        assert_eq!(axis("{name: J7, moves: nothing}").expect("sound").displacement(77.0), Pose::identity());
    }

    #[test]
    fn what_is_missing_is_said() {
        for (entry, says) in [
            ("{name: E1, moves: base}", "direction"),
            ("{name: E1, moves: base, direction: [0, 0, 0], kind: linear}", "direction"),
            ("{name: E1, moves: base, direction: [1, 0, 0]}", "kind"),
            ("{name: E1, moves: base, direction: [1, 0, 0], kind: rotary}", "point_mm"),
            ("{name: E1, moves: nothing, per_unit: 0}", "per_unit"),
            ("{name: E1, move: base}", "unknown field"),
        ] {
            let said = axis(entry).expect_err(entry);
            assert!(said.contains(says), "{entry}: {said}");
        }
    }
}

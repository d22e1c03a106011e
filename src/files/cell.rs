//! Cell files: `falsetarget/cell/1`. What programs name but do not hold: tools, frames and additional axes.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::base::text::Source;
use crate::geometry::pose::Pose;
use crate::model::robot::Mass;

use super::axes::{AxisEntry, CellAxis};
use super::error::FileError;
use super::robot::MassEntry;
use super::yaml::{PoseEntry, complain, parse};

/// The word in the first line.
pub const SCHEMA: &str = "falsetarget/cell/1";

/// A tool of the cell.
#[derive(Clone, Debug, PartialEq)]
pub enum CellTool {
    /// The very point that the recordings measured, as calibration found it.
    Measured,
    /// A TCP in the flange, and its load if declared.
    Pose {
        /// `flange_T_tool`.
        flange_t_tool: Pose,
        /// Mass in the flange.
        payload: Option<Mass>,
    },
}

/// The cell: tools and frames by name, names in lower case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// Tools.
    pub tools: BTreeMap<String, CellTool>,
    /// `base_T_frame`, with all additional axes at their zero.
    pub frames: BTreeMap<String, Pose>,
    /// Additional axes; of two that move the same, the first carries the second.
    pub axes: Vec<CellAxis>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CellEntry {
    schema: String,
    #[serde(default)]
    tools: BTreeMap<String, ToolEntry>,
    #[serde(default)]
    frames: BTreeMap<String, PoseEntry>,
    #[serde(default)]
    axes: Vec<AxisEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ToolEntry {
    #[serde(default)]
    measured: bool,
    xyz_mm: Option<[f64; 3]>,
    rpy_deg: Option<[f64; 3]>,
    payload: Option<MassEntry>,
}

/// Reads a cell file.
///
/// # Errors
/// [`FileError`] with the place.
pub fn read(source: &Source) -> Result<Cell, FileError> {
    let entry: CellEntry = parse(source, "a cell file (schema: falsetarget/cell/1)")?;
    if entry.schema != SCHEMA {
        let message = format!("the schema is `{}`; expected `{SCHEMA}`", entry.schema);
        return Err(complain(source, "schema", None, "schema", message));
    }
    let mut cell = Cell::default();
    for (name, tool) in entry.tools {
        let wrong = |what: &str| complain(source, "tools", None, "tool", format!("tool `{name}` {what}"));
        let tool = match (tool.measured, tool.xyz_mm) {
            (true, None) if tool.rpy_deg.is_none() && tool.payload.is_none() => CellTool::Measured,
            (false, Some(xyz_mm)) => {
                let pose = PoseEntry { xyz_mm, rpy_deg: tool.rpy_deg.unwrap_or_default() };
                if tool.payload.is_some_and(|payload| !payload.is_sound()) {
                    return Err(wrong("has a payload whose mass is negative or not finite"));
                }
                CellTool::Pose {
                    flange_t_tool: pose.pose().ok_or_else(|| wrong("has a number that is not finite"))?,
                    payload: tool.payload.map(|payload| payload.mass()),
                }
            }
            _ => return Err(wrong("needs either `measured: true` alone or `xyz_mm`")),
        };
        cell.tools.insert(name.to_lowercase(), tool);
    }
    for (name, frame) in entry.frames {
        let pose = frame.pose().ok_or_else(|| {
            complain(source, "frames", None, "frame", format!("frame `{name}` has a number that is not finite"))
        })?;
        cell.frames.insert(name.to_lowercase(), pose);
    }
    for (index, axis) in entry.axes.into_iter().enumerate() {
        let wrong = |message: String| complain(source, "axes", Some(index), "axis", message);
        let axis = axis.axis().map_err(wrong)?;
        if cell.axes.iter().any(|other| other.name == axis.name) {
            return Err(wrong(format!("axis `{}` stands here twice", axis.name)));
        }
        cell.axes.push(axis);
    }
    Ok(cell)
}

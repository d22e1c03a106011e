//! Target lists in CSV: one header row, one target a row. No robot's own format: every column's unit and convention has
//! to stand in the file.
//!
//! # Columns (any order, any case; others are kept and not read)
//! * `x`, `y`, `z` (also `pos_x`, ..) with their unit: `x_mm`, `x_m`, `x_inch`, `x [mm]`, `x (mm)`.
//! * Orientation, one of: `qw`, `qx`, `qy`, `qz` (unit quaternion); `roll`, `pitch`, `yaw` (R = Rz(yaw) Ry(pitch) Rx(roll));
//!   `w`, `p`, `r` (FANUC's and RoboDK's, the same); `o`, `a`, `t` (Kawasaki's, R = Rz Ry Rz); `rx`, `ry`, `rz` or
//!   `a`, `b`, `c` or `i`, `j`, `k`, which mean different things to different people and need `orientation=` (see `stated`).
//!   Angles with their unit: `rx_deg`, `rx [rad]`.
//! * `j1` to `j6` with their unit: a joint target where the row has no pose, else the solution to stay near.
//! * `name` (or `id`, `label`), `tool`, `frame`, `motion`; `e1`, `e2`, ..: additional axes, kept.
//!
//! Units may be stated once instead: `# falsetarget: units=mm,deg`. What stands nowhere is not guessed: the list is
//! refused with what to state. Comma, semicolon or tab, as the header has it; cells may be quoted; `#` opens a comment
//! line. Positions without orientation are refused: a correction turns the tool, which such a list cannot hold.

mod header;
mod reader;
mod row;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// CSV target lists.
pub struct Csv;

static META: Meta = Meta {
    id: "csv",
    title: "CSV target list",
    extensions: &["csv"],
    code_page: None,
    numbers: NumberRules { max_decimals: 9, integers_may_gain_point: true },
};

impl Dialect for Csv {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        reader::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

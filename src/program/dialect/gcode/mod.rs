//! G-code for robots (ISO 6983 and its relatives: KUKA.CNC, Sinumerik Run MyRobot, CAM exports) with six axis words.
//!
//! # What is read
//! * Blocks of words: `N10 G1 X.. Y.. Z.. A.. B.. C.. F..`, also `A2= B2= C2=` and `A3= B3= C3=` (Sinumerik). Modal: a
//!   word that is left out is that of the block before. A corrected block gets all six, or blocks would take over
//!   corrected numbers of others.
//! * `G0`, `G1`; `G90`, `G91`; `G20`, `G21`, `G70`, `G71` (inches, millimetres; millimetres stand in the text, or are
//!   stated); work offsets `G54` to `G59`, `G54.1 P..`, `G505` to `G599`: the frame of that name; `T5 M6`: tool `T5`.
//! * What the orientation words mean stands in no G-code. It has to be stated in a comment (see `stated`):
//!   `(falsetarget: orientation=euler-zyx)`: A, B, C are the convention's numbers in this order, degrees;
//!   `orientation=tool-axis,+x`: `A3=`, `B3=`, `C3=` are the axis from the tool's tip to its holder (Sinumerik
//!   programming manual, job planning), parts that are not given are zero. Sinumerik's `ORIEULER` and `ORIRPY` depend on
//!   machine data, so they do not count as a statement.
//! * `G91`, `G53`, radius compensation, cycles, shifts, parameters (`X#1`, `X=R1`): computed.
//! * `G2`, `G3`: a circle is given by its centre. Corrected ends would not lie on it: the program is refused, with the
//!   block. CAM systems export arcs as short lines.
//!
//! Coordinates without a decimal point are read as millimetres (or inches); some controls read increments: a warning.

mod block;
mod modal;
mod numbers;
mod reader;
mod recognise;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// G-code with six axis words.
pub struct GCode;

static META: Meta = Meta {
    id: "gcode",
    title: "G-code with rotary words",
    extensions: &["nc", "cnc", "mpf", "spf", "gcode", "ngc", "tap", "iso"],
    code_page: None,
    // Controls count in 0.1 or 0.01 micrometres at best; longer numbers are alarms on some.
    numbers: NumberRules { max_decimals: 6, integers_may_gain_point: true },
};

impl Dialect for GCode {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        recognise::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

//! FANUC TP programs in ASCII form (`.ls`), R-30iA, R-30iB and alike.
//!
//! A file holds `/PROG name`, attributes, numbered statements under `/MN` that end in `;`, and the points under `/POS`.
//! What is read: the points with group 1, the robot; motion statements (`J`, `L`, `C`, `A`, `S`), selections of frame
//! and tool, and statements that change a point or a frame at run time. Everything else stays opaque: further groups,
//! options, nested `P-SPS` blocks, remarked lines (`//J P[1] ..`).
//!
//! Option words are translated on localized controllers (`ZEIT VOR .10sek`, `WKZ_Offset ,PR[3]`, `KONFIG`), so motions
//! are told by their letter and `P[`, displacements by the `PR[` or `VR[` that they name, and configurations by their
//! quotes.
//!
//! # What is known, and from where
//! * Orientation: W, P, R about fixed X, Y, Z; R = Rz(R) Ry(P) Rx(W). Millimetres and degrees.
//! * Configuration: see `configuration`.
//! * Every point carries the numbers of its frame (UF) and tool (UT). The controller stops with an alarm where they
//!   differ from the selected ones, so the stored ones hold, unless a register selects. Number 0 is the world and the
//!   mechanical interface. The frames' values are not in the program.
//! * Controllers print three decimals in a field of ten columns behind `=`; files with six decimals, written for real
//!   controllers by other tools, are found, and a real has four bytes. Where three decimals of a degree are too coarse
//!   more are written.
//! * `RX`, `RY`, .. `RR` are found in programs with stationary tools (remote TCP); what they refer to is not known here.

mod block;
mod configuration;
mod motion;
mod points;
mod reader;
mod section;
mod statement;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// FANUC TP.
pub struct Fanuc;

static META: Meta = Meta {
    id: "fanuc",
    title: "FANUC TP (ASCII .ls)",
    extensions: &["ls"],
    code_page: None,
    numbers: NumberRules { max_decimals: 6, integers_may_gain_point: true },
};

impl Dialect for Fanuc {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        section::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

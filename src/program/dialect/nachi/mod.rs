//! Nachi and OTC-Daihen robot language (SLIM) as text, AX and FD controllers (`.001`, `MZ07-A.010`).
//!
//! What is read: `MOVEX` with a pose (`M1X`) or joint values (`M1J`) in brackets or in a pose variable, its tool `H=`,
//! its interpolation (`P`, `L`, `C1`, `C2`) and further mechanisms (`M2J`); `P1=(..)`; `MODUSRCOORD`, `CHGCOORD`, `SETTOOL` and
//! shifts. Everything else stays opaque.
//!
//! # What is known, and from where
//! No program that a controller wrote was found: what a controller stores is binary. The text form follows two programs that
//! write it (the RoboDK post for AX and FD, the downloader of CENIT for OTC-Daihen FD19) and one that reads it.
//! * `(x,y,z,rz,ry,rx)`: the turn about Z stands first; R = Rz Ry Rx. Millimetres and degrees. Both writers agree.
//! * `M1X` is a pose in the robot's base, or in the user coordinates that `CHGCOORD` selects. Other letters (`M1XW`, `M1E`) are
//!   left alone.
//! * `CONF=0001`: digits of the posture, of which no table was found; they are kept and ask for nothing.
//! * The writers give two to five decimals; no more than five are written.

mod line;
mod reader;

#[cfg(test)]
mod tests;

use crate::base::text::{Encoding, Source};
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// Nachi SLIM.
pub struct Nachi;

static META: Meta = Meta {
    id: "nachi",
    title: "Nachi / OTC-Daihen SLIM",
    extensions: &["nachi"],
    code_page: Some(Encoding::ShiftJis),
    numbers: NumberRules { max_decimals: 5, integers_may_gain_point: true },
};

impl Dialect for Nachi {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        source.lines().any(|line| line::is_motion(source.bytes(), line))
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

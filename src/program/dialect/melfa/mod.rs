//! Mitsubishi MELFA-BASIC IV, V and VI (`.prg`, `.mb4`, `.mb5`, `.mb6`), with and without line numbers.
//!
//! # What is read
//! * `P1=(x,y,z,a,b,c,l1,l2)(fl1,fl2)`: millimetres and degrees, R = Rz(c) Ry(b) Rx(a) (Basler's and Mech-Mind's tables of
//!   pose formats; MELFA manual BFP-A8787, tool data (0,0,100,45,-90,0)); `J1=(j1,..,j8)`: degrees. In the program or in
//!   the list of positions behind it. Numbers that are left out are zero. `L1`, `L2` are additional axes.
//! * `Mov`, `Mvs`, `Mva`; `Mvr` start, via, end; `Mvr2` start, end, a point of the circle; `Mvc` three points of a circle;
//!   positions written in the move. `Mvs P1,-50` (back along the tool) goes where the correction of `P1` takes it:
//!   that use is computed. `Mvr3` (centre): computed.
//! * `Tool (..)`, `Tool PT`, `M_Tool=1`: tools; `Base (..)` gives the robot's base in the world, in which positions then
//!   are; `Base 1`: work coordinate system 1 of the cell file.
//! * FL1: bit 2 right (1) or left, bit 1 above or below, bit 0 non-flip or flip. That right is in front and non-flip a
//!   positive J5 is inferred from positions that point down, which have 7. FL2 = 0: J1, J4, J6 within half a turn.
//! * A variable that gets a second value, a part of one (`P1.Z=`), sums and products, compliance (`Cmp`, `Fsc`),
//!   tracking (`Trk`): computed.

mod reader;
mod statement;

#[cfg(test)]
mod tests;

use crate::base::text::{Encoding, Source};
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::script::Lexis;
use super::{Dialect, Meta};

/// Mitsubishi MELFA-BASIC.
pub struct Melfa;

static META: Meta = Meta {
    id: "melfa",
    title: "Mitsubishi MELFA-BASIC",
    extensions: &["prg", "mb4", "mb5", "mb6"],
    code_page: Some(Encoding::ShiftJis),
    // Position variables are single precision: seven digits.
    numbers: NumberRules { max_decimals: 4, integers_may_gain_point: true },
};

const LEXIS: Lexis = Lexis {
    comments: &["'"],
    comment_words: &["REM"],
    quotes: b"\"",
    in_names: b".$#",
    brackets_join: false,
    carries_on: None,
    divides: Some(b':'),
};

impl Dialect for Melfa {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        statement::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

//! Comau PDL2 (`.pdl`), C4G and C5G.
//!
//! # What is read
//! * `POS(x,y,z,e1,e2,e3,'config')`: millimetres and degrees, R = Rz(e1) Ry(e2) Rz(e3); `POS(0)`; `{j1,..,j6}`: degrees;
//!   `XTNDPOS(POS(..), , , (aux))`. Written in the move, or assigned to a variable once.
//! * `MOVE`, `MOVEFLY` with `LINEAR`, `JOINT` or `CIRCULAR`, `TO`, `VIA`, `ARM[1]`. `NEAR`, `AWAY`, `RELATIVE`, `ABOUT`,
//!   `BY`: computed.
//! * `$TOOL`, `$BASE`, `$UFRAME`: tool in the flange, robot base in the world, user frame in the world; assigned, or `WITH`
//!   one move. Positions are in the user frame. Other values of them are known at run time.
//! * Configuration: `S` rear, `E` elbow the other way, `W` joint 5 negative; `T1:`, `T2:`, `T3:` turns of joints 4, 6 and 3:
//!   0 from -180 to 180 degrees. From a post processor (RoboDK's Comau C5G), which is the source for the angles too.
//! * A variable that is set twice, a part of one, variables handed to routines: computed. Positions usually stand in a
//!   binary `.var` beside the program: computed.

mod clause;
mod frames;
mod reader;
mod value;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::script::Lexis;
use super::{Dialect, Meta};

/// Comau PDL2.
pub struct Pdl2;

static META: Meta = Meta {
    id: "pdl2",
    title: "Comau PDL2",
    extensions: &["pdl"],
    code_page: None,
    // REAL is single precision: seven digits.
    numbers: NumberRules { max_decimals: 5, integers_may_gain_point: true },
};

const LEXIS: Lexis = Lexis {
    comments: &["--"],
    comment_words: &[],
    quotes: b"'",
    in_names: b"$",
    brackets_join: true,
    carries_on: Some(b'&'),
    divides: Some(b';'),
};

impl Dialect for Pdl2 {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        clause::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

//! Denso PAC and PacScript (`.pac`, `.pcs`), NetwoRC to RC8.
//!
//! # What is read
//! * `P1 = (x,y,z,rx,ry,rz[,fig])`, `P[1] = P(..)`: millimetres and degrees; `J1 = (..)`, `J(..)`: degrees. `P1`, `P01`
//!   and `P[1]` are one variable; `#DEFINE name P1` names it. Names with `DEFPOS`, `DEFJNT`, `DIM .. AS POSITION|JOINT`.
//! * R = Rz(rz) Ry(ry) Rx(rx): the RC8 manual (ID 5210) calls RX, RY, RZ yaw, pitch and roll, rotated in the order RZ,
//!   RY, RX, which are Paul's names and order (Robot Manipulators, 1981, chapter 2). A post processor that writes Z-Y-Z
//!   angles contradicts it.
//! * `MOVE P|L|C|S, [@0|@P|@E|@n] pose[, options]`; `MOVE C, via, end`; `SETSPLINEPOINT n, pose`. Positions written in the
//!   move. `APPROACH` goes along with the correction of its position: computed; so are `DEPART`, `DRAW`, `DRIVE`,
//!   `DRIVEA`, `EX(..)` and sums of positions.
//! * `CHANGETOOL n`, `CHANGEWORK n`: tool and frame of that number, from `TOOL n, pose` and `WORK n, pose` of the program or
//!   from the cell file. `LETX P1 = ..` and a second value make a variable computed. Type T is computed.
//! * FIG is kept and not read: which bit means what could not be confirmed. The solution next to the position before is
//!   taken.

mod reader;
mod statement;

#[cfg(test)]
mod tests;

use crate::base::text::{Encoding, Source};
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::script::Lexis;
use super::{Dialect, Meta};

/// Denso PAC and PacScript.
pub struct Denso;

static META: Meta = Meta {
    id: "denso",
    title: "Denso PAC, PacScript",
    extensions: &["pac", "pcs"],
    code_page: Some(Encoding::ShiftJis),
    // Position variables are single precision: seven digits.
    numbers: NumberRules { max_decimals: 4, integers_may_gain_point: true },
};

const LEXIS: Lexis = Lexis {
    comments: &["'"],
    comment_words: &["REM"],
    quotes: b"\"",
    in_names: b"$",
    brackets_join: false,
    carries_on: None,
    divides: Some(b':'),
};

impl Dialect for Denso {
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

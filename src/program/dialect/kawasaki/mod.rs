//! Kawasaki AS programs and controller saves (`.as`, `.pg`), C to F controllers.
//!
//! A file holds `.PROGRAM name(.arg)` .. `.END` and, when it is a save of a controller, data sections: `.TRANS` (poses by
//! name), `.JOINTS` (joint positions, `#name`) and many that stay opaque. What is read: these two sections; location
//! values in statements (`TRANS(..)`, `#PPOINT(..)`, `#[..]`); motions (`JMOVE`, `LMOVE`, `C1MOVE`, `LAPPRO`, arc welding
//! `LWS`.., block steps `JOINT SPEED9 .. #[..]`); compound locations (`a+b`, `p+TRANS(..)`, `SHIFT(p BY ..)`); `POINT`,
//! `HERE` and `CALL`, which change a location; `TOOL`, `BASE`, `WEIGHT`. Everything else stays opaque.
//!
//! # What is known, and from where
//! * Statements and sections: AS Language Reference Manual (Kawasaki 90209-1017), full saves of three real controllers.
//! * Orientation: O, A, T about Z, Y', Z''; R = Rz(O) Ry(A) Rz(T). Millimetres and degrees. Where A is 0 or 180 only the
//!   sum or difference of O and T counts: the written O is kept.
//! * `a+b` is the pose b seen from a. `SHIFT(p BY x,y,z)` moves along the axes of the base.
//! * Names do not tell case. `.name` is local to its program; all others belong to the controller.
//! * Saves write six decimals, a real has four bytes: no more than six are written.
//! * A location without configuration: the solution near the joints before is taken. `ABOVE` and `BELOW` hold for the next
//!   motion. What `LEFTY`, `RIGHTY`, `UWRIST` and `DWRIST` mean on a given arm is told only by the manual's pictures, and
//!   nothing is concluded from them.
//! * `TOOL` and `BASE` stay selected after a program has ended. Where a save selects none in its programs, those of its
//!   system data hold.
//! * `WEIGHT m,x,y,z,..`: the load behind the flange. That x, y, z are given in the flange and not in the tool is inferred
//!   from a real cell (100 mm in front of a flange whose gripper is turned by 90 degrees).

mod assignment;
mod expression;
mod motion;
mod reader;
mod section;
mod selection;
mod statement;
mod target;
mod ties;
mod value;

#[cfg(test)]
mod tests;

use crate::base::text::{Encoding, Source};
use crate::program::number::NumberRules;
use crate::program::target::Program;
use crate::program::ties::Ties;

use super::{Dialect, Meta};

/// Kawasaki AS.
pub struct Kawasaki;

static META: Meta = Meta {
    id: "kawasaki",
    title: "Kawasaki AS",
    extensions: &["as", "pg", "lc"],
    code_page: Some(Encoding::ShiftJis),
    numbers: NumberRules { max_decimals: 6, integers_may_gain_point: true },
};

impl Dialect for Kawasaki {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        section::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }

    fn ties(&self, source: &Source) -> Ties {
        ties::ties(source)
    }
}

//! Doosan DRL (Doosan Robot Language), a Python with motion commands: `.drl`, scripts for the controller or for ROS nodes.
//!
//! # What is read
//! * `posx(x,y,z,a,b,c)`: millimetres and degrees, R = Rz(a) Ry(b) Rz(c); `posj(..)`: degrees; also with a list in it,
//!   and bare lists, which are joints in `movej` and poses in `movel`. Written in the move, or held by a name that gets
//!   one value in its scope.
//! * `movej`, `movel`, `movejx`, `movec`, `movesj`, `movesx` and their asynchronous forms (`amovej`, ..).
//! * `ref=`, `set_ref_coord`: `DR_BASE` (0) is the robot's base, `DR_WORLD` (2) the frame `world`, 101 and following the
//!   frames of that number in the cell file; `DR_TOOL` is computed. `mod=DR_MV_MOD_REL`: computed.
//! * `set_tcp("name")`: the tool of that name in the cell file; followed as far as the text says.
//! * `sol=0..7` of `movejx`: lefty or righty, elbow below or above, wrist not flipped or flipped, one bit each (4, 2, 1).
//!   That the pose of `posj(0,0,90,0,90,0)` is solution 2, so that lefty is in front and no flip a positive joint 5, is
//!   inferred from examples of the vendor.
//! * `trans(..)`, elements that are set, parameters, loops, `moveb`: computed.

mod motion;
mod names;
mod reader;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::script::Lexis;
use super::{Dialect, Meta};

/// Doosan DRL.
pub struct Drl;

static META: Meta = Meta {
    id: "drl",
    title: "Doosan DRL",
    extensions: &["drl"],
    code_page: None,
    numbers: NumberRules { max_decimals: 9, integers_may_gain_point: true },
};

const LEXIS: Lexis = Lexis {
    comments: &["#"],
    comment_words: &[],
    quotes: b"\"'",
    in_names: b"",
    brackets_join: true,
    carries_on: Some(b'\\'),
    divides: Some(b';'),
};

impl Dialect for Drl {
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

//! Universal Robots URScript (`.script`, `.urscript`), CB3 and e-Series, by hand or exported from the pendant.
//!
//! What is read: moves to poses and joint lists, written in the move or held by a variable; `get_inverse_kin`, whose
//! `qnear` tells the solution; `pose_trans` of constants; `set_tcp`; `set_payload`. The rest stays opaque.
//!
//! # What is known, and from where
//! * `p[x,y,z,rx,ry,rz]`: metres and a rotation vector in radians, in the robot base; `[q1,..,q6]`: radians. A move takes
//!   either. Real programs and exports of the pendant.
//! * A variable counts as a constant when it gets one value in the file, or when the function that moves there has no
//!   branches and no other function sets it. Parameters, elements that are set and arithmetic are known at run time.
//! * `pose_trans(a, b)`: b in the frame a. Where a move goes to a as well, b is a displacement of that target along its
//!   own axes, and moves with it; else a is a frame.
//! * `set_tcp` holds in the order of the text, up to a branch, loop, function or call (see `selection`).
//! * `set_payload(m, cog)`: everything behind the flange, cog in the flange. It counts where the TCP is set in the program
//!   too. Without a centre of gravity it is not used: controllers differ in what they take instead.
//! * The language has no configuration data: the solution next to the joints before is taken.

mod expression;
mod motion;
mod reader;
mod recognise;
mod statement;
mod targets;
mod token;
mod tool;
mod value;
mod variable;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// Universal Robots URScript.
pub struct UrScript;

static META: Meta = Meta {
    id: "urscript",
    title: "Universal Robots URScript",
    extensions: &["script", "urscript"],
    code_page: None,
    numbers: NumberRules { max_decimals: 12, integers_may_gain_point: true },
};

impl Dialect for UrScript {
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

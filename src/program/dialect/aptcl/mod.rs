//! APT cutter location text (APT-CL, CLSF, `.apt`, `.cls`): what CAM systems write before a post processor (ISO 4343,
//! formerly ANSI X3.37).
//!
//! # What is read
//! * `GOTO/x,y,z,i,j,k`: the tool's tip, and its axis from tip to holder; the axis that is left out is that of the `GOTO`
//!   before. A corrected `GOTO` writes it. `FROM` gives an axis, not a goal.
//! * A tool axis leaves the tool's turn about it open. The post processor has a rule for it, and the arm's error depends
//!   on it: it has to be stated, `$$ falsetarget: orientation=tool-axis,+x` or `PPRINT falsetarget: ..` (see `stated`).
//! * `UNITS/MM`, `UNITS/INCHES`, or stated. `LOADTL/5`, `TOOLNO/5`, `LOAD/TOOL,5`: tool `T5`. The frame is `work` unless
//!   stated: no word of the format names it; a second, different `MSYS` makes it computed.
//! * `RAPID`, `FEDRAT` and all other words stay opaque. `$` continues a statement, `$$` opens a comment.
//! * `CYCLE`, `TRACUT`, `ORIGIN`, `TRANS`, `COPY`, `ROTATE`, `ROTABL`, `CUTCOM`, `GODLTA`, `GOTO/name`: computed.
//! * `CIRCLE`, `MOVARC`, `GOFWD`: arcs about a centre: refused, like `GOTO` without any axis (`MULTAX/OFF`): a correction
//!   tilts the tool, which three numbers cannot hold.

mod reader;
mod statement;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// APT cutter location text.
pub struct AptCl;

static META: Meta = Meta {
    id: "aptcl",
    title: "APT cutter location text",
    extensions: &["apt", "aptsource", "cls", "clsf", "cl", "ncl"],
    code_page: None,
    numbers: NumberRules { max_decimals: 9, integers_may_gain_point: true },
};

impl Dialect for AptCl {
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

//! Yaskawa (Motoman) INFORM jobs (`.jbi`), NX100 to YRC1000.
//!
//! A job holds `/JOB`, `//NAME`, positions under `//POS` and instructions under `//INST`. The position section is
//! modal: `///TOOL`, `///USER`, `///POSTYPE` and `///RCONF` hold for all positions behind them until they are given
//! again. What is read: step positions (`C00012`), position variables (`P00124`), the values of base and station axes
//! (`BC`, `EC`) of the same step, `MOVJ`, `MOVL`, `MOVC`, `MOVS`, and what changes a position, a frame or all of them
//! at run time. Everything else stays opaque.
//!
//! # What is known, and from where
//! * Structure: NX100 and DX100 manuals, chapter 4.1; real jobs of a YRC1000. Comments may stand anywhere, also before
//!   `/JOB`; ` //text` behind a move is a comment.
//! * Orientation: Rx, Ry, Rz about fixed X, Y, Z; R = Rz Ry Rx. Millimetres and degrees. Configuration: see
//!   `configuration`.
//! * Pulse positions need the robot's pulse counts, which robot files do not hold: they are left alone.
//! * `BASE` and `ROBOT` are the same frame unless a base axis carries the robot.
//! * Controllers write three decimals of a millimetre and four of a degree (YRC1000; older ones two). The controller
//!   itself counts in units of the last of them, so no more than four are written. An older controller rounds more.
//! * Each `MOVC` ends one piece of an arc and begins the next.

mod assignment;
mod configuration;
mod job;
mod motion;
mod positions;
mod reader;

#[cfg(test)]
mod tests;

use crate::base::text::{Encoding, Source};
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// Yaskawa INFORM.
pub struct Inform;

static META: Meta = Meta {
    id: "inform",
    title: "Yaskawa INFORM (.jbi)",
    extensions: &["jbi"],
    code_page: Some(Encoding::ShiftJis),
    numbers: NumberRules { max_decimals: 4, integers_may_gain_point: true },
};

impl Dialect for Inform {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        job::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

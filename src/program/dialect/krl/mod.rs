//! KUKA KRL (KSS 5 to 8: `.src`, `.dat`, `.sub`).
//!
//! A program is a `.src` and the `.dat` of the same name; tools, bases, loads and home positions stand in `$config.dat`,
//! which all programs of a controller share. These files are one job.
//!
//! What is read: routines and data lists; declarations and assignments of positions, frames, loads and frame data;
//! every motion to a position, point to point, linear, circular or spline; `$TOOL`, `$BASE`, `$LOAD` and `$IPO_MODE`,
//! set directly, by `BAS`, by `WITH`, or by an inline form. Execution follows the statements: what an inline form says in
//! its `;FOLD` line is a comment. Everything else stays opaque.
//!
//! A position is told from other aggregates by a motion that goes there, never by its shape. Millimetres, degrees,
//! R = Rz(A) Ry(B) Rx(C).
//!
//! # What is known, and from where
//! * Grammar, status and turn: KUKA System Software 8, Operating and Programming Instructions for System Integrators;
//!   KRL reference guide. `BAS` and the functions of spline inline forms: KUKA's `bas.src` in public controller images.
//! * Status and turn agree with taught points of a KR 210 R2700 in such an image.
//! * Controllers hold numbers in single precision; files show up to eleven decimals. No more than six are written:
//!   that is below the resolution of single precision from 8 mm (or degrees) on.
//! * Inferred: with `$IPO_MODE = #TCP` a position is that of `$BASE` (the stationary tool) in `$TOOL` (the work piece).

mod aggregate;
mod calls;
mod checks;
mod configuration;
mod frames;
mod job;
mod motion;
mod position;
mod reader;
mod recognise;
mod reference;
mod setting;
mod statement;
mod targets;
mod usage;
mod variable;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// KUKA KRL.
pub struct Krl;

static META: Meta = Meta {
    id: "krl",
    title: "KUKA KRL",
    extensions: &["src", "dat", "sub"],
    code_page: None,
    numbers: NumberRules { max_decimals: 6, integers_may_gain_point: true },
};

impl Dialect for Krl {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        recognise::is_krl(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }

    fn job_of(&self, file_name: &str) -> String {
        file_name.rsplit_once('.').map_or(file_name, |(stem, _)| stem).to_lowercase()
    }

    fn shared_files(&self) -> &'static [&'static str] {
        &["$config.dat"]
    }
}

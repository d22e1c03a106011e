//! Epson SPEL+ projects of RC+: programs (`.prg`), what they include (`.inc`) and point files (`.pts`).
//!
//! A project is a folder. What is read: the points of `.pts` files; in programs motions (`Go`, `Move`, `Jump`, `Jump3`, `Arc`,
//! `Arc3`, `Pass`), positions written in them (`XY(..)`, `JA(..)`, `AglToPls(..)`), assignments to points, `Tool`, `TLSet`,
//! `Local`, `Base`, the order of statements, and `#define` of points and numbers. Everything else stays opaque: options of motions, parallel processing
//! (`! .. !`), conveyors, vision.
//!
//! # What is known, and from where
//! * Files: two projects in public repositories; the Visual Components post for SPEL+, which writes both kinds.
//! * Orientation: R = Rz(U) Ry(V) Rx(W), as that post has it. Millimetres and degrees. A four-axis robot has U alone.
//! * `nUndefined` other than 0: a point that is not taught.
//! * `nHand` 1 in front, 2 behind; `nElbow` 1 above, 2 below (post; SPEL+ words `/R` `/L` `/A` `/B`). Flags 0 of joints 4 and 6:
//!   within 180 degrees. Which side of joint 5 `NoFlip` is has no source, and asks for nothing.
//! * Local 0 is the robot's base, tool 0 the flange. `P3` and its label are one point.
//! * The first line of a point file holds its size (DS) and a checksum (CS) of unknown make. Neither is changed, of which
//!   a note warns.

mod expression;
mod macros;
mod motion;
mod points;
mod reader;
mod setting;
mod statement;

#[cfg(test)]
mod tests;

use crate::base::text::{Encoding, Source};
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// Epson SPEL+.
pub struct Spel;

static META: Meta = Meta {
    id: "spel",
    title: "Epson SPEL+",
    extensions: &["prg", "pts", "inc"],
    code_page: Some(Encoding::ShiftJis),
    numbers: NumberRules { max_decimals: 6, integers_may_gain_point: true },
};

/// All files of a folder are one project.
const PROJECT: &str = "SPEL+ project";

impl Dialect for Spel {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        points::is_point_file(source) || statement::is_program(source) || macros::is_include(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }

    fn job_of(&self, file_name: &str) -> String {
        let ending = file_name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        match ending.as_str() {
            "prg" | "pts" | "inc" => PROJECT.to_owned(),
            _ => file_name.to_owned(),
        }
    }
}

//! Staubli VAL3 applications of CS8 and CS9 controllers: programs (`.pgx`) and the data that they use (`.dtx`), XML.
//!
//! An application is a folder: the project (`.pjx`), one data file and a file a program. What is read: points, joint
//! positions, frames and tools of the data file; in programs the calls `movej`, `movel`, `movec`, `appro` with a written
//! transformation, and what changes a value at run time: assignments, `link`, `setFrame`, parameters passed by reference.
//! Everything else stays opaque: values inside of user types (`Field`), libraries, other statements.
//!
//! # What is known, and from where
//! * Files: the ROS-Industrial driver for Staubli and applications of other authors, of version 6 (see `older`) and of
//!   version 7; the RoboDK post.
//! * **A value that is zero is not written.** A correction may have to insert an attribute, which goes where the
//!   development environment would write it: behind the one before it in the order x, y, z, rx, ry, rz (j1 to j6).
//! * Orientation: R = Rx(rx) Ry(ry) Rz(rz), about X, the turned Y, the turned Z. Millimetres and degrees.
//! * A point is given in the frame that `fatherId` names, and that in its own father, up to `world[0]`; a tool likewise
//!   up to `flange[0]`. `p` is `p[0]`.
//! * `shoulder`: `lefty` in front, `righty` behind; `elbow`: `epositive` where joint 3 is positive; `wrist`: `wpositive`
//!   where joint 5 is; `same` and `free` ask for nothing. From the RoboDK post and the VAL3 reference manual.
//! * `appro(p,{x,y,z,rx,ry,rz})` is that transformation seen from p.
//! * Numbers are doubles; files hold up to ten decimals. No more than nine are written.

mod change;
mod code;
mod data;
mod moves;
mod older;
mod program_file;
mod reader;
mod tree;
mod xml;

#[cfg(test)]
mod tests;

use crate::base::text::Source;
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// Staubli VAL3.
pub struct Val3;

static META: Meta = Meta {
    id: "val3",
    title: "Staubli VAL3",
    extensions: &["pgx", "dtx"],
    code_page: None,
    numbers: NumberRules { max_decimals: 9, integers_may_gain_point: true },
};

/// All files of a folder are one application.
const APPLICATION: &str = "VAL3 application";

impl Dialect for Val3 {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        xml::recognises(source.bytes())
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }

    fn job_of(&self, file_name: &str) -> String {
        let ending = file_name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        match ending.as_str() {
            "pgx" | "dtx" | "pjx" => APPLICATION.to_owned(),
            _ => file_name.to_owned(),
        }
    }
}

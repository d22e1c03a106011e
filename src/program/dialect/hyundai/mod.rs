//! Hyundai JOB: Hi4/Hi5/Hi5a jobs (`MOVE P,S=60%,A=3,T=0  (..)A`) and Hi6 jobs in HRScript
//! (`move P,spd=60%,accu=3,tool=0  [..]`). Both languages share the file name ending and most of the motion
//! grammar, so one reader takes both; only the header and the comment sign tell them apart.
//!
//! What is read: the header with its number of axes, step labels, `MOVE` and `SMOV` with the pose recorded after the
//! parameters or written among them, pose variables and constants (`P1=(..)`, `po=Pose(..)`), tools (`Tool1=(..)T`,
//! `_tool[1]=Shift(..)`), user frames (`MKUCRD`, `mkucs`), `SELUCRD` and `seltool`. Every other statement stays opaque.
//!
//! A pose is told from joint values by its suffix alone (`A`: joint axes, also under `MOVE L`); in Hi6 by the
//! coordinate system that ends the list. Orientations are fixed X-Y-Z degrees, R = Rz(rz) Ry(ry) Rx(rx).
//!
//! # What is known, and from where
//! * Constants and suffixes: HI4 controller manual, 11.1.4; HRScript manual, chapters 5.1 to 5.6; real Hi5 jobs of an
//!   HA006B. `(..)` and `[..]` are both accepted as a recorded pose in both languages.
//! * Configuration: see `configuration`. Base coordinates equal robot coordinates unless an additional axis carries
//!   the robot.
//! * Inferred: the list of a Hi6 recorded pose holds the same elements as `Pose(..)`; a real of Hi4/Hi5 has four
//!   bytes (manual: -3.4E+38 to 3.4E+38), so that at two metres a fifth decimal of a millimetre is lost: no more than
//!   four decimals are written. Files seen have three.
//! * Arcs: consecutive `MOVE C` steps pair up as via point and end point.

mod arc;
mod checks;
mod configuration;
mod definition;
mod elements;
mod expression;
mod header;
mod motion;
mod reader;
mod resolve;
mod selection;
mod statement;
mod target;
mod variable;
mod written_pose;

#[cfg(test)]
mod tests;

use crate::base::text::{Encoding, Source};
use crate::program::number::NumberRules;
use crate::program::target::Program;

use super::{Dialect, Meta};

/// Hyundai JOB, Hi4 to Hi6.
pub struct Hyundai;

static META: Meta = Meta {
    id: "hyundai",
    title: "Hyundai JOB (Hi4/Hi5, Hi6 HRScript)",
    extensions: &["job"],
    code_page: Some(Encoding::Cp949),
    numbers: NumberRules { max_decimals: 4, integers_may_gain_point: true },
};

impl Dialect for Hyundai {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        header::recognises(source)
    }

    fn read(&self, files: &[Source]) -> Program {
        reader::read(files)
    }
}

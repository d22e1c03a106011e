//! Floor 8: results as data that other programs read, as tables and as pages that people read.

pub mod calibration;
pub mod diagnosis;
pub mod html;
pub mod landing;
pub mod sketch;
pub mod tally;
pub mod targets;
pub mod trace;

//! Floor 2: robot programs as bytes with targets in them. Knows no robot: frames, tools and configuration data are
//! read and kept as the text has them.
//!
//! A dialect never changes text. It says where numbers stand and what they mean; floor 5 decides on edits.

pub mod decimal;
pub mod dialect;
pub mod flow;
pub mod gather;
pub mod number;
pub mod scan;
pub mod selection;
pub mod shared;
pub mod target;
pub mod ties;

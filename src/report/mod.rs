//! Floor 6: results as data that other programs read and as tables that people read. Draws nothing itself.

pub mod diagnosis;
pub mod landing;
pub mod tally;
pub mod targets;

//! Recordings: CSV with one header row. The columns stand in docs/files.md.
//!
//! Beside the contract's columns the tool reads `rx_deg`, `ry_deg`, `rz_deg` (orientation of the tool in the measuring
//! frame, fixed X-Y-Z angles, from trackers that measure six degrees of freedom) and `sigma_deg` (its standard
//! uncertainty about each axis). Comma, semicolon or tab separate; the header decides which.

mod columns;
mod read;
mod write;

pub use read::read;
pub use write::{Prediction, write_observations, write_predictions};

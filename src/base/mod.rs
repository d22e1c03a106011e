//! Floor 0: text, edits, diagnostics and units. Knows neither robots nor programs.

pub mod diagnostic;
pub mod edit;
pub mod text;
pub mod units;

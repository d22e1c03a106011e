//! Floor 2: what was measured. Observations and recordings as plain data; reading them from files is floor 3.

#[cfg(test)]
pub(crate) mod fixture;
pub mod observation;
pub mod recording;
pub mod repeats;

//! Identification against what it did not make itself: a simulator that follows other formulas, recordings of real arms,
//! and recordings with every mistake that people make.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "a test may stop where its own preparation fails")]

mod accuracy;
mod coverage;
mod faults;
mod recordings;
mod shelf;
mod simulator;

//! The promise of the tool: a corrected program, read again and sent through the controller's nominal inverse and the
//! real arm, lands on the intended poses; and nothing but the digits of its targets changed.

#![allow(clippy::expect_used, reason = "a test may stop where its own preparation fails")]

mod axes;
mod kuka_status;
mod left_out;
mod random_programs;
mod shipped;
mod spoil;
mod staubli_config;

/// How near the corrected program lands: position.
const LANDS_WITHIN_M: f64 = 2e-6;
/// How near the corrected program lands: orientation.
const LANDS_WITHIN_RAD: f64 = 5e-6;

//! Floor 5: a program, a cell and a model of the real arm become a corrected program and a list that says what
//! happened to every target.

mod arrivals;
mod carriers;
pub mod class;
pub mod correct;
mod digits;
mod displaced;
mod false_target;
pub mod outcome;
mod pass;
pub mod play;
mod setting;
pub mod spin;
pub mod split;
mod visits;
mod words;

pub use class::{Class, class_by_text};
pub use correct::{Job, Options, correct};
pub use outcome::{Outcome, TargetOutcome};
pub use visits::written_pose;

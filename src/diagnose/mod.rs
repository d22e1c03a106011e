//! Floor 6: what the model leaves out, found in a recording and named. See docs/diagnosis.md.

pub mod advice;
pub mod baseline;
pub mod calibration;
pub mod candidate;
pub mod check;
pub mod detection;
pub mod diagnosis;
pub mod evidence;
pub mod fitted;
pub mod free;
pub mod hold_out;
pub mod left_over;
pub mod projection;
pub mod rank;
pub mod regressors;
pub mod review;
pub mod ripple;
pub mod scan;
pub mod search;
pub mod simplify;
pub mod spectrum;
pub mod stability;
pub mod statement;
pub mod story;
pub mod updated;
pub mod worth;

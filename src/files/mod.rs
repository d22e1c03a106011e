//! Floor 3: the tool's own files. YAML and CSV in, checked values out; millimetres and degrees end here.

pub mod axes;
pub mod builtin;
pub mod calibration;
pub mod cell;
pub mod error;
pub mod recording;
pub mod robot;
pub mod settings;
mod yaml;

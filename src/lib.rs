//! Corrects robot programs for the robot that is really there.

#![deny(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, clippy::print_stderr)]

pub mod base;
pub mod cli;
pub mod diagnose;
pub mod files;
pub mod geometry;
pub mod identify;
pub mod invert;
pub mod kinematics;
pub mod measure;
pub mod model;
pub mod program;
pub mod report;
pub mod rewrite;

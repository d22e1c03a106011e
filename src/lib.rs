//! Corrects robot programs for the robot that is really there.

pub mod base;
pub mod files;
pub mod geometry;
pub mod invert;
pub mod kinematics;
pub mod model;
pub mod program;
pub mod rewrite;

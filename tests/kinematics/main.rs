//! The controller's side: forward and inverse kinematics of built-in and random arms, and the choice of a branch.

#![allow(clippy::expect_used, clippy::panic)]

mod arms;
mod choosing;
mod hard_poses;
mod oracle;
mod round_trip;

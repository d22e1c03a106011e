//! Floor 3: the controller's side. Nominal forward and inverse kinematics, and which of the solutions a program means.
//!
//! A [`controller::Controller`] is made from a robot. Its family (spherical wrist, three parallel axes, or neither) is
//! read off the axes, not off a name; the first two are solved in closed form, the rest by iteration.
//!
//! # Limitations
//! For arms in neither family every solution given is one, but a solution may be missing.

pub mod choose;
pub mod closed_form;
pub mod controller;
pub mod general;
pub mod numeric;
pub mod planar;
pub mod posture;
pub mod skeleton;
pub mod solution;
pub mod turn;
pub mod turns;
pub mod wrist;

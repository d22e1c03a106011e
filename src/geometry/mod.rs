//! Floor 1: rotations, poses and the orientation conventions of the makers. Lengths in metres, angles in radians.

pub mod orientation;
pub mod pose;
pub mod real;

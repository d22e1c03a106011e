//! Floor 4: from the pose that is meant to the command that makes the real arm take it.

mod newton;

pub use newton::{Correction, InversionError, MeantPose, RealArm};

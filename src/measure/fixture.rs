//! Records for tests.

use crate::model::robot::DOF;

use super::observation::Observation;

/// A record that says nothing but its joint numbers.
pub fn observation(numbers_rad: [f64; DOF]) -> Observation {
    Observation { id: "1".into(), line: 2, ..Observation::unmeasured(numbers_rad) }
}

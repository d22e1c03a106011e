//! Records for tests.

use crate::model::conditions::Conditions;
use crate::model::robot::DOF;

use super::observation::Observation;

/// A record that says nothing but its joint numbers.
pub fn observation(numbers_rad: [f64; DOF]) -> Observation {
    Observation {
        id: "1".into(),
        station: None,
        numbers_rad,
        conditions: Conditions::default(),
        measured: None,
        sigma_m: None,
        sigma_rad: None,
        set: None,
        line: 2,
    }
}

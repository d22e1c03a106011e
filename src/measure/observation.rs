//! One record: where the controller says the joints stood, and where the tracker saw the tool.

use nalgebra::{Matrix3, Vector3};

use crate::model::conditions::Conditions;
use crate::model::robot::DOF;

/// Who may use a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SetName {
    /// Identification of parameters.
    Identify,
    /// Training of the learner on top.
    Train,
    /// Nothing but the final figures.
    Validate,
}

impl SetName {
    /// The sets with their words in files.
    pub const ALL: [(&'static str, SetName); 3] =
        [("identify", SetName::Identify), ("train", SetName::Train), ("validate", SetName::Validate)];

    /// The word in files.
    pub fn word(self) -> &'static str {
        match self {
            SetName::Identify => "identify",
            SetName::Train => "train",
            SetName::Validate => "validate",
        }
    }
}

/// What the tracker saw, in the measuring frame of the record's station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The tool point, m.
    pub position_m: Vector3<f64>,
    /// `measuring_R_tool`, where the tracker also measures orientation.
    pub rotation: Option<Matrix3<f64>>,
}

impl Measured {
    /// Numbers that this measurement gives: three, or six with an orientation.
    pub fn numbers(&self) -> usize {
        if self.rotation.is_some() { 6 } else { 3 }
    }
}

/// One record of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Its name: the `id` column, or its number in the file counted from one. Not necessarily unique.
    pub id: String,
    /// Where the tracker stood, by name.
    pub station: Option<String>,
    /// What the controller showed or was told, rad.
    pub numbers_rad: [f64; DOF],
    /// The circumstances.
    pub conditions: Conditions,
    /// What was measured; `None` for a pose that is only to be predicted, or where the tracker saw nothing.
    pub measured: Option<Measured>,
    /// Standard uncertainty of the position, per axis, m.
    pub sigma_m: Option<f64>,
    /// Standard uncertainty of the orientation, about each axis, rad.
    pub sigma_rad: Option<f64>,
    /// Who may use it; `None` where the file does not say.
    pub set: Option<SetName>,
    /// Line in its file, from one.
    pub line: usize,
}

impl Observation {
    /// A pose of which nothing is known but the joint numbers.
    pub fn unmeasured(numbers_rad: [f64; DOF]) -> Self {
        Self {
            id: String::new(),
            station: None,
            numbers_rad,
            conditions: Conditions::default(),
            measured: None,
            sigma_m: None,
            sigma_rad: None,
            set: None,
            line: 0,
        }
    }
}

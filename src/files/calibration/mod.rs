//! Model files: `falsetarget/model/1`, what is known of the real arm. A robot file serves as one without errors.
//! Effects files: `falsetarget/effects/1`, the same errors and effects without a robot, for simulation.

//!
//! The parts: `entries` (what stands in a file, as the file has it), `read` and `write`, `errors` (geometry, effects and
//! learner between file and model), `effects_file`, `names` (what parameters are called), `uncertainty` (covariances).

use serde::{Deserialize, Serialize};

use crate::geometry::pose::Pose;
use crate::measure::observation::Observation;
use crate::model::arm::ArmModel;
use crate::model::parameters::ParameterId;
use crate::model::robot::{DOF, Robot};
use crate::model::uncertainty::Uncertainty;

mod effects_file;
mod entries;
mod errors;
mod names;
mod read;
#[cfg(test)]
mod tests;
mod uncertainty;
mod write;

pub use effects_file::{EffectsFile, read_effects};
pub use names::{geometry_name, geometry_unit};
pub use read::read;
pub use write::write;

/// The word in the first line of a model file.
pub const MODEL_SCHEMA: &str = "falsetarget/model/1";
/// The word in the first line of an effects file.
pub const EFFECTS_SCHEMA: &str = "falsetarget/effects/1";

/// A model of a real arm with what is known about that knowledge.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The model.
    pub arm: ArmModel,
    /// Standard uncertainty of parameters, in their SI unit, where a file states no more than that; absent for those
    /// that were not identified.
    pub sigma: Vec<(ParameterId, f64)>,
    /// The whole covariance and what stays unexplained, where the tool identified the model itself.
    pub uncertainty: Option<Uncertainty>,
    /// Trackers that stood elsewhere than the measuring frame.
    pub stations: Vec<StationFrame>,
    /// The joint numbers that the recordings covered.
    pub region: Option<Region>,
    /// Where it comes from.
    pub provenance: Option<Provenance>,
}

/// Where a tracker stood that does not measure in the measuring frame.
#[derive(Clone, Debug, PartialEq)]
pub struct StationFrame {
    /// Its name in recordings.
    pub name: String,
    /// `station_T_measuring`.
    pub station_t_measuring: Pose,
}

impl StationFrame {
    /// Which of the known stations looked at a record; `None` for the one whose frame is the measuring frame.
    pub fn which(stations: &[Self], record: &Observation) -> Option<usize> {
        let name = record.station.as_ref()?;
        stations.iter().position(|station| station.name == *name)
    }
}

/// A box of joint numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Smallest number of each joint, rad.
    pub min_rad: [f64; DOF],
    /// Largest number of each joint, rad.
    pub max_rad: [f64; DOF],
}

impl Region {
    /// The smallest box around these joint numbers; `None` around none.
    pub fn covering<'a>(numbers_rad: impl IntoIterator<Item = &'a [f64; DOF]>) -> Option<Self> {
        let mut all = numbers_rad.into_iter();
        let first = *all.next()?;
        let grow = |region: Self, numbers: &[f64; DOF]| Self {
            min_rad: std::array::from_fn(|joint| region.min_rad[joint].min(numbers[joint])),
            max_rad: std::array::from_fn(|joint| region.max_rad[joint].max(numbers[joint])),
        };
        Some(all.fold(Self { min_rad: first, max_rad: first }, grow))
    }
}

/// Where a model comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// The program and its version.
    pub written_by: String,
    /// Each recording's name, SHA-256 and number of records.
    #[serde(default)]
    pub recordings: Vec<RecordingProvenance>,
    /// Anything a person should know: `made by hand`, `class stand-in`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// A recording that went into a model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordingProvenance {
    /// File name.
    pub name: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// Records in it.
    pub records: usize,
    /// Records used.
    pub used: usize,
}

impl Calibration {
    /// What a robot file alone says.
    pub fn nominal(robot: Robot) -> Self {
        Self {
            arm: ArmModel::nominal(robot),
            sigma: Vec::new(),
            uncertainty: None,
            stations: Vec::new(),
            region: None,
            provenance: None,
        }
    }

    /// Standard uncertainty of a number; `None` where it was not identified.
    pub fn sigma_of(&self, id: ParameterId) -> Option<f64> {
        let whole = self.uncertainty.as_ref().and_then(|uncertainty| uncertainty.sigma(id));
        whole.or_else(|| self.sigma.iter().find(|(known, _)| *known == id).map(|(_, sigma)| *sigma))
    }
}

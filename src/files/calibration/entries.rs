//! A model file's keys, as the file has them: numbers of their units, names of things.

use serde::{Deserialize, Serialize};

use crate::files::robot::RobotEntry;
use crate::files::yaml::PoseEntry;
use crate::model::curves::JointCurves;
use crate::model::effect::Location;
use crate::model::network::ResidualNetwork;
use crate::model::robot::DOF;

use super::Provenance;
use super::uncertainty::UncertaintyEntry;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ModelEntry {
    pub(super) schema: String,
    pub(super) robot: RobotEntry,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) measuring_t_base: Option<PoseEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) flange_t_tool: Option<PoseEntry>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) parameters: Vec<GeometryEntry>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) effects: Vec<EffectEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) network: Option<ResidualNetwork>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) stations: Vec<StationEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) curves: Option<JointCurves>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) region: Option<RegionEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) provenance: Option<Provenance>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) uncertainty: Option<UncertaintyEntry>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StationEntry {
    pub(super) name: String,
    pub(super) station_t_measuring: PoseEntry,
}

/// `{at: joint 2, quantity: a, value: 0.31e-3, unit: m}`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GeometryEntry {
    pub(super) at: String,
    pub(super) quantity: String,
    pub(super) value: f64,
    pub(super) unit: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sigma: Option<f64>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct EffectEntry {
    pub(super) effect: String,
    pub(super) location: Location,
    pub(super) parameters: Vec<ValueEntry>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ValueEntry {
    pub(super) name: String,
    pub(super) value: f64,
    pub(super) unit: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sigma: Option<f64>,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RegionEntry {
    pub(super) min_deg: [f64; DOF],
    pub(super) max_deg: [f64; DOF],
}

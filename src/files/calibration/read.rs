//! A model from its file.

use serde::Deserialize;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::base::units::rad_from_deg;
use crate::files::error::FileError;
use crate::files::robot;
use crate::files::yaml::{PoseEntry, complain, parse};
use crate::geometry::pose::Pose;
use crate::model::arm::ArmModel;

use super::entries::ModelEntry;
use super::errors::{fill_effects, fill_geometry, learner};
use super::{Calibration, MODEL_SCHEMA, Region, StationFrame};

#[derive(Deserialize)]
struct SchemaOnly {
    schema: String,
}

/// Reads a model file, or a robot file in its place.
///
/// # Errors
/// [`FileError`] with the place.
pub fn read(source: &Source) -> Result<Calibration, FileError> {
    let what = "a model file (schema: falsetarget/model/1) or a robot file";
    let schema = schema_of(source, what)?;
    if schema == robot::SCHEMA {
        return Ok(Calibration::nominal(robot::read(source)?));
    }
    if schema != MODEL_SCHEMA {
        let message = format!("the schema is `{schema}`; expected `{MODEL_SCHEMA}` or `{}`", robot::SCHEMA);
        return Err(complain(source, "schema", None, "schema", message));
    }
    let entry: ModelEntry = parse(source, what)?;
    let mut arm = ArmModel::nominal(entry.robot.robot(source)?);
    let finite = |key: &str, pose: Option<PoseEntry>| match pose.map(|pose| pose.pose()) {
        Some(None) => Err(complain(source, key, None, "pose", format!("`{key}` has a number that is not finite"))),
        Some(pose) => Ok(pose),
        None => Ok(None),
    };
    if let Some(pose) = finite("measuring_t_base", entry.measuring_t_base)? {
        arm.measuring_t_base = pose;
    }
    if let Some(pose) = finite("flange_t_tool", entry.flange_t_tool)? {
        arm.flange_t_tool = pose;
    }
    let mut sigma = fill_geometry(source, &mut arm, &entry.parameters)?;
    let (places, effect_sigma) = fill_effects(source, &mut arm, &entry.effects)?;
    sigma.extend(effect_sigma);
    arm.learner = learner(source, entry.network, entry.curves)?;
    let stations = entry
        .stations
        .iter()
        .map(|station| {
            let name = station.name.clone();
            let pose = finite("stations", Some(station.station_t_measuring))?.unwrap_or_else(Pose::identity);
            Ok(StationFrame { name, station_t_measuring: pose })
        })
        .collect::<Result<_, FileError>>()?;
    let uncertainty = match &entry.uncertainty {
        Some(entry) => Some(entry.uncertainty(source, &arm, &places)?),
        None => None,
    };
    if uncertainty.is_some() {
        // One truth: the covariance says more than the sigmas beside the values.
        sigma.clear();
    }
    let region = entry
        .region
        .map(|region| Region { min_rad: region.min_deg.map(rad_from_deg), max_rad: region.max_deg.map(rad_from_deg) });
    Ok(Calibration { arm, sigma, uncertainty, stations, region, provenance: entry.provenance })
}

/// The schema that a file names.
pub(super) fn schema_of(source: &Source, what: &str) -> Result<String, FileError> {
    // The other keys belong to the schema that is named, so they are read afterwards, with that schema's own type.
    match parse::<SchemaOnly>(source, what) {
        Ok(only) => Ok(only.schema),
        Err(error) if error.diagnostic.message.contains("missing field") => {
            let missing = Diagnostic::error("schema", format!("no `schema:` key; expected {what}"));
            Err(FileError::new(source, missing.at(0, Span::new(0, 0), "")))
        }
        Err(error) => Err(error),
    }
}

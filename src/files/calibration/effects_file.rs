//! Effects files: what to conceal in a simulated robot.

use serde::Deserialize;

use crate::base::text::Source;
use crate::files::error::FileError;
use crate::files::yaml::{complain, parse};
use crate::model::arm::ArmModel;
use crate::model::curves::JointCurves;
use crate::model::network::ResidualNetwork;
use crate::model::robot::Robot;

use super::entries::{EffectEntry, GeometryEntry};
use super::errors::{fill_effects, fill_geometry, learner};
use super::read::{read, schema_of};
use super::{EFFECTS_SCHEMA, MODEL_SCHEMA};

/// An effects file: what to conceal in a simulated robot.
#[derive(Clone, Debug)]
pub struct EffectsFile {
    /// The real arm that the simulation plays.
    pub arm: ArmModel,
    /// Noise of the simulated tracker, standard deviation per axis, m.
    pub noise_sigma_m: f64,
    /// Seed of the noise.
    pub seed: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EffectsFileEntry {
    schema: String,
    #[serde(default)]
    parameters: Vec<GeometryEntry>,
    #[serde(default)]
    effects: Vec<EffectEntry>,
    network: Option<ResidualNetwork>,
    curves: Option<JointCurves>,
    noise_sigma_mm: Option<f64>,
    seed: Option<u64>,
}

/// Reads an effects file for this robot.
///
/// # Errors
/// [`FileError`] with the place.
pub fn read_effects(source: &Source, robot: Robot) -> Result<EffectsFile, FileError> {
    let what = "an effects file (schema: falsetarget/effects/1) or a model file";
    let schema = schema_of(source, what)?;
    if schema == MODEL_SCHEMA {
        return Ok(EffectsFile { arm: read(source)?.arm, noise_sigma_m: 0.0, seed: 1 });
    }
    if schema != EFFECTS_SCHEMA {
        let message = format!("the schema is `{schema}`; expected `{EFFECTS_SCHEMA}`");
        return Err(complain(source, "schema", None, "schema", message));
    }
    let entry: EffectsFileEntry = parse(source, what)?;
    let mut arm = ArmModel::nominal(robot);
    fill_geometry(source, &mut arm, &entry.parameters)?;
    fill_effects(source, &mut arm, &entry.effects)?;
    arm.learner = learner(source, entry.network, entry.curves)?;
    let noise_sigma_mm = entry.noise_sigma_mm.unwrap_or(0.0);
    if !(0.0..100.0).contains(&noise_sigma_mm) {
        let message = format!("noise of {noise_sigma_mm} mm; expected 0 to 100 mm");
        return Err(complain(source, "noise_sigma_mm", None, "unit-scale", message));
    }
    debug_assert_eq!(entry.schema, EFFECTS_SCHEMA);
    Ok(EffectsFile { arm, noise_sigma_m: noise_sigma_mm * 1e-3, seed: entry.seed.unwrap_or(1) })
}

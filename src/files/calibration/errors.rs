//! What a real arm has beyond the nominal one, from a file into a model: geometry, effects, what was learned.

use crate::base::text::Source;
use crate::files::error::FileError;
use crate::files::yaml::complain;
use crate::model::arm::{ArmModel, EffectInstance};
use crate::model::curves::JointCurves;
use crate::model::effect;
use crate::model::learner::Learner;
use crate::model::network::ResidualNetwork;
use crate::model::parameters::ParameterId;

use super::entries::{EffectEntry, GeometryEntry};
use super::names::{geometry_id, geometry_unit};

/// Largest believable geometric error, m or rad: anything beyond is a wrong unit or a wrong robot.
const LARGEST_ERROR: f64 = 0.2;

/// Geometry errors into the model; the sigmas that stand beside the values.
pub(super) fn fill_geometry(
    source: &Source,
    arm: &mut ArmModel,
    entries: &[GeometryEntry],
) -> Result<Sigmas, FileError> {
    let mut sigma = Vec::new();
    for (index, entry) in entries.iter().enumerate() {
        let wrong = |code, message| Err(complain(source, "parameters", Some(index), code, message));
        let Some(id) = geometry_id(&entry.at, &entry.quantity) else {
            let message = format!(
                "no parameter `{}` at `{}`; joints have offset, d, a, alpha, beta; base and tool x, y, z, rx, ry, rz; \
                 the loop crank, coupler",
                entry.quantity, entry.at
            );
            return wrong("parameter", message);
        };
        if entry.unit != geometry_unit(id) {
            let message = format!("unit `{}`; `{}` is given in {}", entry.unit, entry.quantity, geometry_unit(id));
            return wrong("unit", message);
        }
        if !entry.value.is_finite() || entry.value.abs() > LARGEST_ERROR {
            let message =
                format!("an error of {} {} is no calibration error; below 0.2 is expected", entry.value, entry.unit);
            return wrong("unit-scale", message);
        }
        if let Some(number) = arm.parameters.get_mut(id) {
            *number = entry.value;
        }
        sigma.extend(entry.sigma.map(|sigma| (id, sigma)));
    }
    Ok(sigma)
}

/// Parameters with their standard uncertainty.
pub(super) type Sigmas = Vec<(ParameterId, f64)>;

/// Puts the effects of a file into the model. Returns the model's index of each, and the sigmas that stand beside the
/// values.
pub(super) fn fill_effects(
    source: &Source,
    arm: &mut ArmModel,
    entries: &[EffectEntry],
) -> Result<(Vec<usize>, Sigmas), FileError> {
    let mut sigma = Vec::new();
    let mut places = Vec::with_capacity(entries.len());
    for (index, entry) in entries.iter().enumerate() {
        let wrong = |message| complain(source, "effects", Some(index), "effect", message);
        let effect = effect::by_id(&entry.effect).ok_or_else(|| {
            let known: Vec<&str> = effect::EFFECTS.iter().map(|effect| effect.meta().id).collect();
            wrong(format!("no effect `{}`; known are {}", entry.effect, known.join(", ")))
        })?;
        let meta = effect.meta();
        if !meta.place.fits(&entry.location) {
            return Err(wrong(format!("`{}` needs its place: {}", meta.id, meta.place.fields().join(", "))));
        }
        let mut values = vec![0.0; meta.parameters.len()];
        let instance = arm.effects.len();
        // A compliance that the robot file states is replaced, not doubled.
        let same_place = |known: &EffectInstance| known.effect.meta().id == meta.id && known.location == entry.location;
        let at = arm.effects.iter().position(same_place).unwrap_or(instance);
        for value in &entry.parameters {
            let Some(slot) = meta.parameters.iter().position(|parameter| parameter.name == value.name) else {
                return Err(wrong(format!("`{}` has no parameter `{}`", meta.id, value.name)));
            };
            if value.unit != meta.parameters[slot].unit || !value.value.is_finite() {
                let unit = meta.parameters[slot].unit;
                return Err(wrong(format!("parameter `{}` is a finite number in {unit}", value.name)));
            }
            values[slot] = value.value;
            sigma.extend(value.sigma.map(|sigma| (ParameterId::Effect(at, slot), sigma)));
        }
        if at == instance {
            arm.effects.push(EffectInstance { effect, location: entry.location });
            arm.parameters.effects.push(values);
        } else {
            arm.parameters.effects[at] = values;
        }
        places.push(at);
    }
    Ok((places, sigma))
}

/// The network or the curves.
pub(super) fn learner(
    source: &Source,
    network: Option<ResidualNetwork>,
    curves: Option<JointCurves>,
) -> Result<Option<Learner>, FileError> {
    if let Some(network) = &network {
        network.check().map_err(|error| complain(source, "network", None, "network", error.to_string()))?;
    }
    if let Some(curves) = &curves {
        curves.check().map_err(|error| complain(source, "curves", None, "curves", error.to_string()))?;
    }
    match (network, curves) {
        (Some(_), Some(_)) => {
            let message = "a model has either a `network` or `curves` on top of its effects, not both".into();
            Err(complain(source, "curves", None, "curves", message))
        }
        (Some(network), None) => Ok(Some(Learner::Network(network))),
        (None, curves) => Ok(curves.map(Learner::Curves)),
    }
}

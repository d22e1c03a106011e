//! A model into its file.

use crate::base::units::deg_from_rad;
use crate::files::robot::RobotEntry;
use crate::files::yaml::PoseEntry;
use crate::model::learner::Learner;
use crate::model::parameters::ParameterId;

use super::entries::{EffectEntry, GeometryEntry, ModelEntry, RegionEntry, StationEntry, ValueEntry};
use super::names::{geometry_ids, geometry_name, geometry_unit};
use super::uncertainty::UncertaintyEntry;
use super::{Calibration, MODEL_SCHEMA};

/// The text of a model file.
///
/// # Errors
/// [`serde_yaml::Error`] when the library cannot write it, which no model is known to cause.
pub fn write(calibration: &Calibration) -> Result<String, serde_yaml::Error> {
    let arm = &calibration.arm;
    let sigma_of = |id: ParameterId| calibration.sigma_of(id);
    let parameters = geometry_ids()
        .filter_map(|id| {
            let value = arm.parameters.clone().get_mut(id).copied()?;
            let sigma = sigma_of(id);
            if value == 0.0 && sigma.is_none() {
                return None;
            }
            let (at, quantity) = geometry_name(id)?;
            Some(GeometryEntry { at, quantity, value, unit: geometry_unit(id).into(), sigma })
        })
        .collect();
    // An effect that is zero and that nobody has asked about is no news.
    let told = |index: usize, values: &[f64]| {
        let identified = (0..values.len()).any(|slot| sigma_of(ParameterId::Effect(index, slot)).is_some());
        identified || values.iter().any(|&value| value != 0.0)
    };
    let places: Vec<usize> =
        (0..arm.effects.len()).filter(|&index| told(index, &arm.parameters.effects[index])).collect();
    let effects = places
        .iter()
        .map(|&index| (index, (&arm.effects[index], &arm.parameters.effects[index])))
        .map(|(index, (instance, values))| EffectEntry {
            effect: instance.effect.meta().id.into(),
            location: instance.location,
            parameters: instance
                .effect
                .meta()
                .parameters
                .iter()
                .zip(values)
                .enumerate()
                .map(|(slot, (meta, &value))| ValueEntry {
                    name: meta.name.into(),
                    value,
                    unit: meta.unit.into(),
                    sigma: sigma_of(ParameterId::Effect(index, slot)),
                })
                .collect(),
        })
        .collect();
    let entry = ModelEntry {
        schema: MODEL_SCHEMA.into(),
        robot: RobotEntry::from_robot(&arm.robot, false),
        measuring_t_base: Some(PoseEntry::from_pose(&arm.measuring_t_base)),
        flange_t_tool: Some(PoseEntry::from_pose(&arm.flange_t_tool)),
        parameters,
        effects,
        network: match &arm.learner {
            Some(Learner::Network(network)) => Some(network.clone()),
            _ => None,
        },
        curves: match &arm.learner {
            Some(Learner::Curves(curves)) => Some(curves.clone()),
            _ => None,
        },
        region: calibration.region.map(|region| RegionEntry {
            min_deg: region.min_rad.map(deg_from_rad),
            max_deg: region.max_rad.map(deg_from_rad),
        }),
        stations: calibration
            .stations
            .iter()
            .map(|station| StationEntry {
                name: station.name.clone(),
                station_t_measuring: PoseEntry::from_pose(&station.station_t_measuring),
            })
            .collect(),
        provenance: calibration.provenance.clone(),
        uncertainty: calibration.uncertainty.as_ref().map(|known| UncertaintyEntry::new(known, arm, &places)),
    };
    serde_yaml::to_string(&entry)
}

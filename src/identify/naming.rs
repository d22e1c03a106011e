//! What unknowns are called in reports.

use crate::files::calibration::{geometry_name, geometry_unit};
use crate::model::parameters::ParameterId;

use super::state::State;
use super::unknown::UnknownId;

const COMPONENTS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// `joint 2 a`, `joint_compliance at joint 3: compliance`, `station W2 rz`.
pub fn name_of(id: UnknownId, state: &State) -> String {
    match id {
        UnknownId::Model(ParameterId::Effect(effect, parameter)) => {
            let instance = state.model.effects.get(effect);
            instance.map_or_else(String::new, |instance| {
                let meta = instance.effect.meta();
                let parameter = meta.parameters.get(parameter).map_or("", |parameter| parameter.name);
                format!("{} at {}: {parameter}", meta.id, instance.location)
            })
        }
        UnknownId::Model(id) => geometry_name(id).map_or_else(String::new, |(at, quantity)| format!("{at} {quantity}")),
        UnknownId::Station { station, component } => {
            let name = state.stations.get(station).and_then(|station| station.name.as_deref()).unwrap_or("?");
            format!("station {name} {}", COMPONENTS.get(component).unwrap_or(&"?"))
        }
    }
}

/// The SI unit of an unknown.
pub fn unit_of(id: UnknownId, state: &State) -> &'static str {
    match id {
        UnknownId::Model(ParameterId::Effect(effect, parameter)) => state
            .model
            .effects
            .get(effect)
            .and_then(|instance| instance.effect.meta().parameters.get(parameter))
            .map_or("", |parameter| parameter.unit),
        UnknownId::Model(id) => geometry_unit(id),
        UnknownId::Station { component, .. } => {
            if component < 3 {
                "m"
            } else {
                "rad"
            }
        }
    }
}

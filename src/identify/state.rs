//! The current estimate: a model, and where each tracker station stands.

use nalgebra::Vector3;

use crate::geometry::pose::Pose;
use crate::model::arm::ArmModel;
use crate::model::chain::displacement_pose;
use crate::model::parameters::Displacement;

use super::unknown::UnknownId;

/// Where a tracker stood, against the reference station whose frame is the measuring frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Its name in the recording; `None` where records name none.
    pub name: Option<String>,
    /// `station_T_measuring` as first found.
    pub station_t_measuring: Pose,
    /// Its error: `station_T_measuring * displacement`.
    pub displacement: Displacement<f64>,
}

impl Station {
    /// A station that measures in the measuring frame itself.
    pub fn reference(name: Option<String>) -> Self {
        Self { name, station_t_measuring: Pose::identity(), displacement: [0.0; 6] }
    }

    /// `station_T_measuring` as it is estimated now.
    pub fn pose(&self) -> Pose {
        self.station_t_measuring * displacement_pose(&self.displacement)
    }
}

/// A model of the arm and the stations that looked at it. Station 0 is the reference and has no unknowns.
#[derive(Clone, Debug)]
pub struct State {
    /// The arm.
    pub model: ArmModel,
    /// The stations.
    pub stations: Vec<Station>,
}

impl State {
    /// One station.
    pub fn new(model: ArmModel) -> Self {
        Self { model, stations: vec![Station::reference(None)] }
    }

    /// The value of an unknown; `None` for one that this state does not have.
    pub fn get(&self, id: UnknownId) -> Option<f64> {
        match id {
            // `get_mut` is the one list of what the names mean; a copy of the small struct is cheaper than a second list.
            UnknownId::Model(id) => self.model.parameters.clone().get_mut(id).copied(),
            UnknownId::Station { station, component } => {
                self.stations.get(station)?.displacement.get(component).copied()
            }
        }
    }

    /// Changes an unknown by `change`. An unknown that this state does not have is left out.
    pub fn add(&mut self, id: UnknownId, change: f64) {
        let number = match id {
            UnknownId::Model(id) => self.model.parameters.get_mut(id),
            UnknownId::Station { station, component } => {
                self.stations.get_mut(station).and_then(|station| station.displacement.get_mut(component))
            }
        };
        if let Some(number) = number {
            *number += change;
        }
    }

    /// The point of the measuring frame where `position_m` of a station's frame lies.
    pub fn in_measuring_frame(&self, station: usize, position_m: &Vector3<f64>) -> Vector3<f64> {
        match self.stations.get(station) {
            Some(station) => station.pose().inverse().transform_point(position_m),
            None => *position_m,
        }
    }
}

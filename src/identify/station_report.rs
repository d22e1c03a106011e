//! What is said of tracker stations.

use serde::Serialize;

use crate::base::units::{deg_from_rad, mm_from_m};
use crate::geometry::pose::vector_from_rotation;

use super::state::State;

/// A tracker station.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StationReport {
    /// Its name.
    pub name: Option<String>,
    /// Its records.
    pub records: usize,
    /// True when it was given a frame of its own.
    pub own_frame: bool,
    /// How far its frame lies from the measuring frame at the arm's place, mm.
    pub shift_mm: f64,
    /// How far it is turned, deg.
    pub turn_deg: f64,
}

/// The stations of a fit.
///
/// # Arguments
/// * `own_frame` - for each station: true when it was given a frame of its own
/// * `station_of` - the station of each record
pub fn station_reports(state: &State, own_frame: &[bool], station_of: &[usize]) -> Vec<StationReport> {
    let base = state.model.prepared().measuring_t_base().translation;
    state
        .stations
        .iter()
        .enumerate()
        .map(|(index, station)| {
            let pose = station.pose();
            StationReport {
                name: station.name.clone(),
                records: station_of.iter().filter(|&&of| of == index).count(),
                own_frame: own_frame.get(index).copied().unwrap_or(false),
                shift_mm: mm_from_m((pose.transform_point(&base) - base).norm()),
                turn_deg: deg_from_rad(vector_from_rotation(&pose.rotation).norm()),
            }
        })
        .collect()
}

impl StationReport {
    /// In a sentence, when it stood elsewhere.
    pub fn note(&self) -> Option<String> {
        self.own_frame.then(|| {
            format!(
                "station {} measured from elsewhere ({:.2} mm and {:.3} deg from the others): it has a frame of its own",
                self.name.as_deref().unwrap_or("?"),
                self.shift_mm,
                self.turn_deg
            )
        })
    }
}

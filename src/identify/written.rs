//! What a fit leaves to be written down: the model file's content, with how sure its numbers are.

use crate::files::calibration::{Calibration, Provenance, RecordingProvenance, Region, StationFrame};
use crate::measure::recording::Recording;
use crate::model::parameters::ParameterId;
use crate::model::uncertainty::Uncertainty;

use super::estimate::Estimate;
use super::unknown::UnknownId;

/// The model file's content.
///
/// # Arguments
/// * `own_frame` - for each station of the fit: true when it has a frame of its own
/// * `noise_sigma_m`, `unexplained_sigma_m` - what the fit leaves, per axis
/// * `recordings` - where its records are from
pub fn written(
    estimate: &Estimate<'_>,
    own_frame: &[bool],
    noise_sigma_m: f64,
    unexplained_sigma_m: f64,
    recordings: &[Recording],
) -> Calibration {
    let fit = &estimate.fit;
    let of_model: Vec<(usize, ParameterId)> = fit
        .unknowns
        .iter()
        .enumerate()
        .filter_map(|(index, unknown)| match unknown.id {
            UnknownId::Model(id) => Some((index, id)),
            UnknownId::Station { .. } => None,
        })
        .collect();
    let rows: Vec<usize> = of_model.iter().map(|(index, _)| *index).collect();
    let root = fit.covariance_root.select_rows(&rows);
    let uncertainty = Uncertainty {
        ids: of_model.iter().map(|(_, id)| *id).collect(),
        covariance: &root * root.transpose(),
        freedom: estimate.spread.freedom,
        noise_sigma_m,
        unexplained_sigma_m,
    };
    let stations = fit
        .state
        .stations
        .iter()
        .zip(own_frame)
        .filter(|(_, own)| **own)
        .filter_map(|(station, _)| {
            Some(StationFrame { name: station.name.clone()?, station_t_measuring: station.pose() })
        })
        .collect();
    let provenance = Provenance {
        written_by: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")).into(),
        recordings: recordings
            .iter()
            .map(|recording| RecordingProvenance {
                name: recording.name.clone(),
                sha256: recording.sha256.clone(),
                records: recording.observations.len(),
                used: used(estimate, recording),
            })
            .collect(),
        note: None,
    };
    Calibration {
        arm: fit.state.model.clone(),
        sigma: Vec::new(),
        uncertainty: Some(uncertainty),
        stations,
        region: region(estimate),
        provenance: Some(provenance),
    }
}

/// The box of joint numbers of the fitted records.
pub fn region(estimate: &Estimate<'_>) -> Option<Region> {
    Region::covering(estimate.problem.records.iter().map(|record| &record.observation.numbers_rad))
}

/// Records of a recording that the fit stands on: those that lie in its memory.
fn used(estimate: &Estimate<'_>, recording: &Recording) -> usize {
    let inside = recording.observations.as_ptr_range();
    estimate.problem.records.iter().filter(|record| inside.contains(&std::ptr::from_ref(record.observation))).count()
}

//! The model that a diagnosis leaves: with what it found, and how sure that is.

use crate::files::calibration::{Calibration, Provenance, RecordingProvenance, Region, StationFrame};
use crate::identify::unknown::UnknownId;
use crate::measure::recording::Recording;
use crate::model::parameters::ParameterId;
use crate::model::uncertainty::Uncertainty;

use super::diagnosis::Diagnosis;

/// The model file's content.
pub fn updated(diagnosis: &Diagnosis<'_>, recordings: &[Recording]) -> Calibration {
    let fit = &diagnosis.estimate.fit;
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
    let has_frame = |station: usize| {
        fit.unknowns
            .iter()
            .any(|unknown| matches!(unknown.id, UnknownId::Station { station: own, .. } if own == station))
    };
    Calibration {
        arm: fit.state.model.clone(),
        sigma: Vec::new(),
        uncertainty: Some(Uncertainty {
            ids: of_model.iter().map(|(_, id)| *id).collect(),
            covariance: &root * root.transpose(),
            freedom: diagnosis.estimate.spread.freedom,
            noise_sigma_m: diagnosis.noise_sigma_m,
            unexplained_sigma_m: diagnosis.unexplained_sigma_m,
        }),
        stations: fit
            .state
            .stations
            .iter()
            .enumerate()
            .filter(|(index, _)| has_frame(*index))
            .filter_map(|(_, station)| {
                Some(StationFrame { name: station.name.clone()?, station_t_measuring: station.pose() })
            })
            .collect(),
        region: region(diagnosis),
        provenance: Some(Provenance {
            written_by: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")).into(),
            recordings: recordings
                .iter()
                .map(|recording| RecordingProvenance {
                    name: recording.name.clone(),
                    sha256: recording.sha256.clone(),
                    records: recording.observations.len(),
                    used: used(diagnosis, recording),
                })
                .collect(),
            note: None,
        }),
    }
}

/// Records of a recording that the fit stands on.
fn used(diagnosis: &Diagnosis<'_>, recording: &Recording) -> usize {
    let records = &diagnosis.estimate.problem.records;
    let inside = |record: &&crate::identify::problem::Record<'_>| {
        recording.observations.iter().any(|observation| std::ptr::eq(observation, record.observation))
    };
    records.iter().filter(inside).count()
}

/// The box of joint numbers of the records used.
fn region(diagnosis: &Diagnosis<'_>) -> Option<Region> {
    let numbers = diagnosis.estimate.problem.records.iter().map(|record| &record.observation.numbers_rad);
    Region::covering(numbers)
}

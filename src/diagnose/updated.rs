//! The model that a diagnosis leaves: with what it found, and how sure that is.

use crate::files::calibration::Calibration;
use crate::identify::unknown::UnknownId;
use crate::identify::written::written;
use crate::measure::recording::Recording;

use super::diagnosis::Diagnosis;

/// The model file's content.
pub fn updated(diagnosis: &Diagnosis<'_>, recordings: &[Recording]) -> Calibration {
    let fit = &diagnosis.estimate.fit;
    let has_frame = |station: usize| {
        fit.unknowns
            .iter()
            .any(|unknown| matches!(unknown.id, UnknownId::Station { station: own, .. } if own == station))
    };
    let own_frame: Vec<bool> = (0..fit.state.stations.len()).map(has_frame).collect();
    let (noise, unexplained) = (diagnosis.noise_sigma_m, diagnosis.unexplained_sigma_m);
    written(&diagnosis.estimate, &own_frame, noise, unexplained, recordings)
}

//! The model that a diagnosis leaves: with what it found, and how sure that is.

use crate::files::calibration::Calibration;
use crate::identify::written::written;
use crate::measure::recording::Recording;

use super::diagnosis::Diagnosis;

/// The model file's content.
pub fn updated(diagnosis: &Diagnosis<'_>, recordings: &[Recording]) -> Calibration {
    let fit = &diagnosis.estimate.fit;
    let (noise, unexplained) = (diagnosis.noise_sigma_m, diagnosis.unexplained_sigma_m);
    written(&diagnosis.estimate, &fit.own_frames(), noise, unexplained, recordings)
}

//! The model that a diagnosis leaves: with what it found, what of it has no name as it was learned, and how
//! sure that is.

use crate::files::calibration::Calibration;
use crate::identify::written::written;
use crate::measure::recording::Recording;

use super::diagnosis::Diagnosis;

/// The model file's content.
pub fn updated(diagnosis: &Diagnosis<'_>, recordings: &[Recording]) -> Calibration {
    let estimate = diagnosis.learned.as_ref().map_or(&diagnosis.estimate, |learned| &learned.estimate);
    let (noise, unexplained) = (diagnosis.noise_sigma_m, diagnosis.unexplained_sigma_m);
    written(estimate, &estimate.fit.own_frames(), noise, unexplained, recordings)
}

//! What an identification has to say, as plain data for JSON and for tables. Millimetres here, SI inside.

use serde::Serialize;

use crate::base::units::mm_from_m;
use crate::model::robot::DOF;

use super::split::SplitSource;
use super::station_report::StationReport;

/// The word in the first key.
pub const SCHEMA: &str = "falsetarget/calibration/1";

/// Everything a calibration has to say.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// The robot's name.
    pub robot: String,
    /// The files.
    pub recordings: Vec<RecordingReport>,
    /// Who used which records.
    pub split: SplitReport,
    /// The table of the paper: what each step leaves, by set.
    pub stages: Vec<Stage>,
    /// Noise and what stays unexplained.
    pub rest: Rest,
    /// Every identified number.
    pub parameters: Vec<ParameterReport>,
    /// Numbers that no recording could tell.
    pub redundant: Vec<RedundantReport>,
    /// Names of numbers that this recording could not tell: they stay near nominal because their prior holds them.
    pub undetermined: Vec<String>,
    /// Pairs that the recording tells only together.
    pub correlated: Vec<Correlated>,
    /// Observability.
    pub observability: Observability,
    /// Tracker stations.
    pub stations: Vec<StationReport>,
    /// Records that were not used, each with its reason.
    pub left_out: Vec<LeftOutReport>,
    /// Sentences for a person.
    pub notes: Vec<String>,
    /// Residuals of the model that was delivered, record by record.
    pub residuals: Vec<ResidualReport>,
}

/// A file.
#[derive(Clone, Debug, Serialize)]
pub struct RecordingReport {
    /// Its name.
    pub name: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// Records in it.
    pub records: usize,
    /// Records used in any set.
    pub used: usize,
    /// `static` or `continuous`.
    pub kind: &'static str,
    /// `recorded` or `inferred` (from the order of the records).
    pub approach: &'static str,
}

/// Who used which records.
#[derive(Clone, Debug, Serialize)]
pub struct SplitReport {
    /// Where the sets come from.
    pub source: SplitSource,
    /// Records that the stages were identified from.
    pub identify: usize,
    /// Records for the learner.
    pub train: usize,
    /// Records that only the figures saw.
    pub validate: usize,
    /// Records in no set.
    pub unassigned: usize,
    /// Records that the delivered model was fitted to.
    pub delivered: usize,
}

/// Distances between model and measurement over a set.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// How many records.
    pub records: usize,
    /// Mean, mm.
    pub mean_mm: f64,
    /// Root of the mean square, mm.
    pub rms_mm: f64,
    /// Standard deviation, mm.
    pub std_mm: f64,
    /// Largest, mm.
    pub max_mm: f64,
    /// 95 % quantile, mm.
    pub p95_mm: f64,
}

impl Figures {
    /// Of these distances, m; `None` of nothing.
    pub fn of(lengths_m: &[f64]) -> Option<Self> {
        if lengths_m.is_empty() {
            return None;
        }
        let mut sorted: Vec<f64> = lengths_m.iter().map(|&length| mm_from_m(length)).collect();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len() as f64;
        let mean_mm = sorted.iter().sum::<f64>() / count;
        let square = sorted.iter().map(|length| length * length).sum::<f64>() / count;
        let spread = sorted.iter().map(|length| (length - mean_mm).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
        // The smallest distance that at least 95 % do not exceed.
        let rank = ((0.95 * count).ceil() as usize).clamp(1, sorted.len());
        Some(Self {
            records: sorted.len(),
            mean_mm,
            rms_mm: square.sqrt(),
            std_mm: spread.sqrt(),
            max_mm: sorted[sorted.len() - 1],
            p95_mm: sorted[rank - 1],
        })
    }
}

/// One line of the stage table.
#[derive(Clone, Debug, Serialize)]
pub struct Stage {
    /// `nominal`, `frames`, `geometry`, `geometry_compliance`, ...
    pub name: String,
    /// How many numbers were free.
    pub free: usize,
    /// Over the identification set.
    pub identify: Option<Figures>,
    /// Over the training set.
    pub train: Option<Figures>,
    /// Over the validation set.
    pub validate: Option<Figures>,
}

/// What the delivered model leaves.
#[derive(Clone, Debug, Serialize)]
pub struct Rest {
    /// Standard deviation per axis of the residuals, corrected for the fitted numbers, mm.
    pub sigma_mm: f64,
    /// That part of it which is noise of the measurement, mm.
    pub noise_sigma_mm: f64,
    /// That part which the arm does and the model does not, mm.
    pub unexplained_sigma_mm: f64,
    /// How the two were told apart: `stated`, `repeats` or `structure`.
    pub told_by: &'static str,
    /// Degrees of freedom.
    pub freedom: f64,
    /// Scatter per axis of poses repeated the same way, mm.
    pub repeat_same_approach_mm: Option<f64>,
    /// Scatter per axis of poses repeated whatever the way, mm.
    pub repeat_any_approach_mm: Option<f64>,
}

/// One identified number.
#[derive(Clone, Debug, Serialize)]
pub struct ParameterReport {
    /// Its name.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// Its standard uncertainty.
    pub sigma: f64,
    /// Interval that holds it with 95 %.
    pub ci95: [f64; 2],
    /// Standard deviation that the prior gave it.
    pub prior_sigma: f64,
    /// mag: RMS effect of a prior-sized error on a coordinate, mm.
    pub magnitude_mm: f64,
    /// var: variance inflation by the other numbers, from the data alone; `null` for infinite.
    pub inflation: Option<f64>,
    /// Standard uncertainty after over before.
    pub remaining: f64,
}

/// A redundant number.
#[derive(Clone, Debug, Serialize)]
pub struct RedundantReport {
    /// Its name.
    pub name: String,
    /// What says the same: names, and the change of each that replaces a unit change of this one.
    pub coupled_with: Vec<Coupled>,
}

/// A part of a coupling.
#[derive(Clone, Debug, Serialize)]
pub struct Coupled {
    /// The other number's name.
    pub name: String,
    /// Its change per unit change.
    pub factor: f64,
}

/// Two numbers that are known together better than apart.
#[derive(Clone, Debug, Serialize)]
pub struct Correlated {
    /// One.
    pub a: String,
    /// The other.
    pub b: String,
    /// Their correlation.
    pub correlation: f64,
}

/// Observability of the identified numbers.
#[derive(Clone, Debug, Serialize)]
pub struct Observability {
    /// Rank of the data, columns scaled.
    pub rank: usize,
    /// Numbers identified.
    pub unknowns: usize,
    /// Condition number, columns scaled to unit length.
    pub condition: f64,
    /// O1 to O5, of the Jacobian in mm per prior-sized error.
    pub indices: [f64; 5],
}

/// A record that was not used.
#[derive(Clone, Debug, Serialize)]
pub struct LeftOutReport {
    /// Its file.
    pub recording: String,
    /// Its name.
    pub id: String,
    /// Its line.
    pub line: usize,
    /// How far off it is, mm.
    pub away_mm: Option<f64>,
    /// A word for scripts.
    pub code: &'static str,
    /// A sentence for people.
    pub reason: String,
}

/// The residual of a record.
#[derive(Clone, Debug, Serialize)]
pub struct ResidualReport {
    /// Its name.
    pub id: String,
    /// Its file, by index.
    pub recording: usize,
    /// Its line.
    pub line: usize,
    /// Its set, where it has one.
    pub set: Option<&'static str>,
    /// False when it was left out.
    pub used: bool,
    /// Joint numbers, deg: what a plot of the residuals stands over.
    pub joints_deg: [f64; DOF],
    /// Model minus measurement in its station's frame, mm.
    pub residual_mm: [f64; 3],
    /// Their length, mm.
    pub length_mm: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_those_of_the_textbook() {
        let lengths: Vec<f64> = (1..=20).map(|n| f64::from(n) * 1e-3).collect();
        let figures = Figures::of(&lengths).expect("figures");
        assert!((figures.mean_mm - 10.5).abs() < 1e-12);
        assert!((figures.rms_mm - 143.5f64.sqrt()).abs() < 1e-9);
        assert!((figures.std_mm - 35f64.sqrt()).abs() < 1e-9);
        assert_eq!((figures.max_mm.round(), figures.p95_mm.round()), (20.0, 19.0));
        assert_eq!(Figures::of(&[]), None);
    }
}

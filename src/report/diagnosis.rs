//! `falsetarget/diagnosis/1`: what a diagnosis says to other programs.

use serde::Serialize;

use crate::diagnose::diagnosis::{Diagnosis, Errors, Finding, Verdict};
use crate::diagnose::nameless::Nameless;
use crate::diagnose::statement::{headline, of_finding, of_unexplained};
use crate::identify::station_report::{StationReport, station_reports};
use crate::measure::recording::Kind;
use crate::model::effect::Location;

/// The whole report.
#[derive(Clone, Debug, Serialize)]
pub struct DiagnosisReport {
    /// Always `falsetarget/diagnosis/1`.
    pub schema: &'static str,
    /// What was looked at.
    pub recording: RecordingPart,
    /// The model as given, refitted.
    pub before: ErrorPart,
    /// With the findings.
    pub after: ErrorPart,
    /// In a word.
    pub verdict: Verdict,
    /// In a sentence.
    pub statement: String,
    /// In order of what they explain.
    pub findings: Vec<FindingPart>,
    /// Structure without a name.
    pub unexplained: Option<UnexplainedPart>,
    /// Names of the gross errors.
    pub outliers: Vec<String>,
    /// Tracker stations, if there are several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stations: Vec<StationReport>,
    /// What to measure next.
    pub next_measurements: Vec<NextPart>,
}

/// What was looked at.
#[derive(Clone, Debug, Serialize)]
pub struct RecordingPart {
    /// Records in the recording.
    pub records: usize,
    /// Records used.
    pub used: usize,
    /// `static` or `continuous`.
    pub kind: &'static str,
    /// Noise per axis, mm.
    pub noise_sigma_mm: f64,
}

/// Distances, mm.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ErrorPart {
    /// Mean.
    pub mean_mm: f64,
    /// Root of the mean square.
    pub rms_mm: f64,
    /// Largest.
    pub max_mm: f64,
    /// Root of the mean square over records held out.
    pub heldout_rms_mm: f64,
}

/// A finding.
#[derive(Clone, Debug, Serialize)]
pub struct FindingPart {
    /// The effect's id.
    pub effect: &'static str,
    /// Its place.
    pub location: Location,
    /// Its numbers.
    pub parameters: Vec<ParameterPart>,
    /// Part of the error before that it explains, in squares.
    pub share: f64,
    /// Why it is believed.
    pub evidence: EvidencePart,
    /// Those that this recording cannot tell from it.
    pub alternatives: Vec<AlternativePart>,
    /// Interval that holds the order of a periodic error with 95 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order_ci95: Option<[f64; 2]>,
    /// In a sentence.
    pub statement: String,
}

/// A fitted number.
#[derive(Clone, Debug, Serialize)]
pub struct ParameterPart {
    /// Its name.
    pub name: &'static str,
    /// The number.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// Interval that holds the truth with 95 %.
    pub ci95: [f64; 2],
}

/// Why a finding is believed.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct EvidencePart {
    /// Held out, without it.
    pub heldout_rms_before_mm: f64,
    /// Held out, with it.
    pub heldout_rms_after_mm: f64,
    /// Probability of as large a gain by chance.
    pub p_value: f64,
    /// Part of random halves of the records that would have shown it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stability: Option<f64>,
}

/// What may be there instead.
#[derive(Clone, Debug, Serialize)]
pub struct AlternativePart {
    /// The effect's id.
    pub effect: &'static str,
    /// Its place.
    pub location: Location,
}

/// Structure without a name.
#[derive(Clone, Debug, Serialize)]
pub struct UnexplainedPart {
    /// Its size.
    pub rms_mm: f64,
    /// Probability of as much by chance.
    pub p_value: f64,
    /// The variables.
    pub depends_on: Vec<String>,
    /// Where it sits.
    pub location: Location,
    /// As the updated model has learned it; null where it has no part for it.
    pub learned: Option<LearnedPart>,
    /// In a sentence.
    pub statement: String,
}

/// What has no name, learned.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct LearnedPart {
    /// Held out, without it.
    pub heldout_rms_before_mm: f64,
    /// Held out, with it.
    pub heldout_rms_after_mm: f64,
}

impl LearnedPart {
    /// In a sentence.
    pub fn statement(&self) -> String {
        let Self { heldout_rms_before_mm: before, heldout_rms_after_mm: after } = self;
        format!("The updated model holds it as learned: held-out RMS {before:.3} -> {after:.3} mm.")
    }
}

/// A measurement to make.
#[derive(Clone, Debug, Serialize)]
pub struct NextPart {
    /// Why.
    pub why: String,
    /// What.
    pub what: String,
}

/// Half the width of a 95 % interval in standard uncertainties.
const HALF_95: f64 = 1.959_964;

impl DiagnosisReport {
    /// Writes a diagnosis down.
    pub fn new(diagnosis: &Diagnosis<'_>) -> Self {
        Self {
            schema: "falsetarget/diagnosis/1",
            recording: RecordingPart {
                records: diagnosis.records,
                used: diagnosis.estimate.problem.records.len(),
                kind: match diagnosis.kind {
                    Kind::Static => "static",
                    Kind::Continuous => "continuous",
                },
                noise_sigma_mm: 1e3 * diagnosis.noise_sigma_m,
            },
            before: errors(&diagnosis.before),
            after: errors(&diagnosis.after),
            verdict: diagnosis.verdict,
            statement: headline(diagnosis),
            findings: diagnosis.findings.iter().map(finding).collect(),
            unexplained: diagnosis.unexplained.as_ref().map(|unexplained| UnexplainedPart {
                rms_mm: unexplained.rms_mm,
                p_value: unexplained.p_value,
                depends_on: unexplained.depends_on(),
                location: unexplained.location(),
                learned: diagnosis.learned.as_ref().map(learned),
                statement: of_unexplained(unexplained),
            }),
            outliers: diagnosis.outliers.clone(),
            stations: stations(diagnosis),
            next_measurements: diagnosis
                .next_measurements
                .iter()
                .map(|advice| NextPart { why: advice.why.clone(), what: advice.what.clone() })
                .collect(),
        }
    }
}

fn learned(learned: &Nameless<'_>) -> LearnedPart {
    let [heldout_rms_before_mm, heldout_rms_after_mm] = learned.held_out_rms_mm;
    LearnedPart { heldout_rms_before_mm, heldout_rms_after_mm }
}

fn stations(diagnosis: &Diagnosis<'_>) -> Vec<StationReport> {
    let fit = &diagnosis.estimate.fit;
    let station_of: Vec<usize> = diagnosis.estimate.problem.records.iter().map(|record| record.station).collect();
    match fit.state.stations.len() {
        0 | 1 => Vec::new(),
        _ => station_reports(&fit.state, &fit.own_frames(), &station_of),
    }
}

/// A probability in a word: below what numbers hold it says so.
pub fn probability(p_value: f64) -> String {
    match p_value {
        p if p < 1e-100 => "< 1e-100".into(),
        p if p < 1e-3 => format!("{p:.0e}"),
        p => format!("{p:.3}"),
    }
}

fn errors(errors: &Errors) -> ErrorPart {
    ErrorPart {
        mean_mm: errors.fitted.mean_mm,
        rms_mm: errors.fitted.rms_mm,
        max_mm: errors.fitted.max_mm,
        heldout_rms_mm: errors.held_out_rms_mm,
    }
}

fn finding(finding: &Finding) -> FindingPart {
    let [heldout_rms_before_mm, heldout_rms_after_mm] = finding.held_out_rms_mm;
    FindingPart {
        effect: finding.instance.effect.meta().id,
        location: finding.instance.location,
        parameters: finding
            .values
            .iter()
            .map(|value| ParameterPart {
                name: value.name,
                value: value.value,
                unit: value.unit,
                ci95: [value.value - HALF_95 * value.sigma, value.value + HALF_95 * value.sigma],
            })
            .collect(),
        share: finding.share,
        evidence: EvidencePart {
            heldout_rms_before_mm,
            heldout_rms_after_mm,
            p_value: finding.p_value,
            stability: finding.stability,
        },
        alternatives: finding
            .alternatives
            .iter()
            .map(|rival| AlternativePart { effect: rival.effect, location: rival.location })
            .collect(),
        order_ci95: finding.order_95,
        statement: of_finding(finding),
    }
}

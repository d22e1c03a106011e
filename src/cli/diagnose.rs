//! `falsetarget diagnose`: what physics a model leaves out.

use std::path::PathBuf;

use crate::diagnose::diagnosis::diagnose;
use crate::diagnose::updated::updated;
use crate::files::calibration;
use crate::report::diagnosis::DiagnosisReport;

use super::console::Console;
use super::exit::{Exit, Failure};
use super::load;
use super::output;

/// Say what physics the model leaves out, where it sits, and model it
///
/// Geometry, frames and every effect that the model already has are refitted first, so that nothing explainable is called
/// missing. What is named was tested on held-out records; what has structure but no name is told as unexplained.
#[derive(clap::Args)]
pub struct Args {
    /// Model file, robot file or a built-in robot's name
    #[arg(long, value_name = "MODEL")]
    model: String,
    /// Recording (CSV); may be given several times
    #[arg(long, value_name = "REC.csv", required = true)]
    recording: Vec<PathBuf>,
    /// Where to write the model with what was found
    #[arg(short, long, value_name = "UPDATED.yaml")]
    output: Option<PathBuf>,
    /// Where to write the diagnosis as JSON
    #[arg(long, value_name = "D.json")]
    json: Option<PathBuf>,
    /// Seed of everything that is drawn
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let model = load::model(&args.model)?;
    let recordings =
        args.recording.iter().map(|path| load::recording(path, &model.arm.robot)).collect::<Result<Vec<_>, _>>()?;
    let diagnosis = diagnose(&model.arm, &recordings, args.seed)?;
    let report = DiagnosisReport::new(&diagnosis);
    if let Some(path) = &args.output {
        let text =
            calibration::write(&updated(&diagnosis, &recordings)).map_err(|error| Failure::Usage(error.to_string()))?;
        output::write(path, text.as_bytes())?;
    }
    if let Some(path) = &args.json {
        output::write_json(path, &report)?;
    }
    tell_person(&report, console);
    Ok(Exit::Done)
}

fn tell_person(report: &DiagnosisReport, console: &Console) {
    console.say(&report.statement);
    for finding in &report.findings {
        console.say(&format!("  found: {} (p {:.1e})", finding.statement, finding.evidence.p_value));
        for rival in &finding.alternatives {
            console.say(&format!("    or {} at the {}: this recording cannot tell", rival.effect, rival.location));
        }
    }
    if let Some(unexplained) = &report.unexplained {
        console.say(&format!("  unexplained: {}", unexplained.statement));
    }
    if !report.outliers.is_empty() {
        console.say(&format!("  left out: records {}", report.outliers.join(", ")));
    }
    for next in &report.next_measurements {
        console.say(&format!("  next: {}, because {}", next.what, next.why));
    }
}

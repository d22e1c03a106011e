//! `falsetarget diagnose`: what physics a model leaves out.

use std::path::PathBuf;

use crate::diagnose::diagnosis::{Diagnosis, diagnose};
use crate::diagnose::updated::updated;
use crate::files::calibration;
use crate::measure::recording::Recording;
use crate::report::diagnosis::DiagnosisReport;
use crate::report::html::{self, DiagnosisPage};
use crate::report::sketch::sketch;
use crate::report::trace::{Trace, trace, unexplained_traces};

use super::console::Console;
use super::diagnosed;
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
    /// Where to write the diagnosis as a page with plots
    #[arg(long, value_name = "D.html")]
    html: Option<PathBuf>,
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
    if let Some(path) = &args.html {
        output::write(path, page(&diagnosis, &recordings, &report).as_bytes())?;
    }
    diagnosed::tell(&report, console);
    Ok(Exit::Done)
}

fn page(diagnosis: &Diagnosis<'_>, recordings: &[Recording], report: &DiagnosisReport) -> String {
    let estimate = &diagnosis.estimate;
    let names: Vec<String> = recordings.iter().map(|recording| recording.name.clone()).collect();
    let traces: Vec<Trace> = diagnosis.findings.iter().map(|finding| trace(estimate, &finding.instance)).collect();
    let unexplained = diagnosis.unexplained.as_ref().map(|one| unexplained_traces(estimate, one)).unwrap_or_default();
    let sketch = sketch(estimate);
    html::diagnosis(&DiagnosisPage {
        robot: &estimate.fit.state.model.robot.name,
        recordings: &names,
        report,
        traces: &traces,
        unexplained: &unexplained,
        sketch: sketch.as_ref(),
    })
}

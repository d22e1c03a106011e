//! `falsetarget validate`: does the model still hold?

use std::path::PathBuf;

use crate::base::units::m_from_mm;
use crate::identify::validate::{Validation, validate};
use crate::measure::observation::{Observation, SetName};
use crate::report::html;

use super::console::Console;
use super::exit::{Exit, Failure};
use super::load;
use super::output;

/// Compare a model with a recording
///
/// Fails (exit status 1) when significantly fewer than 95 % of the records lie within the radius that the model claims,
/// or when a record is further off than --limit-mm.
#[derive(clap::Args)]
pub struct Args {
    /// Model file, robot file or a built-in robot's name
    #[arg(long, value_name = "MODEL")]
    model: String,
    /// Recording (CSV)
    #[arg(long, value_name = "REC.csv")]
    recording: PathBuf,
    /// Largest distance that is allowed
    #[arg(long, value_name = "MM")]
    limit_mm: Option<f64>,
    /// Only records of the `validate` set
    #[arg(long)]
    validate_set: bool,
    /// Where to write the result as JSON
    #[arg(long, value_name = "V.json")]
    json: Option<PathBuf>,
    /// Where to write the result as a page with plots
    #[arg(long, value_name = "V.html")]
    html: Option<PathBuf>,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let model = load::model(&args.model)?;
    let recording = load::recording(&args.recording, &model.arm.robot)?;
    let wanted = |record: &&Observation| !args.validate_set || record.set == Some(SetName::Validate);
    let records: Vec<&Observation> = recording.observations.iter().filter(wanted).collect();
    if !records.iter().any(|record| record.measured.is_some()) {
        return Err(Failure::Usage(format!("{}: no measured record to compare with", recording.name)));
    }
    let validation = validate(&model, &records, args.limit_mm.map(m_from_mm))
        .map_err(|error| Failure::Usage(format!("{}: {error}", recording.name)))?;
    if let Some(path) = &args.json {
        output::write_json(path, &validation)?;
    }
    if let Some(path) = &args.html {
        output::write(path, html::validation(&args.model, &recording.name, &validation).as_bytes())?;
    }
    tell_person(&validation, console);
    Ok(if validation.passed { Exit::Done } else { Exit::No })
}

fn tell_person(validation: &Validation, console: &Console) {
    console.say(&format!("{:<12} {:>6} {:>8} {:>8} {:>8} {:>8}", "mm", "n", "mean", "rms", "p95", "max"));
    let rows = [("nominal", validation.nominal), ("model", validation.model), ("registered", validation.registered)];
    for (name, figures) in rows {
        if let Some(f) = figures {
            console.say(&format!(
                "{name:<12} {:>6} {:>8.4} {:>8.4} {:>8.4} {:>8.4}",
                f.records, f.mean_mm, f.rms_mm, f.p95_mm, f.max_mm
            ));
        }
    }
    if let Some(within) = validation.within_u95 {
        console.say(&format!("{:.1} % within the 95 % radius", within * 100.0));
    }
    for note in &validation.notes {
        console.say(&format!("note: {note}"));
    }
    console.say(if validation.passed { "the model holds" } else { "the model does not hold" });
}

//! `falsetarget predict`: where the tool point will be.

use std::path::PathBuf;

use crate::base::diagnostic::Diagnostic;
use crate::files::recording::{Prediction, write_predictions};
use crate::identify::predict::predict;
use crate::measure::observation::Observation;

use super::console::Console;
use super::exit::{Exit, Failure};
use super::load;
use super::output;

/// Predict the measured point of poses, with the radius in which it lies with 95 %
#[derive(clap::Args)]
pub struct Args {
    /// Model file, robot file or a built-in robot's name
    #[arg(long, value_name = "MODEL")]
    model: String,
    /// Poses: a recording, measured or not
    #[arg(long, value_name = "POSES.csv")]
    recording: PathBuf,
    /// Where to write the predictions
    #[arg(short, long, value_name = "PREDICTED.csv")]
    output: PathBuf,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let model = load::model(&args.model)?;
    let recording = load::recording(&args.recording, &model.arm.robot)?;
    let records: Vec<&Observation> = recording.observations.iter().collect();
    let predicted = predict(&model.arm, model.uncertainty.as_ref(), &model.stations, &records)
        .map_err(|error| Failure::Usage(format!("{}: {error}", recording.name)))?;
    if model.uncertainty.is_none() {
        let unknown = "the model does not know its uncertainty: u95_mm stays empty";
        console.diagnostic(&[], &Diagnostic::warning("no-uncertainty", unknown));
    }
    let rows: Vec<Prediction> = recording
        .observations
        .iter()
        .zip(predicted)
        .map(|(record, predicted)| Prediction {
            id: record.id.clone(),
            position_m: predicted.position_m,
            u95_m: predicted.u95_m,
        })
        .collect();
    output::write(&args.output, write_predictions(&rows).as_bytes())?;
    Ok(Exit::Done)
}

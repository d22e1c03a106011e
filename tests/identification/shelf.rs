//! The recordings under calibration/recordings, and calibrating them.

use falsetarget::base::text::Source;
use falsetarget::files::calibration::Calibration;
use falsetarget::files::{recording, robot};
use falsetarget::identify::calibrate::{Options, Refusal, calibrate};
use falsetarget::identify::predict::predict;
use falsetarget::identify::report::{Figures, Report};
use falsetarget::identify::summary::summarise;
use falsetarget::learn::calibration::{add, add_paper_network};
use falsetarget::measure::observation::Observation;
use falsetarget::measure::recording::Recording;
use falsetarget::model::arm::ArmModel;
use falsetarget::model::robot::Robot;

fn source(folder: &str, file: &str) -> Source {
    let path = format!("{}/calibration/recordings/{folder}/{file}", env!("CARGO_MANIFEST_DIR"));
    Source::new(file.to_string(), std::fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}")))
}

pub fn robot_of(folder: &str) -> Robot {
    robot::read(&source(folder, "robot.yaml")).expect("a robot")
}

pub fn recording_of(folder: &str, file: &str) -> Recording {
    recording::read(&source(folder, file), &robot_of(folder)).expect("a recording")
}

/// Calibrates with default options.
pub fn calibrated(robot: &Robot, recordings: &[Recording]) -> Result<(Calibration, Report), Refusal> {
    let outcome = calibrate(&ArmModel::nominal(robot.clone()), recordings, &Options::default(), &mut |_| {})?;
    Ok(summarise(&outcome, recordings)?)
}

/// Calibrates with default options and learns what the physics leaves.
pub fn learned(robot: &Robot, recordings: &[Recording]) -> (Calibration, Report) {
    let start = ArmModel::nominal(robot.clone());
    let mut outcome = calibrate(&start, recordings, &Options::default(), &mut |_| {}).expect("a model");
    add(&mut outcome, 1).expect("placeable");
    summarise(&outcome, recordings).expect("placeable")
}

/// The pipeline of the paper.
pub fn by_the_paper(robot: &Robot, recordings: &[Recording]) -> (Calibration, Report) {
    let options = Options { refit_with_training: false, ..Options::default() };
    let mut outcome = calibrate(&ArmModel::nominal(robot.clone()), recordings, &options, &mut |_| {}).expect("a model");
    add_paper_network(&mut outcome, 1).expect("placeable");
    summarise(&outcome, recordings).expect("placeable")
}

/// Figures of a stage on the records held out.
pub fn validation(report: &Report, stage: &str) -> Figures {
    let stage = report.stages.iter().find(|one| one.name == stage).unwrap_or_else(|| panic!("no stage {stage}"));
    stage.validate.expect("validation figures")
}

/// RMS distance of the predictions from the true points of a folder's hold-out, mm.
pub fn missed_mm(model: &Calibration, folder: &str) -> f64 {
    let truth = recording_of(folder, "holdout_truth.csv");
    let observations: Vec<&Observation> = truth.observations.iter().collect();
    let predicted = predict(&model.arm, model.uncertainty.as_ref(), &model.stations, &observations).expect("placeable");
    let square: f64 = predicted
        .iter()
        .zip(&observations)
        .map(|(predicted, record)| (predicted.position_m - record.measured.unwrap().position_m).norm_squared())
        .sum();
    1e3 * (square / observations.len() as f64).sqrt()
}

//! `falsetarget calibrate`: from a tracker's recording to a model of the real arm.

use std::path::PathBuf;

use crate::diagnose;
use crate::files::calibration;
use crate::identify::calibrate::{Options, Refusal, calibrate};
use crate::identify::report::{Figures, Report};
use crate::identify::summary::summarise;
use crate::learn;
use crate::model::arm::ArmModel;
use crate::report::calibration::CalibrationReport;
use crate::report::html;

use super::console::Console;
use super::exit::{Exit, Failure};
use super::load;
use super::output;

/// Identify the real robot from recordings of a laser tracker
///
/// Geometry, base, measured point, parallelogram and joint compliances are identified together; then physics that the
/// recording shows beyond them is named, as `diagnose` does, and what has no name is learned where that helps on held-out
/// records. Gross errors are found, listed and left out. The `set` column of the recording is obeyed; without one, whole regions are held out for the
/// figures and the model that is written is fitted to all records.
#[derive(clap::Args)]
pub struct Args {
    /// Robot file or a built-in robot's name: what the controller believes
    #[arg(long, value_name = "ROBOT")]
    robot: String,
    /// Recording (CSV); may be given several times
    #[arg(long, value_name = "REC.csv", required = true)]
    recording: Vec<PathBuf>,
    /// Where to write the model
    #[arg(short, long, value_name = "MODEL.yaml")]
    output: PathBuf,
    /// Where to write the report as JSON
    #[arg(long, value_name = "REPORT.json")]
    json: Option<PathBuf>,
    /// Where to write the report as a page with plots
    #[arg(long, value_name = "REPORT.html")]
    html: Option<PathBuf>,
    /// Standard uncertainty of a measured position per axis, for records that state none
    #[arg(long, value_name = "MM", value_parser = positive)]
    sigma_mm: Option<f64>,
    /// Fit the model to identification records alone, not to training records too
    #[arg(long)]
    identify_only: bool,
    /// Name no physics beyond geometry and joint compliance
    #[arg(long)]
    no_diagnose: bool,
    /// Learn nothing beyond the named physics
    #[arg(long)]
    no_learner: bool,
    /// The paper's pipeline: geometry and compliance from identification records, a plain network from training records
    #[arg(long, conflicts_with_all = ["no_learner", "no_diagnose"])]
    paper: bool,
    /// Seed of everything that is drawn
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("expected a positive number".into()),
    }
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let robot = load::robot(&args.robot)?;
    let recordings = args.recording.iter().map(|path| load::recording(path, &robot)).collect::<Result<Vec<_>, _>>()?;
    let options = Options {
        seed: args.seed,
        sigma_m: args.sigma_mm.map(crate::base::units::m_from_mm),
        refit_with_training: !args.identify_only && !args.paper,
    };
    let mut tell = |step: &str| {
        if console.is_terminal() {
            console.say(&format!("{step} ..."));
        }
    };
    let mut outcome = calibrate(&ArmModel::nominal(robot), &recordings, &options, &mut tell)?;
    let mut named = Vec::new();
    if !args.paper && !args.no_diagnose {
        tell("naming the physics beyond");
        named = diagnose::calibration::add(&mut outcome, &recordings, args.seed).map_err(Refusal::from)?;
    }
    let mut learned = None;
    if args.paper {
        tell("training the network");
        learn::calibration::add_paper_network(&mut outcome, args.seed).map_err(Refusal::from)?;
    } else if !args.no_learner {
        tell("learning what the physics leaves");
        learned = Some(learn::calibration::add(&mut outcome, args.seed).map_err(Refusal::from)?);
    }
    let (model, report) = summarise(&outcome, &recordings).map_err(Refusal::from)?;
    let text = calibration::write(&model).map_err(|error| Failure::Usage(error.to_string()))?;
    output::write(&args.output, text.as_bytes())?;
    if let Some(path) = &args.json {
        output::write_json(path, &CalibrationReport::new(&report, &named, learned.as_ref()))?;
    }
    if let Some(path) = &args.html {
        output::write(path, html::calibration(&report).as_bytes())?;
    }
    tell_person(&report, console);
    Ok(Exit::Done)
}

fn tell_person(report: &Report, console: &Console) {
    for left in &report.left_out {
        console
            .say(&format!("left out: record `{}` ({}, line {}): {}", left.id, left.recording, left.line, left.reason));
    }
    for note in &report.notes {
        console.say(&format!("note: {note}"));
    }
    let cell = |figures: &Option<Figures>| match figures {
        Some(figures) => {
            format!("{:>6} {:>8.4} {:>8.4} {:>8.4}", figures.records, figures.mean_mm, figures.rms_mm, figures.max_mm)
        }
        None => format!("{:>6} {:>8} {:>8} {:>8}", "", "-", "-", "-"),
    };
    console.say(&format!("{:<24} {:>33}   {:>33}", "mm", "identification", "validation"));
    let heads = format!("{:>6} {:>8} {:>8} {:>8}", "n", "mean", "rms", "max");
    console.say(&format!("{:<24} {heads}   {heads}", ""));
    for stage in &report.stages {
        console.say(&format!("{:<24} {}   {}", stage.name, cell(&stage.identify), cell(&stage.validate)));
    }
}

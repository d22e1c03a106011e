//! `falsetarget simulate`: a real robot on a laptop.

use std::path::PathBuf;

use rand::SeedableRng;
use rand_distr::{Distribution, Normal};

use crate::files::calibration::{EffectsFile, read_effects};
use crate::files::recording;
use crate::kinematics::controller::Controller;
use crate::measure::observation::Measured;
use crate::model::robot::Robot;
use crate::program::dialect::Dialect;
use crate::report::landing::{Landing, table};
use crate::rewrite::play::{Arrival, play};

use super::console::Console;
use super::exit::{Exit, Failure};
use super::job::{self, Loaded};
use super::load;
use super::output;

/// Play poses or a program on a "real" robot built from an effects file
///
/// With --recording the measured positions of POSES.csv are made up: the effects file's robot moves there and a
/// simulated tracker looks (its noise and seed stand in the effects file).
///
/// With --program the table says where each target is meant, where the program as written lands, and, with
/// --corrected, where the corrected program lands.
#[derive(clap::Args)]
pub struct Args {
    /// Robot file or a built-in robot's name: what the controller believes
    #[arg(long, value_name = "ROBOT")]
    robot: String,
    /// What the real robot has on top (falsetarget/effects/1, or a model file)
    #[arg(long, value_name = "EFFECTS.yaml")]
    effects: PathBuf,
    /// Poses to measure
    #[arg(long, value_name = "POSES.csv", required_unless_present = "program", conflicts_with = "program")]
    recording: Option<PathBuf>,
    /// Program to play
    #[arg(long, value_name = "PROGRAM")]
    program: Option<PathBuf>,
    /// The same program, corrected
    #[arg(long, value_name = "PROGRAM", requires = "program")]
    corrected: Option<PathBuf>,
    /// Tools and frames that the program names but does not hold
    #[arg(long, value_name = "CELL.yaml")]
    cell: Option<PathBuf>,
    /// Take the programs as this language instead of telling it from their content
    #[arg(long, value_name = "NAME", value_parser = load::parse_dialect)]
    dialect: Option<&'static dyn Dialect>,
    /// Lines of the table
    #[arg(long, default_value_t = 10)]
    rows: usize,
    /// Where to write the recording or the table
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let robot = load::robot(&args.robot)?;
    let effects = read_effects(&load::source(&args.effects)?, robot.clone())?;
    match (&args.recording, &args.program) {
        (Some(poses), _) => record(args, &robot, &effects, poses),
        (None, Some(program)) => landings(args, &robot, &effects, program, console),
        (None, None) => Err(Failure::Usage("say --recording or --program".into())),
    }
}

fn record(args: &Args, robot: &Robot, effects: &EffectsFile, poses: &std::path::Path) -> Result<Exit, Failure> {
    let mut recording = recording::read(&load::source(poses)?, robot)?;
    let prepared = effects.arm.prepared();
    let noise = Normal::new(0.0, effects.noise_sigma_m).map_err(|error| Failure::Usage(error.to_string()))?;
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(effects.seed);
    for observation in &mut recording.observations {
        let state = prepared
            .at(&observation.numbers_rad, &observation.conditions, None)
            .map_err(|error| Failure::Usage(format!("{}, line {}: {error}", poses.display(), observation.line)))?;
        let exact = prepared.measured(&state).translation;
        let position_m = exact.map(|coordinate| coordinate + noise.sample(&mut random));
        observation.measured = Some(Measured { position_m, rotation: None });
    }
    output::write(&args.output, recording::write_observations(&recording.observations).as_bytes())?;
    Ok(Exit::Done)
}

fn landings(
    args: &Args,
    robot: &Robot,
    effects: &EffectsFile,
    program: &std::path::Path,
    console: &Console,
) -> Result<Exit, Failure> {
    let cell = load::cell(args.cell.as_deref())?;
    let controller = Controller::new(robot);
    let written = job::of_file(program, args.dialect)?;
    let arrivals = play(&written.program, &cell, &effects.arm, &controller);
    let corrected = match &args.corrected {
        Some(path) => {
            let loaded = job::of_file(path, args.dialect)?;
            if loaded.program.targets.len() != written.program.targets.len() {
                return Err(Failure::Usage("the corrected program holds other targets than the program".into()));
            }
            play(&loaded.program, &cell, &effects.arm, &controller)
        }
        None => Vec::new(),
    };
    let rows: Vec<Landing> = arrivals.iter().map(|arrival| landing(&written, arrival, &corrected)).collect();
    let moves: usize = written.program.targets.iter().map(|target| target.uses.len()).sum();
    if rows.len() < moves {
        console.say(&format!(
            "{} of {moves} arrivals cannot be played: their targets are not in the text, or out of reach",
            moves - rows.len()
        ));
    }
    output::write(&args.output, table(&rows, args.rows).as_bytes())?;
    Ok(Exit::Done)
}

fn landing(written: &Loaded, arrival: &Arrival, corrected: &[Arrival]) -> Landing {
    let target = &written.program.targets[arrival.target];
    let line = written.sources[target.file].line(target.span.start);
    let same = |other: &&Arrival| (other.target, other.one_use) == (arrival.target, arrival.one_use);
    let other = corrected.iter().find(same);
    Landing {
        label: target.name.clone().unwrap_or_else(|| format!("line {line}")),
        intended: arrival.written,
        uncorrected: arrival.landed,
        corrected: other.map(|other| other.landed),
        left_alone: other.is_some_and(|other| other.written == arrival.written),
    }
}

//! Floor 7: the command line. The only place that reads and writes files, prints, and asks whether a terminal is there.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod batch;
mod calibrate;
mod census;
mod console;
mod correct;
mod diagnose;
mod diagnosed;
mod exit;
mod in_order;
mod inspect;
mod items;
mod job;
mod load;
mod output;
mod plan;
mod predict;
mod record;
mod report_file;
mod robots;
mod shop;
mod simulate;
mod summary;
mod tell;
mod validate;
mod watch;
mod writers;

use console::Console;

/// Corrects robot programs for the robot that is really there.
///
/// An industrial robot repeats within hundredths of a millimetre and misses by millimetres, because its controller
/// believes a nominal model. falsetarget learns the real robot from a laser tracker's recording and replaces each
/// target of a program by a false target: the command that makes the real arm arrive where the programmer meant.
///
/// Exit status: 0 done; 1 it ran and the answer is no (a refused target); 2 bad usage or bad input, nothing written.
#[derive(Parser)]
#[command(name = "falsetarget", version, max_term_width = 100, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Calibrate(calibrate::Args),
    Predict(predict::Args),
    Diagnose(diagnose::Args),
    Validate(validate::Args),
    Plan(plan::Args),
    Correct(correct::Args),
    Watch(watch::Args),
    Inspect(inspect::Args),
    Simulate(simulate::Args),
    Robots(robots::Args),
}

/// Parses the command line, runs it, and says how it ended.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    let console = Console::new();
    let result = match &cli.command {
        Command::Calibrate(args) => calibrate::run(args, &console),
        Command::Predict(args) => predict::run(args, &console),
        Command::Diagnose(args) => diagnose::run(args, &console),
        Command::Validate(args) => validate::run(args, &console),
        Command::Plan(args) => plan::run(args, &console),
        Command::Correct(args) => correct::run(args, &console),
        Command::Watch(args) => watch::run(args, &console),
        Command::Inspect(args) => inspect::run(args, &console),
        Command::Simulate(args) => simulate::run(args, &console),
        Command::Robots(args) => robots::run(args),
    };
    match result {
        Ok(exit) => exit.code(),
        Err(failure) => console.failure(&failure).code(),
    }
}

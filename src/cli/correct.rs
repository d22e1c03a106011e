//! `falsetarget correct`: the main job.

use std::path::{Path, PathBuf};

use super::batch::{self, BatchArgs};
use super::console::Console;
use super::exit::{Exit, Failure};
use super::shop::{Shop, ShopArgs, same_file};
use super::{job, output, report_file, tell};

const EXAMPLES: &str = "\
Examples:
  cat job.mod | falsetarget correct --model model.yaml > corrected.mod
  falsetarget correct --model model.yaml --cell cell.yaml job.mod -o corrected.mod --report targets.json
  falsetarget correct --model model.yaml --out-dir corrected/ library/";

/// Rewrite programs so that the real robot lands where the programmer meant
///
/// Every target is replaced by a false target: the command that makes the arm described by the model arrive at the
/// intended pose. Nothing else in the file changes, and a model without error gives the file back byte for byte. With
/// no PROGRAM one program is read from standard input and the corrected one written to standard output.
///
/// Every target is listed as corrected, joint (left alone unless --joint-targets), computed (its value is not in the
/// text) or refused (no solution). One refused target and nothing is written, unless --allow-partial.
///
/// Files that belong together (KUKA .src and .dat of one name) are one job: given one of them the others are read from
/// beside it, and --out-dir writes all of them. Files that jobs share (KUKA $config.dat) are read and never written.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    shop: ShopArgs,
    /// Write what happened to every target as JSON (falsetarget/targets/1), or as JSON lines, one a file, where the
    /// name ends with .jsonl; `-` for standard output
    #[arg(long, value_name = "R.json")]
    report: Option<PathBuf>,
    /// Where to write the corrected program; `-` is standard output
    #[arg(short, long, value_name = "FILE", conflicts_with = "out_dir")]
    output: Option<PathBuf>,
    #[command(flatten)]
    batch: BatchArgs,
    /// Programs, or folders with --out-dir
    #[arg(value_name = "PROGRAM")]
    programs: Vec<PathBuf>,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let programs = args.programs.first().filter(|program| program.as_os_str() != "-");
    let shop = Shop::open(&args.shop, programs.map_or(Path::new("."), PathBuf::as_path))?;
    match &args.batch.out_dir {
        Some(out_dir) => batch::run(&shop, &args.batch, &args.programs, out_dir, args.report.as_deref(), console),
        None => one(&shop, args, console),
    }
}

fn one(shop: &Shop, args: &Args, console: &Console) -> Result<Exit, Failure> {
    let file = match &args.programs[..] {
        [] => None,
        [path] if path.as_os_str() == "-" => None,
        [path] => Some(path),
        _ => return Err(Failure::Usage("several programs need --out-dir".into())),
    };
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from("-"));
    for path in args.report.iter().chain([&output]) {
        if args.programs.first().is_some_and(|program| same_file(program, path)) {
            return Err(Failure::Usage(format!("{} would overwrite the program itself", path.display())));
        }
        output::check(path)?;
    }
    if args.report.as_ref().is_some_and(|report| report != Path::new("-") && *report == output) {
        return Err(Failure::Usage("the program and the report cannot both go to one file".into()));
    }
    let both_on_stdout = args.report.as_deref() == Some(Path::new("-")) && output.as_os_str() == "-";
    if both_on_stdout {
        return Err(Failure::Usage("the program and the report cannot both go to standard output".into()));
    }
    let loaded = match file {
        Some(path) => job::of_file(path, shop.dialect)?,
        None => job::of_standard_input(shop.dialect)?,
    };
    let corrected = shop.correct(loaded)?;
    tell::targets(console, &corrected.loaded, &corrected.outcome);
    if let Some(path) = &args.report {
        report_file::write_whole(path, corrected.reports())?;
    }
    if corrected.is_refused() && !shop.allow_partial {
        console.say("nothing is written; --allow-partial writes the rest and leaves refused targets as they are");
        return Ok(Exit::No);
    }
    if let Some(other) = corrected.changed().find(|&file| file > 0) {
        let name = corrected.loaded.sources[other].name();
        let message = format!("targets of this program stand in {name}: --out-dir DIR writes all files of the job");
        return Err(Failure::Usage(message));
    }
    let exit = if corrected.is_refused() { Exit::No } else { Exit::Done };
    // The first of the job is the one that was asked for.
    if let Some(bytes) = corrected.into_files()?.first() {
        output::write(&output, bytes)?;
    }
    Ok(exit)
}

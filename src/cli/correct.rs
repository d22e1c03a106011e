//! `falsetarget correct`: the main job.

use std::path::{Path, PathBuf};

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::edit::EditSet;
use crate::base::text::Source;
use crate::files::calibration::Calibration;
use crate::files::cell::Cell;
use crate::kinematics::controller::Controller;
use crate::program::dialect::Dialect;
use crate::report::targets::{FileReport, TargetsReport, files};
use crate::rewrite::class::Class;
use crate::rewrite::correct::{Job, Options, correct};
use crate::rewrite::outcome::Outcome;
use crate::rewrite::split::split;

use super::console::Console;
use super::exit::{Exit, Failure};
use super::job::{self, Loaded};
use super::{batch, load, output, tell};

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
    /// Model of the real robot, a robot file, or a built-in robot's name
    #[arg(long, value_name = "MODEL")]
    model: String,
    /// Tools and frames that the program names but does not hold
    #[arg(long, value_name = "CELL.yaml")]
    cell: Option<PathBuf>,
    /// Take the programs as this language instead of telling it from their content
    #[arg(long, value_name = "NAME", value_parser = load::parse_dialect)]
    pub(super) dialect: Option<&'static dyn Dialect>,
    /// Write what happened to every target as JSON (falsetarget/targets/1); `-` for standard output
    #[arg(long, value_name = "R.json")]
    pub(super) report: Option<PathBuf>,
    /// Correct joint targets too: they are taken to mean the pose that the nominal robot has there
    #[arg(long)]
    joint_targets: bool,
    /// Write the file although some targets are refused; those stay as they are
    #[arg(long)]
    pub(super) allow_partial: bool,
    /// Give a target that is used with several tools, frames or loads one declaration for each (RAPID): copies are
    /// put behind the declaration, and the moves name them
    #[arg(long)]
    split_shared: bool,
    /// Refuse targets outside the joint region that the recordings covered
    #[arg(long)]
    inside_only: bool,
    /// Believe the units of a program whose numbers look like metres where millimetres belong
    #[arg(long)]
    trust_units: bool,
    /// Where to write the corrected program; `-` is standard output
    #[arg(short, long, value_name = "FILE", conflicts_with = "out_dir")]
    output: Option<PathBuf>,
    /// Folder for the corrected programs; the tree of a PROGRAM that is a folder is mirrored
    #[arg(long, value_name = "DIR")]
    out_dir: Option<PathBuf>,
    /// Number of programs corrected at once [default: one a processor]
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
    /// Programs, or folders with --out-dir
    #[arg(value_name = "PROGRAM")]
    pub(super) programs: Vec<PathBuf>,
}

/// What every file of a run shares.
pub(super) struct Shop<'a> {
    pub args: &'a Args,
    calibration: Calibration,
    controller: Controller,
    cell: Cell,
    options: Options,
}

/// A corrected job, not yet written.
pub(super) struct Corrected {
    pub loaded: Loaded,
    pub outcome: Outcome,
    /// The job's own files.
    pub files: Vec<Vec<u8>>,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let calibration = load::model(&args.model)?;
    let options = Options { joint_targets: args.joint_targets, inside_only: region(args, &calibration)? };
    let controller = Controller::new(&calibration.arm.robot);
    let shop = Shop { args, calibration, controller, cell: load::cell(args.cell.as_deref())?, options };
    match &args.out_dir {
        Some(out_dir) => batch::run(&shop, out_dir, console),
        None => one(&shop, console),
    }
}

fn region(args: &Args, calibration: &Calibration) -> Result<Option<crate::files::calibration::Region>, Failure> {
    if !args.inside_only {
        return Ok(None);
    }
    let missing = || Failure::Usage(format!("--inside-only: {} names no calibrated region", args.model));
    calibration.region.map(Some).ok_or_else(missing)
}

fn one(shop: &Shop<'_>, console: &Console) -> Result<Exit, Failure> {
    let file = match &shop.args.programs[..] {
        [] => None,
        [path] if path.as_os_str() == "-" => None,
        [path] => Some(path),
        _ => return Err(Failure::Usage("several programs need --out-dir".into())),
    };
    let output = shop.args.output.clone().unwrap_or_else(|| PathBuf::from("-"));
    for path in shop.args.report.iter().chain([&output]) {
        if shop.args.programs.first().is_some_and(|program| same_file(program, path)) {
            return Err(Failure::Usage(format!("{} would overwrite the program itself", path.display())));
        }
        output::check(path)?;
    }
    if shop.args.report.as_ref().is_some_and(|report| report != Path::new("-") && *report == output) {
        return Err(Failure::Usage("the program and the report cannot both go to one file".into()));
    }
    let both_on_stdout = shop.args.report.as_deref() == Some(Path::new("-")) && output.as_os_str() == "-";
    if both_on_stdout {
        return Err(Failure::Usage("the program and the report cannot both go to standard output".into()));
    }
    let loaded = match file {
        Some(path) => job::of_file(path, shop.args.dialect)?,
        None => job::of_standard_input(shop.args.dialect)?,
    };
    let corrected = shop.correct(loaded)?;
    tell::targets(console, &corrected.loaded, &corrected.outcome);
    if let Some(path) = &shop.args.report {
        output::write_json(path, &TargetsReport::new(corrected.reports()))?;
    }
    if corrected.is_refused() && !shop.args.allow_partial {
        console.say("nothing is written; --allow-partial writes the rest and leaves refused targets as they are");
        return Ok(Exit::No);
    }
    if let Some(other) = corrected.changed().find(|&file| file > 0) {
        let name = corrected.loaded.sources[other].name();
        let message = format!("targets of this program stand in {name}: --out-dir DIR writes all files of the job");
        return Err(Failure::Usage(message));
    }
    output::write(&output, &corrected.files[0])?;
    Ok(if corrected.is_refused() { Exit::No } else { Exit::Done })
}

/// True when both names lead to the same existing file or folder.
pub(super) fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

impl Shop<'_> {
    /// Corrects a job; nothing is written.
    ///
    /// # Errors
    /// [`Failure::Program`] when it holds errors, or numbers in another unit.
    pub fn correct(&self, loaded: Loaded) -> Result<Corrected, Failure> {
        let metres = loaded.program.diagnostics.iter().find(|finding| finding.code == "unit-scale");
        if let Some(finding) = metres.filter(|_| !self.args.trust_units) {
            let finding = Diagnostic { severity: Severity::Error, ..finding.clone() }
                .help("convert the program to its language's unit; --trust-units takes the numbers as they are");
            return Err(Failure::Program(loaded.sources, vec![finding]));
        }
        let outcome = self.outcome(&loaded);
        if self.args.split_shared && outcome.targets.iter().any(|target| target.shared) {
            let edits = split(&loaded.sources, &loaded.program, &outcome);
            if !edits.iter().all(EditSet::is_empty) {
                let with_copies = with_edits(loaded, &edits)?;
                let outcome = self.outcome(&with_copies);
                return corrected(with_copies, outcome);
            }
        }
        corrected(loaded, outcome)
    }

    fn outcome(&self, loaded: &Loaded) -> Outcome {
        let job = Job {
            sources: &loaded.sources,
            program: &loaded.program,
            rules: loaded.dialect.meta().numbers,
            cell: &self.cell,
        };
        correct(&job, &self.calibration.arm, &self.controller, &self.options)
    }
}

/// The job with edits made, read again.
fn with_edits(loaded: Loaded, edits: &[EditSet]) -> Result<Loaded, Failure> {
    let own = apply(&loaded, edits)?;
    let names = loaded.sources.iter().map(|source| source.name().to_string());
    let mut sources: Vec<Source> = names.zip(own).map(|(name, bytes)| Source::new(name, bytes)).collect();
    sources.extend(loaded.sources.into_iter().skip(loaded.own));
    job::read(sources, loaded.own, loaded.dialect)
}

fn corrected(loaded: Loaded, outcome: Outcome) -> Result<Corrected, Failure> {
    let files = apply(&loaded, &outcome.edits)?;
    Ok(Corrected { loaded, outcome, files })
}

/// The job's own files with edits made.
fn apply(loaded: &Loaded, edits: &[EditSet]) -> Result<Vec<Vec<u8>>, Failure> {
    let own = loaded.sources.iter().zip(edits).take(loaded.own);
    let files: Result<_, _> = own.map(|(source, edits)| edits.apply(source.bytes())).collect();
    files.map_err(|error| Failure::Program(loaded.sources.clone(), vec![Diagnostic::error("edit", error.to_string())]))
}

impl Corrected {
    /// What happened to its targets.
    pub fn reports(&self) -> Vec<FileReport> {
        files(&self.loaded.sources, self.loaded.dialect, &self.loaded.program, Some(&self.outcome))
    }

    /// Some target has no solution.
    pub fn is_refused(&self) -> bool {
        self.outcome.count(Class::Refused) > 0
    }

    /// The files that come out other than they went in.
    fn changed(&self) -> impl Iterator<Item = usize> + '_ {
        self.outcome.edits.iter().enumerate().filter(|(_, edits)| !edits.is_empty()).map(|(file, _)| file)
    }
}

//! `falsetarget correct --out-dir`: many programs at once.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::program::dialect::{self, Dialect};
use crate::report::targets::{FileReport, TargetsReport};

use super::console::Console;
use super::correct::{Shop, same_file, tell};
use super::exit::{Exit, Failure};
use super::{job, load, output};

/// One input and where its output goes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Item {
    input: PathBuf,
    output: PathBuf,
}

/// Files that are corrected together.
struct JobItems {
    dialect: &'static dyn Dialect,
    items: Vec<Item>,
}

/// Corrects programs and folders into `out_dir`.
pub(super) fn run(shop: &Shop<'_>, out_dir: &Path, console: &Console) -> Result<Exit, Failure> {
    let args = shop.args();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(args.jobs.unwrap_or(0))
        .build()
        .map_err(|error| Failure::Usage(format!("--jobs: {error}")))?;
    let items = items(&args.programs, out_dir)?;
    let dialects = pool.install(|| dialects(&items, args.dialect));
    let Sorted { jobs, skipped, failures } = sorted(items, dialects, &args.programs, out_dir)?;
    for item in &skipped {
        console.say(&format!("{}: no robot program that this tool knows; not copied", item.input.display()));
    }
    let progress = match console.is_terminal() {
        true => indicatif::ProgressBar::new(jobs.len() as u64),
        false => indicatif::ProgressBar::hidden(),
    };
    let results: Vec<Result<Vec<FileReport>, Failure>> = pool.install(|| {
        jobs.par_iter()
            .map(|job| {
                let result = correct_job(shop, job, console);
                progress.inc(1);
                result
            })
            .collect()
    });
    progress.finish_and_clear();
    let (mut exit, mut reports) = (Exit::Done, Vec::new());
    for result in failures.into_iter().map(Err).chain(results) {
        match result {
            Ok(files) => reports.extend(files),
            Err(failure) => {
                console.failure(&failure);
                exit = Exit::No;
            }
        }
    }
    let report = TargetsReport::new(reports);
    let summary = report.summary;
    console.say(&format!(
        "{} file(s): {} corrected, {} joint, {} computed, {} refused; {} other file(s) are no robot programs",
        summary.files,
        summary.corrected,
        summary.joint,
        summary.computed,
        summary.refused,
        skipped.len()
    ));
    if let Some(path) = &args.report {
        output::write_json(path, &report)?;
    }
    Ok(if summary.refused > 0 { exit.max(Exit::No) } else { exit })
}

/// Corrects a job and writes all its files, or none.
fn correct_job(shop: &Shop<'_>, job: &JobItems, console: &Console) -> Result<Vec<FileReport>, Failure> {
    let inputs: Vec<PathBuf> = job.items.iter().map(|item| item.input.clone()).collect();
    let corrected = shop.correct(job::of_files(&inputs, job.dialect)?)?;
    tell(console, &corrected);
    if !corrected.is_refused() || shop.args().allow_partial {
        for folder in job.items.iter().filter_map(|item| item.output.parent()) {
            std::fs::create_dir_all(folder).map_err(|error| Failure::file(folder, error))?;
        }
        let outputs = job.items.iter().map(|item| item.output.as_path());
        let files: Vec<(&Path, &[u8])> = outputs.zip(corrected.files().iter().map(Vec::as_slice)).collect();
        output::write_all(&files)?;
    }
    Ok(corrected.reports())
}

/// The languages of the files; none for a file that is no robot program.
fn dialects(
    items: &[Item],
    wanted: Option<&'static dyn Dialect>,
) -> Vec<Result<Option<&'static dyn Dialect>, Failure>> {
    let of = |item: &Item| {
        let source = load::source(&item.input)?;
        match (wanted, dialect::detect(&source)) {
            (None, None) => Ok(None),
            _ => job::dialect_of(&source, wanted).map(Some),
        }
    };
    items.par_iter().map(of).collect()
}

/// The files of a run, put together as jobs.
struct Sorted {
    jobs: Vec<JobItems>,
    skipped: Vec<Item>,
    failures: Vec<Failure>,
}

fn sorted(
    items: Vec<Item>,
    dialects: Vec<Result<Option<&'static dyn Dialect>, Failure>>,
    programs: &[PathBuf],
    out_dir: &Path,
) -> Result<Sorted, Failure> {
    let mut sorted = Sorted { jobs: Vec::new(), skipped: Vec::new(), failures: Vec::new() };
    let mut jobs: BTreeMap<(PathBuf, &'static str, String), (&'static dyn Dialect, BTreeSet<Item>)> = BTreeMap::new();
    for (item, dialect) in items.into_iter().zip(dialects) {
        let dialect = match dialect {
            Ok(Some(dialect)) => dialect,
            Ok(None) => {
                sorted.skipped.push(item);
                continue;
            }
            Err(failure) => {
                sorted.failures.push(failure);
                continue;
            }
        };
        let name = item.input.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let folder = item.input.parent().unwrap_or(Path::new("")).to_path_buf();
        let key = (folder, dialect.meta().id, dialect.job_of(&name));
        let (_, job) = jobs.entry(key).or_insert_with(|| (dialect, BTreeSet::new()));
        // A file that was named alone brings what lies beside it; a folder brings all that it holds.
        if programs.contains(&item.input) {
            for input in job::companions(&item.input, dialect)? {
                let output = out_dir.join(input.file_name().unwrap_or_default());
                let item = Item { input, output };
                refuse_to_overwrite(&item)?;
                job.insert(item);
            }
        }
        job.insert(item);
    }
    sorted.jobs = jobs.into_values().map(|(dialect, items)| JobItems { dialect, items: in_order(items) }).collect();
    Ok(sorted)
}

/// The files of a job, the last by name first: a program before its data (`.src`, `.dat`).
fn in_order(items: BTreeSet<Item>) -> Vec<Item> {
    items.into_iter().rev().collect()
}

/// The files of a batch, folders walked, in a stable order.
fn items(programs: &[PathBuf], out_dir: &Path) -> Result<Vec<Item>, Failure> {
    if programs.is_empty() {
        return Err(Failure::Usage("--out-dir needs at least one PROGRAM or folder".into()));
    }
    let mut items = Vec::new();
    for program in programs {
        if program.is_dir() {
            if same_file(program, out_dir) {
                return Err(Failure::Usage(format!("{} is both input and --out-dir", out_dir.display())));
            }
            walk(program, out_dir, &mut items)?;
        } else {
            let name =
                program.file_name().ok_or_else(|| Failure::Usage(format!("{} is no file", program.display())))?;
            items.push(Item { input: program.clone(), output: out_dir.join(name) });
        }
    }
    items.sort();
    items.iter().try_for_each(refuse_to_overwrite)?;
    Ok(items)
}

fn refuse_to_overwrite(item: &Item) -> Result<(), Failure> {
    match same_file(&item.input, &item.output) {
        true => Err(Failure::Usage(format!("{} would be overwritten", item.input.display()))),
        false => Ok(()),
    }
}

fn walk(folder: &Path, out: &Path, items: &mut Vec<Item>) -> Result<(), Failure> {
    let entries = std::fs::read_dir(folder).map_err(|error| Failure::file(folder, error))?;
    for entry in entries {
        let entry = entry.map_err(|error| Failure::file(folder, error))?;
        let (path, name) = (entry.path(), entry.file_name());
        if path.is_dir() {
            walk(&path, &out.join(&name), items)?;
        } else {
            items.push(Item { input: path, output: out.join(&name) });
        }
    }
    Ok(())
}

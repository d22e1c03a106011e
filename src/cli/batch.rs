//! `falsetarget correct --out-dir`: many programs at once.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::program::dialect;
use crate::report::targets::{FileReport, TargetsReport};
use crate::rewrite::class::Class;

use super::console::Console;
use super::correct::{Shop, same_file};
use super::exit::{Exit, Failure};
use super::{load, output, tell};

/// One input of a batch and where its output goes.
struct Item {
    input: PathBuf,
    output: PathBuf,
    /// Named by the user, not found in a folder: it is an error when it is no program.
    named: bool,
}

/// What became of one file of a batch.
struct Done {
    console: Console,
    result: Result<Option<Vec<FileReport>>, Failure>,
}

/// Corrects every program into its place under `out_dir`.
///
/// A program is written when it has no refused target; the others of the batch do not wait for it. The exit status is
/// the worst of all files.
pub fn run(shop: &Shop<'_>, out_dir: &Path, console: &Console) -> Result<Exit, Failure> {
    let items = items(&shop.args.programs, out_dir)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(shop.args.jobs.unwrap_or(0))
        .build()
        .map_err(|error| Failure::Usage(format!("--jobs: {error}")))?;
    let progress = match console.is_terminal() {
        true => indicatif::ProgressBar::new(items.len() as u64),
        false => indicatif::ProgressBar::hidden(),
    };
    let all: Vec<Done> = pool.install(|| {
        let work = |item| {
            let console = console.holding();
            let result = one_file(shop, item, &console);
            progress.inc(1);
            Done { console, result }
        };
        items.par_iter().map(work).collect()
    });
    progress.finish_and_clear();
    let (mut exit, mut reports, mut skipped) = (Exit::Done, Vec::new(), 0);
    for done in all {
        console.release(done.console);
        match done.result {
            Ok(Some(files)) => reports.extend(files),
            Ok(None) => skipped += 1,
            Err(failure) => exit = exit.max(console.failure(&failure)),
        }
    }
    let report = TargetsReport::new(reports);
    let summary = report.summary;
    console.say(&format!(
        "{} file(s): {} corrected, {} joint, {} computed, {} refused; {skipped} other file(s) are no robot programs",
        summary.files, summary.corrected, summary.joint, summary.computed, summary.refused
    ));
    if let Some(path) = &shop.args.report {
        output::write_json(path, &report)?;
    }
    Ok(if summary.refused > 0 { exit.max(Exit::No) } else { exit })
}

/// Corrects and writes one file of a batch; `None` for a file of a folder that is no robot program.
fn one_file(shop: &Shop<'_>, item: &Item, console: &Console) -> Result<Option<Vec<FileReport>>, Failure> {
    let source = load::source(&item.input)?;
    if !item.named && shop.args.dialect.is_none() && dialect::detect(&source).is_none() {
        console.say(&format!("{}: no robot program that this tool knows; not copied", item.input.display()));
        return Ok(None);
    }
    let corrected = shop.correct(source)?;
    tell::targets(console, &corrected.loaded, &corrected.outcome);
    if corrected.outcome.count(Class::Refused) == 0 || shop.args.allow_partial {
        if let Some(folder) = item.output.parent() {
            std::fs::create_dir_all(folder).map_err(|error| Failure::file(folder, error))?;
        }
        output::write(&item.output, &corrected.bytes)?;
    } else {
        console.say(&format!("{} is not written; --allow-partial writes the rest of it", item.output.display()));
    }
    Ok(Some(corrected.reports()))
}

/// The files of a batch, folders walked, in a stable order.
fn items(programs: &[PathBuf], out_dir: &Path) -> Result<Vec<Item>, Failure> {
    if programs.is_empty() {
        return Err(Failure::Usage("--out-dir needs at least one PROGRAM or folder".into()));
    }
    if out_dir.exists() && !out_dir.is_dir() {
        return Err(Failure::Usage(format!("--out-dir {} is a file", out_dir.display())));
    }
    let mut items = Vec::new();
    for program in programs {
        if program.is_dir() {
            if same_file(program, out_dir) {
                return Err(Failure::Usage(format!("{} is both input and --out-dir", out_dir.display())));
            }
            walk(program, out_dir, out_dir, &mut items)?;
        } else {
            let name =
                program.file_name().ok_or_else(|| Failure::Usage(format!("{} is no file", program.display())))?;
            items.push(Item { input: program.clone(), output: out_dir.join(name), named: true });
        }
    }
    items.sort_by(|a, b| (&a.output, &a.input).cmp(&(&b.output, &b.input)));
    if let Some(item) = items.iter().find(|item| same_file(&item.input, &item.output)) {
        return Err(Failure::Usage(format!("{} would be overwritten", item.input.display())));
    }
    if let Some(pair) = items.windows(2).find(|pair| pair[0].output == pair[1].output) {
        let (a, b, output) = (pair[0].input.display(), pair[1].input.display(), pair[0].output.display());
        return Err(Failure::Usage(format!("{a} and {b} would both become {output}")));
    }
    Ok(items)
}

/// The regular files below a folder. Links to folders are not followed (they may lead back), and results of an earlier
/// run below `out_dir` are no input.
fn walk(folder: &Path, out: &Path, out_dir: &Path, items: &mut Vec<Item>) -> Result<(), Failure> {
    let entries = std::fs::read_dir(folder).map_err(|error| Failure::file(folder, error))?;
    for entry in entries {
        let entry = entry.map_err(|error| Failure::file(folder, error))?;
        let (path, output) = (entry.path(), out.join(entry.file_name()));
        let kind = entry.file_type().map_err(|error| Failure::file(&path, error))?;
        if kind.is_dir() {
            if !same_file(&path, out_dir) {
                walk(&path, &output, out_dir, items)?;
            }
        } else if path.is_file() {
            items.push(Item { input: path, output, named: false });
        }
    }
    Ok(())
}

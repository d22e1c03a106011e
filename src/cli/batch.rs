//! `falsetarget correct --out-dir`: many programs at once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::program::dialect::{self, Dialect};
use crate::report::targets::{FileReport, TargetsReport};

use super::console::Console;
use super::correct::{Args, Shop, same_file};
use super::exit::{Exit, Failure};
use super::{job, load, output, tell};

/// One input of a batch and where its output goes.
struct Item {
    input: PathBuf,
    output: PathBuf,
    /// Named by the user, not found in a folder: it is an error when it is no program.
    named: bool,
}

/// Files that are corrected together, in the language that they are written in; one that is no program is alone.
struct Task {
    items: Vec<Item>,
    dialect: Result<Option<&'static dyn Dialect>, Failure>,
}

/// What became of one job of a batch.
struct Done {
    console: Console,
    result: Result<Option<Vec<FileReport>>, Failure>,
}

/// Corrects every program into its place under `out_dir`.
///
/// A job is written whole when it has no refused target; the others of the batch do not wait for it. The exit status is
/// the worst of all.
pub fn run(shop: &Shop<'_>, out_dir: &Path, console: &Console) -> Result<Exit, Failure> {
    let items = items(shop.args, out_dir)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(shop.args.jobs.unwrap_or(0))
        .build()
        .map_err(|error| Failure::Usage(format!("--jobs: {error}")))?;
    let tasks = pool.install(|| tasks(items, shop.args.dialect));
    let progress = match console.is_terminal() {
        true => indicatif::ProgressBar::new(tasks.len() as u64),
        false => indicatif::ProgressBar::hidden(),
    };
    let all: Vec<Done> = pool.install(|| {
        let work = |task| {
            let console = console.holding();
            let result = one_job(shop, task, &console);
            progress.inc(1);
            Done { console, result }
        };
        tasks.into_par_iter().map(work).collect()
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

/// Corrects a job and writes all its files, or none; `None` for a file of a folder that is no robot program.
fn one_job(shop: &Shop<'_>, task: Task, console: &Console) -> Result<Option<Vec<FileReport>>, Failure> {
    let Some(dialect) = task.dialect? else {
        for item in &task.items {
            console.say(&format!("{}: no robot program that this tool knows; not copied", item.input.display()));
        }
        return Ok(None);
    };
    let inputs: Vec<PathBuf> = task.items.iter().map(|item| item.input.clone()).collect();
    let corrected = shop.correct(job::of_files(&inputs, dialect)?)?;
    tell::targets(console, &corrected.loaded, &corrected.outcome);
    if !corrected.is_refused() || shop.args.allow_partial {
        for folder in task.items.iter().filter_map(|item| item.output.parent()) {
            std::fs::create_dir_all(folder).map_err(|error| Failure::file(folder, error))?;
        }
        let outputs = task.items.iter().map(|item| item.output.as_path());
        let files: Vec<(&Path, &[u8])> = outputs.zip(corrected.files.iter().map(Vec::as_slice)).collect();
        output::write_all(&files)?;
    } else {
        for item in &task.items {
            console.say(&format!("{} is not written; --allow-partial writes the rest of it", item.output.display()));
        }
    }
    Ok(Some(corrected.reports()))
}

/// The items put together as jobs, in the order of the first file of each.
fn tasks(items: Vec<Item>, wanted: Option<&'static dyn Dialect>) -> Vec<Task> {
    let dialects: Vec<_> = items.par_iter().map(|item| language(item, wanted)).collect();
    let mut tasks: Vec<Task> = Vec::new();
    let mut known: HashMap<(PathBuf, &'static str, String), usize> = HashMap::new();
    for (item, dialect) in items.into_iter().zip(dialects) {
        if let Ok(Some(dialect)) = &dialect {
            let name = item.input.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let folder = item.input.parent().unwrap_or(Path::new("")).to_path_buf();
            let job = *known.entry((folder, dialect.meta().id, dialect.job_of(&name))).or_insert(tasks.len());
            if let Some(task) = tasks.get_mut(job) {
                task.items.push(item);
                continue;
            }
        }
        tasks.push(Task { items: vec![item], dialect });
    }
    // A program before its data: `.src`, `.dat`.
    tasks.iter_mut().for_each(|task| task.items.sort_by(|a, b| b.input.cmp(&a.input)));
    tasks
}

/// The language of a file; none for a file of a folder that is no robot program.
fn language(item: &Item, wanted: Option<&'static dyn Dialect>) -> Result<Option<&'static dyn Dialect>, Failure> {
    let source = load::source(&item.input)?;
    if !item.named && wanted.is_none() && dialect::detect(&source).is_none() {
        return Ok(None);
    }
    job::dialect_of(&source, wanted).map(Some)
}

/// The files of a batch, folders walked, in a stable order.
fn items(args: &Args, out_dir: &Path) -> Result<Vec<Item>, Failure> {
    let programs = &args.programs;
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
            for input in beside(program, args.dialect).into_iter().filter(|input| !programs.contains(input)) {
                let output = out_dir.join(input.file_name().unwrap_or_default());
                // Two named files of one job bring the same others.
                if !items.iter().any(|item| item.input == input) {
                    items.push(Item { input, output, named: true });
                }
            }
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

/// The other files of the job of a file that was named alone; a folder brings all that it holds. What is wrong with
/// the file is said later.
fn beside(program: &Path, wanted: Option<&'static dyn Dialect>) -> Vec<PathBuf> {
    let dialect = load::source(program).ok().and_then(|source| wanted.or_else(|| dialect::detect(&source)));
    dialect.and_then(|dialect| job::companions(program, dialect).ok()).unwrap_or_default()
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

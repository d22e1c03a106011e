//! `falsetarget correct --out-dir`: many programs at once.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use sha2::{Digest, Sha256};

use crate::report::tally::Tally;
use crate::rewrite::class::Class;

use super::census::{self, Entry, Plan};
use super::console::Console;
use super::exit::{Exit, Failure};
use super::in_order::in_order;
use super::items::{self, Item};
use super::record::{Flushing, Place, Records, hex};
use super::report_file::{self, ReportFile};
use super::shop::{Corrected, Shop, same_file};
use super::summary::Summary;
use super::{job, tell};

/// How many programs are corrected at once, and which.
#[derive(clap::Args)]
pub struct BatchArgs {
    /// Folder for the corrected programs; the tree of a PROGRAM that is a folder is mirrored. A run that was stopped
    /// and is started again goes on where it stopped
    #[arg(long, value_name = "DIR")]
    pub out_dir: Option<PathBuf>,
    /// Number of programs corrected at once, and of parts of a large one [default: one a processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// What to do with the files of a folder that are no robot programs
    #[arg(long, value_name = "WHAT", default_value = "skip")]
    others: Others,
    /// Begin no further program after one that cannot be written
    #[arg(long)]
    fail_fast: bool,
    /// Do the K-th of N parts of the programs: N computers with one DIR share a library
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
}

/// What becomes of files that are no robot programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Others {
    /// Mirrored byte for byte.
    Copy,
    /// Left out.
    Skip,
}

/// A part of a library.
#[derive(Clone, Copy, Debug)]
struct Shard {
    /// From zero.
    index: u64,
    count: u64,
}

/// Files that are corrected together, or one that is no program.
enum Work<'a> {
    Job(&'a Plan),
    Other(usize),
    Bad(usize),
}

/// A piece of work and where its outputs go.
struct Task<'a> {
    work: Work<'a>,
    place: Place,
}

/// What became of a task.
pub enum Fate {
    Written(Tally, Vec<String>),
    /// By an earlier run.
    Finished(Tally, Vec<String>),
    /// Some target is refused: with the first reason.
    Refused(Tally, Vec<String>, String),
    Other,
}

/// What all jobs of a run are done with.
pub struct Batch<'a> {
    pub shop: &'a Shop,
    pub entries: &'a [Entry],
    pub records: &'a Records,
    pub others: Others,
    pub with_reports: bool,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse::<u64>().ok()?, n.parse::<u64>().ok()?)));
        match numbers {
            Some((k, count)) if (1..=count).contains(&k) => Ok(Self { index: k - 1, count }),
            _ => Err("expected K/N with K from 1 to N".into()),
        }
    }
}

/// Corrects every program into its place under `out_dir`.
///
/// A job is written whole when it has no refused target; the others of the batch do not wait for it. The exit status is
/// the worst of all.
pub fn run(
    shop: &Shop,
    args: &BatchArgs,
    programs: &[PathBuf],
    out_dir: &Path,
    report: Option<&Path>,
    console: &Console,
) -> Result<Exit, Failure> {
    let threads = args.jobs.map_or_else(processors, usize::from);
    // The targets of a large program are shared out too, among as many; a pool that is there already does as well.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
    let (items, entries) = survey(programs, out_dir, shop, threads)?;
    let plans = census::plans(&entries);
    let all = tasks(&entries, &items, &plans, out_dir);
    items::check_places(all.iter().flat_map(|task| task.work.files()).map(|file| &items[file]).collect())?;
    let records = Records::below(out_dir, Flushing::AtTheEnd);
    let batch =
        Batch { shop, entries: &entries, records: &records, others: args.others, with_reports: report.is_some() };
    let mut report = report.map(ReportFile::create).transpose()?;

    let is_ours = |task: &Task<'_>| args.shard.is_none_or(|shard| task.place.shard(shard.count) == shard.index);
    let (tasks, theirs): (Vec<Task<'_>>, Vec<Task<'_>>) = all.into_iter().partition(is_ours);
    let mut summary =
        Summary { other_shards: theirs.len(), others_copied: args.others == Others::Copy, ..Summary::default() };

    let progress = match console.is_terminal() {
        true => indicatif::ProgressBar::new(tasks.len() as u64),
        false => indicatif::ProgressBar::hidden(),
    };
    let (mut exit, mut failed_writing, mut taken) = (Exit::Done, None, 0);
    let work = |index: usize| {
        let console = console.holding();
        let fate = batch.task(&tasks[index], &console);
        (console, fate)
    };
    let is_last = |(_, fate): &(Console, Result<Fate, Failure>)| {
        args.fail_fast && !fate.as_ref().is_ok_and(|fate| fate.exit() == Exit::Done)
    };
    in_order(threads, tasks.len(), work, is_last, |index, (said, fate)| {
        progress.suspend(|| console.release(said));
        progress.inc(1);
        taken += 1;
        let task = &tasks[index];
        let one = match fate {
            Ok(fate) => note(&mut summary, task, &batch, fate),
            Err(failure) => {
                let exit = progress.suspend(|| console.failure(&failure));
                summary.left_out.extend(batch.names(task).map(|name| (name, failure.to_string())));
                (exit, Vec::new())
            }
        };
        exit = exit.max(one.0);
        if let Some(Err(failure)) = report.as_mut().map(|report| report.add(&one.1)) {
            failed_writing = Some(failure);
        }
        match failed_writing.is_some() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    progress.finish_and_clear();
    summary.not_begun = tasks.len() - taken;
    if let Some(failure) = failed_writing {
        return Err(failure);
    }
    console.say(&summary.text());
    if let Some(report) = report {
        report.finish(&summary.tally)?;
    }
    if summary.not_begun == 0 {
        tasks.iter().try_for_each(|task| records.flush(&task.place))?;
        tasks.iter().for_each(|task| records.forget(&task.place));
        records.close(args.shard.is_none());
    }
    Ok(exit)
}

fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The files that were asked for and those beside them that may be of their jobs, in a stable order, each looked at.
fn survey(
    programs: &[PathBuf],
    out_dir: &Path,
    shop: &Shop,
    threads: usize,
) -> Result<(Vec<Item>, Vec<Entry>), Failure> {
    let asked = items::items(programs, out_dir)?;
    let mut all: Vec<(Item, Entry)> = Vec::with_capacity(asked.len());
    let look = |index: usize| census::look(&asked[index].input, shop.dialect, asked[index].is_named);
    let mut entries = Vec::with_capacity(asked.len());
    let take = |_, entry| {
        entries.push(entry);
        ControlFlow::Continue(())
    };
    in_order(threads, asked.len(), look, |_| false, take);
    // A folder brings all that it holds.
    let named = asked.iter().zip(&entries).filter(|(item, _)| item.is_named);
    let mut beside: Vec<Entry> = named.flat_map(|(_, entry)| census::beside(entry)).collect();
    all.extend(asked.into_iter().zip(entries));
    beside.retain(|entry| !all.iter().any(|(item, _)| same_file(&item.input, &entry.path)));
    for entry in beside {
        let output = out_dir.join(entry.path.file_name().unwrap_or_default());
        all.push((Item { input: entry.path.clone(), output, is_named: false, is_asked: false }, entry));
    }
    all.sort_by(|(a, _), (b, _)| (&a.output, &a.input).cmp(&(&b.output, &b.input)));
    // Two files of one job bring the same others; a file that is named twice is one.
    all.dedup_by(|(a, _), (b, _)| a.input == b.input && a.output == b.output);
    Ok(all.into_iter().unzip())
}

/// All there is to do, in the order of the files.
fn tasks<'a>(entries: &[Entry], items: &[Item], plans: &'a [Plan], out_dir: &Path) -> Vec<Task<'a>> {
    let asked_for = |plan: &&Plan| plan.own.iter().any(|file| items[*file].is_asked);
    let jobs = plans.iter().filter(asked_for).map(Work::Job);
    let rest = entries.iter().zip(items).enumerate().filter(|(_, (_, item))| item.is_asked);
    let rest = rest.filter_map(|(file, (entry, _))| match &entry.dialect {
        Ok(Some(_)) => None,
        Ok(None) => Some(Work::Other(file)),
        Err(_) => Some(Work::Bad(file)),
    });
    let mut all: Vec<Work<'a>> = jobs.chain(rest).collect();
    all.sort_by_key(|work| work.files().iter().min().copied());
    let place =
        |work: &Work<'_>| Place::new(out_dir, work.files().iter().map(|file| items[*file].output.clone()).collect());
    all.into_iter().map(|work| Task { place: place(&work), work }).collect()
}

impl Fate {
    /// How a run of nothing else would end.
    fn exit(&self) -> Exit {
        match self {
            Fate::Written(tally, _) | Fate::Finished(tally, _) if tally.refused == 0 => Exit::Done,
            Fate::Written(..) | Fate::Finished(..) | Fate::Refused(..) => Exit::No,
            Fate::Other => Exit::Done,
        }
    }
}

impl Work<'_> {
    /// The files that are written together.
    fn files(&self) -> Vec<usize> {
        match self {
            Work::Job(plan) => plan.own.clone(),
            Work::Other(file) | Work::Bad(file) => vec![*file],
        }
    }
}

impl Batch<'_> {
    /// Does a task; what it writes appears whole or not at all.
    fn task(&self, task: &Task<'_>, console: &Console) -> Result<Fate, Failure> {
        match task.work {
            Work::Job(plan) => self.job(plan, &task.place, console),
            Work::Other(file) => self.other(&self.entries[file].path, &task.place, console),
            // Looked at again, for what was wrong with it.
            Work::Bad(file) => {
                let path = &self.entries[file].path;
                census::look(path, self.shop.dialect, true).dialect.map(|_| Fate::Other)
            }
        }
    }

    /// Corrects a job and writes it, unless that is done already.
    ///
    /// # Errors
    /// [`Failure`] when a file cannot be read or written, or holds errors.
    pub fn job(&self, plan: &Plan, place: &Place, console: &Console) -> Result<Fate, Failure> {
        let paths =
            |files: &[usize]| -> Vec<PathBuf> { files.iter().map(|file| self.entries[*file].path.clone()).collect() };
        let (own, shared) = (paths(&plan.own), paths(&plan.shared));
        let key = self.key(plan, &own);
        if let Some(record) = self.records.finished(place, &key, self.with_reports) {
            return Ok(Fate::Finished(record.tally, record.reports.unwrap_or_default()));
        }
        let corrected = self.shop.correct(job::of_files(&own, &shared, plan.dialect)?)?;
        tell::targets(console, &corrected.loaded, &corrected.outcome);
        let tally = Tally::of(&corrected.loaded.program, &corrected.outcome, corrected.loaded.own);
        let reports = match self.with_reports {
            true => Some(report_file::lines(&corrected.reports())?),
            false => None,
        };
        if let Some(reason) = first_refusal(&corrected).filter(|_| !self.shop.allow_partial) {
            for output in &place.outputs {
                console.say(&format!("{} is not written; --allow-partial writes the rest of it", output.display()));
            }
            return Ok(Fate::Refused(tally, reports.unwrap_or_default(), reason));
        }
        self.records.finish(place, &corrected.into_files()?, &key, tally, reports.clone())?;
        Ok(Fate::Written(tally, reports.unwrap_or_default()))
    }

    /// Copies or leaves a file that is no program.
    ///
    /// # Errors
    /// [`Failure::File`]
    pub fn other(&self, path: &Path, place: &Place, console: &Console) -> Result<Fate, Failure> {
        let fate = match self.others {
            Others::Skip => "not copied",
            Others::Copy => {
                self.records.copy(place, path)?;
                "copied"
            }
        };
        console.say(&format!("{}: no robot program that this tool knows; {fate}", path.display()));
        Ok(Fate::Other)
    }

    /// The hash of all that decides about the outputs of a job.
    pub fn key(&self, plan: &Plan, own: &[PathBuf]) -> String {
        let mut hash = Sha256::new();
        hash.update(self.shop.fingerprint);
        hash.update(plan.dialect.meta().id);
        for file in plan.own.iter().chain(&plan.shared) {
            hash.update(self.entries[*file].digest);
        }
        for path in own.first().map(|first| job::shared_files(first, plan.dialect)).unwrap_or_default() {
            hash.update(Sha256::digest(std::fs::read(path).unwrap_or_default()));
        }
        hex(&hash.finalize())
    }

    fn names(&self, task: &Task<'_>) -> impl Iterator<Item = String> {
        let name = |file: usize| self.entries[file].path.display().to_string();
        task.work.files().into_iter().map(name)
    }
}

/// The reason of the first refused target.
fn first_refusal(corrected: &Corrected) -> Option<String> {
    let mut all = corrected.outcome.targets.iter().zip(&corrected.loaded.program.targets);
    let (result, target) = all.find(|(result, _)| result.class == Class::Refused)?;
    let line = corrected.loaded.sources[target.file].line(target.span.start);
    Some(format!("line {line}: {}", result.reason.as_deref().unwrap_or("refused")))
}

/// Adds what became of a task to the summary; how it ended, and its lines for the report.
fn note(summary: &mut Summary, task: &Task<'_>, batch: &Batch<'_>, fate: Fate) -> (Exit, Vec<String>) {
    let name = batch.names(task).next().unwrap_or_default();
    let exit = fate.exit();
    let reports = match fate {
        Fate::Written(tally, reports) => {
            summary.add(&name, &tally);
            reports
        }
        Fate::Finished(tally, reports) => {
            summary.add(&name, &tally);
            summary.finished_before += 1;
            reports
        }
        Fate::Refused(tally, reports, reason) => {
            summary.add(&name, &tally);
            summary.left_out.extend(batch.names(task).map(|name| (name, reason.clone())));
            reports
        }
        Fate::Other => {
            summary.others += 1;
            Vec::new()
        }
    };
    (exit, reports)
}

//! `falsetarget watch`: a hot folder.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use crate::program::dialect::DIALECTS;

use super::batch::{Batch, Fate, Others};
use super::census::{self, Entry, Plan};
use super::console::Console;
use super::exit::{Exit, Failure};
use super::items::{self, Item};
use super::record::{Flushing, Place, Records};
use super::shop::{Shop, ShopArgs, same_file};
use super::writers::files_being_written;

const EXAMPLES: &str = "\
Examples:
  falsetarget watch --model model.yaml --cell cell.yaml from-cam/ to-robot/
  falsetarget watch --once from-cam/ to-robot/            (from cron, with a falsetarget.yaml in from-cam/)";

/// Correct programs as they arrive in a folder
///
/// A file counts as complete when its size and time have not changed for a while, no process holds it open for writing,
/// and neither does the rest of its folder change (programs of several files arrive one after the other). The corrected
/// program then appears in OUT, whole, under the same name and folder; the original stays where it is and is corrected
/// again when it changes. What cannot be corrected is moved aside with a .txt that says why.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    shop: ShopArgs,
    /// Where failures go [default: a folder `failed` in IN]
    #[arg(long, value_name = "DIR")]
    failed: Option<PathBuf>,
    /// What to do with files that are no robot programs
    #[arg(long, value_name = "WHAT", default_value = "skip")]
    others: Others,
    /// Seconds for which a file must not have changed
    #[arg(long, value_name = "S", default_value = "2", value_parser = seconds)]
    settle: Duration,
    /// Seconds between two looks at IN
    #[arg(long, value_name = "S", default_value = "1", value_parser = seconds)]
    every: Duration,
    /// Correct what is there, wait for what is arriving, and end
    #[arg(long)]
    once: bool,
    /// The folder in which programs arrive
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// The folder for corrected programs
    #[arg(value_name = "OUT")]
    output: PathBuf,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let number = text.parse::<f64>().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    number.ok_or_else(|| "expected a number of seconds".into())
}

/// Size and time of a file.
type Stamp = (u64, Option<SystemTime>);

/// A file of the folder.
struct Seen {
    stamp: Stamp,
    since: Instant,
    /// Corrected, copied or left alone as it is now.
    done: bool,
}

struct Watch<'a> {
    args: &'a Args,
    shop: &'a Shop,
    records: Records,
    failed: PathBuf,
    seen: HashMap<PathBuf, Seen>,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    if !args.input.is_dir() {
        return Err(Failure::Usage(format!("{} is no folder", args.input.display())));
    }
    if same_file(&args.input, &args.output) {
        return Err(Failure::Usage(format!("{} is both IN and OUT", args.output.display())));
    }
    let shop = Shop::open(&args.shop, &args.input)?;
    let failed = args.failed.clone().unwrap_or_else(|| args.input.join("failed"));
    let records = Records::below(&args.output, Flushing::Each);
    let mut watch = Watch { args, shop: &shop, records, failed, seen: HashMap::new() };
    let mut exit = Exit::Done;
    loop {
        let (worst, waiting) = watch.look(console)?;
        exit = exit.max(worst);
        if args.once && !waiting {
            return Ok(exit);
        }
        std::thread::sleep(args.every);
    }
}

impl Watch<'_> {
    /// One look at the folder: the worst that happened, and whether something is still arriving.
    fn look(&mut self, console: &Console) -> Result<(Exit, bool), Failure> {
        let apart = [self.args.output.as_path(), self.failed.as_path()];
        let mut items = Vec::new();
        items::walk(&self.args.input, &self.args.output, &apart, &mut items)?;
        items.sort_by(|a, b| a.input.cmp(&b.input));
        self.note(&items);
        let is_new = |item: &&Item| self.seen.get(&item.input).is_some_and(|seen| !seen.done);
        if !items.iter().any(|item| is_new(&item)) {
            return Ok((Exit::Done, false));
        }
        let arriving = self.folders_arriving(&items);
        let is_settled = |item: &Item| item.input.parent().is_none_or(|folder| !arriving.contains(folder));
        let (settled, rest): (Vec<Item>, Vec<Item>) = items.into_iter().partition(is_settled);
        let waiting = rest.iter().any(|item| is_new(&item));
        // The rest of the folder is not read again because one file is slow.
        if !settled.iter().any(|item| is_new(&item)) {
            return Ok((Exit::Done, waiting));
        }
        let entries: Vec<Entry> = settled.iter().map(|item| census::look(&item.input, None, false)).collect();
        Ok((self.settled(&settled, &entries, console), waiting))
    }

    /// Takes note of sizes and times; forgets what has gone.
    fn note(&mut self, items: &[Item]) {
        let now = Instant::now();
        let present: HashSet<&Path> = items.iter().map(|item| item.input.as_path()).collect();
        self.seen.retain(|path, _| present.contains(path.as_path()));
        for item in items {
            let Some(stamp) = stamp(&item.input) else { continue };
            let new = Seen { stamp, since: now, done: false };
            let seen = self.seen.entry(item.input.clone()).or_insert_with(|| Seen { ..new });
            if seen.stamp != stamp {
                *seen = new;
            }
        }
    }

    /// Folders in which some file still changes or is held open.
    fn folders_arriving(&self, items: &[Item]) -> HashSet<PathBuf> {
        let held = files_being_written();
        let is_arriving = |item: &&Item| {
            let changes = self.seen.get(&item.input).is_none_or(|seen| seen.since.elapsed() < self.args.settle);
            changes || item.input.canonicalize().is_ok_and(|path| held.contains(&path))
        };
        let folder = |item: &Item| item.input.parent().map(Path::to_path_buf);
        items.iter().filter(is_arriving).filter_map(folder).collect()
    }

    fn settled(&mut self, items: &[Item], entries: &[Entry], console: &Console) -> Exit {
        let (shop, others) = (self.shop, self.args.others);
        let plans = census::plans(entries);
        let mut exit = Exit::Done;
        for plan in &plans {
            if plan.own.iter().any(|file| !self.is_done(&items[*file])) {
                let batch = Batch { shop, entries, records: &self.records, others, with_reports: false };
                let worst = self.job(&batch, plan, items, console);
                exit = exit.max(worst);
                plan.own.iter().for_each(|file| self.finish(&items[*file]));
            }
        }
        for (item, entry) in items.iter().zip(entries) {
            if !matches!(entry.dialect, Ok(Some(_))) && !self.is_done(item) {
                let batch = Batch { shop, entries, records: &self.records, others, with_reports: false };
                exit = exit.max(self.other(&batch, item, console));
                self.finish(item);
            }
        }
        exit
    }

    fn is_done(&self, item: &Item) -> bool {
        self.seen.get(&item.input).is_some_and(|seen| seen.done)
    }

    fn finish(&mut self, item: &Item) {
        if let Some(seen) = self.seen.get_mut(&item.input) {
            seen.done = true;
        }
    }

    fn job(&self, batch: &Batch<'_>, plan: &Plan, items: &[Item], console: &Console) -> Exit {
        let own: Vec<&Item> = plan.own.iter().map(|file| &items[*file]).collect();
        let place = Place::new(&self.args.output, own.iter().map(|item| item.output.clone()).collect());
        let inputs: Vec<PathBuf> = own.iter().map(|item| item.input.clone()).collect();
        if self.records.knows(&place, &batch.key(plan, &inputs)) {
            return Exit::Done;
        }
        let said = console.holding();
        let exit = match batch.job(plan, &place, &said) {
            Ok(Fate::Refused(..)) => Exit::No,
            Ok(_) => Exit::Done,
            Err(failure) => said.failure(&failure),
        };
        let said = said.into_text();
        if !said.is_empty() {
            console.say(said.trim_end());
        }
        if exit != Exit::Done {
            own.iter().for_each(|item| self.move_aside(item, &said, console));
        }
        exit
    }

    /// A file that is no program: one that is called like one has failed.
    fn other(&self, batch: &Batch<'_>, item: &Item, console: &Console) -> Exit {
        let ending = item.input.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let is_meant_as_program = DIALECTS.iter().any(|dialect| dialect.meta().extensions.contains(&ending.as_str()));
        let said = console.holding();
        let exit = match is_meant_as_program {
            true => match census::look(&item.input, self.shop.dialect, true).dialect {
                Ok(_) => Exit::Done,
                Err(failure) => said.failure(&failure),
            },
            false => {
                let place = Place::new(&self.args.output, vec![item.output.clone()]);
                batch.other(&item.input, &place, &said).map_or_else(|failure| said.failure(&failure), |_| Exit::Done)
            }
        };
        let said = said.into_text();
        if !said.is_empty() {
            console.say(said.trim_end());
        }
        if exit != Exit::Done {
            self.move_aside(item, &said, console);
        }
        exit
    }

    /// Moves a failure where nobody looks for corrected programs, with what there is to say about it; unless it has
    /// changed meanwhile, for then it gets another try.
    fn move_aside(&self, item: &Item, said: &str, console: &Console) {
        let unchanged = self.seen.get(&item.input).is_some_and(|seen| stamp(&item.input) == Some(seen.stamp));
        if !unchanged {
            return;
        }
        let below = item.input.strip_prefix(&self.args.input).unwrap_or(&item.input);
        let place = self.failed.join(below);
        let mut note = place.clone().into_os_string();
        note.push(".txt");
        let done = std::fs::create_dir_all(place.parent().unwrap_or(&self.failed))
            .and_then(|()| std::fs::write(&note, said))
            .and_then(|()| rename(&item.input, &place));
        match done {
            Ok(()) => console.say(&format!("{} was moved to {}", item.input.display(), place.display())),
            Err(error) => _ = console.failure(&Failure::file(&place, error)),
        }
    }
}

fn stamp(path: &Path) -> Option<Stamp> {
    std::fs::metadata(path).ok().map(|metadata| (metadata.len(), metadata.modified().ok()))
}

/// Moves a file, to another disk if need be.
fn rename(from: &Path, to: &Path) -> std::io::Result<()> {
    std::fs::rename(from, to).or_else(|_| std::fs::copy(from, to).and_then(|_| std::fs::remove_file(from)))
}

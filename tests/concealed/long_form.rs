//! Runs the long form: in pieces, if need be.

use std::collections::BTreeSet;
use std::env::var;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;
use std::time::Instant;

use crate::judge::{Outcome, judge};
use crate::plan;
use crate::tables;
use crate::trial::{Spec, build};

/// Reads what to do from the environment and does it.
pub fn run() {
    let path = var("FALSETARGET_RESULTS").unwrap_or_else(|_| {
        let path = concat!(env!("CARGO_TARGET_TMPDIR"), "/concealed.jsonl").to_string();
        // A run that nobody asked to continue starts anew.
        let _ = fs::remove_file(&path);
        path
    });
    let done: BTreeSet<u64> = outcomes(&path).iter().map(|outcome| outcome.number).collect();
    let groups = var("FALSETARGET_GROUPS").unwrap_or_default();
    let wanted = |spec: &Spec| groups.is_empty() || groups.split(',').any(|group| group == spec.group);
    let [part, parts] = shard();
    let series: u64 = var("FALSETARGET_SERIES").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    let specs: Vec<Spec> = plan::all(series)
        .into_iter()
        .filter(wanted)
        .enumerate()
        .filter(|(index, spec)| index % parts == part && !done.contains(&spec.number))
        .map(|(_, spec)| spec)
        .collect();
    let seconds: f64 = var("FALSETARGET_SECONDS").ok().and_then(|text| text.parse().ok()).unwrap_or(f64::INFINITY);
    println!("{} trials to do, {} done before, results in {path}", specs.len(), done.len());
    let file = OpenOptions::new().create(true).append(true).open(&path).expect("a file for the results");
    let file = Mutex::new((file, 0));
    let begun = Instant::now();
    let next = AtomicUsize::new(0);
    let worker = || {
        while begun.elapsed().as_secs_f64() < seconds {
            let Some(spec) = specs.get(next.fetch_add(1, Ordering::Relaxed)) else { return };
            let outcome = judge(spec, &build(spec));
            let line = serde_json::to_string(&outcome).expect("an outcome");
            let mut guard = file.lock().expect("the results");
            writeln!(guard.0, "{line}").expect("room for the results");
            guard.1 += 1;
            let fates: Vec<String> =
                outcome.causes.iter().map(|one| format!("{} {:.1} {:?}", one.kind, one.level, one.fate)).collect();
            println!(
                "{}/{} no. {} {} {} [{}] wrong {:?} {:.1} s",
                guard.1,
                specs.len(),
                outcome.number,
                outcome.group,
                outcome.arm,
                fates.join(", "),
                outcome.wrong,
                outcome.seconds
            );
        }
    };
    // A trial a core; the first come in order, so that a run that is cut short leaves the beginning done.
    std::thread::scope(|scope| {
        for _ in 0..available_parallelism().map_or(1, usize::from) {
            scope.spawn(worker);
        }
    });
    let tables = tables::markdown(&outcomes(&path));
    println!("\n{tables}");
    if let Ok(path) = var("FALSETARGET_TABLES") {
        fs::write(path, tables).expect("a place for the tables");
    }
}

fn outcomes(path: &str) -> Vec<Outcome> {
    let text = fs::read_to_string(path).unwrap_or_default();
    text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// `FALSETARGET_SHARD`: which of how many, counted from one there and from zero here.
fn shard() -> [usize; 2] {
    let text = var("FALSETARGET_SHARD").unwrap_or_else(|_| "1/1".into());
    let numbers: Vec<usize> = text.split('/').filter_map(|number| number.parse().ok()).collect();
    match numbers[..] {
        [part, parts] if (1..=parts).contains(&part) => [part - 1, parts],
        _ => panic!("FALSETARGET_SHARD={text}: expected something like 2/8"),
    }
}

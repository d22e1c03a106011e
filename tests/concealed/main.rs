//! Diagnosis on concealed data: arms, causes and noise drawn at random by a simulator that shares no formula with the
//! model, written to the files that a user would have, diagnosed, and judged.
//!
//! The short form runs with the other tests. The long form, more than a thousand trials and the tables of
//! docs/diagnosis.md:
//!
//! ```text
//! cargo test --release --test concealed -- --ignored --nocapture
//! ```
//!
//! `FALSETARGET_SERIES=7` draws other arms, causes and noise for the same plan. It can be cut and continued:
//! `FALSETARGET_GROUPS=null,single` (also `several`, `hard`, `together`, `outside`), `FALSETARGET_SHARD=2/8`,
//! `FALSETARGET_RESULTS=outcomes.jsonl` (what stands there is not tried again; the tables are of everything in it),
//! `FALSETARGET_SECONDS=200` (begins no trial after that), `FALSETARGET_TABLES=tables.md` (writes the tables there),
//! `FALSETARGET_BIN=falsetarget` (asks a program instead of the library: another version, say).

#![allow(clippy::expect_used, reason = "a test may stop where its own preparation fails")]
#![allow(clippy::print_stdout, reason = "the long form reports")]

mod arm;
mod ask;
mod cause;
mod dice;
mod judge;
mod long_form;
mod measurement;
mod motion;
mod plan;
mod radius;
mod real;
mod rivals;
mod simulator_laws;
mod size;
mod tables;
mod trial;

/// Trials that the diagnosis must get right in any version.
#[test]
fn a_handful_of_trials_is_judged_right() {
    for spec in plan::few() {
        let trial = trial::build(&spec);
        let outcome = judge::judge(&spec, &trial);
        assert_eq!(outcome.refused, None, "{spec:?}");
        assert!(!outcome.alarmed(), "{spec:?} {:?}", outcome.wrong);
        assert!(outcome.causes.iter().all(|one| one.fate.right()), "{spec:?} {:?} {:?}", outcome.causes, outcome.found);
    }
}

/// The long form. See the head of this file.
#[test]
#[ignore = "more than a thousand trials"]
fn long_form() {
    long_form::run();
}

/// Radii of 95 % on fresh recordings. Prints the table of docs/accuracy.md:
///
/// ```text
/// cargo test --release --test concealed -- --ignored --nocapture radii
/// ```
#[test]
#[ignore = "a hundred calibrations"]
fn radii_hold_on_fresh_recordings() {
    let all = radius::study(&plan::fresh(), true);
    println!("| recordings | number | within, % | least | tenth | median | error over noise |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    let pooled = radius::tell("all", &all, |_| true);
    radius::tell("noise stated", &all, |held| held.noise_stated);
    radius::tell("noise not stated", &all, |held| !held.noise_stated);
    for causes in 0..3 {
        radius::tell(&format!("{causes} causes"), &all, |held| held.causes == causes);
    }
    radius::tell("up to 100 records", &all, |held| held.records <= 100);
    radius::tell("240 records and more", &all, |held| held.records >= 240);
    assert!((0.93..=0.97).contains(&pooled), "{pooled}");
}

/// Geometry alone, from few records.
#[test]
#[ignore = "fifty calibrations"]
fn geometry_from_few_records() {
    let all = radius::study(&plan::bare(), false);
    for records in [40, 60, 120, 240] {
        radius::tell(&format!("{records} records"), &all, |held| held.records == records);
    }
    let pooled = radius::tell("all", &all, |_| true);
    assert!((0.93..=0.97).contains(&pooled), "{pooled}");
}

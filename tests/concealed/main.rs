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
//! It can be cut and continued: `FALSETARGET_GROUPS=null,single` (also `several`, `hard`, `together`, `outside`),
//! `FALSETARGET_SHARD=2/8`, `FALSETARGET_RESULTS=outcomes.jsonl` (what stands there is not tried again; the tables are of
//! everything in it), `FALSETARGET_SECONDS=200` (begins no trial after that), `FALSETARGET_TABLES=tables.md` (writes the
//! tables there), `FALSETARGET_BIN=falsetarget` (asks a program instead of the library: another version, say).

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

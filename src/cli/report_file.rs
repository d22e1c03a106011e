//! The report of a run as a file: one JSON document, or JSON lines. Written as the run goes, in its place when whole.

use std::collections::HashSet;
use std::path::Path;

use serde_json::json;

use crate::report::tally::Tally;
use crate::report::targets::{FileReport, SCHEMA, TargetsReport};

use super::exit::Failure;
use super::output::{self, Staged};

/// A report on its way.
pub struct ReportFile {
    is_lines: bool,
    file: Staged,
    files: HashSet<String>,
    is_empty: bool,
}

/// Writes the report of one job.
///
/// # Errors
/// [`Failure::File`] or [`Failure::Output`].
pub fn write_whole(path: &Path, reports: Vec<FileReport<'_>>) -> Result<(), Failure> {
    if !is_lines(path) {
        return output::write_json(path, &TargetsReport::new(reports));
    }
    let summary = TargetsReport::new(reports.clone()).summary;
    let tally = Tally {
        corrected: summary.corrected,
        joint: summary.joint,
        computed: summary.computed,
        refused: summary.refused,
        ..Tally::default()
    };
    let mut file = ReportFile::create(path)?;
    file.add(&lines(&reports)?)?;
    file.finish(&tally)
}

/// Each file of a report as one line of JSON.
///
/// # Errors
/// [`Failure::Output`] when a number has no JSON.
pub fn lines(reports: &[FileReport<'_>]) -> Result<Vec<String>, Failure> {
    let line = |report| serde_json::to_string(report).map_err(|error| Failure::Output(error.into()));
    reports.iter().map(line).collect()
}

fn is_lines(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("jsonl"))
}

impl ReportFile {
    /// Begins a report.
    ///
    /// # Errors
    /// [`Failure::File`] when there is no place for it.
    pub fn create(path: &Path) -> Result<Self, Failure> {
        let file = Staged::create(path)?;
        let mut report = Self { is_lines: is_lines(path), file, files: HashSet::new(), is_empty: true };
        if !report.is_lines {
            report.file.add(format!("{{\n  \"schema\": {},\n  \"files\": [", json!(SCHEMA)).as_bytes())?;
        }
        Ok(report)
    }

    /// Adds files, each a line of JSON.
    ///
    /// # Errors
    /// [`Failure::File`] or [`Failure::Output`].
    pub fn add(&mut self, lines: &[String]) -> Result<(), Failure> {
        let mut text = String::new();
        for line in lines {
            // A file that several jobs share is listed with each and counted once.
            if let Some(path) = path_of(line) {
                self.files.insert(path.to_string());
            }
            match self.is_lines {
                true => text += &format!("{line}\n"),
                false => text += &format!("{}\n    {line}", if self.is_empty { "" } else { "," }),
            }
            self.is_empty = false;
        }
        self.file.add(text.as_bytes())
    }

    /// Adds the summary and puts the report in its place.
    ///
    /// # Errors
    /// [`Failure::File`] or [`Failure::Output`].
    pub fn finish(mut self, tally: &Tally) -> Result<(), Failure> {
        let summary = json!({
            "corrected": tally.corrected, "joint": tally.joint, "computed": tally.computed, "refused": tally.refused,
            "files": self.files.len(),
        });
        let end = match self.is_lines {
            true => format!("{}\n", json!({"schema": SCHEMA, "summary": summary})),
            false => format!("\n  ],\n  \"summary\": {summary}\n}}\n"),
        };
        self.file.add(end.as_bytes())?;
        self.file.finish()
    }
}

/// The path in a line of a report, which begins with it.
fn path_of(line: &str) -> Option<&str> {
    line.strip_prefix("{\"path\":")?.split_once(",\"dialect\":").map(|(path, _)| path)
}

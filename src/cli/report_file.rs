//! The report of a run as a file: one JSON document, or JSON lines. Written as the run goes, in its place when whole.

use std::collections::HashSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::report::tally::Tally;
use crate::report::targets::{FileReport, SCHEMA, TargetsReport};

use super::exit::Failure;
use super::output;

/// A report on its way.
pub struct ReportFile {
    path: PathBuf,
    is_lines: bool,
    /// Nothing for standard output.
    temporary: Option<tempfile::NamedTempFile>,
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
        output::check(path)?;
        let temporary = match path.as_os_str() == "-" {
            true => None,
            false => Some(output::temporary(path).map_err(|error| Failure::file(path, error.kind().into()))?),
        };
        let path = path.to_path_buf();
        let mut report = Self { is_lines: is_lines(&path), path, temporary, files: HashSet::new(), is_empty: true };
        if !report.is_lines {
            report.put(&format!("{{\n  \"schema\": {},\n  \"files\": [", json!(SCHEMA)))?;
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
        self.put(&text)
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
        match self.is_lines {
            true => self.put(&format!("{}\n", json!({"schema": SCHEMA, "summary": summary})))?,
            false => self.put(&format!("\n  ],\n  \"summary\": {summary}\n}}\n"))?,
        }
        let failure = |error: std::io::Error| Failure::file(&self.path, error);
        match self.temporary {
            Some(file) => {
                file.as_file().sync_all().map_err(failure)?;
                file.persist(&self.path).map(|_| ()).map_err(|error| failure(error.error))
            }
            None => Ok(()),
        }
    }

    fn put(&mut self, text: &str) -> Result<(), Failure> {
        match &mut self.temporary {
            Some(file) => file.write_all(text.as_bytes()).map_err(|error| Failure::file(&self.path, error)),
            None => output::print(text.as_bytes()),
        }
    }
}

/// The path in a line of a report, which begins with it.
fn path_of(line: &str) -> Option<&str> {
    line.strip_prefix("{\"path\":")?.split_once(",\"dialect\":").map(|(path, _)| path)
}

//! What a batch says when it is done: one table.

use std::fmt::Write;

use crate::report::tally::Tally;

/// Files that are named one by one; the rest is counted.
const LISTED: usize = 50;

/// What became of the files of a batch.
#[derive(Default)]
pub struct Summary {
    /// Targets of all jobs.
    pub tally: Tally,
    /// The job with the largest correction.
    pub largest: String,
    /// Jobs that an earlier run had finished.
    pub finished_before: usize,
    /// Files that are no robot programs.
    pub others: usize,
    /// What happened to those.
    pub others_copied: bool,
    /// Files that are not written, with the reason.
    pub left_out: Vec<(String, String)>,
    /// Files that another computer does.
    pub other_shards: usize,
    /// Jobs that were not begun because an earlier one failed.
    pub not_begun: usize,
}

impl Summary {
    /// Adds a job.
    pub fn add(&mut self, name: &str, tally: &Tally) {
        if tally.largest_m > self.tally.largest_m {
            self.largest = name.to_string();
        }
        self.tally.add(tally);
    }

    /// In words.
    pub fn text(&self) -> String {
        let tally = &self.tally;
        let fate = if self.others_copied { "copied" } else { "not copied" };
        let mut text = format!(
            "{} file(s): {} corrected, {} joint, {} computed, {} refused; {} other file(s) are no robot programs, {fate}\n",
            tally.files, tally.corrected, tally.joint, tally.computed, tally.refused, self.others
        );
        let mut row = |what: &str, value: String| _ = writeln!(text, "  {what:<22} {value}");
        row("targets", tally.targets().to_string());
        row("correction, mean", format!("{:.3} mm", tally.mean_mm()));
        let of = if self.largest.is_empty() { String::new() } else { format!("  ({})", self.largest) };
        row("correction, largest", format!("{:.3} mm{of}", tally.largest_mm()));
        let counted = [
            ("finished before", self.finished_before, "job(s) that an earlier run had finished"),
            ("other shards", self.other_shards, "job(s) and other files"),
            ("not begun", self.not_begun, "job(s), because of the first failure"),
            ("not written", self.left_out.len(), "file(s)"),
        ];
        for (what, count, unit) in counted.into_iter().filter(|(_, count, _)| *count > 0) {
            row(what, format!("{count} {unit}"));
        }
        for (file, reason) in self.left_out.iter().take(LISTED) {
            let _ = writeln!(text, "    {file}: {reason}");
        }
        if self.left_out.len() > LISTED {
            let _ = writeln!(text, "    ... and {} more; --report lists their targets", self.left_out.len() - LISTED);
        }
        text.truncate(text.trim_end().len());
        text
    }
}

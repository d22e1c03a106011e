//! Counts and sizes of corrections over many jobs: what a summary needs when the targets themselves are long forgotten.

use serde::{Deserialize, Serialize};

use crate::base::units::mm_from_m;
use crate::program::target::Program;
use crate::rewrite::class::Class;
use crate::rewrite::outcome::Outcome;

/// Counts by class, and how far corrections went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    /// Files written or to be written.
    pub files: usize,
    /// Targets by class.
    pub corrected: usize,
    /// See [`Class::Joint`].
    pub joint: usize,
    /// See [`Class::Computed`].
    pub computed: usize,
    /// See [`Class::Refused`].
    pub refused: usize,
    /// Sum of all corrections, m.
    pub sum_m: f64,
    /// Largest correction, m.
    pub largest_m: f64,
}

impl Tally {
    /// Of one job with `files` own files.
    pub fn of(program: &Program, outcome: &Outcome, files: usize) -> Self {
        let mut tally = Self { files, ..Self::default() };
        let concerned = program.targets.iter().zip(&outcome.targets).filter(|(target, _)| program.concerns(target));
        for (_, result) in concerned {
            match result.class {
                Class::Corrected => tally.corrected += 1,
                Class::Joint => tally.joint += 1,
                Class::Computed => tally.computed += 1,
                Class::Refused => tally.refused += 1,
            }
            let correction_m = result.figures.as_ref().map_or(0.0, |figures| figures.correction_m);
            tally.sum_m += correction_m;
            tally.largest_m = tally.largest_m.max(correction_m);
        }
        tally
    }

    /// Adds another job.
    pub fn add(&mut self, other: &Self) {
        self.files += other.files;
        self.corrected += other.corrected;
        self.joint += other.joint;
        self.computed += other.computed;
        self.refused += other.refused;
        self.sum_m += other.sum_m;
        self.largest_m = self.largest_m.max(other.largest_m);
    }

    /// All targets.
    pub fn targets(&self) -> usize {
        self.corrected + self.joint + self.computed + self.refused
    }

    /// Mean correction of the corrected targets, mm.
    pub fn mean_mm(&self) -> f64 {
        mm_from_m(self.sum_m) / self.corrected.max(1) as f64
    }

    /// Largest correction, mm.
    pub fn largest_mm(&self) -> f64 {
        mm_from_m(self.largest_m)
    }
}

//! What happened to every target of a job.

use crate::base::edit::EditSet;

use super::class::Class;

/// What happened to the targets of one job, in the order of [`crate::program::target::Program::targets`].
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// One a target.
    pub targets: Vec<TargetOutcome>,
    /// The edits of each file of the job.
    pub edits: Vec<EditSet>,
}

/// What happened to a target.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetOutcome {
    /// Its class.
    pub class: Class,
    /// Why, where it is not corrected; or what to know, where it is.
    pub reason: Option<String>,
    /// The figures of a corrected target.
    pub figures: Option<Figures>,
    /// True when it is refused because its uses need different values.
    pub shared: bool,
}

/// The figures of a corrected target. There are millions of them in a large program: what can be read from the program
/// again, before or after, is not kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Distance between the written and the corrected target, m.
    pub correction_m: f64,
    /// Turn between the written and the corrected target, rad.
    pub correction_rad: f64,
    /// Steps of the inversion.
    pub iterations: usize,
    /// Orientation error that stays because a displaced target shares the orientation of its base, rad.
    pub orientation_left_rad: f64,
}

impl TargetOutcome {
    /// A target that is left alone.
    pub fn left(class: Class, reason: impl Into<Option<String>>) -> Self {
        Self { class, reason: reason.into(), figures: None, shared: false }
    }
}

impl Outcome {
    /// Number of targets of a class.
    pub fn count(&self, class: Class) -> usize {
        self.targets.iter().filter(|target| target.class == class).count()
    }
}

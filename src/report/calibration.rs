//! What `calibrate --json` says: the identification, the physics named beyond it, and what was tried as a learner.

use serde::Serialize;

use crate::identify::report::Report;
use crate::learn::choose::Candidate;
use crate::learn::learned::Learned;
use crate::model::arm::EffectInstance;
use crate::model::effect::Location;

/// Everything that a calibration found, as data.
#[derive(Serialize)]
pub struct CalibrationReport<'a> {
    #[serde(flatten)]
    identification: &'a Report,
    named_physics: Vec<Named>,
    learner: Option<LearnerReport<'a>>,
}

/// An effect at its place. Its numbers stand among the parameters of the identification.
#[derive(Serialize)]
struct Named {
    effect: &'static str,
    location: Location,
}

/// The learners that were tried, and which one is used.
#[derive(Serialize)]
struct LearnerReport<'a> {
    chosen: Option<&'static str>,
    candidates: &'a [Candidate],
}

impl<'a> CalibrationReport<'a> {
    /// `learned` is `None` where no learner was asked for.
    pub fn new(identification: &'a Report, named: &[EffectInstance], learned: Option<&'a Learned>) -> Self {
        let named_physics = named
            .iter()
            .map(|instance| Named { effect: instance.effect.meta().id, location: instance.location })
            .collect();
        let learner = learned.map(|learned| LearnerReport {
            chosen: learned.candidates.get(learned.chosen).map(|candidate| candidate.name),
            candidates: &learned.candidates,
        });
        Self { identification, named_physics, learner }
    }
}

//! From recordings to the records that can be fitted, and why the others cannot.

use crate::measure::observation::{Measured, Observation};
use crate::measure::recording::Recording;
use crate::measure::repeats::copies;
use crate::model::arm::ArmModel;
use crate::model::robot::Robot;

use super::estimate::{START_PER_REACH, START_RAD};
use super::outlier::Reason;
use super::prior::reach_m;
use super::problem::{Problem, Record, expected_pose};
use super::robust;
use super::stations::Grouping;

/// A record that can be fitted.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// Which recording.
    pub recording: usize,
    /// The record.
    pub observation: &'a Observation,
    /// Its measurement.
    pub measured: Measured,
}

/// A record that is not used.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Which recording.
    pub recording: usize,
    /// Its name.
    pub id: String,
    /// Its line.
    pub line: usize,
    /// How far off it is, m, where that is known.
    pub away_m: Option<f64>,
    /// Why.
    pub reason: Reason,
}

/// Records sorted into usable and not.
#[derive(Clone, Debug)]
pub struct Gathered<'a> {
    /// Usable, in the order of the recordings.
    pub entries: Vec<Entry<'a>>,
    /// Not usable.
    pub left_out: Vec<LeftOut>,
}

/// Sorts out what cannot be fitted: not measured, copied to the last digit, or impossible for the arm.
pub fn gather<'a>(model: &ArmModel, recordings: &'a [Recording]) -> Gathered<'a> {
    let all: Vec<(usize, &Observation)> = recordings
        .iter()
        .enumerate()
        .flat_map(|(recording, content)| content.observations.iter().map(move |observation| (recording, observation)))
        .collect();
    let observations: Vec<&Observation> = all.iter().map(|(_, observation)| *observation).collect();
    let copied: std::collections::BTreeMap<usize, usize> = copies(&observations).into_iter().collect();
    let prepared = model.prepared();
    let mut gathered = Gathered { entries: Vec::new(), left_out: Vec::new() };
    for (index, &(recording, observation)) in all.iter().enumerate() {
        let impossible = || {
            let identity = crate::geometry::pose::Pose::identity();
            let placed = expected_pose(&prepared, &identity, observation);
            placed.err().map(|error| Reason::Impossible { why: error.to_string() })
        };
        let reason = match (observation.measured, copied.get(&index)) {
            (None, _) => Some(Reason::Unmeasured),
            (_, Some(&of)) => Some(Reason::Copy { of: observations[of].id.clone(), line: observations[of].line }),
            _ => impossible(),
        };
        match (reason, observation.measured) {
            (None, Some(measured)) => gathered.entries.push(Entry { recording, observation, measured }),
            (reason, _) => gathered.left_out.push(LeftOut {
                recording,
                id: observation.id.clone(),
                line: observation.line,
                away_m: None,
                reason: reason.unwrap_or(Reason::Unmeasured),
            }),
        }
    }
    gathered
}

/// The records as a fit takes them; true when their sigmas are stated, in them or by `sigma_m` for all that state none.
pub fn problem_of<'a>(
    entries: &[Entry<'a>],
    grouping: &Grouping,
    robot: &Robot,
    sigma_m: Option<f64>,
) -> (Problem<'a>, bool) {
    let stated: Vec<f64> = entries.iter().filter_map(|entry| entry.observation.sigma_m).collect();
    // Where some records state their sigma and others do not, the others are taken for typical ones.
    let typical = if stated.is_empty() { START_PER_REACH * reach_m(robot) } else { robust::median(&stated) };
    let fallback = sigma_m.unwrap_or(typical);
    let records = entries
        .iter()
        .zip(&grouping.station_of)
        .map(|(entry, &station)| Record {
            observation: entry.observation,
            measured: entry.measured,
            station,
            sigma_m: entry.observation.sigma_m.unwrap_or(fallback),
            sigma_rad: entry.observation.sigma_rad.unwrap_or(START_RAD),
        })
        .collect();
    (Problem { records }, !stated.is_empty() || sigma_m.is_some())
}

//! A recording: records in the order in which they were taken.

use crate::model::robot::DOF;

use super::observation::Observation;

/// How the senses of approach became known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ApproachSource {
    /// Columns of the file say it.
    Recorded,
    /// From the change of each joint since the record before.
    Inferred,
}

/// Standing at poses, or moving through them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The arm stood still at every record.
    Static,
    /// The arm moved: the file has joint speeds.
    Continuous,
}

impl Kind {
    /// Of recordings taken together: moving where all of them are.
    pub fn of(recordings: &[Recording]) -> Self {
        match recordings.iter().all(|recording| recording.kind == Kind::Continuous) {
            true => Kind::Continuous,
            false => Kind::Static,
        }
    }
}

/// Everything in one file.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The file's name.
    pub name: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// Standing or moving.
    pub kind: Kind,
    /// How the senses of approach became known.
    pub approach: ApproachSource,
    /// The records.
    pub observations: Vec<Observation>,
}

/// Changes below this count as standing still, rad: above the last digit of a display, below any wanted motion.
const STILL_RAD: f64 = 1e-5;

/// Fills the senses of approach from the order of the records: the sense of each joint's last change.
///
/// Between two stops a joint may have gone there and back, so this is a guess, and recordings say so
/// ([`ApproachSource::Inferred`]). A joint that has not moved yet keeps 0.
pub fn infer_approach(observations: &mut [Observation]) {
    let mut sense = [0.0; DOF];
    let mut before: Option<[f64; DOF]> = None;
    for observation in observations {
        if let Some(before) = before {
            for (joint, sense) in sense.iter_mut().enumerate() {
                let change = observation.numbers_rad[joint] - before[joint];
                if change.abs() > STILL_RAD {
                    *sense = change.signum();
                }
            }
        }
        before = Some(observation.numbers_rad);
        observation.conditions.approach = sense;
    }
}

/// Time between two records that state none, s: what a tracker and an arm usually take for a pose.
const USUAL_PAUSE_S: f64 = 10.0;

/// Fills the times of measured records from their order, as if one were taken every ten seconds: what changes slowly or at
/// once shows in the order too, with a rate that is as uncertain as that guess.
pub fn infer_time(observations: &mut [Observation]) {
    for (index, observation) in observations.iter_mut().enumerate().filter(|(_, record)| record.measured.is_some()) {
        observation.conditions.time_s = Some(USUAL_PAUSE_S * index as f64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fixture::observation;

    #[test]
    fn order_is_time_where_a_recording_states_none() {
        let mut records = vec![observation([0.0; DOF]), observation([0.1; DOF])];
        records[0].measured = None;
        infer_time(&mut records);
        assert_eq!(records[0].conditions.time_s, None);
        assert_eq!(records[1].conditions.time_s, records[1].measured.map(|_| USUAL_PAUSE_S));
    }

    #[test]
    fn the_sense_of_approach_is_that_of_the_last_change() {
        let mut records: Vec<Observation> =
            [0.0, 0.2, 0.2, 0.1].iter().map(|&q1| observation([q1, 0.0, 0.0, 0.0, 0.0, 0.0])).collect();
        infer_approach(&mut records);
        let senses: Vec<f64> = records.iter().map(|record| record.conditions.approach[0]).collect();
        assert_eq!(senses, [0.0, 1.0, 1.0, -1.0]);
        assert!(records.iter().all(|record| record.conditions.approach[1] == 0.0));
    }
}

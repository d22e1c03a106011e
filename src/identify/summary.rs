//! From an outcome to what is written down: the model file and the report.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::base::units::{deg_from_rad, mm_from_m};
use crate::files::calibration::Calibration;
use crate::measure::recording::{ApproachSource, Kind, Recording};
use crate::model::effect::JOINT_COMPLIANCE;
use crate::model::parameters::ParameterId;
use crate::model::robot::DOF;

use super::calibrate::Outcome;
use super::identifiability::{Identifiability, judge};
use super::naming::{name_of, unit_of};
use super::problem::NoPose;
use super::report::*;
use super::rest::{Left, ToldBy, left};
use super::robust::lengths_of;
use super::split::SplitSource;
use super::state::State;
use super::station_report::{StationReport, station_reports};
use super::unknown::UnknownId;
use super::written::{region, written};

/// Standard uncertainty after over before from which a number counts as not told by the recording.
const UNDETERMINED: f64 = 0.7;

/// The model file's content and the report of an outcome.
///
/// # Errors
/// [`NoPose`] when a fitted model cannot place a record, which its own fit has excluded.
pub fn summarise(outcome: &Outcome<'_>, recordings: &[Recording]) -> Result<(Calibration, Report), NoPose> {
    let left = left(outcome)?;
    let delivered = &outcome.delivered;
    let calibration = written(delivered, &outcome.own_frame, left.noise_sigma_m, left.unexplained_sigma_m, recordings);
    let fit = &delivered.fit;
    let judged = judge(
        &fit.whitened_jacobian,
        &fit.unknowns,
        &fit.covariance_root,
        delivered.spread.sigma_m,
        delivered.problem.records.len(),
    );
    let state = &fit.state;
    let named = |id: UnknownId| name_of(id, state);
    let report = Report {
        schema: SCHEMA,
        robot: state.model.robot.name.clone(),
        recordings: recordings.iter().enumerate().map(|(index, one)| recording_report(outcome, one, index)).collect(),
        split: SplitReport {
            source: outcome.split.source,
            identify: outcome.split.identify.len(),
            train: outcome.split.train.len(),
            validate: outcome.split.validate.len(),
            unassigned: outcome.split.unassigned.len(),
            delivered: outcome.fitted.len(),
        },
        stages: stages(outcome)?,
        rest: Rest {
            sigma_mm: mm_from_m(left.sigma_m),
            noise_sigma_mm: mm_from_m(left.noise_sigma_m),
            unexplained_sigma_mm: mm_from_m(left.unexplained_sigma_m),
            told_by: left.told_by.word(),
            freedom: delivered.spread.freedom,
            repeat_same_approach_mm: left.repeatability.same_approach.map(|pure| mm_from_m(pure.sigma_m)),
            repeat_any_approach_mm: left.repeatability.any_approach.map(|pure| mm_from_m(pure.sigma_m)),
        },
        parameters: parameters(outcome, &judged),
        redundant: outcome
            .selection
            .redundant
            .iter()
            .map(|redundant| RedundantReport {
                name: named(redundant.unknown.id),
                coupled_with: redundant
                    .coupled_with
                    .iter()
                    .map(|&(id, factor)| Coupled { name: named(id), factor })
                    .collect(),
            })
            .collect(),
        undetermined: judged
            .shown
            .iter()
            .filter(|shown| shown.remaining > UNDETERMINED)
            .map(|shown| named(shown.id))
            .collect(),
        correlated: judged
            .correlated
            .iter()
            .map(|&(a, b, correlation)| Correlated { a: named(a), b: named(b), correlation })
            .collect(),
        observability: Observability {
            rank: judged.rank,
            unknowns: fit.unknowns.len(),
            condition: judged.condition,
            indices: judged.observability,
        },
        stations: stations_of(outcome),
        left_out: outcome
            .left_out
            .iter()
            .map(|left| LeftOutReport {
                recording: recordings.get(left.recording).map_or_else(String::new, |recording| recording.name.clone()),
                id: left.id.clone(),
                line: left.line,
                away_mm: left.away_m.map(mm_from_m),
                code: left.reason.code(),
                reason: left.reason.to_string(),
            })
            .collect(),
        notes: notes(outcome, recordings, &left, &judged),
        residuals: residuals(outcome)?,
    };
    Ok((calibration, report))
}

fn recording_report(outcome: &Outcome<'_>, recording: &Recording, index: usize) -> RecordingReport {
    let assigned: std::collections::BTreeSet<usize> =
        outcome.split.identify.iter().chain(&outcome.split.train).chain(&outcome.split.validate).copied().collect();
    let used = assigned.iter().filter(|&&entry| outcome.sound[entry] && outcome.entries[entry].recording == index);
    RecordingReport {
        name: recording.name.clone(),
        sha256: recording.sha256.clone(),
        records: recording.observations.len(),
        used: used.count(),
        kind: match recording.kind {
            Kind::Static => "static",
            Kind::Continuous => "continuous",
        },
        approach: match recording.approach {
            ApproachSource::Recorded => "recorded",
            ApproachSource::Inferred => "inferred",
        },
    }
}

fn stages(outcome: &Outcome<'_>) -> Result<Vec<Stage>, NoPose> {
    let split = &outcome.split;
    let own_training = split.train != split.identify;
    let stage = |name: &str, free: usize, state: &State| -> Result<Stage, NoPose> {
        let lengths = lengths_of(&outcome.problem, &outcome.problem.residuals(state)?);
        let over = |set: &[usize]| {
            let sound: Vec<f64> =
                set.iter().filter(|&&index| outcome.sound[index]).map(|&index| lengths[index]).collect();
            Figures::of(&sound)
        };
        Ok(Stage {
            name: name.into(),
            free,
            identify: over(&split.identify),
            train: if own_training { over(&split.train) } else { None },
            validate: over(&split.validate),
        })
    };
    let mut all: Vec<Stage> =
        outcome.stages.iter().map(|one| stage(one.name, one.free, &one.state)).collect::<Result<_, _>>()?;
    let refitted_to_validation = split.source == SplitSource::Regions;
    let trained = outcome.stages.iter().any(|stage| stage.trained);
    if !trained && !refitted_to_validation && outcome.fitted.len() > split.identify.len() {
        let fit = &outcome.delivered.fit;
        all.push(stage("refitted_with_training", fit.unknowns.len(), &fit.state)?);
    }
    Ok(all)
}

fn parameters(outcome: &Outcome<'_>, judged: &Identifiability) -> Vec<ParameterReport> {
    let fit = &outcome.delivered.fit;
    let freedom = outcome.delivered.spread.freedom.max(1.0);
    let reach = StudentsT::new(0.0, 1.0, freedom).map_or(1.96, |student| student.inverse_cdf(0.975));
    fit.unknowns
        .iter()
        .zip(&judged.shown)
        .enumerate()
        .map(|(index, (unknown, shown))| {
            let value = fit.state.get(unknown.id).unwrap_or(0.0);
            let sigma = fit.covariance_root.row(index).norm();
            ParameterReport {
                name: name_of(unknown.id, &fit.state),
                unit: unit_of(unknown.id, &fit.state),
                value,
                sigma,
                ci95: [value - reach * sigma, value + reach * sigma],
                prior_sigma: unknown.prior.sigma,
                magnitude_mm: mm_from_m(shown.magnitude_m),
                inflation: shown.inflation.is_finite().then_some(shown.inflation),
                remaining: shown.remaining,
            }
        })
        .collect()
}

fn stations_of(outcome: &Outcome<'_>) -> Vec<StationReport> {
    station_reports(&outcome.delivered.fit.state, &outcome.own_frame, &outcome.grouping.station_of)
}

fn notes(outcome: &Outcome<'_>, recordings: &[Recording], left: &Left, judged: &Identifiability) -> Vec<String> {
    let mut notes = Vec::new();
    for recording in recordings.iter().filter(|recording| recording.approach == ApproachSource::Inferred) {
        notes.push(format!(
            "{} has no columns dir1 to dir{DOF}: the sense of approach is inferred from the order of its records",
            recording.name
        ));
    }
    let state = &outcome.delivered.fit.state;
    notes.extend(stations_of(outcome).iter().filter_map(StationReport::note));
    notes.extend(still_joints(outcome));
    if outcome.split.source == SplitSource::Regions {
        notes.push(
            "the recording names no sets: whole regions were held out for the figures; the delivered model is fitted to all \
             records"
                .into(),
        );
    }
    if outcome.split.source == SplitSource::None {
        notes.push("too few records to hold any out: there are no validation figures".into());
    }
    for (effect, (instance, values)) in state.model.effects.iter().zip(&state.model.parameters.effects).enumerate() {
        let id = UnknownId::Model(ParameterId::Effect(effect, 0));
        let sigma = outcome.delivered.fit.unknowns.iter().position(|unknown| unknown.id == id);
        let Some(sigma) = sigma.map(|index| outcome.delivered.fit.covariance_root.row(index).norm()) else { continue };
        let is_compliance = instance.effect.meta().id == JOINT_COMPLIANCE.meta().id;
        if is_compliance && values.first().is_some_and(|value| *value < -3.0 * sigma) {
            notes.push(format!(
                "the compliance at {} comes out negative, which no drive is: something else follows its torque",
                instance.location
            ));
        }
    }
    if judged.condition > 100.0 {
        notes.push(format!(
            "the condition number is {:.0}, above 100: some numbers are known only together; see `correlated` and \
             `undetermined`",
            judged.condition
        ));
    }
    if left.told_by == ToldBy::Structure && left.unexplained_sigma_m > 0.0 {
        notes.push(format!(
            "the residuals have structure: {:.3} mm per axis of them would come again at the same pose",
            mm_from_m(left.unexplained_sigma_m)
        ));
    }
    notes
}

/// Joints that hardly moved, rad.
const STILL_RAD: f64 = 0.1;

fn still_joints(outcome: &Outcome<'_>) -> Vec<String> {
    let Some(region) = region(&outcome.delivered) else { return Vec::new() };
    (0..DOF)
        .filter(|&joint| region.max_rad[joint] - region.min_rad[joint] < STILL_RAD)
        .map(|joint| {
            format!(
                "joint {} moved only {:.2} deg: what belongs to it is hardly told by this recording and stays near nominal",
                joint + 1,
                deg_from_rad(region.max_rad[joint] - region.min_rad[joint])
            )
        })
        .collect()
}

fn residuals(outcome: &Outcome<'_>) -> Result<Vec<ResidualReport>, NoPose> {
    let residuals = outcome.problem.residuals(&outcome.delivered.fit.state)?;
    Ok(outcome
        .problem
        .first_rows()
        .into_iter()
        .enumerate()
        .map(|(index, first)| {
            let residual = residuals.fixed_rows::<3>(first);
            let observation = outcome.entries[index].observation;
            ResidualReport {
                id: observation.id.clone(),
                recording: outcome.entries[index].recording,
                line: observation.line,
                set: set_of(outcome, index),
                used: outcome.sound[index],
                joints_deg: observation.numbers_rad.map(deg_from_rad),
                residual_mm: std::array::from_fn(|axis| mm_from_m(residual[axis])),
                length_mm: mm_from_m(residual.norm()),
            }
        })
        .collect())
}

fn set_of(outcome: &Outcome<'_>, index: usize) -> Option<&'static str> {
    let split = &outcome.split;
    [("identify", &split.identify), ("train", &split.train), ("validate", &split.validate)]
        .into_iter()
        .find(|(_, set)| set.binary_search(&index).is_ok())
        .map(|(name, _)| name)
}

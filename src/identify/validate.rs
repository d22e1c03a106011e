//! A model against records that it may never have seen.

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
use statrs::distribution::{Binomial, DiscreteCDF};

use crate::base::units::mm_from_m;
use crate::files::calibration::{Calibration, StationFrame};
use crate::measure::observation::Observation;
use crate::model::arm::ArmModel;

use super::ball;
use super::place::{Handedness, registration};
use super::predict::{Predicted, predict};
use super::problem::NoPose;
use super::report::Figures;

/// The word in the first key.
pub const SCHEMA: &str = "falsetarget/validation/1";

/// What a validation says.
#[derive(Clone, Debug, Serialize)]
pub struct Validation {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Records compared.
    pub records: usize,
    /// Of the nominal robot, base and tool as the model has them.
    pub nominal: Option<Figures>,
    /// Of the model.
    pub model: Option<Figures>,
    /// Of the model when the measuring frame may lie elsewhere than in the calibration: after a rigid registration.
    pub registered: Option<Figures>,
    /// Part of the records within their own 95 % radius, the noise of the measurement allowed for.
    pub within_u95: Option<f64>,
    /// Probability of so few inside, were the radii right.
    pub p_value: Option<f64>,
    /// Whether the model holds what it promises.
    pub passed: bool,
    /// Why not, or what to look at.
    pub notes: Vec<String>,
    /// Record by record.
    pub residuals: Vec<Residual>,
}

/// One record.
#[derive(Clone, Debug, Serialize)]
pub struct Residual {
    /// Its name.
    pub id: String,
    /// Its line.
    pub line: usize,
    /// Model minus measurement, mm.
    pub residual_mm: [f64; 3],
    /// Their length, mm.
    pub length_mm: f64,
    /// The radius that the model claims, mm.
    pub u95_mm: Option<f64>,
}

/// Probability below which too few records inside their radius are no accident.
const ACCIDENT: f64 = 0.01;

/// Compares a model with measured records; with `limit_m` no record may be further off than that.
///
/// # Errors
/// [`NoPose`] for the first record that the arm cannot take.
pub fn validate(
    calibration: &Calibration,
    observations: &[&Observation],
    limit_m: Option<f64>,
) -> Result<Validation, NoPose> {
    let measured: Vec<(&Observation, Vector3<f64>)> =
        observations.iter().filter_map(|record| Some((*record, in_measuring_frame(calibration, record)?))).collect();
    let records: Vec<&Observation> = measured.iter().map(|(record, _)| *record).collect();
    let predicted = predict(&calibration.arm, calibration.uncertainty.as_ref(), &[], &records)?;
    let nominal = predict(&nominal_of(&calibration.arm), None, &[], &records)?;
    let points: Vec<Vector3<f64>> = measured.iter().map(|(_, point)| *point).collect();
    let misses = |predicted: &[Predicted]| -> Vec<f64> {
        predicted.iter().zip(&points).map(|(predicted, point)| (predicted.position_m - point).norm()).collect()
    };
    let body: Vec<Vector3<f64>> = predicted.iter().map(|one| one.position_m).collect();
    let registered = registration(&body, &points, Handedness::Right).map(|moved| {
        body.iter().zip(&points).map(|(body, point)| (moved.transform_point(body) - point).norm()).collect::<Vec<_>>()
    });
    let lengths = misses(&predicted);
    let mut validation = Validation {
        schema: SCHEMA,
        records: records.len(),
        nominal: Figures::of(&misses(&nominal)),
        model: Figures::of(&lengths),
        registered: registered.and_then(|lengths| Figures::of(&lengths)),
        within_u95: None,
        p_value: None,
        passed: true,
        notes: Vec::new(),
        residuals: residuals(&measured, &predicted),
    };
    coverage(&mut validation, calibration, &measured, &predicted);
    if let Some(limit_m) = limit_m {
        let beyond = lengths.iter().filter(|&&length| length > limit_m).count();
        if beyond > 0 {
            validation.passed = false;
            validation.notes.push(format!("{beyond} records are further off than {} mm", mm_from_m(limit_m)));
        }
    }
    if let (Some(model), Some(registered)) = (validation.model, validation.registered)
        && model.records > 12
        && registered.rms_mm * 3.0 < model.rms_mm
    {
        validation.notes.push(format!(
            "the measuring frame lies elsewhere than in the calibration: after registration {:.3} mm RMS are left of {:.3} mm",
            registered.rms_mm, model.rms_mm
        ));
    }
    Ok(validation)
}

/// Counts the records within their radius.
fn coverage(
    validation: &mut Validation,
    calibration: &Calibration,
    measured: &[(&Observation, Vector3<f64>)],
    predicted: &[Predicted],
) {
    let Some(uncertainty) = &calibration.uncertainty else {
        return;
    };
    let inside = measured
        .iter()
        .zip(predicted)
        .filter(|((record, point), predicted)| {
            let noise_m = record.sigma_m.unwrap_or(uncertainty.noise_sigma_m);
            predicted.covariance_m2.is_some_and(|covariance| {
                // Widened as the prediction itself is, then the measurement's own scatter on top.
                let widening = match (predicted.u95_m, ball::radius(&covariance, 0.95)) {
                    (Some(claimed), plain) if plain > 0.0 => claimed / plain,
                    _ => 1.0,
                };
                let whole = covariance * widening.powi(2) + Matrix3::identity() * noise_m.powi(2);
                (predicted.position_m - point).norm() <= ball::radius(&whole, 0.95)
            })
        })
        .count();
    let count = measured.len();
    if count == 0 {
        return;
    }
    validation.within_u95 = Some(inside as f64 / count as f64);
    let p_value = Binomial::new(0.95, count as u64).map_or(1.0, |binomial| binomial.cdf(inside as u64));
    validation.p_value = Some(p_value);
    if p_value < ACCIDENT {
        validation.passed = false;
        validation.notes.push(format!(
            "only {inside} of {count} records lie within the 95 % radius that the model claims: the arm has changed, it was \
             measured from elsewhere, or these poses lie outside what the model was made from"
        ));
    }
}

/// The robot of a model without anything that was identified but where it stands and what it holds.
fn nominal_of(arm: &ArmModel) -> ArmModel {
    let prepared = arm.prepared();
    let mut nominal = ArmModel::nominal(arm.robot.clone());
    if arm.robot.base.is_none() {
        nominal.measuring_t_base = prepared.measuring_t_base();
    }
    if arm.robot.tool.is_none() {
        nominal.flange_t_tool = prepared.flange_t_tool();
    }
    nominal
}

/// The measured point in the measuring frame: through the station's frame where the model knows one of that name.
fn in_measuring_frame(calibration: &Calibration, record: &Observation) -> Option<Vector3<f64>> {
    let point = record.measured?.position_m;
    let station = StationFrame::which(&calibration.stations, record).map(|index| &calibration.stations[index]);
    Some(station.map_or(point, |station| station.station_t_measuring.inverse().transform_point(&point)))
}

fn residuals(measured: &[(&Observation, Vector3<f64>)], predicted: &[Predicted]) -> Vec<Residual> {
    measured
        .iter()
        .zip(predicted)
        .map(|((record, point), predicted)| {
            let miss = predicted.position_m - point;
            Residual {
                id: record.id.clone(),
                line: record.line,
                residual_mm: std::array::from_fn(|axis| mm_from_m(miss[axis])),
                length_mm: mm_from_m(miss.norm()),
                u95_mm: predicted.u95_m.map(mm_from_m),
            }
        })
        .collect()
}

//! Where the tool point will be, and how sure that is.

use nalgebra::{DMatrix, Matrix3, Vector3};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::files::calibration::StationFrame;
use crate::measure::observation::{Measured, Observation};
use crate::model::arm::ArmModel;
use crate::model::linkage::actuators_from_numbers;
use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::DOF;
use crate::model::uncertainty::Uncertainty;

use super::ball;
use super::problem::{NoPose, Problem, Record};
use super::state::{State, Station};
use super::unknown::{Prior, Unknown, UnknownId};

/// A predicted point of the measuring frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predicted {
    /// Position, m.
    pub position_m: Vector3<f64>,
    /// Covariance of the position from the parameters and from what stays unexplained, m^2; `None` where the model
    /// does not know its own uncertainty.
    pub covariance_m2: Option<Matrix3<f64>>,
    /// Radius in which the real point lies with 95 %, m.
    pub u95_m: Option<f64>,
}

/// The probability of `u95`.
const PROBABILITY: f64 = 0.95;

/// Predicts the tool point of every record in the measuring frame of the model, or where its station is one of `stations` in
/// that station's frame.
///
/// The covariance is `J C J' + unexplained^2 I`: parameters through the Jacobian at the pose, and what the model is known
/// to leave. The radius is that of the ball holding such a normal point, widened for a covariance that was itself
/// estimated (Hotelling: by the root of the F quantile over the chi-squared one).
///
/// # Errors
/// [`NoPose`] for the first record that the arm cannot take.
pub fn predict(
    arm: &ArmModel,
    uncertainty: Option<&Uncertainty>,
    stations: &[StationFrame],
    observations: &[&Observation],
) -> Result<Vec<Predicted>, NoPose> {
    let origin = Measured { position_m: Vector3::zeros(), rotation: None };
    // Station 0 is the reference.
    let station_of =
        |observation: &Observation| StationFrame::which(stations, observation).map_or(0, |index| index + 1);
    let records = observations
        .iter()
        .map(|&observation| {
            let station = station_of(observation);
            Record { observation, measured: origin, station, sigma_m: 1.0, sigma_rad: 1.0 }
        })
        .collect();
    let problem = Problem { records };
    let mut state = State::new(arm.clone());
    state.stations.extend(stations.iter().map(|station| Station {
        station_t_measuring: station.station_t_measuring,
        ..Station::reference(Some(station.name.clone()))
    }));
    let positions = problem.residuals(&state)?;
    let spread = match uncertainty {
        Some(uncertainty) => Some((uncertainty, spread_of(&problem, &state, uncertainty)?)),
        None => None,
    };
    Ok((0..observations.len())
        .map(|index| {
            let covariance_m2 = spread.as_ref().map(|(uncertainty, covariances)| {
                covariances[index] + Matrix3::identity() * uncertainty.unexplained_sigma_m.powi(2)
            });
            let widening = uncertainty.map_or(1.0, |uncertainty| widening(uncertainty.freedom));
            Predicted {
                position_m: positions.fixed_rows::<3>(3 * index).into_owned(),
                covariance_m2,
                u95_m: covariance_m2.map(|covariance| widening * ball::radius(&covariance, PROBABILITY)),
            }
        })
        .collect())
}

fn spread_of(problem: &Problem<'_>, state: &State, uncertainty: &Uncertainty) -> Result<Vec<Matrix3<f64>>, NoPose> {
    let any = Prior { mean: 0.0, sigma: 1.0 };
    let unknowns: Vec<Unknown> =
        uncertainty.ids.iter().map(|&id| Unknown { id: UnknownId::Model(id), prior: any }).collect();
    let jacobian: DMatrix<f64> = problem.jacobian(state, &unknowns)?;
    let learned = spread_of_learner(problem, state)?;
    Ok((0..problem.records.len())
        .map(|index| {
            let rows = jacobian.fixed_rows::<3>(3 * index);
            let spread = rows * &uncertainty.covariance * rows.transpose();
            spread.fixed_view::<3, 3>(0, 0) + learned[index]
        })
        .collect())
}

/// Covariance of each position by the uncertainty of what was learned, m^2, through the levers of the actuators.
fn spread_of_learner(problem: &Problem<'_>, state: &State) -> Result<Vec<Matrix3<f64>>, NoPose> {
    let Some(learner) = &state.model.learner else {
        return Ok(vec![Matrix3::zeros(); problem.records.len()]);
    };
    let any = Prior { mean: 0.0, sigma: 1.0 };
    let zeros: Vec<Unknown> = (0..DOF)
        .map(|joint| Unknown { id: UnknownId::Model(ParameterId::Row(joint, RowQuantity::Offset)), prior: any })
        .collect();
    let levers = problem.jacobian(state, &zeros)?;
    let prepared = state.model.prepared();
    Ok(problem
        .records
        .iter()
        .enumerate()
        .map(|(index, record)| {
            let observation = record.observation;
            // The Jacobian has placed the record: this cannot fail any more.
            let stand = prepared.at(&observation.numbers_rad, &observation.conditions, None);
            let torques = stand.map_or([0.0; DOF], |stand| stand.statics.actuator_torque_nm);
            let angles = actuators_from_numbers(&state.model.robot, &observation.numbers_rad);
            let sigma_rad = learner.sigma_rad(&angles, &torques, &observation.conditions);
            (0..DOF)
                .map(|actuator| {
                    let lever: Vector3<f64> = levers.fixed_view::<3, 1>(3 * index, actuator) * sigma_rad[actuator];
                    lever * lever.transpose()
                })
                .sum()
        })
        .collect())
}

/// `sqrt(3 F(0.95; 3, nu) / chi2(0.95; 3))`.
fn widening(freedom: f64) -> f64 {
    const CHI_SQUARED_3: f64 = 7.814_727_903_251_18;
    let fisher = FisherSnedecor::new(3.0, freedom.max(1.0));
    fisher.map_or(1.0, |fisher| (3.0 * fisher.inverse_cdf(PROBABILITY) / CHI_SQUARED_3).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_degrees_of_freedom_widen() {
        // F(0.95; 3, 10) = 3.7083 (tables), chi2(0.95; 3) = 7.8147.
        assert!((widening(10.0) - (3.0 * 3.7083f64 / 7.8147).sqrt()).abs() < 1e-4);
        assert!((widening(1e6) - 1.0).abs() < 1e-4);
    }
}

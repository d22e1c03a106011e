//! Which poses to measure: those after which the model knows best where the tool will be.
//!
//! Bayesian I-optimal design (Studden 1977; for robots the test-pose idea of Klimchik, Wu, Caro, Furet and Pashkevich 2014):
//! poses are chosen from many so that the variance of predicted points, averaged over all of the many, is smallest, the
//! priors counted in; one after the other first, then exchanged one by one until no exchange gains (Fedorov 1972).

use nalgebra::{DMatrix, Matrix3, Vector3};
use rand::seq::SliceRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::measure::observation::{Measured, Observation};
use crate::model::arm::ArmModel;
use crate::model::robot::DOF;

use super::identifiability::select;
use super::prior::unknown_of;
use super::problem::{NoPose, Problem, Record};
use super::state::State;
use super::unknown::{Scope, model_ids};

/// Rounds of exchanges at most.
const MOST_ROUNDS: usize = 6;
/// Gain of a round of exchanges, as part of the variance that is left, below which there is no further one.
const SMALLEST_GAIN: f64 = 5e-3;
/// Records from which a plan has control poses and poses approached from both sides.
const WITH_CONTROLS: usize = 30;
/// One record in so many is the control pose again, and one is another pose approached from the other side.
const CONTROL_EVERY: usize = 10;

/// Poses in the order in which they are to be measured.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Joint numbers, senses of approach and names; nothing measured yet.
    pub poses: Vec<Observation>,
    /// How many numbers the plan is made to tell.
    pub unknowns: usize,
    /// Standard uncertainty of a predicted point per axis, root mean square over the candidates, that a recording of this
    /// plan will leave, m.
    pub expected_sigma_m: f64,
    /// The same for as many candidates taken as they come, m.
    pub unplanned_sigma_m: f64,
}

/// Chooses poses to measure.
///
/// # Arguments
/// * `model` - the arm, with the effects that are to be identified
/// * `candidates` - poses to choose from: their joint numbers are used
/// * `count` - records of the plan; repeats of a control pose and approaches from the other side among them
/// * `sigma_m` - standard uncertainty of the tracker per axis, m
///
/// # Errors
/// [`NoPose`] when the arm cannot take a candidate.
pub fn plan(
    model: &ArmModel,
    candidates: &[Observation],
    count: usize,
    sigma_m: f64,
    seed: u64,
) -> Result<Plan, NoPose> {
    let origin = Measured { position_m: Vector3::zeros(), rotation: None };
    let records = candidates
        .iter()
        .map(|observation| Record { observation, measured: origin, station: 0, sigma_m, sigma_rad: 1.0 })
        .collect();
    let problem = Problem { records };
    let state = State::new(model.clone());
    let torque = problem.largest_torque_nm(&state);
    let ids = model_ids(model, Scope::Everything, false);
    let unknowns = ids.into_iter().map(|id| unknown_of(id, model, &torque)).collect();
    let unknowns = select(&problem, &state, unknowns, seed)?.free;
    let mut jacobian = problem.jacobian(&state, &unknowns)?;
    for (mut column, unknown) in jacobian.column_iter_mut().zip(&unknowns) {
        column *= unknown.prior.sigma / sigma_m;
    }
    let rows: Vec<DMatrix<f64>> = (0..candidates.len()).map(|pose| jacobian.rows(3 * pose, 3).into_owned()).collect();

    let extra = if count >= WITH_CONTROLS { count / CONTROL_EVERY } else { 0 };
    let distinct = count.saturating_sub(2 * extra).min(candidates.len());
    let mut design = Design::new(&rows, unknowns.len());
    design.fill(distinct);
    design.exchange();
    let poses = in_order(candidates, &design.chosen, extra, seed);
    for again in 0..extra {
        design.update(design.chosen[0], 1.0);
        design.update(design.chosen[again + 1], 1.0);
    }
    let mut unplanned = Design::new(&rows, unknowns.len());
    (0..poses.len().min(rows.len())).for_each(|pose| unplanned.add(pose));
    Ok(Plan {
        poses,
        unknowns: unknowns.len(),
        expected_sigma_m: sigma_m * design.mean_sigma(),
        unplanned_sigma_m: sigma_m * unplanned.mean_sigma(),
    })
}

/// Chosen poses and the covariance of the unknowns that they leave, in units of the priors.
struct Design<'a> {
    /// Whitened rows of each candidate, 3 x unknowns.
    rows: &'a [DMatrix<f64>],
    /// Information that the mean square of a predicted coordinate asks for: `A'A / rows` over all candidates.
    wanted: DMatrix<f64>,
    covariance: DMatrix<f64>,
    chosen: Vec<usize>,
}

impl<'a> Design<'a> {
    fn new(rows: &'a [DMatrix<f64>], unknowns: usize) -> Self {
        let coordinates = 3 * rows.len().max(1);
        let sum = rows.iter().fold(DMatrix::zeros(unknowns, unknowns), |sum, rows| sum + rows.transpose() * rows);
        let covariance = DMatrix::identity(unknowns, unknowns);
        Self { rows, wanted: sum / coordinates as f64, covariance, chosen: Vec::new() }
    }

    /// Covariance of a candidate's point, in units of the tracker's.
    fn spread(&self, pose: usize) -> Matrix3<f64> {
        congruent(&self.rows[pose], &self.covariance)
    }

    /// Mean variance of a predicted coordinate, in units of the tracker's.
    fn variance(&self) -> f64 {
        self.covariance.dot(&self.wanted)
    }

    /// By how much the mean variance falls with a candidate, given `C W C`.
    fn gain(&self, pose: usize, fall: &DMatrix<f64>) -> f64 {
        let middle = (Matrix3::identity() + self.spread(pose)).try_inverse().unwrap_or_default();
        (middle * congruent(&self.rows[pose], fall)).trace()
    }

    fn fall(&self) -> DMatrix<f64> {
        &self.covariance * &self.wanted * &self.covariance
    }

    /// Woodbury's formula, adding (`sign` 1) or removing (-1) three rows.
    fn update(&mut self, pose: usize, sign: f64) {
        let rows = &self.rows[pose];
        let middle = (Matrix3::identity() * sign + self.spread(pose)).try_inverse();
        if let Some(middle) = middle {
            let across = &self.covariance * rows.transpose();
            self.covariance -= &across * middle * across.transpose();
        }
    }

    fn add(&mut self, pose: usize) {
        self.update(pose, 1.0);
        self.chosen.push(pose);
    }

    /// The candidate not yet chosen that tells most.
    fn best(&self, fall: &DMatrix<f64>) -> Option<(usize, f64)> {
        (0..self.rows.len())
            .into_par_iter()
            .filter(|pose| !self.chosen.contains(pose))
            .map(|pose| (pose, self.gain(pose, fall)))
            .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
    }

    fn fill(&mut self, count: usize) {
        while self.chosen.len() < count {
            let Some((pose, _)) = self.best(&self.fall()) else { return };
            self.add(pose);
        }
    }

    fn exchange(&mut self) {
        for _ in 0..MOST_ROUNDS {
            let before = self.variance();
            for place in 0..self.chosen.len() {
                let leaving = self.chosen[place];
                self.update(leaving, -1.0);
                let fall = self.fall();
                let kept = self.gain(leaving, &fall);
                let coming = self.best(&fall).filter(|(_, gain)| *gain > kept);
                let next = coming.map_or(leaving, |(pose, _)| pose);
                self.update(next, 1.0);
                self.chosen[place] = next;
            }
            if self.variance() > before * (1.0 - SMALLEST_GAIN) {
                return;
            }
        }
    }

    /// Standard uncertainty of a predicted coordinate, root mean square, in units of the tracker's.
    fn mean_sigma(&self) -> f64 {
        self.variance().sqrt()
    }
}

/// `A M A'` of three rows.
fn congruent(rows: &DMatrix<f64>, middle: &DMatrix<f64>) -> Matrix3<f64> {
    (rows * middle * rows.transpose()).fixed_view::<3, 3>(0, 0).into_owned()
}

/// The chosen poses in random order, so that drift is not taken for a region; every joint of each approached from a random
/// side, so that lost motion is not either; some poses again from the other sides; the first chosen one, the control pose,
/// again at even distances.
fn in_order(candidates: &[Observation], chosen: &[usize], extra: usize, seed: u64) -> Vec<Observation> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let named = |pose: usize, id: String, approach: [f64; DOF]| {
        let mut record = candidates[pose].clone();
        record.id = id;
        record.conditions.approach = approach;
        record.measured = None;
        record
    };
    let mut poses = Vec::new();
    for (place, &pose) in chosen.iter().enumerate() {
        let approach: [f64; DOF] = std::array::from_fn(|_| if random.random::<bool>() { 1.0 } else { -1.0 });
        poses.push(named(pose, format!("{}", place + 1), approach));
        if place >= 1 && place <= extra {
            poses.push(named(pose, format!("{}-other-side", place + 1), approach.map(|sense| -sense)));
        }
    }
    poses.shuffle(&mut random);
    let Some(&control) = chosen.first().filter(|_| extra > 0) else { return poses };
    let senses = poses.iter().find(|pose| pose.id == "1").map_or([1.0; DOF], |pose| pose.conditions.approach);
    let every = poses.len() / extra;
    for repeat in (0..extra).rev() {
        poses.insert((repeat + 1) * every, named(control, format!("1-control-{}", repeat + 1), senses));
    }
    poses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::workspace::random_poses;
    use crate::measure::fixture::observation;
    use crate::model::fixture;
    use crate::model::robot::Convention;

    fn candidates(model: &ArmModel, count: usize) -> Vec<Observation> {
        random_poses(&model.robot, count, 5).into_iter().map(observation).collect()
    }

    #[test]
    fn a_plan_tells_more_than_poses_taken_as_they_come() {
        let model = ArmModel::nominal(fixture::serial_with_masses());
        let all = candidates(&model, 200);
        let plan = plan(&model, &all, 40, 5e-5, 1).expect("placeable");
        assert_eq!(plan.poses.len(), 40);
        assert!(plan.expected_sigma_m < 0.95 * plan.unplanned_sigma_m, "{plan:?}");
        let named = |part: &str| plan.poses.iter().filter(|pose| pose.id.contains(part)).count();
        assert_eq!((named("control"), named("other-side")), (4, 4));
        assert!(plan.poses.iter().all(|pose| pose.conditions.approach.iter().all(|sense| sense.abs() == 1.0)));
    }

    #[test]
    fn updates_of_the_covariance_agree_with_the_inverse_of_the_information() {
        let rows: Vec<DMatrix<f64>> =
            (0..8).map(|pose| DMatrix::from_fn(3, 5, |i, j| ((pose * 15 + i * 5 + j) as f64 * 0.77).sin())).collect();
        let mut design = Design::new(&rows, 5);
        design.fill(6);
        design.exchange();
        let information = design
            .chosen
            .iter()
            .fold(DMatrix::identity(5, 5), |sum: DMatrix<f64>, &pose| sum + rows[pose].transpose() * &rows[pose]);
        let inverse = information.clone().try_inverse().expect("priors");
        assert!((&design.covariance - inverse).norm() < 1e-10);
        // Every plan of six out of eight: exchanges must have led to nearly the best of them.
        let mut least = f64::INFINITY;
        for (a, b) in (0..8).flat_map(|a| (a + 1..8).map(move |b| (a, b))) {
            let sum = (0..8)
                .filter(|pose| *pose != a && *pose != b)
                .fold(DMatrix::identity(5, 5), |sum, pose| sum + rows[pose].transpose() * &rows[pose]);
            let covariance = sum.try_inverse().expect("priors");
            let squares = rows.iter().map(|rows| (rows * &covariance * rows.transpose()).trace());
            least = least.min(squares.sum::<f64>() / 24.0);
        }
        assert!((0.999..1.02).contains(&(design.variance() / least)), "{} {least}", design.variance());
    }

    #[test]
    fn the_arm_of_the_plan_may_be_one_with_a_parallelogram() {
        let model = ArmModel::nominal(fixture::bare(Convention::Standard, &fixture::LOOPED));
        let plan = plan(&model, &candidates(&model, 60), 12, 5e-5, 2).expect("placeable");
        assert_eq!(plan.poses.len(), 12);
    }
}

//! What was learned, whichever kind of learner it is.

use crate::identify::state::State;
use crate::identify::unknown::Unknown;

use super::additive::{Fitted, Regression};
use super::choose::Candidate;
use super::network::{Bag, Course};
use super::samples::Samples;
use super::term::Family;

/// Records that are asked how uncertain a learner is; with more, some of them.
const MOST_ASKED: usize = 500;

/// A kind of learner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Sums of functions of one variable.
    Additive(Family),
    /// The network of joint errors.
    Network,
}

/// What was learned.
#[derive(Clone, Debug)]
pub struct Learned {
    /// All that was tried, the simplest first.
    pub candidates: Vec<Candidate>,
    /// Index of the one that is used; zero is `none`.
    pub chosen: usize,
    /// Its kind.
    pub kind: Option<Kind>,
    /// The state with geometry moved and the learner on; `None` when none is used.
    pub state: Option<State>,
    /// Factor on the records' sigmas that gives the noise which the learner leaves.
    pub noise_scale: f64,
    /// Degrees of freedom behind that.
    pub freedom: f64,
    /// Mean square of the error that the learner itself is expected to make in a pose like the records', beside that of
    /// the geometry, m^2: its variance, were it all that there is.
    pub error_m2: f64,
    /// What held-out records say of that: their mean square error over it. One where none were held out.
    pub held_out_ratio: f64,
}

impl Learned {
    /// No learner.
    pub fn nothing(samples: &Samples<'_>) -> Self {
        Self {
            candidates: Vec::new(),
            chosen: 0,
            kind: None,
            state: None,
            noise_scale: 1.0,
            freedom: samples.missing.len() as f64,
            error_m2: 0.0,
            held_out_ratio: 1.0,
        }
    }

    /// Holds the error that the learner expects to make against the distances that held-out records were missed by.
    ///
    /// # Arguments
    /// * `share` - of the learner's own part in what the learner and the geometry beside it err by
    pub fn hold_against(&mut self, missed_m: &[f64], rows: usize, share: f64, sigmas_m: &[f64]) {
        let noise_m2 = 3.0 * self.noise_scale.powi(2) * mean(sigmas_m.iter().map(|sigma| sigma * sigma));
        let expected_m2 = noise_m2 + self.error_m2 / share;
        // A mean square scatters by this part of itself; only what is beyond two of that is more than expected.
        let beyond_chance_m2 = expected_m2 * (1.0 + 2.0 * (2.0 / rows.max(1) as f64).sqrt());
        let missed_m2 = mean(missed_m.iter().map(|length| length * length));
        if self.error_m2 > 0.0 {
            self.held_out_ratio = 1.0 + (missed_m2 - beyond_chance_m2).max(0.0) / self.error_m2;
        }
    }
}

/// A regression as what was learned.
pub fn of_regression(
    family: Family,
    regression: &Regression<'_>,
    fitted: &Fitted,
    (state, unknowns): (&State, &[Unknown]),
    sigmas_m: &[f64],
) -> Learned {
    let samples = regression.samples;
    let mut learned = Learned::nothing(samples);
    let mut moved = state.clone();
    regression.move_geometry(fitted, unknowns, &mut moved);
    moved.model.learner = regression.curves(fitted).map(Into::into);
    learned.kind = Some(Kind::Additive(family));
    learned.noise_scale = fitted.variances.noise.sqrt();
    learned.freedom -= fitted.posterior.determined;
    learned.error_m2 = error_of_terms_m2(regression, fitted, sigmas_m);
    learned.state = Some(moved);
    learned
}

/// Mean square of the error that the terms are expected to make in a pose like the records', beside that of geometry, m^2.
pub fn error_of_terms_m2(regression: &Regression<'_>, fitted: &Fitted, sigmas_m: &[f64]) -> f64 {
    let samples = regression.samples;
    let asked: Vec<usize> = (0..samples.count()).step_by(samples.count().div_ceil(MOST_ASKED).max(1)).collect();
    let variance = regression.predicted_variance(fitted, &asked);
    let mut first = 0;
    let squares = asked.iter().map(|&record| {
        let count = samples.rows_of(record).len();
        let position = variance[first..first + count.min(3)].iter().sum::<f64>();
        first += count;
        position * sigmas_m[record] * sigmas_m[record]
    });
    share_of_terms(regression, fitted) * mean(squares)
}

/// A bag of networks as what was learned. `None` where numbers are not finite.
pub fn of_network(
    course: &Course<'_>,
    bag: &Bag,
    samples: &Samples<'_>,
    (state, unknowns): (&State, &[Unknown]),
    sigmas_m: &[f64],
) -> Option<Learned> {
    let mut learned = Learned::nothing(samples);
    let mut moved = state.clone();
    course.move_geometry(bag, unknowns, &mut moved)?;
    moved.model.learner = Some(course.network(bag).into());
    learned.kind = Some(Kind::Network);
    learned.noise_scale = bag.noise().sqrt();
    learned.freedom -= bag.determined() + unknowns.len() as f64;
    learned.error_m2 = 3.0 * course.moved_variance(bag) * mean(sigmas_m.iter().map(|sigma| sigma * sigma));
    learned.state = Some(moved);
    Some(learned)
}

/// Share of a bag's error that is not geometry's (see [`share_of_terms`]).
pub fn share_of_network(bag: &Bag, geometry: usize) -> f64 {
    bag.determined().max(1.0) / (bag.determined().max(1.0) + geometry as f64)
}

/// Share of a regression's own error that is not geometry's, which has about one noise variance for each of its numbers.
pub fn share_of_terms(regression: &Regression<'_>, fitted: &Fitted) -> f64 {
    (1.0 - regression.geometry as f64 / fitted.posterior.determined).max(0.05)
}

fn mean(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0usize), |(sum, count), number| (sum + number, count + 1));
    sum / count.max(1) as f64
}

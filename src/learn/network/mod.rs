//! The network of joint errors: what a plain network cannot know (through which levers an error acts, how a joint was
//! approached, how it is loaded) is built in. Its outputs turn the actuators; geometry stays free beside it.
//!
//! The parts: [`lesson`] (inputs, levers, what is missing), [`beside`] (geometry integrated out), [`member`] (one network,
//! its training and its evidence). Here: the bag of them, its held-out residuals, and what a model file gets.

pub mod beside;
pub mod lesson;
pub mod member;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::state::State;
use crate::identify::unknown::Unknown;
use crate::model::network::{Layers, MeasuredBox, Output, ResidualNetwork, Sureness};
use crate::model::robot::DOF;

use super::samples::Samples;
use super::subject::Subject;
use beside::Beside;
use lesson::{Inputs, Lesson, Outputs, prior_mean};
use member::{Evidenced, Held, Member};

/// Restarts with which a network is judged on held-out records; their mean is what is judged.
pub const FEW: usize = 3;
/// Restarts of a network that was chosen.
pub const MANY: usize = 10;
/// Records beyond which no network is tried: curves learn all that so many have to tell, and sooner.
pub const MOST_RECORDS: usize = 1500;

/// Networks of the same records, to be averaged.
#[derive(Clone, Debug)]
pub struct Bag {
    members: Vec<(Member, Held, Evidenced)>,
}

/// A recording that networks learn from.
#[derive(Clone, Debug)]
pub struct Course<'a> {
    samples: &'a Samples<'a>,
    inputs: Inputs,
    outputs: Outputs,
    prior_mean: DVector<f64>,
    seed: u64,
}

impl<'a> Course<'a> {
    /// The records of a problem, with the state and the unknowns of [`Samples::new`].
    pub fn new(samples: &'a Samples<'a>, subject: &Subject, state: &State, unknowns: &[Unknown], seed: u64) -> Self {
        let has_loop = state.model.robot.parallelogram.is_some();
        Self {
            samples,
            inputs: Inputs::new(samples, subject.features(has_loop)),
            outputs: Outputs::new(samples, subject),
            prior_mean: prior_mean(state, unknowns),
            seed,
        }
    }

    fn lesson(&self, records: &[usize]) -> Lesson {
        Lesson::new(self.samples, &self.inputs, &self.outputs, &self.prior_mean, records)
    }

    fn all(&self) -> Lesson {
        self.lesson(&(0..self.samples.count()).collect::<Vec<_>>())
    }

    /// A bag of so many restarts on all records. `None` where numbers are not finite.
    pub fn train(&self, restarts: usize) -> Option<Bag> {
        let lesson = self.all();
        let train = |member: usize| Member::train(&lesson, self.seed.wrapping_add(member as u64));
        Some(Bag { members: (0..restarts).into_par_iter().map(train).collect::<Option<_>>()? })
    }

    /// Whitened residuals of every record, each from a bag trained anew without its fold, from the same random weights and
    /// with the variances that all records gave.
    pub fn held_out(&self, bag: &Bag, fold_of: &[usize]) -> Option<Vec<DVector<f64>>> {
        let folds = fold_of.iter().max().map_or(0, |largest| largest + 1);
        let parts: Vec<Vec<(usize, DVector<f64>)>> =
            (0..folds).into_par_iter().map(|fold| self.left_of_fold(bag, fold_of, fold)).collect::<Option<_>>()?;
        let mut all = vec![DVector::zeros(0); fold_of.len()];
        for (record, left) in parts.into_iter().flatten() {
            all[record] = left;
        }
        Some(all)
    }

    fn left_of_fold(&self, bag: &Bag, fold_of: &[usize], fold: usize) -> Option<Vec<(usize, DVector<f64>)>> {
        let part = |held: bool| -> Vec<usize> {
            (0..fold_of.len()).filter(|&record| (fold_of[record] == fold) == held).collect()
        };
        let (taught, kept_back) = (self.lesson(&part(false)), part(true));
        let members: Vec<(Member, Held, Evidenced)> = bag
            .members
            .iter()
            .enumerate()
            .map(|(member, (_, held, evidenced))| {
                let seed = self.seed.wrapping_add(member as u64);
                Some((Member::train_held(&taught, held, seed)?, held.clone(), evidenced.clone()))
            })
            .collect::<Option<_>>()?;
        let bag = Bag { members };
        let geometry = bag.geometry(&taught)?;
        let held = self.lesson(&kept_back);
        let left = &held.missing - &held.geometry * geometry - held.moved(&bag.outputs(&held.inputs));
        let mut first = 0;
        let of_record = |&record: &usize| {
            let count = self.samples.rows_of(record).len();
            first += count;
            (record, left.rows(first - count, count).into_owned())
        };
        Some(kept_back.iter().map(of_record).collect())
    }

    /// Moves the geometry of `state` to where the records have it beside the bag.
    pub fn move_geometry(&self, bag: &Bag, unknowns: &[Unknown], state: &mut State) -> Option<()> {
        let geometry = bag.geometry(&self.all())? + &self.prior_mean;
        for (unknown, change) in unknowns.iter().zip(geometry.iter()) {
            state.add(unknown.id, change * unknown.prior.sigma);
        }
        Some(())
    }

    /// Variance of what the bag moves a row by, mean over the rows, whitened: what the evidence leaves of a member, and by
    /// what the members differ, both with geometry following, which undoes an offset.
    pub fn moved_variance(&self, bag: &Bag) -> f64 {
        let lesson = self.all();
        let beside = Beside::new(&lesson.geometry, bag.noise());
        let moved_by = |member: &Member| {
            let moved = lesson.moved(&member.outputs(&lesson.inputs));
            beside.as_ref().map_or_else(|| moved.clone(), |beside| beside.apply(&moved))
        };
        let moved: Vec<DVector<f64>> = bag.members.iter().map(|(member, ..)| moved_by(member)).collect();
        let count = moved.len().max(1) as f64;
        let mean = moved.iter().fold(DVector::zeros(lesson.missing.len()), |sum, one| sum + one) / count;
        let spread = moved.iter().map(|one| (one - &mean).norm_squared()).sum::<f64>() / (count - 1.0).max(1.0);
        let evidence = bag.members.iter().map(|(.., evidenced)| evidenced.moved_variance).sum::<f64>() / count;
        evidence + spread / lesson.missing.len().max(1) as f64
    }

    /// The bag as a model file holds it.
    pub fn network(&self, bag: &Bag) -> ResidualNetwork {
        let Outputs { actuators, unit_rad } = &self.outputs;
        let row = |matrix: &DMatrix<f64>, row: usize, columns: usize, factor: f64| -> Vec<f64> {
            (0..columns).map(|column| matrix[(row, column)] * factor).collect()
        };
        let layers = |(member, ..): &(Member, Held, Evidenced)| {
            let (units, inputs) = (member.first.nrows(), member.first.ncols() - 1);
            let mut output_weights = vec![vec![0.0; units]; DOF];
            for (output, (&actuator, &unit)) in actuators.iter().zip(unit_rad).enumerate() {
                output_weights[actuator] = row(&member.second, output, units, unit);
            }
            Layers {
                hidden_weights: (0..units).map(|unit| row(&member.first, unit, inputs, 1.0)).collect(),
                hidden_biases: member.first.column(inputs).iter().copied().collect(),
                output_weights,
                output_biases: vec![0.0; DOF],
            }
        };
        let mut evidence_rad = [0.0; DOF];
        for (output, (&actuator, unit)) in actuators.iter().zip(unit_rad).enumerate() {
            let mean = bag.members.iter().map(|(.., evidenced)| evidenced.variance[output]).sum::<f64>();
            evidence_rad[actuator] = unit * (mean / bag.members.len().max(1) as f64).sqrt();
        }
        let angles = &self.samples.actuators_rad;
        let limit = |of: fn(f64, f64) -> f64, start: f64| -> [f64; DOF] {
            std::array::from_fn(|joint| angles.iter().map(|angles| angles[joint]).fold(start, of))
        };
        ResidualNetwork {
            features: self.inputs.features.clone(),
            shift: self.inputs.shift.clone(),
            scale: self.inputs.scale.clone(),
            output: Output::Actuators,
            members: bag.members.iter().map(layers).collect(),
            measured: Some(Box::new(MeasuredBox {
                min_rad: limit(f64::min, f64::INFINITY),
                max_rad: limit(f64::max, f64::NEG_INFINITY),
            })),
            sureness: Some(Box::new(Sureness { evidence_rad, factor: 1.0 })),
        }
    }
}

impl Bag {
    /// Mean of the members' outputs.
    fn outputs(&self, inputs: &DMatrix<f64>) -> DMatrix<f64> {
        let mut all = self.members.iter().map(|(member, ..)| member.outputs(inputs));
        let first = all.next().unwrap_or_else(|| DMatrix::zeros(0, inputs.ncols()));
        all.fold(first, |sum, one| sum + one) / self.members.len().max(1) as f64
    }

    /// Noise variance of a row, whitened: mean of the members'.
    pub fn noise(&self) -> f64 {
        self.members.iter().map(|(_, held, _)| held.noise).sum::<f64>() / self.members.len().max(1) as f64
    }

    /// Numbers that the records determined, of a member's weights, in the mean.
    pub fn determined(&self) -> f64 {
        self.members.iter().map(|(.., evidenced)| evidenced.determined).sum::<f64>() / self.members.len().max(1) as f64
    }

    /// Weights of a member.
    pub fn weights(&self) -> usize {
        self.members.first().map_or(0, |(member, ..)| member.first.len() + member.second.len())
    }

    fn geometry(&self, lesson: &Lesson) -> Option<DVector<f64>> {
        let left = &lesson.missing - lesson.moved(&self.outputs(&lesson.inputs));
        Some(Beside::new(&lesson.geometry, self.noise())?.geometry_of(&left))
    }
}

//! Which unknowns a robot can show at all, and how well a recording shows them. Everything numerical: no list of
//! redundant parameters stands anywhere.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::measure::observation::{Measured, Observation};
use crate::model::robot::Robot;

use super::prior::{unknown_of, unknowns_of_station};
use super::problem::{NoPose, Problem, Record};
use super::state::State;
use super::unknown::{Scope, Unknown, UnknownId, model_ids};
use super::workspace::random_poses;

/// An unknown that cannot be told from others, whatever pose the arm takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Redundant {
    /// The unknown, left at what the model has.
    pub unknown: Unknown,
    /// Those that say the same together, the strongest first, with the change that replaces a unit change of this one
    /// (in their units per its unit). Empty: it moves nothing that is measured.
    pub coupled_with: Vec<(UnknownId, f64)>,
}

/// Unknowns sorted into those to fit and those that are redundant.
#[derive(Clone, Debug)]
pub struct Selection {
    /// To fit, in the order given.
    pub free: Vec<Unknown>,
    /// Redundant.
    pub redundant: Vec<Redundant>,
}

/// Poses all over the joint range on which redundancy is judged.
const POSES: usize = 160;
/// An unknown is redundant when an error as large as its prior, after all others have done what they can to undo it,
/// moves the tool by less than this RMS, m. Redundancies of bare geometry are exact and leave 1e-14; where a compliant
/// arm breaks them only through the load (zero of joint 6 against the tool) they leave 1e-7 and less; a tracker sees
/// 1e-5.
const INVISIBLE_M: f64 = 5e-6;
/// Couplings below this part of the strongest are not named.
const NAMED_COUPLING: f64 = 0.02;

/// Sorts out what is redundant on poses all over the joint range (seeded), under the circumstances of the records.
///
/// Unknowns are taken in order: one is redundant when it does nothing that the ones before it cannot do. That a
/// recording happens not to show an unknown (a joint that hardly moved) is another matter: such an unknown stays free,
/// its prior keeps it at nominal, and its uncertainty stays in every prediction.
///
/// # Errors
/// [`NoPose`] when the model cannot place the records.
pub fn select(problem: &Problem<'_>, state: &State, unknowns: Vec<Unknown>, seed: u64) -> Result<Selection, NoPose> {
    let poses = poses_in_range(&state.model.robot, problem, seed);
    let prepared = state.model.prepared();
    let placeable = |record: &Record<'_>| {
        super::problem::expected_pose(&prepared, &crate::geometry::pose::Pose::identity(), record.observation).is_ok()
    };
    let mut records: Vec<Record<'_>> = poses
        .iter()
        .zip(problem.records.iter().cycle())
        .map(|(observation, like)| Record {
            observation,
            measured: Measured { position_m: Vector3::zeros(), ..like.measured },
            station: like.station,
            // A metre and a radian weigh alike, and all records the same: this is about geometry, not about noise.
            sigma_m: 1.0,
            sigma_rad: 1.0,
        })
        .filter(placeable)
        .collect();
    records.extend(problem.records.iter().take(POSES).map(|record| Record { sigma_m: 1.0, sigma_rad: 1.0, ..*record }));
    let jacobian = Problem { records }.jacobian(state, &unknowns)?;
    Ok(sort_out(&jacobian, unknowns))
}

/// What `scope` frees, stations' frames included, less what is redundant.
///
/// # Errors
/// [`NoPose`] when the model cannot place the records.
pub fn selection_of(
    problem: &Problem<'_>,
    state: &State,
    scope: Scope,
    own_frame: &[bool],
    seed: u64,
) -> Result<Selection, NoPose> {
    let with_rotation = problem.records.iter().any(|record| record.measured.rotation.is_some());
    let torque = problem.largest_torque_nm(state);
    let mut unknowns: Vec<Unknown> = model_ids(&state.model, scope, with_rotation)
        .into_iter()
        .map(|id| unknown_of(id, &state.model, &torque))
        .collect();
    // Frames first: what a row says as well as a frame is the frame's.
    let frames = model_ids(&state.model, Scope::Frames, with_rotation).len();
    let stations = (0..own_frame.len()).filter(|&station| own_frame[station]).flat_map(unknowns_of_station);
    unknowns.splice(frames..frames, stations.collect::<Vec<_>>());
    select(problem, state, unknowns, seed)
}

fn poses_in_range(robot: &Robot, problem: &Problem<'_>, seed: u64) -> Vec<Observation> {
    let like = problem.records.iter().map(|record| record.observation).cycle();
    random_poses(robot, POSES, seed)
        .into_iter()
        .zip(like)
        .map(|(numbers_rad, like)| Observation { numbers_rad, ..like.clone() })
        .collect()
}

fn sort_out(jacobian: &DMatrix<f64>, unknowns: Vec<Unknown>) -> Selection {
    let rows = jacobian.nrows().max(1) as f64;
    let mut basis: Vec<DVector<f64>> = Vec::new();
    // Columns kept so far as combinations of the basis: the triangular factor, column by column.
    let mut triangle: Vec<Vec<f64>> = Vec::new();
    let mut lengths: Vec<f64> = Vec::new();
    let mut free: Vec<Unknown> = Vec::new();
    let mut redundant = Vec::new();
    for (column, unknown) in jacobian.column_iter().zip(unknowns) {
        let length = column.norm();
        let invisible = INVISIBLE_M * rows.sqrt() / unknown.prior.sigma;
        if length < invisible {
            redundant.push(Redundant { unknown, coupled_with: Vec::new() });
            continue;
        }
        let mut left = column.into_owned() / length;
        let mut along = vec![0.0; basis.len()];
        for _ in 0..2 {
            for (direction, along) in basis.iter().zip(&mut along) {
                let part = direction.dot(&left);
                left.axpy(-part, direction, 1.0);
                *along += part;
            }
        }
        let rest = left.norm();
        if rest * length < invisible {
            let coupled_with = couplings(&triangle, &along, &lengths, length, &free);
            redundant.push(Redundant { unknown, coupled_with });
        } else {
            basis.push(left / rest);
            along.push(rest);
            triangle.push(along);
            lengths.push(length);
            free.push(unknown);
        }
    }
    Selection { free, redundant }
}

/// The combination of kept columns that gives a redundant one: back-substitution in the triangular factor.
fn couplings(
    triangle: &[Vec<f64>],
    along: &[f64],
    lengths: &[f64],
    length: f64,
    kept: &[Unknown],
) -> Vec<(UnknownId, f64)> {
    let count = along.len();
    let mut share = vec![0.0; count];
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|column| triangle[column][row] * share[column]).sum();
        share[row] = (along[row] - known) / triangle[row][row];
    }
    let strongest = share.iter().fold(0.0f64, |largest, part| largest.max(part.abs()));
    let mut order: Vec<usize> = (0..count).filter(|&k| share[k].abs() > NAMED_COUPLING * strongest).collect();
    order.sort_by(|&a, &b| share[b].abs().total_cmp(&share[a].abs()));
    order.into_iter().map(|k| (kept[k].id, share[k] * length / lengths[k])).collect()
}

/// How well a recording shows an unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Which.
    pub id: UnknownId,
    /// mag: RMS effect on a measured coordinate of an error as large as the prior allows, m.
    pub magnitude_m: f64,
    /// var: by how much its variance is larger than if all others were known (variance inflation factor), from the
    /// data alone; infinite where the data alone cannot tell it.
    pub inflation: f64,
    /// Standard uncertainty after the recording over that before: near 1, the recording said nothing.
    pub remaining: f64,
}

/// What a recording can and cannot tell.
#[derive(Clone, Debug)]
pub struct Identifiability {
    /// One entry an unknown.
    pub shown: Vec<Shown>,
    /// Pairs of unknowns with a correlation beyond [`STRONG_CORRELATION`], strongest first.
    pub correlated: Vec<(UnknownId, UnknownId, f64)>,
    /// Rank of the data alone, columns scaled to unit length.
    pub rank: usize,
    /// Condition number of the column-scaled Jacobian (Schroer 1993 asks for less than 100).
    pub condition: f64,
    /// Observability indices O1 to O5 (Borm and Menq 1991; Driels and Pathre 1990; Nahvi, Hollerbach and Hayward
    /// 1994; Nahvi and Hollerbach 1996; Sun and Hollerbach 2008), of the Jacobian in mm per prior-sized error.
    pub observability: [f64; 5],
}

/// Correlations beyond this are named.
pub const STRONG_CORRELATION: f64 = 0.9;
/// Singular values below this part of the largest count as zero, columns scaled.
const RANK_TOLERANCE: f64 = 1e-5;

/// Judges a recording by the whitened Jacobian and the covariance root of a fit (`sigma_m` is the noise it was
/// whitened with, for effects in metres).
pub fn judge(
    whitened_jacobian: &DMatrix<f64>,
    unknowns: &[Unknown],
    covariance_root: &DMatrix<f64>,
    sigma_m: f64,
    records: usize,
) -> Identifiability {
    let (rows, columns) = whitened_jacobian.shape();
    let mut by_length = whitened_jacobian.clone();
    let mut by_prior = whitened_jacobian.clone();
    for (index, unknown) in unknowns.iter().enumerate() {
        let length = whitened_jacobian.column(index).norm();
        by_length.column_mut(index).unscale_mut(if length > 0.0 { length } else { 1.0 });
        by_prior.column_mut(index).scale_mut(unknown.prior.sigma * sigma_m * 1e3);
    }
    let svd = by_length.qr().r().svd(false, true);
    let largest = svd.singular_values.amax();
    let smallest = svd.singular_values.min();
    let rank = svd.singular_values.iter().filter(|&&value| value > RANK_TOLERANCE * largest).count();
    let shown = unknowns
        .iter()
        .enumerate()
        .map(|(index, unknown)| {
            let inflation = svd.v_t.as_ref().map_or(f64::INFINITY, |v_t| {
                (0..columns.min(rows))
                    .map(|k| {
                        let part = v_t[(k, index)];
                        let value = svd.singular_values[k];
                        if value > RANK_TOLERANCE * largest {
                            (part / value).powi(2)
                        } else if part.abs() > 1e-3 {
                            f64::INFINITY
                        } else {
                            0.0
                        }
                    })
                    .sum()
            });
            let length = whitened_jacobian.column(index).norm();
            Shown {
                id: unknown.id,
                magnitude_m: length * sigma_m * unknown.prior.sigma / (rows.max(1) as f64).sqrt(),
                inflation,
                remaining: covariance_root.row(index).norm() / unknown.prior.sigma,
            }
        })
        .collect();
    Identifiability {
        shown,
        correlated: correlated(unknowns, covariance_root),
        rank,
        condition: if smallest > 0.0 { largest / smallest } else { f64::INFINITY },
        observability: observability(&by_prior, records),
    }
}

fn correlated(unknowns: &[Unknown], covariance_root: &DMatrix<f64>) -> Vec<(UnknownId, UnknownId, f64)> {
    let mut pairs = Vec::new();
    for first in 0..unknowns.len() {
        for second in 0..first {
            let (a, b) = (covariance_root.row(first), covariance_root.row(second));
            let correlation = a.dot(&b) / (a.norm() * b.norm());
            if correlation.abs() > STRONG_CORRELATION {
                pairs.push((unknowns[second].id, unknowns[first].id, correlation));
            }
        }
    }
    pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
    pairs
}

fn observability(jacobian: &DMatrix<f64>, records: usize) -> [f64; 5] {
    let values = jacobian.clone().qr().r().singular_values();
    let count = values.len().max(1) as f64;
    let (largest, smallest) = (values.amax(), values.min());
    if smallest <= 0.0 {
        return [0.0; 5];
    }
    let geometric_mean = (values.iter().map(|value| value.ln()).sum::<f64>() / count).exp();
    [
        geometric_mean / (records.max(1) as f64).sqrt(),
        smallest / largest,
        smallest,
        smallest * smallest / largest,
        1.0 / values.iter().map(|value| 1.0 / value).sum::<f64>(),
    ]
}

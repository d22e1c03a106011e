//! Errors of the tracker itself, which follow the direction of its beam and nothing in the arm.
//!
//! A tracker whose horizontal encoder is off centre, or whose graduation is, turns its beam by an angle that depends on where
//! it looks. Where it stood nobody has written down. So places around the robot are tried, the best one is narrowed, and the
//! turn may be any smooth function of the direction: a suspect without a name, which explains clearly more than any name of
//! the arm's physics only where it is the tracker. Seen from the arm's foot such an error passes for a wobble of axis 1.

use rayon::prelude::*;

use super::evidence;
use super::free::{FreeFunction, Seat, Stand, Variable, free_functions};
use super::projection::Projection;
use super::rank::{Cause, Suspect};
use super::regressors::Regressors;

/// Distances from the robot base that are tried, in parts of how far the records reach.
const DISTANCES: [f64; 2] = [1.4, 2.5];
/// Directions in which a tracker may stand.
const DIRECTIONS: usize = 12;
/// Rounds of narrowing, each with half the step of the one before.
const NARROWINGS: usize = 6;

/// An error that follows the beam of a tracker, from where it explains most.
pub fn tracker(regressors: &Regressors<'_, '_>, projection: &Projection) -> Option<Suspect> {
    let reach_mm =
        regressors.stands.iter().map(|stand| 1e3 * stand.base_t_flange.translation.xy().norm()).fold(0.0, f64::max);
    let places = DISTANCES.len() * DIRECTIONS;
    let looked_at = evidence::looked_at((free_functions(regressors).len() * places) as f64);
    let suspect = |[x_mm, y_mm]: [f64; 2]| {
        let at_mm: Stand = [x_mm.round() as i32, y_mm.round() as i32];
        let function = FreeFunction { seat: Seat::Tracker(at_mm), variables: vec![Variable::Beam(at_mm)] };
        Suspect { columns: function.columns(regressors), cause: Cause::Free(function), looked_at }
    };
    let explained = |at_mm: &[f64; 2]| projection.smooth_gain(&suspect(*at_mm).columns, looked_at).0.explained;
    let best_of = |places: Vec<[f64; 2]>| {
        places.into_par_iter().map(|at_mm| (explained(&at_mm), at_mm)).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let around = DISTANCES.iter().flat_map(|distance| {
        (0..DIRECTIONS).map(move |direction| {
            let (sine, cosine) = (std::f64::consts::TAU * direction as f64 / DIRECTIONS as f64).sin_cos();
            [distance * reach_mm * cosine, distance * reach_mm * sine]
        })
    });
    let (_, mut best) = best_of(around.collect())?;
    let mut step_mm = 0.4 * reach_mm;
    for _ in 0..NARROWINGS {
        let beside = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
        let near = beside.map(|[x, y]| [best[0] + step_mm * x, best[1] + step_mm * y]);
        // Within the arm's reach no tracker stands.
        let outside = near.into_iter().filter(|at_mm| at_mm[0].hypot(at_mm[1]) > reach_mm);
        (_, best) = best_of(outside.collect())?;
        step_mm *= 0.6;
    }
    Some(suspect(best))
}

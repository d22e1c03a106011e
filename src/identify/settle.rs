//! Which tracker stations get a frame of their own, beyond those that clearly stood elsewhere.

use super::identifiability::selection_of;
use super::problem::{NoPose, Problem};
use super::robust;
use super::state::State;
use super::stations::{Start, candidates, moved};
use super::unknown::Scope;

/// Stations up to which each is tried with a frame of its own. With more, the moved one is in the minority, and a robust
/// fit shows it.
const MOST_TRIALS: usize = 5;
/// A frame of its own must make all residuals smaller by this factor, typically.
const FRAME_GAIN: f64 = 1.5;

/// Gives a frame to every station that has moved, one after the other, the most evident first.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn settle(problem: &Problem<'_>, placed: Start, seed: u64) -> Result<Start, NoPose> {
    let Start { state, mut own_frame } = placed;
    let robust_fit = |own_frame: &[bool]| -> Result<State, NoPose> {
        let free = selection_of(problem, &state, Scope::Everything, own_frame, seed)?.free;
        robust::fit(problem, state.clone(), &free)
    };
    let spread = |fitted: &State| -> Result<f64, NoPose> {
        Ok(robust::spread_m(&robust::lengths_of(problem, &problem.residuals(fitted)?)))
    };
    while own_frame.iter().filter(|own| !**own).count() > 1 {
        let fitted = robust_fit(&own_frame)?;
        let mut evident = moved(problem, &fitted, &own_frame)?;
        let tried = candidates(problem, &own_frame);
        if evident.is_none() && tried.len() <= MOST_TRIALS {
            let before = spread(&fitted)?;
            let mut best = before / FRAME_GAIN;
            for station in tried {
                let mut with_frame = own_frame.clone();
                with_frame[station] = true;
                let after = spread(&robust_fit(&with_frame)?)?;
                if after < best {
                    (evident, best) = (Some(station), after);
                }
            }
        }
        match evident {
            Some(station) => own_frame[station] = true,
            None => break,
        }
    }
    Ok(Start { state, own_frame })
}

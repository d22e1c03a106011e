//! What has no name, learned: the updated model holds it as a function of what was located, where held-out records say that
//! it helps. Knowing where an error sits and what it depends on leaves little to learn: one joint by two variables is told by as
//! many records as thirty functions of one.

use crate::identify::estimate::Estimate;
use crate::identify::problem::NoPose;
use crate::learn::calibration::with_learner;
use crate::learn::choose::{Rivals, learn};
use crate::learn::subject::Subject;
use crate::model::network::Feature;

use super::found::Found;
use super::free::{FreeFunction, Variable};

/// An estimate with what has no name in it.
#[derive(Clone, Debug)]
pub struct Nameless<'a> {
    /// The fit with the findings and what was learned.
    pub estimate: Estimate<'a>,
    /// Held-out root mean square without and with what was learned, mm.
    pub held_out_rms_mm: [f64; 2],
}

/// Learns what a search left without a name; `None` where there is nothing that a model file could hold, or where held-out
/// records are no nearer with it.
///
/// # Errors
/// [`NoPose`] when a model cannot place a record.
pub fn nameless<'a>(found: &Found<'a>, seed: u64) -> Result<Option<Nameless<'a>>, NoPose> {
    let before = &found.fitted.estimate;
    // A model has one learner: that of the given model, or the curves that the search found, stays.
    let (None, Some(subject)) = (&before.fit.state.model.learner, subject(&found.free)) else { return Ok(None) };
    let own = (&before.fit.state, &before.fit.unknowns[..]);
    let learned = learn(&before.problem, own, &subject, Rivals::All, seed)?;
    let (Some(without), Some(with)) = (learned.candidates.first(), learned.candidates.get(learned.chosen)) else {
        return Ok(None);
    };
    let held_out_rms_mm = [without.heldout_rms_mm, with.heldout_rms_mm];
    let estimate = with_learner(before.problem.clone(), before, &learned)?;
    Ok(estimate.map(|estimate| Nameless { estimate, held_out_rms_mm }))
}

/// What was located, as far as it is the arm's and depends on what a program's target has: pose, load and approach.
fn subject(free: &[FreeFunction]) -> Option<Subject> {
    // The arm must not be taught what its tracker does.
    if free.iter().any(FreeFunction::is_of_tracker) {
        return None;
    }
    let (mut turns, mut features) = (Vec::new(), Vec::new());
    for function in free {
        let seen: Option<Vec<Vec<Feature>>> = function.variables.iter().map(|one| features_of(*one)).collect();
        let (Some(joint), Some(seen)) = (function.joint(), seen) else { continue };
        add_new(&mut turns, [joint]);
        add_new(&mut features, seen.into_iter().flatten());
    }
    (!turns.is_empty()).then_some(Subject::Located { turns, features })
}

fn add_new<T: PartialEq>(all: &mut Vec<T>, more: impl IntoIterator<Item = T>) {
    for one in more {
        if !all.contains(&one) {
            all.push(one);
        }
    }
}

/// The inputs of a learner that tell a variable; `None` where a program's target does not have it.
fn features_of(variable: Variable) -> Option<Vec<Feature>> {
    match variable {
        Variable::Position(joint) => Some(vec![Feature::Sine(joint + 1), Feature::Cosine(joint + 1)]),
        Variable::Approach(joint) => Some(vec![Feature::Approach(joint + 1)]),
        Variable::Torque(joint) => Some(vec![Feature::Torque(joint + 1)]),
        Variable::Speed(_) | Variable::Acceleration(_) | Variable::Time | Variable::Temperature | Variable::Beam(_) => {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::free::Seat;

    fn at(joint: usize, variables: &[Variable]) -> FreeFunction {
        FreeFunction { seat: Seat::Joint(joint), variables: variables.to_vec() }
    }

    #[test]
    fn what_was_located_is_what_may_be_learned() {
        let free = [
            at(4, &[Variable::Position(1), Variable::Position(3)]),
            at(4, &[Variable::Approach(4), Variable::Position(1)]),
            at(2, &[Variable::Time]),
            FreeFunction { seat: Seat::Base, variables: vec![Variable::Time] },
        ];
        let sines = [Feature::Sine(2), Feature::Cosine(2), Feature::Sine(4), Feature::Cosine(4)];
        let features = sines.into_iter().chain([Feature::Approach(5)]).collect();
        assert_eq!(subject(&free), Some(Subject::Located { turns: vec![4], features }));
        assert_eq!(subject(&free[2..]), None);
    }

    #[test]
    fn an_arm_is_not_taught_the_errors_of_its_tracker() {
        let tracker = FreeFunction { seat: Seat::Tracker([4000, 0]), variables: vec![Variable::Beam([4000, 0])] };
        assert_eq!(subject(&[at(4, &[Variable::Position(1)]), tracker]), None);
    }
}

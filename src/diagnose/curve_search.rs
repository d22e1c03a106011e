//! Curves in the place of what a search has found: of lines where a joint shows many, of functions without a name where a
//! curve of a joint's own angle, which has one, says the same or more.

use crate::identify::problem::NoPose;
use crate::measure::recording::Kind;
use crate::model::robot::DOF;

use super::evidence::{DECIDES, SMALLEST_PART};
use super::fitted::{Fitted, Ground};
use super::found::Found;
use super::free::FreeFunction;
use super::hold_out::{Blocks, fall_in_errors, held_out_squares_m2};
use super::regressors::Regressors;
use super::review::review;
use super::ripple::{JointRipple, curved, relearned};
use super::search::{MOST_SEARCHED, search_in};

/// Lines of one joint that make it worth asking for a curve.
const FEWEST_LINES: usize = 2;
/// Orders up to here have names of their own (eccentricity, ovality): they ask for no curve.
const LOW_ORDER: f64 = 3.5;
/// Standard errors by which held-out records must be nearer to curves than to a list of lines.
const SURELY_NEARER: f64 = 1.0;

/// Why curves are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Occasion {
    /// A joint shows many lines.
    ManyLines,
    /// What has no name are functions of their joints' own angles.
    OwnAngles,
    /// What has no name are other functions of the arm, which may stand for the curves of several joints.
    OtherFunctions,
}

impl Occasion {
    fn of(found: &Found<'_>) -> Option<Self> {
        let free = &found.free;
        if shows_many_lines(found) {
            return Some(Self::ManyLines);
        }
        if free.is_empty() || free.iter().any(FreeFunction::is_of_tracker) {
            return None;
        }
        let all_own = free.iter().all(FreeFunction::is_of_own_position);
        Some(if all_own { Self::OwnAngles } else { Self::OtherFunctions })
    }

    /// The joints that may have a curve. What curves they have shows beside each other's alone.
    fn joints(self, found: &Found<'_>) -> Vec<usize> {
        match self {
            Self::ManyLines | Self::OtherFunctions => (0..DOF).collect(),
            Self::OwnAngles => found.free.iter().filter_map(FreeFunction::joint).collect(),
        }
    }

    /// Standard errors by which held-out records must be nearer to curves. In the place of a nameless function of the same
    /// angle a curve says the same, and has a name: then it need only be as near.
    fn least(self) -> f64 {
        match self {
            Self::ManyLines | Self::OtherFunctions => SURELY_NEARER,
            Self::OwnAngles => -SURELY_NEARER,
        }
    }
}

fn shows_many_lines(found: &Found<'_>) -> bool {
    let fine = |joint: usize| {
        let terms = found.fitted.terms.iter().map(super::candidate::Candidate::location);
        terms.filter(|at| at.joint_index() == Some(joint) && at.order.is_some_and(|order| order > LOW_ORDER)).count()
    };
    (0..DOF).any(|joint| fine(joint) >= FEWEST_LINES)
}

/// The search's result with curves in the place of lines or of nameless functions, where held-out records are nearer to the
/// curves; `None` where they are not.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn with_curves<'a>(
    ground: &Ground<'a>,
    before: &Found<'a>,
    kind: Kind,
    seed: u64,
) -> Result<Option<Found<'a>>, NoPose> {
    let Some(occasion) = Occasion::of(before) else { return Ok(None) };
    let searched = ground.thinned(MOST_SEARCHED);
    let part = searched.as_ref().unwrap_or(ground);
    let plain = match &searched {
        None => before.clone(),
        Some(part) => Found { fitted: part.refit(&before.fitted, &before.fitted.terms, &[])?, ..before.clone() },
    };
    let blocks = Blocks::for_curves(&plain.fitted.estimate.problem, kind, seed);
    let of_plain_m2 = squares_m2(&plain, &blocks)?;
    let nearer =
        |found: &Found<'_>| -> Result<f64, NoPose> { Ok(fall_in_errors(&of_plain_m2, &squares_m2(found, &blocks)?)) };
    let Some(all) = curved(part, &occasion.joints(before))? else { return Ok(None) };
    let all = all.fit(&[])?;
    if occasion == Occasion::OtherFunctions {
        // Curves alone must tell more than everything that was found: what a search adds to them later is no word for them.
        let alone = Found { fitted: all.clone(), free: Vec::new(), ..plain.clone() };
        if nearer(&alone)? < SURELY_NEARER {
            return Ok(None);
        }
    }
    let mut telling = telling(&all);
    if occasion == Occasion::OwnAngles {
        telling.retain(|one| one.is_periodic());
    }
    let joints: Vec<usize> = telling.iter().map(|one| one.joint).collect();
    if joints.is_empty() {
        return Ok(None);
    }
    let Some(curved_part) = curved(part, &joints)? else { return Ok(None) };
    let mut found = search_in(&curved_part, curved_part.fit(&[])?, kind, seed)?;
    if nearer(&found)? < occasion.least() {
        return Ok(None);
    }
    // Curves and causes were found in turn: now together, on all records.
    let with_terms = ground.fit(&found.fitted.terms)?;
    let Some(together) = relearned(&with_terms, &joints)? else { return Ok(None) };
    found.fitted = together;
    found.bare_m2 = before.bare_m2;
    if searched.is_some() {
        found.blocks = before.blocks.clone();
    }
    found.reviews = review(&found)?;
    Ok(Some(found))
}

/// Squared distances of held-out records from what was found, with a name and without.
fn squares_m2(found: &Found<'_>, blocks: &Blocks) -> Result<Vec<f64>, NoPose> {
    let estimate = &found.fitted.estimate;
    let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
    Ok(held_out_squares_m2(&estimate.problem, blocks, &found.projection(&regressors, None)))
}

/// The curves that are believed beside all others.
fn telling<'f>(fitted: &'f Fitted<'_>) -> Vec<&'f JointRipple> {
    let Some(ripple) = &fitted.ripple else { return Vec::new() };
    let believed = |one: &&JointRipple| {
        let (explained, evidence, projection) = one.gain(fitted);
        evidence < -DECIDES && explained > SMALLEST_PART * projection.cost
    };
    ripple.joints.iter().filter(believed).collect()
}

//! Which of the solutions a program means.

use std::f64::consts::PI;

use crate::model::robot::{DOF, LimitViolation};

use super::controller::{Controller, STRAIGHT_RAD};
use super::posture::{Posture, Singularity};
use super::solution::{Branches, NoSolution, Stance};
use super::turns::{LIMIT_SLACK_RAD, Preference, nearest_in, outside};

/// What a program says about the solution it means; the default says nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wish {
    /// Intervals that joint numbers lie in, rad: quadrants, turns, signs.
    pub intervals_rad: [Option<(f64, f64)>; DOF],
    /// See [`Posture::rear`].
    pub rear: Option<bool>,
    /// See [`Posture::elbow_down`].
    pub elbow_down: Option<bool>,
    /// See [`Posture::wrist_negative`].
    pub wrist_negative: Option<bool>,
    /// Numbers near which the solution lies, rad; goes before the previous target.
    pub near_rad: Option<[f64; DOF]>,
    /// A wrist that is bent by less counts as straight, rad: the turn of axis 4 is then taken from the wish, at the
    /// price of so large an error in orientation. Never less than [`STRAIGHT_RAD`].
    pub straight_wrist_rad: f64,
}

/// The solution chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The controller's numbers, rad.
    pub numbers_rad: [f64; DOF],
    /// How the arm stands.
    pub posture: Posture,
    /// How near it is to where postures meet.
    pub singularity: Singularity,
    /// True when the wrist counts as straight, so that its turns were taken from the wish.
    pub singular: bool,
    /// By how much the wish is not met, rad: distances from intervals, and up to pi for each side of the posture.
    pub wish_violation_rad: f64,
}

/// Violations below this are rounding of a program's decimals, rad.
const ROUNDING_RAD: f64 = 1e-4;
/// Distance from where two postures meet (a sine, or a part of the arm's size) from which on a mismatch counts fully.
const CLEARLY: f64 = 0.05;

impl Controller {
    /// The solution that best meets the wish; among equals the one nearest to the wish's or the previous numbers, or
    /// to the home position when there are none.
    ///
    /// A violated wish is measured, not refused: a pose a hair across the boundary of a quadrant stays in its branch,
    /// and the caller sees by how much ([`Choice::wish_violation_rad`]). A posture on the wrong side counts pi rad, and
    /// less in proportion within [`CLEARLY`] of the place where the two sides meet.
    ///
    /// # Errors
    /// [`NoSolution::JointLimit`] when every solution lies outside the limits by more than [`LIMIT_SLACK_RAD`].
    pub fn choose(
        &self,
        branches: &Branches<impl Copy + Into<Stance>>,
        wish: &Wish,
        previous_rad: Option<&[f64; DOF]>,
    ) -> Result<Choice, NoSolution> {
        let near_rad = wish.near_rad.or(previous_rad.copied()).unwrap_or(*self.home_rad());
        let preference = Preference { near_rad, intervals_rad: wish.intervals_rad };
        let straight = wish.straight_wrist_rad.max(STRAIGHT_RAD);
        let mut contest = Contest { controller: self, wish, preference, straight, best: None, nearest_limit: None };
        let branches = branches.map(|&one| one.into());
        contest.enter_all(&branches);
        if branches.iter().any(|solution| self.leaves_freedom(solution, straight)) {
            self.enter_free_turns(&branches, &mut contest);
        }
        contest.result()
    }

    /// [`Controller::inverse`] and [`Controller::choose`] in one; for arms without a closed form the numbers to be near
    /// to are a start as well.
    ///
    /// # Errors
    /// [`NoSolution`].
    pub fn solve(
        &self,
        base_t_flange: &crate::geometry::pose::Pose,
        wish: &Wish,
        previous_rad: Option<&[f64; DOF]>,
    ) -> Result<Choice, NoSolution> {
        let near = wish.near_rad.as_ref().or(previous_rad);
        let freedom = self.freedom(near.unwrap_or(self.home_rad()), STRAIGHT_RAD);
        let branches = self.inverse_with(base_t_flange, &freedom, near)?;
        self.choose(&branches, wish, previous_rad)
    }

    fn leaves_freedom(&self, solution: &Stance, straight_rad: f64) -> bool {
        solution.singularity.wrist_sin < straight_rad || solution.singularity.shoulder_m < STRAIGHT_RAD
    }

    /// Enters the solutions in which the free turn is the preferred one, or lies at an end of what the intervals of
    /// the two wrist joints allow.
    fn enter_free_turns(&self, branches: &Branches<Stance>, contest: &mut Contest<'_>) {
        let Preference { near_rad, intervals_rad } = contest.preference;
        let free = self.free_row();
        let straight = contest.straight;
        let mut wanted = near_rad;
        for (number, interval) in wanted.iter_mut().zip(&intervals_rad) {
            if let Some((from, to)) = interval {
                *number = nearest_in(*number, *from, *to);
            }
        }
        let freedom = self.freedom(&wanted, contest.straight);
        let near = Some(&near_rad);
        let Ok(pinned) = self.inverse_with(&branches.base_t_flange, &freedom, near) else { return };
        pinned.iter().for_each(|solution| contest.enter(solution));
        // The other joint of a straight wrist turns with the free one, in the same or in the opposite sense.
        let other = if free == 3 { 5 } else { 3 };
        for solution in pinned.iter().filter(|solution| solution.singularity.wrist_sin < straight) {
            let number = self.place(&solution.actuators_rad, &contest.preference)[other];
            let missing = wanted[other] - number;
            if intervals_rad[other].is_some_and(|(from, to)| outside(number, from, to) > 0.0) {
                for turn in [missing, -missing] {
                    let freedom = super::closed_form::Freedom { wrist_rad: freedom.wrist_rad + turn, ..freedom };
                    if let Ok(shifted) = self.inverse_with(&branches.base_t_flange, &freedom, near) {
                        shifted.iter().for_each(|solution| contest.enter(solution));
                    }
                }
            }
        }
    }
}

/// The best so far.
struct Contest<'a> {
    controller: &'a Controller,
    wish: &'a Wish,
    preference: Preference,
    straight: f64,
    best: Option<Entry>,
    nearest_limit: Option<(f64, LimitViolation)>,
}

struct Entry {
    choice: Choice,
    distance: f64,
}

impl Entry {
    fn beats(&self, other: &Entry) -> bool {
        let counted = |entry: &Entry| {
            let violation = entry.choice.wish_violation_rad;
            if violation < ROUNDING_RAD { 0.0 } else { violation }
        };
        (counted(self), self.distance) < (counted(other), other.distance)
    }
}

impl Contest<'_> {
    /// Enters all, the one whose posture is wished for first: next to it most others need no closer look.
    fn enter_all(&mut self, branches: &Branches<Stance>) {
        let mut likeliest = (f64::INFINITY, 0);
        for (index, stance) in branches.iter().enumerate() {
            let mismatch = self.posture_violation_rad(stance);
            if mismatch < likeliest.0 {
                likeliest = (mismatch, index);
            }
        }
        branches.iter().skip(likeliest.1).take(1).for_each(|stance| self.enter(stance));
        let others = branches.iter().enumerate().filter(|&(index, _)| index != likeliest.1);
        others.for_each(|(_, stance)| self.enter(stance));
    }

    fn enter(&mut self, solution: &Stance) {
        let by_posture = self.posture_violation_rad(solution);
        let is_beaten = |best: &Entry| by_posture >= ROUNDING_RAD && by_posture > best.choice.wish_violation_rad;
        if self.best.as_ref().is_some_and(is_beaten) {
            return;
        }
        let numbers_rad = self.controller.place(&solution.actuators_rad, &self.preference);
        if let Some(violation) = self.controller.robot().limit_violation(&numbers_rad, LIMIT_SLACK_RAD) {
            let over = outside(violation.value_rad, violation.min_rad, violation.max_rad);
            if self.nearest_limit.is_none_or(|(least, _)| over < least) {
                self.nearest_limit = Some((over, violation));
            }
            return;
        }
        let singular = solution.singularity.wrist_sin < self.straight;
        let choice = Choice {
            numbers_rad,
            posture: solution.posture,
            singularity: solution.singularity,
            singular,
            wish_violation_rad: by_posture + self.beside_intervals_rad(&numbers_rad),
        };
        let apart = numbers_rad.iter().zip(&self.preference.near_rad).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let entry = Entry { choice, distance: apart };
        if self.best.as_ref().is_none_or(|best| entry.beats(best)) {
            self.best = Some(entry);
        }
    }

    fn beside_intervals_rad(&self, numbers_rad: &[f64; DOF]) -> f64 {
        let intervals = numbers_rad.iter().zip(&self.wish.intervals_rad);
        intervals.filter_map(|(&q, interval)| interval.map(|(from, to)| outside(q, from, to))).sum()
    }

    fn posture_violation_rad(&self, solution: &Stance) -> f64 {
        let Singularity { shoulder_m, elbow_sin, wrist_sin } = solution.singularity;
        let mismatch = |wished: Option<bool>, is: bool, margin: f64| {
            if wished.is_some_and(|wished| wished != is) { PI * (margin / CLEARLY).min(1.0) } else { 0.0 }
        };
        mismatch(self.wish.rear, solution.posture.rear, shoulder_m / self.controller.size_m())
            + mismatch(self.wish.elbow_down, solution.posture.elbow_down, elbow_sin)
            + mismatch(self.wish.wrist_negative, solution.posture.wrist_negative, wrist_sin)
    }

    fn result(self) -> Result<Choice, NoSolution> {
        match (self.best, self.nearest_limit) {
            (Some(entry), _) => Ok(entry.choice),
            (None, Some((_, violation))) => Err(NoSolution::JointLimit(violation)),
            (None, None) => Err(NoSolution::LoopOpen),
        }
    }
}

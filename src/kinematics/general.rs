//! Branches of arms without a closed form, collected from many starts.

use nalgebra::Vector3;

use crate::geometry::pose::Pose;
use crate::model::robot::DOF;

use super::closed_form::Freedom;
use super::controller::{Controller, NEARLY};
use super::numeric::{Ended, follow, spread_starts};
use super::solution::{Branches, MOST_BRANCHES, NoSolution, Stance};
use super::turn::Turn;

/// Starts for an arm that is near to no family.
const STARTS: u32 = 400;
/// Row angles nearer together than this are one solution, rad.
const SAME_RAD: f64 = 1e-5;

impl Controller {
    /// Iteration from the branches of the nearest arms with a closed form, then from starts all over.
    pub(super) fn iterate(
        &self,
        base_t_flange: &Pose,
        freedom: &Freedom,
        near_rad: Option<&[f64; DOF]>,
        branches: &mut Branches<Stance>,
    ) -> Result<(), NoSolution> {
        let mut found = Found { theta_rad: [[0.0; DOF]; MOST_BRANCHES], count: 0, missed_m: f64::MAX };
        let mut from = |start: &[f64; DOF]| {
            found.add(&follow(&self.rows, &self.still, base_t_flange, start, self.size_m));
            found.count
        };
        if let Some(near) = near_rad
            && let Ok((_, angles)) = self.chain(near)
        {
            from(&angles.theta_rad);
        }
        let mut complete = false;
        for form in self.nearly.iter().flatten() {
            let Ok(roots) = form.solve(base_t_flange, freedom) else { continue };
            let mut count = 0;
            for root in roots.found.iter().flatten() {
                count = from(&root.theta_rad);
            }
            complete |= form.misfit < NEARLY && count > 0;
        }
        if !complete {
            spread_starts(STARTS).for_each(|start| {
                from(&start);
            });
        }
        for theta in found.theta_rad.iter().take(found.count) {
            self.push_found(theta, branches);
        }
        if found.count == 0 { Err(NoSolution::OutOfReach { by_m: found.missed_m }) } else { Ok(()) }
    }

    fn push_found(&self, theta_rad: &[f64; DOF], branches: &mut Branches<Stance>) {
        let chain = self.rows.at(theta_rad, &self.still);
        let axis = |joint: usize| chain.axes[joint].direction;
        let center = chain.frames[3].transform_point(&self.center_in_fourth);
        let swung = Turn::by(-theta_rad[0]).rotate(&axis(0), &(center - chain.axes[0].origin));
        let [shoulder, elbow] = [chain.axes[1].origin, chain.axes[2].origin];
        let carried = if self.wrist_axis == 1 { chain.axes[3].origin } else { center };
        let flat = |vector: Vector3<f64>| vector - axis(1) * axis(1).dot(&vector);
        let (lower, upper) = (flat(elbow - shoulder), flat(carried - elbow));
        let bend_sin = axis(1).dot(&lower.cross(&upper)) / (lower.norm() * upper.norm()).max(1e-12);
        let opening_sin = axis(self.wrist_axis).cross(&axis(5)).norm();
        let (posture, singularity) = self.frame.read(&swung, bend_sin, theta_rad[4], opening_sin);
        if let Ok(actuators_rad) = self.actuators(theta_rad) {
            branches.push(Stance { actuators_rad, posture, singularity });
        }
    }
}

/// Distinct row angles that the iteration reached.
struct Found {
    theta_rad: [[f64; DOF]; MOST_BRANCHES],
    count: usize,
    missed_m: f64,
}

impl Found {
    fn add(&mut self, ended: &Ended) {
        if !ended.reached() {
            self.missed_m = self.missed_m.min(ended.position_m);
            return;
        }
        let half_turn_apart = |a: f64, b: f64| (0.5 * (a - b)).sin().abs();
        let known = |theta: &[f64; DOF]| {
            theta.iter().zip(&ended.theta_rad).all(|(&a, &b)| half_turn_apart(a, b) < 0.5 * SAME_RAD)
        };
        if !self.theta_rad.iter().take(self.count).any(known)
            && let Some(place) = self.theta_rad.get_mut(self.count)
        {
            *place = ended.theta_rad;
            self.count += 1;
        }
    }
}

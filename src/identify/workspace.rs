//! Poses all over what the joints allow.

use std::f64::consts::PI;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::model::robot::{DOF, Robot};

/// Poses drawn evenly over the joint ranges, within half a turn to either side, in the controller's numbers, rad. Fewer
/// than `count` where hardly any pose keeps the passive limits of a parallelogram. Deterministic for a seed.
pub fn random_poses(robot: &Robot, count: usize, seed: u64) -> Vec<[f64; DOF]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut poses = Vec::new();
    for _ in 0..100 * count {
        if poses.len() == count {
            break;
        }
        let numbers_rad: [f64; DOF] = std::array::from_fn(|joint| {
            let limits = &robot.joints[joint];
            let (low, high) = (limits.min_rad.max(-PI), limits.max_rad.min(PI));
            low + (high - low) * random.random::<f64>()
        });
        if robot.limit_violation(&numbers_rad, 0.0).is_none() {
            poses.push(numbers_rad);
        }
    }
    poses
}

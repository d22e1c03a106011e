//! The arm from the side, for a picture: where its joints stand in a vertical plane.

use nalgebra::Vector3;

use crate::identify::estimate::Estimate;

/// Points of the arm in the plane of the picture, m: along the floor and up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sketch {
    /// The foot.
    pub foot: [f64; 2],
    /// A marker for each joint.
    pub joints: Vec<[f64; 2]>,
    /// The flange.
    pub flange: [f64; 2],
    /// The measured point.
    pub tool: [f64; 2],
}

/// Joints nearer than this share of the reach to another one would be drawn on top of it.
const ON_TOP: f64 = 0.1;
/// Such a joint is drawn at this share of the way to the next one: its axis runs there, or its housing.
const ON_THE_WAY: f64 = 0.45;

/// Draws the arm in the recorded pose that shows most of its length from the side.
pub fn sketch(estimate: &Estimate<'_>) -> Option<Sketch> {
    let model = &estimate.fit.state.model;
    let prepared = model.prepared();
    let up = -model.robot.gravity_m_s2.try_normalize(1e-9)?;
    let mut best: Option<(f64, Sketch)> = None;
    for record in &estimate.problem.records {
        let Ok(state) = prepared.at(&record.observation.numbers_rad, &record.observation.conditions, None) else {
            continue;
        };
        let flange = state.chain.flange();
        let tool = flange.transform_point(&prepared.flange_t_tool().translation);
        let origins: Vec<Vector3<f64>> = state.chain.axes.iter().map(|axis| axis.origin).collect();
        let across = flange.translation - up * up.dot(&flange.translation);
        let Some(ahead) = across.try_normalize(1e-6) else { continue };
        let flat = |point: &Vector3<f64>| [ahead.dot(point), up.dot(point)];
        let flat_joints =
            spread_out([0.0, 0.0], &origins.iter().map(flat).collect::<Vec<_>>(), flat(&flange.translation));
        let drawn =
            Sketch { foot: [0.0, 0.0], joints: flat_joints, flange: flat(&flange.translation), tool: flat(&tool) };
        let seen = length(&drawn);
        if best.as_ref().is_none_or(|(most, _)| seen > *most) {
            best = Some((seen, drawn));
        }
    }
    best.map(|(_, sketch)| sketch)
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Seen length, less what folds back on itself: a stretched, bent arm reads best.
fn length(sketch: &Sketch) -> f64 {
    let mut line = vec![sketch.foot];
    line.extend(&sketch.joints);
    line.extend([sketch.flange, sketch.tool]);
    let along: f64 = line.windows(2).map(|pair| distance(&pair[0], &pair[1])).sum();
    let smallest = |axis: usize| line.iter().map(|point| point[axis]).fold(f64::INFINITY, f64::min);
    let largest = |axis: usize| line.iter().map(|point| point[axis]).fold(f64::NEG_INFINITY, f64::max);
    along + (largest(0) - smallest(0)) + (largest(1) - smallest(1))
}

/// Moves joints that would be drawn on top of the foot or of another joint on towards the next that would not.
fn spread_out(foot: [f64; 2], joints: &[[f64; 2]], flange: [f64; 2]) -> Vec<[f64; 2]> {
    let line: Vec<[f64; 2]> = [foot].into_iter().chain(joints.iter().copied()).chain([flange]).collect();
    let near = ON_TOP * line.windows(2).map(|pair| distance(&pair[0], &pair[1])).sum::<f64>();
    let mut drawn = vec![foot];
    for (index, joint) in joints.iter().enumerate() {
        let covered = drawn.iter().any(|other| distance(other, joint) < near);
        let next = joints[index + 1..].iter().find(|other| distance(other, joint) > near);
        drawn.push(match (covered, next) {
            (true, Some(next)) => std::array::from_fn(|axis| joint[axis] + ON_THE_WAY * (next[axis] - joint[axis])),
            // The last axis ends in the flange.
            (true, None) => flange,
            (false, _) => *joint,
        });
    }
    drawn.split_off(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_that_share_a_place_are_drawn_apart() {
        let joints = [[0.0, 0.0], [0.1, 1.0], [0.1, 2.0], [0.2, 2.0], [1.2, 2.0], [1.2, 2.0]];
        let drawn = spread_out([0.0, 0.0], &joints, [1.4, 2.0]);
        assert!((drawn[0][0] - 0.045).abs() < 1e-12 && (drawn[0][1] - 0.45).abs() < 1e-12, "{drawn:?}");
        assert!((drawn[3][0] - 0.65).abs() < 1e-12);
        assert_eq!(drawn[5], [1.4, 2.0]);
        for (index, joint) in drawn.iter().enumerate() {
            assert!(drawn[..index].iter().all(|other| distance(other, joint) > 0.1), "{drawn:?}");
        }
    }
}

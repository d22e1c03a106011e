//! Base and tool in closed form: where a fit starts when a robot file does not say where the robot stands.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::geometry::pose::{Pose, rotation_from_vector, skew};

/// A base, a tool point, and how well they place the nominal arm on the measurements.
#[derive(Clone, Debug)]
pub struct Placement {
    /// `measuring_T_base`.
    pub measuring_t_base: Pose,
    /// The tool point in the flange, m.
    pub tool_m: Vector3<f64>,
    /// Distance of every measurement from where the nominal arm puts it, m.
    pub misfit_m: Vec<f64>,
    /// Their median, m: typical, whatever a few gross errors do.
    pub typical_misfit_m: f64,
}

/// Whether the measuring frame may be left-handed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Handedness {
    /// A proper rotation.
    Right,
    /// A rotation with one axis reversed.
    Left,
}

/// Part of the records that a placement trusts while it looks for gross errors.
const TRUSTED_PART: f64 = 0.75;
/// Rounds of sorting out the worst.
const ROUNDS: usize = 6;
/// Rounds of base and tool in turn, to come near enough for the joint refinement.
const ALTERNATIONS: usize = 25;
/// Steps of the joint refinement of base and tool.
const REFINEMENTS: usize = 12;

/// Places the nominal flange poses (`base_T_flange`) on measured points.
///
/// With `tool_m` known: rigid registration (Kabsch 1976; Umeyama 1991). Unknown: registration and mean of the tool
/// point in turn, then Gauss-Newton on the nine numbers. Trimmed: each round keeps the best three quarters.
///
/// `None` for fewer than four points, or numbers that are not finite.
pub fn place(
    flanges: &[Pose],
    points_m: &[Vector3<f64>],
    tool_m: Option<Vector3<f64>>,
    handedness: Handedness,
) -> Option<Placement> {
    let count = flanges.len().min(points_m.len());
    if count < 4 {
        return None;
    }
    let mut kept: Vec<usize> = (0..count).collect();
    let mut placed = None;
    for _ in 0..ROUNDS {
        let chosen_flanges: Vec<Pose> = kept.iter().map(|&index| flanges[index]).collect();
        let chosen_points: Vec<Vector3<f64>> = kept.iter().map(|&index| points_m[index]).collect();
        let (base, tool) = place_all(&chosen_flanges, &chosen_points, tool_m, handedness)?;
        let misfit_m: Vec<f64> = flanges
            .iter()
            .zip(points_m)
            .map(|(flange, point)| (base.transform_point(&flange.transform_point(&tool)) - point).norm())
            .collect();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| misfit_m[a].total_cmp(&misfit_m[b]));
        let typical_misfit_m = misfit_m[order[count / 2]];
        let keep = ((count as f64 * TRUSTED_PART).ceil() as usize).max(4).min(count);
        let mut best = order[..keep].to_vec();
        best.sort_unstable();
        let settled = best == kept;
        kept = best;
        placed = Some(Placement { measuring_t_base: base, tool_m: tool, misfit_m, typical_misfit_m });
        if settled {
            break;
        }
    }
    placed.filter(|placement| placement.typical_misfit_m.is_finite())
}

fn place_all(
    flanges: &[Pose],
    points_m: &[Vector3<f64>],
    tool_m: Option<Vector3<f64>>,
    handedness: Handedness,
) -> Option<(Pose, Vector3<f64>)> {
    let register = |tool: &Vector3<f64>| {
        let body: Vec<Vector3<f64>> = flanges.iter().map(|flange| flange.transform_point(tool)).collect();
        registration(&body, points_m, handedness)
    };
    if let Some(tool) = tool_m {
        return Some((register(&tool)?, tool));
    }
    let mut tool = Vector3::zeros();
    let mut base = register(&tool)?;
    for _ in 0..ALTERNATIONS {
        let into_base = base.inverse();
        let sum: Vector3<f64> = flanges
            .iter()
            .zip(points_m)
            .map(|(flange, point)| flange.inverse().transform_point(&into_base.transform_point(point)))
            .sum();
        tool = sum / flanges.len() as f64;
        base = register(&tool)?;
    }
    Some(refine(base, tool, flanges, points_m))
}

/// `measuring_T_base` that carries `body` onto `seen` with least squares: Kabsch's solution by SVD.
///
/// For [`Handedness::Left`] the rotation has determinant -1. `None` when numbers are not finite.
pub fn registration(body: &[Vector3<f64>], seen: &[Vector3<f64>], handedness: Handedness) -> Option<Pose> {
    let count = body.len().min(seen.len());
    if count == 0 {
        return None;
    }
    let mean = |points: &[Vector3<f64>]| points.iter().take(count).sum::<Vector3<f64>>() / count as f64;
    let (body_mean, seen_mean) = (mean(body), mean(seen));
    let covariance: Matrix3<f64> =
        body.iter().zip(seen).map(|(body, seen)| (seen - seen_mean) * (body - body_mean).transpose()).sum();
    if !covariance.iter().all(|number| number.is_finite()) {
        return None;
    }
    let svd = covariance.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    let wanted = if handedness == Handedness::Right { 1.0 } else { -1.0 };
    let sign = (u * v_t).determinant() * wanted;
    // Singular values come sorted, so the last direction is the one to turn round at least cost.
    let rotation = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign.signum())) * v_t;
    Some(Pose { rotation, translation: seen_mean - rotation * body_mean })
}

/// Gauss-Newton on turn and shift of the base and on the tool point, together.
fn refine(mut base: Pose, mut tool: Vector3<f64>, flanges: &[Pose], points_m: &[Vector3<f64>]) -> (Pose, Vector3<f64>) {
    for _ in 0..REFINEMENTS {
        let mut jacobian = DMatrix::zeros(3 * flanges.len(), 9);
        let mut right = DVector::zeros(3 * flanges.len());
        for (index, (flange, point)) in flanges.iter().zip(points_m).enumerate() {
            let arm = base.rotation * flange.transform_point(&tool);
            let rows = 3 * index;
            jacobian.fixed_view_mut::<3, 3>(rows, 0).copy_from(&(-skew(&arm)));
            jacobian.fixed_view_mut::<3, 3>(rows, 3).copy_from(&Matrix3::identity());
            jacobian.fixed_view_mut::<3, 3>(rows, 6).copy_from(&(base.rotation * flange.rotation));
            right.fixed_rows_mut::<3>(rows).copy_from(&(point - arm - base.translation));
        }
        // Orientations that hardly change leave part of the tool to the base: the smallest such step.
        let qr = jacobian.qr();
        qr.q_tr_mul(&mut right);
        let svd = qr.r().svd(true, true);
        let small = 1e-9 * svd.singular_values.amax();
        let Ok(step) = svd.solve(&right.rows(0, 9).into_owned(), small) else { break };
        let turn = rotation_from_vector(&Vector3::new(step[0], step[1], step[2]));
        base = Pose {
            rotation: turn * base.rotation,
            translation: base.translation + Vector3::new(step[3], step[4], step[5]),
        };
        tool += Vector3::new(step[6], step[7], step[8]);
        if step.norm() < 1e-12 {
            break;
        }
    }
    (base, tool)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::arm::ArmModel;
    use crate::model::conditions::Conditions;
    use crate::model::fixture;
    use crate::model::robot::Convention;

    fn scene() -> (Vec<Pose>, Pose, Vector3<f64>, Vec<Vector3<f64>>) {
        let model = ArmModel::controller(fixture::bare(Convention::Standard, &fixture::LOOPED));
        let prepared = model.prepared();
        let flanges: Vec<Pose> = (0..40)
            .map(|index| {
                let numbers = std::array::from_fn(|joint| ((index * (joint + 3)) as f64 * 0.71).sin());
                prepared.at(&numbers, &Conditions::default(), None).expect("a pose").base_t_flange
            })
            .collect();
        let base = Pose {
            rotation: rotation_from_vector(&Vector3::new(0.4, -1.9, 0.8)),
            translation: Vector3::new(3.0, -2.0, 0.5),
        };
        let tool = Vector3::new(0.12, -0.06, 0.32);
        let points =
            flanges.iter().map(|flange| base.transform_point(&flange.transform_point(&tool))).collect::<Vec<_>>();
        (flanges, base, tool, points)
    }

    #[test]
    fn base_and_tool_are_found_from_scratch() {
        let (flanges, base, tool, points) = scene();
        let found = place(&flanges, &points, None, Handedness::Right).expect("a placement");
        assert!((found.tool_m - tool).norm() < 1e-9, "{}", found.tool_m);
        assert!((found.measuring_t_base.rotation - base.rotation).norm() < 1e-9);
        assert!((found.measuring_t_base.translation - base.translation).norm() < 1e-9);
        assert!(found.typical_misfit_m < 1e-9);
    }

    #[test]
    fn gross_errors_do_not_pull() {
        let (flanges, base, tool, mut points) = scene();
        for index in [3, 17, 29, 38] {
            points[index] += Vector3::new(0.8, -0.3, 0.5);
        }
        let found = place(&flanges, &points, Some(tool), Handedness::Right).expect("a placement");
        assert!((found.measuring_t_base.translation - base.translation).norm() < 1e-9);
        assert!(found.misfit_m[3] > 0.9);
    }

    #[test]
    fn a_mirrored_frame_fits_only_mirrored() {
        let (flanges, _, tool, points) = scene();
        let mirrored: Vec<Vector3<f64>> = points.iter().map(|point| Vector3::new(point.y, point.x, point.z)).collect();
        let right = place(&flanges, &mirrored, Some(tool), Handedness::Right).expect("a placement");
        let left = place(&flanges, &mirrored, Some(tool), Handedness::Left).expect("a placement");
        assert!(left.typical_misfit_m < 1e-9 && right.typical_misfit_m > 0.1);
    }
}

//! How large a concealed cause is: its trace in the record after everything that geometry and the known compliances can
//! take up has been projected out.

use falsetarget::model::robot::DOF;
use nalgebra::{DVector, Vector3};

use crate::arm::{Arm, BODIES, Shape};
use crate::cause::Cause;
use crate::motion::Moment;
use crate::real::Real;

/// The space of what a refit can take up, orthonormal.
pub struct Nuisance(Vec<DVector<f64>>);

/// Columns that keep less than this of their length add no direction.
const INDEPENDENT: f64 = 1e-6;

impl Nuisance {
    /// Six numbers of every body, rods, the measured point, and the drives that the file knows to be soft.
    pub fn of(arm: &Arm, moments: &[Moment]) -> Option<Self> {
        let bare = Real::new(arm, &[]);
        let mut columns: Vec<Vec<Vector3<f64>>> = vec![Vec::new(); 6 * BODIES + DOF + 2];
        for moment in moments {
            let drives = arm.drives(&moment.numbers);
            let (torques, stand) = bare.loaded(moment)?;
            let mut rates = Vec::with_capacity(columns.len());
            for body in 0..BODIES {
                let end = if body == 0 { stand.foot } else { stand.ends[body - 1] };
                let lever = stand.point - end.translation.vector;
                for axis in 0..3 {
                    let direction = end.rotation * Vector3::ith(axis, 1.0);
                    rates.push(direction);
                    rates.push(direction.cross(&lever));
                }
            }
            let shape = Shape::default();
            for joint in 0..DOF {
                let step = 1e-5;
                let mut turned = drives;
                turned[joint] += step;
                let soft = if arm.compliance[joint] > 0.0 { torques[joint] } else { 0.0 };
                rates.push((arm.stand(&turned, &shape)?.point - stand.point) * (soft / step));
            }
            for rod in 0..2 {
                let mut other = arm.clone();
                let step = 1e-6;
                match (&mut other.rods, rod) {
                    (Some(rods), 0) => rods.crank += step,
                    (Some(rods), _) => rods.coupler += step,
                    (None, _) => {}
                }
                rates.push((other.stand(&drives, &shape)?.point - stand.point) / step);
            }
            columns.iter_mut().zip(rates).for_each(|(column, rate)| column.push(rate));
        }
        Some(Self(orthonormal(columns.into_iter().map(|column| stacked(&column)).collect())))
    }

    /// What is left of a trace.
    pub fn clear(&self, trace: &[Vector3<f64>]) -> DVector<f64> {
        let mut left = stacked(trace);
        for _ in 0..2 {
            for direction in &self.0 {
                let along = direction.dot(&left);
                left.axpy(-along, direction, 1.0);
            }
        }
        left
    }
}

fn stacked(vectors: &[Vector3<f64>]) -> DVector<f64> {
    DVector::from_iterator(3 * vectors.len(), vectors.iter().flat_map(|vector| vector.iter().copied()))
}

/// Gram and Schmidt, the longest first, twice over.
fn orthonormal(columns: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
    let mut rest: Vec<(DVector<f64>, f64)> = columns
        .into_iter()
        .filter_map(|column| {
            let length = column.norm();
            (length > 0.0).then(|| (column / length, 1.0))
        })
        .collect();
    let mut directions: Vec<DVector<f64>> = Vec::new();
    loop {
        let longest = rest.iter().enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1)).map(|(index, _)| index);
        let Some(index) = longest.filter(|&index| rest[index].1 > INDEPENDENT) else { return directions };
        let (mut next, _) = rest.swap_remove(index);
        for direction in &directions {
            let along = direction.dot(&next);
            next.axpy(-along, direction, 1.0);
        }
        let length = next.norm();
        if length <= INDEPENDENT {
            continue;
        }
        next /= length;
        for (other, left) in &mut rest {
            let along = next.dot(other);
            other.axpy(-along, &next, 1.0);
            *left = other.norm();
        }
        directions.push(next);
    }
}

/// A cause at the size that leaves this trace per axis, m; and the trace that it really leaves.
pub fn sized(
    arm: &Arm,
    cause: &Cause,
    sizes: (f64, f64),
    wanted_m: f64,
    moments: &[Moment],
    nuisance: &Nuisance,
) -> Option<(f64, f64)> {
    let bare: Vec<Vector3<f64>> =
        moments.iter().map(|moment| Real::new(arm, &[]).point(moment)).collect::<Option<_>>()?;
    let left = |size: f64| -> Option<f64> {
        let real = Real::new(arm, &[(cause.clone(), size)]);
        let trace: Vec<Vector3<f64>> =
            moments.iter().zip(&bare).map(|(moment, bare)| Some(real.point(moment)? - bare)).collect::<Option<_>>()?;
        Some(nuisance.clear(&trace).norm() / (3.0 * moments.len() as f64).sqrt())
    };
    let (mut size, most) = sizes;
    let mut trace = left(size)?;
    for _ in 0..4 {
        if (trace / wanted_m - 1.0).abs() < 0.01 || trace <= 0.0 {
            break;
        }
        let next = (size * wanted_m / trace).min(most);
        if next == size {
            break;
        }
        size = next;
        trace = left(size)?;
    }
    Some((size, trace))
}

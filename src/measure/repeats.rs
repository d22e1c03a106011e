//! Poses that were measured more than once: what they scatter is pure error, whatever the model.

use nalgebra::Vector3;

use super::observation::Observation;

/// Scatter about the means of repeated poses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PureError {
    /// Standard deviation per axis, m.
    pub sigma_m: f64,
    /// Degrees of freedom: coordinates beyond the means.
    pub freedom: usize,
}

/// Two kinds of pure error. Their ratio shows what depends on the sense of approach, without any model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Repeatability {
    /// Repeats that came the same way (every joint's last motion in the same sense).
    pub same_approach: Option<PureError>,
    /// Repeats whatever the way.
    pub any_approach: Option<PureError>,
}

/// Joint numbers closer than this are the same pose, rad: 0.002 deg, well below what moves the tool by its noise.
const SAME_POSE_RAD: f64 = 3.5e-5;

/// Finds repeated poses and their scatter. Exact copies of a row are no repeats: see [`copies`].
pub fn repeatability(observations: &[&Observation]) -> Repeatability {
    let copied: std::collections::BTreeSet<usize> = copies(observations).into_iter().map(|(copy, _)| copy).collect();
    let kept: Vec<&Observation> = observations
        .iter()
        .enumerate()
        .filter(|(index, record)| record.measured.is_some() && !copied.contains(index))
        .map(|(_, record)| *record)
        .collect();
    let same_pose = |a: &Observation, b: &Observation| {
        a.station == b.station
            && a.conditions.payload == b.conditions.payload
            && a.numbers_rad.iter().zip(&b.numbers_rad).all(|(x, y)| (x - y).abs() < SAME_POSE_RAD)
    };
    let same_way = |a: &Observation, b: &Observation| same_pose(a, b) && a.conditions.approach == b.conditions.approach;
    Repeatability { same_approach: pooled(&kept, same_way), any_approach: pooled(&kept, same_pose) }
}

/// Records that repeat an earlier one to the last digit of joints and position: `(copy, original)` indices.
///
/// A tracker never gives the same three numbers twice, so such a row was duplicated by a person or a program.
pub fn copies(observations: &[&Observation]) -> Vec<(usize, usize)> {
    let mut seen = std::collections::HashMap::new();
    let mut found = Vec::new();
    for (index, record) in observations.iter().enumerate() {
        let Some(measured) = &record.measured else { continue };
        let key: Vec<u64> =
            record.numbers_rad.iter().chain(measured.position_m.iter()).map(|number| number.to_bits()).collect();
        match seen.entry(key) {
            std::collections::hash_map::Entry::Occupied(original) => found.push((index, *original.get())),
            std::collections::hash_map::Entry::Vacant(place) => {
                place.insert(index);
            }
        }
    }
    found
}

fn pooled(observations: &[&Observation], same: impl Fn(&Observation, &Observation) -> bool) -> Option<PureError> {
    let mut order: Vec<usize> = (0..observations.len()).collect();
    // Sorted by the first joint, equal poses are neighbours up to the tolerance: no search over all pairs.
    order.sort_by(|&a, &b| observations[a].numbers_rad[0].total_cmp(&observations[b].numbers_rad[0]));
    let mut grouped = vec![false; observations.len()];
    let (mut sum, mut freedom) = (0.0, 0);
    for (rank, &first) in order.iter().enumerate() {
        if grouped[first] {
            continue;
        }
        let mut group = vec![first];
        for &other in &order[rank + 1..] {
            if observations[other].numbers_rad[0] - observations[first].numbers_rad[0] > SAME_POSE_RAD {
                break;
            }
            if !grouped[other] && same(observations[first], observations[other]) {
                group.push(other);
            }
        }
        if group.len() < 2 {
            continue;
        }
        let points: Vec<Vector3<f64>> = group
            .iter()
            .filter_map(|&index| observations[index].measured.map(|measured| measured.position_m))
            .collect();
        let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
        sum += points.iter().map(|point| (point - mean).norm_squared()).sum::<f64>();
        freedom += 3 * (points.len() - 1);
        for index in group {
            grouped[index] = true;
        }
    }
    (freedom > 0).then(|| PureError { sigma_m: (sum / freedom as f64).sqrt(), freedom })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fixture::observation;
    use crate::measure::observation::Measured;

    fn record(q1: f64, x_mm: f64, sense: f64) -> Observation {
        let mut record = observation([q1, 0.1, 0.2, 0.3, 0.4, 0.5]);
        record.measured = Some(Measured { position_m: Vector3::new(x_mm * 1e-3, 0.0, 0.0), rotation: None });
        record.conditions.approach[0] = sense;
        record
    }

    #[test]
    fn scatter_is_split_by_the_sense_of_approach() {
        let records = [
            record(0.5, 1.0, 1.0),
            record(0.5, 1.2, 1.0),
            record(0.5, 3.0, -1.0),
            record(0.5, 3.2, -1.0),
            record(0.9, 9.0, 1.0),
        ];
        let records: Vec<&Observation> = records.iter().collect();
        let found = repeatability(&records);
        // Two pairs 0.2 mm apart: sum of squares 2 * 0.02 mm^2 over 6 coordinates beyond the means.
        let same = found.same_approach.expect("repeats");
        assert_eq!(same.freedom, 6);
        assert!((same.sigma_m * 1e3 - (0.04f64 / 6.0).sqrt()).abs() < 1e-12);
        let any = found.any_approach.expect("repeats");
        assert_eq!(any.freedom, 9);
        assert!(any.sigma_m > 4.0 * same.sigma_m);
    }

    #[test]
    fn an_exact_copy_is_no_repeat() {
        let records = [record(0.5, 1.0, 1.0), record(0.5, 1.0, 1.0)];
        let records: Vec<&Observation> = records.iter().collect();
        assert_eq!(copies(&records), [(1, 0)]);
        assert_eq!(repeatability(&records), Repeatability::default());
    }
}

//! Blocked cross-validation: whole regions of joint space are held out, so that neighbours do not flatter.

use crate::identify::split::regions;
use crate::measure::observation::Observation;

/// Parts into which the records are dealt.
pub const FOLDS: usize = 10;
/// Records in a region, about: enough that a record's neighbours are held out with it, few enough that no joint loses a
/// part of its range with them.
const REGION_SIZE: usize = 6;
/// Regions at most.
const MOST_REGIONS: usize = 120;

/// The fold of each record: regions of joint space, dealt out to `count` folds of about equal size. Deterministic.
pub fn folds(observations: &[&Observation], count: usize, seed: u64) -> Vec<usize> {
    let wanted = (observations.len() / REGION_SIZE).clamp(count, MOST_REGIONS);
    let region_of = regions(observations, wanted, seed);
    let found = region_of.iter().max().map_or(0, |largest| largest + 1);
    let mut sizes: Vec<(usize, usize)> =
        (0..found).map(|region| (region, region_of.iter().filter(|&&of| of == region).count())).collect();
    sizes.sort_by_key(|&(region, size)| (std::cmp::Reverse(size), region));
    let mut load = vec![0; count.max(1)];
    let mut fold_of_region = vec![0; found];
    for (region, size) in sizes {
        let lightest = (0..load.len()).min_by_key(|&fold| (load[fold], fold)).unwrap_or(0);
        load[lightest] += size;
        fold_of_region[region] = lightest;
    }
    region_of.into_iter().map(|region| fold_of_region[region]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fixture::observation;

    #[test]
    fn folds_are_of_about_equal_size_and_every_record_has_one() {
        let records: Vec<Observation> = (0..200)
            .map(|index| observation(std::array::from_fn(|joint| ((index * (2 * joint + 3)) as f64 * 0.617).sin())))
            .collect();
        let records: Vec<&Observation> = records.iter().collect();
        let fold_of = folds(&records, 8, 1);
        assert_eq!(fold_of, folds(&records, 8, 1));
        for fold in 0..8 {
            let size = fold_of.iter().filter(|&&of| of == fold).count();
            assert!((15..=35).contains(&size), "{size}");
        }
    }
}

//! Which trials there are.

use crate::cause::{MOVING_KINDS, OUTSIDE_KINDS, STATIC_KINDS};
use crate::dice::Dice;
use crate::trial::{Hardship, Spec};

/// Sizes over the noise at which single causes are tried.
pub const LEVELS: [f64; 3] = [3.0, 1.0, 0.3];

const RECORDS: usize = 240;
const FEW_RECORDS: usize = 60;
const NULLS: [usize; 2] = [160, 40];
const STATIC_SINGLES: usize = 8;
const MOVING_SINGLES: usize = 6;
const SEVERAL: usize = 40;
const HARD_NULLS: usize = 6;
const HARD_SINGLES: usize = 8;
const TOGETHER: usize = 20;
const OUTSIDE: usize = 10;
/// Numbers from one series to the next; those of the short form and of the studies of radii are far above any.
const SERIES: u64 = 10_000;
const FRESH: usize = 96;
const BARE: usize = 48;

/// Every trial of the long form, in an order in which any beginning is a fair sample: the same plan for every series, with
/// arms, causes and noise of its own.
pub fn all(series: u64) -> Vec<Spec> {
    let mut specs = Vec::new();
    for (moving, count) in [(false, NULLS[0]), (true, NULLS[1])] {
        specs.extend((0..count).map(|_| spec("null", moving, Vec::new(), Vec::new())));
    }
    for (kinds, moving, count) in
        [(&STATIC_KINDS[..], false, STATIC_SINGLES), (&MOVING_KINDS[..], true, MOVING_SINGLES)]
    {
        for kind in kinds {
            for level in LEVELS {
                specs.extend((0..count).map(|_| spec("single", moving, vec![(*kind, level)], Vec::new())));
            }
        }
    }
    let mut dice = Dice::new(4);
    for count in 2..=4 {
        for _ in 0..SEVERAL {
            specs.push(spec("several", false, some(count, &mut dice), Vec::new()));
        }
    }
    for (hardship, _) in Hardship::ALL {
        specs.extend((0..HARD_NULLS).map(|_| spec("hard", false, Vec::new(), vec![hardship])));
        for index in 0..HARD_SINGLES {
            let kind = at_stake(hardship, index, &mut dice);
            specs.push(spec("hard", false, vec![(kind, 2.0)], vec![hardship]));
        }
    }
    for index in 0..TOGETHER {
        let mut hardships: Vec<Hardship> =
            Hardship::ALL.iter().map(|(hardship, _)| *hardship).filter(|_| dice.chance(0.25)).collect();
        // Sixty records in a corner of the room hold a dozen numbers, not forty.
        if hardships.contains(&Hardship::FewRecords) {
            hardships.retain(|&hardship| hardship != Hardship::Restricted);
        }
        let wanted = if index.is_multiple_of(2) { Vec::new() } else { some(1, &mut dice) };
        specs.push(spec("together", false, wanted, hardships));
    }
    for kind in OUTSIDE_KINDS {
        specs.extend((0..OUTSIDE).map(|_| spec("outside", false, vec![(kind, 3.0)], Vec::new())));
        for _ in 0..OUTSIDE {
            let mut wanted = some(1, &mut dice);
            wanted.push((kind, 3.0));
            specs.push(spec("outside", false, wanted, Vec::new()));
        }
    }
    for (index, spec) in specs.iter_mut().enumerate() {
        spec.number = SERIES * series + index as u64 + 1;
    }
    // Shuffled (Fisher and Yates): shards and interrupted runs see every group.
    for last in (1..specs.len()).rev() {
        specs.swap(last, dice.below(last + 1));
    }
    specs
}

/// The short form: a handful that any change can afford.
pub fn few() -> Vec<Spec> {
    let mut specs = vec![
        spec("null", false, Vec::new(), Vec::new()),
        spec("single", false, vec![("friction_windup", 3.0)], Vec::new()),
        spec("single", false, vec![("joint_coupling", 3.0)], Vec::new()),
    ];
    for (index, spec) in specs.iter_mut().enumerate() {
        spec.number = 1_000_001 + index as u64;
    }
    specs
}

/// Fresh recordings for `u95_mm`: 60 to 500 records, 0.01 to 0.1 mm of noise, half of them stating it, up to two causes.
pub fn fresh() -> Vec<Spec> {
    let mut dice = Dice::new(29);
    (0..FRESH)
        .map(|index| {
            let mut one = spec("fresh", false, some(index % 3, &mut dice), Vec::new());
            one.number = 5_000_001 + index as u64;
            one.records = *dice.pick(&[60, 100, 160, 240, 360, 500]);
            one.noise_m = Some(1e-5 * 10f64.powf(dice.between(0.0, 1.0)));
            one.noise_stated = dice.chance(0.5);
            one
        })
        .collect()
}

/// Arms with nothing but geometry errors and few records.
pub fn bare() -> Vec<Spec> {
    let mut dice = Dice::new(31);
    (0..BARE)
        .map(|index| {
            let mut one = spec("bare", false, Vec::new(), Vec::new());
            one.number = 6_000_001 + index as u64;
            one.records = [40, 60, 120, 240][index % 4];
            one.noise_m = Some(1e-5 * 10f64.powf(dice.between(0.0, 1.0)));
            one
        })
        .collect()
}

/// A trial without a number.
pub fn spec(group: &'static str, moving: bool, wanted: Vec<(&'static str, f64)>, hardships: Vec<Hardship>) -> Spec {
    let records = if hardships.contains(&Hardship::FewRecords) { FEW_RECORDS } else { RECORDS };
    Spec { number: 0, group, moving, wanted, hardships, records, noise_m: None, noise_stated: false }
}

/// Different kinds at different levels.
fn some(count: usize, dice: &mut Dice) -> Vec<(&'static str, f64)> {
    let mut wanted: Vec<(&'static str, f64)> = Vec::new();
    while wanted.len() < count {
        let kind = *dice.pick(&STATIC_KINDS);
        if wanted.iter().all(|(other, _)| *other != kind) {
            wanted.push((kind, *dice.pick(&[1.0, 1.5, 2.0, 3.0, 5.0])));
        }
    }
    wanted
}

/// Kinds that a hardship makes hard, and any others in turn.
fn at_stake(hardship: Hardship, index: usize, dice: &mut Dice) -> &'static str {
    let kinds: &[&str] = match hardship {
        Hardship::NoDir | Hardship::Quantised | Hardship::Unsettled => &["backlash", "friction_windup"],
        Hardship::NoTime | Hardship::MovedStation => &["drift", "step_shift"],
        Hardship::NoTemperature => &["thermal_growth"],
        Hardship::Masses | Hardship::Compliances => &["joint_compliance", "joint_stiffening", "gravity_tilt"],
        _ => &STATIC_KINDS,
    };
    let kind = if index.is_multiple_of(2) { *dice.pick(kinds) } else { *dice.pick(&STATIC_KINDS) };
    STATIC_KINDS.iter().find(|known| **known == kind).copied().unwrap_or("backlash")
}

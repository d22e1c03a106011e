//! What to measure next, to settle what a recording leaves open.

use crate::identify::problem::{NoPose, Problem};
use crate::measure::recording::Kind;
use crate::model::effect::Location;
use crate::model::robot::DOF;

use super::detection::smallest_line_rad;
use super::diagnosis::{Diagnosis, Finding, Rival};
use super::free::Seat;
use super::regressors::Regressors;

/// A measurement to make.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// What it would settle.
    pub why: String,
    /// What to do.
    pub what: String,
}

/// Uncertainty of a number, in parts of it, beyond which it is worth measuring better.
const VAGUE: f64 = 0.25;
/// Records that are named for a repetition.
const NAMED_RECORDS: usize = 5;
/// Levers shorter than this part of the longest show nothing of a joint.
const NO_LEVER: f64 = 1e-3;

/// What to measure next, the most urgent first.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn next_measurements(diagnosis: &Diagnosis<'_>) -> Result<Vec<Advice>, NoPose> {
    let problem = &diagnosis.estimate.problem;
    let regressors = Regressors::new(problem, &diagnosis.estimate.fit.state)?;
    let levers = Levers::new(&regressors);
    let mut all: Vec<Advice> = Vec::new();
    for finding in &diagnosis.findings {
        all.extend(between_rivals(finding, problem, &levers));
        all.extend(sharper(finding, problem, &levers));
    }
    all.extend(without_name(diagnosis));
    all.extend(not_recorded(diagnosis));
    all.extend(below_the_limit(diagnosis, &levers));
    Ok(all)
}

/// How long the levers of each joint are, in standard deviations of the noise per rad.
struct Levers {
    /// Root of the sum of squares over all coordinates.
    in_all: [f64; DOF],
    /// Records, the longest lever first.
    longest: [Vec<usize>; DOF],
}

impl Levers {
    fn new(regressors: &Regressors<'_, '_>) -> Self {
        let squares = |joint: usize| {
            let mut of_record = vec![0.0; regressors.stands.len()];
            for (row, &record) in regressors.record_of.iter().enumerate() {
                of_record[record] += regressors.joints[(row, joint)].powi(2);
            }
            of_record
        };
        let squares: [Vec<f64>; DOF] = std::array::from_fn(squares);
        let longest = |squares: &Vec<f64>| {
            let mut order: Vec<usize> = (0..squares.len()).collect();
            order.sort_by(|&a, &b| squares[b].total_cmp(&squares[a]));
            order
        };
        Self {
            in_all: std::array::from_fn(|joint| squares[joint].iter().sum::<f64>().sqrt()),
            longest: std::array::from_fn(|joint| longest(&squares[joint])),
        }
    }

    /// Joints that move the measured point.
    fn telling(&self) -> impl Iterator<Item = usize> + '_ {
        let longest = self.in_all.iter().copied().fold(0.0, f64::max);
        (0..DOF).filter(move |&joint| self.in_all[joint] > NO_LEVER * longest)
    }
}

/// The records at which a joint shows most, by name.
fn records_for(at: &Location, problem: &Problem<'_>, levers: &Levers) -> String {
    let Some(joint) = at.joint_index() else { return String::new() };
    let names = levers.longest[joint].iter().take(NAMED_RECORDS);
    let names: Vec<&str> = names.map(|&record| problem.records[record].observation.id.as_str()).collect();
    format!(" (records {} have the longest levers)", names.join(", "))
}

/// What tells two orders of a joint apart.
const ANOTHER_ORDER: &str = "turn that joint alone through all of its range, all else still, with eight stops for each repetition: over a \
    longer range two orders drift apart";

/// One measurement for all rivals that it tells from a finding.
fn between_rivals(finding: &Finding, problem: &Problem<'_>, levers: &Levers) -> Vec<Advice> {
    let (name, here) = (finding.instance.effect.meta().id, &finding.instance.location);
    let is_another_order = |rival: &&Rival| rival.effect == name && rival.location.order != here.order;
    let (orders, others): (Vec<&Rival>, Vec<&Rival>) = finding.alternatives.iter().partition(is_another_order);
    let settled = |rivals: Vec<&Rival>, what: String| {
        let names: Vec<String> = rivals.iter().map(|one| format!("{} at the {}", one.effect, one.location)).collect();
        let why = format!("{name} at the {here} and {} explain these records equally well", names.join(", "));
        (!rivals.is_empty()).then_some(Advice { why, what })
    };
    let apart = format!("{}{}", finding.instance.effect.meta().told_apart_by, records_for(here, problem, levers));
    settled(others, apart).into_iter().chain(settled(orders, ANOTHER_ORDER.into())).collect()
}

/// A number that is only vaguely known.
fn sharper(finding: &Finding, problem: &Problem<'_>, levers: &Levers) -> Option<Advice> {
    let size = finding.values.iter().map(|value| value.value.abs()).fold(0.0, f64::max);
    let strongest = finding.values.iter().find(|value| value.value.abs() == size)?;
    let part = strongest.sigma / size.max(f64::MIN_POSITIVE);
    (part > VAGUE).then(|| Advice {
        why: format!(
            "{} of {} at the {} is known to {:.0} % only",
            strongest.name,
            finding.instance.effect.meta().id,
            finding.instance.location,
            100.0 * part
        ),
        what: format!(
            "{} more poses like these{}",
            (problem.records.len() as f64 * (part / (0.5 * VAGUE)).powi(2)).ceil().min(5e3),
            records_for(&finding.instance.location, problem, levers)
        ),
    })
}

fn without_name(diagnosis: &Diagnosis<'_>) -> Option<Advice> {
    let unexplained = diagnosis.unexplained.as_ref()?;
    let variables = unexplained.depends_on().join(" and ");
    let why = format!("structure at the {} follows {variables} and has no name", unexplained.place());
    if unexplained.functions.first().is_some_and(|function| matches!(function.seat, Seat::Tracker(_))) {
        let what = "sight ten of the points in both faces of the tracker, and measure twenty poses again from a station a quarter \
            turn around the robot: what is the tracker's stays with its beam, what is the arm's with the arm";
        return Some(Advice { why, what: what.into() });
    }
    Some(Advice {
        why,
        what: format!(
            "move {variables} alone through the whole range in 40 stops, all else still; once more with no payload and \
             once from the other side"
        ),
    })
}

/// What records do not say, and what that hides.
fn not_recorded(diagnosis: &Diagnosis<'_>) -> Vec<Advice> {
    let records = &diagnosis.estimate.problem.records;
    let some = |told: &dyn Fn(&crate::model::conditions::Conditions) -> bool| {
        records.iter().any(|record| told(&record.observation.conditions))
    };
    let mut all = Vec::new();
    let mut missing = |why: &str, what: &str| all.push(Advice { why: why.into(), what: what.into() });
    if diagnosis.kind == Kind::Static && !some(&|conditions| conditions.approach.iter().any(|sense| *sense != 0.0)) {
        missing(
            "no sense of approach is known: play and wind-up do not show",
            "note from which side each joint came (dir1 to dir6), and come to ten poses from both sides",
        );
    }
    if !some(&|conditions| conditions.temperature_c.is_some()) && !diagnosis.findings.is_empty() {
        let slow = |finding: &Finding| matches!(finding.instance.effect.meta().id, "drift" | "thermal_growth");
        if diagnosis.findings.iter().any(slow) {
            missing(
                "no temperature was recorded: a growing link and a drifting station look alike in time",
                "a sensor on the arm (temp_c), and three control poses every 25 records",
            );
        }
    }
    all
}

/// What is too small for this recording.
fn below_the_limit(diagnosis: &Diagnosis<'_>, levers: &Levers) -> Option<Advice> {
    if diagnosis.kind != Kind::Static {
        return None;
    }
    let rows = diagnosis.estimate.fit.residuals.len();
    let limits: Vec<String> = levers
        .telling()
        .map(|joint| format!("J{} {:.3}", joint + 1, 1e3 * smallest_line_rad(levers.in_all[joint], rows)))
        .collect();
    Some(Advice {
        why: format!(
            "fine errors of gears and encoders below these amplitudes would not show in this recording, mrad: {}",
            limits.join(", ")
        ),
        what:
            "four times as many poses, at angles of no lattice, halve these limits; one joint alone in steps of 0.4 deg over \
               8 deg, all else still, shows what is finer"
                .into(),
    })
}

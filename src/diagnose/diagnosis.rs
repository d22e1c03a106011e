//! The whole way from a recording to a diagnosis.

use nalgebra::DVector;
use serde::Serialize;

use crate::identify::calibrate::Refusal;
use crate::identify::estimate::Estimate;
use crate::identify::identify::{Identified, deviations, of_one_joint};
use crate::identify::problem::{NoPose, Problem};
use crate::identify::report::Figures;
use crate::identify::robust;
use crate::identify::stated::{doubting, refitted, trusting};
use crate::measure::recording::{Kind, Recording};
use crate::model::arm::{ArmModel, EffectInstance};
use crate::model::effect::{Location, by_id};

use super::advice::{Advice, next_measurements};
use super::baseline::{Baseline, baseline};
use super::curve_search::with_curves;
use super::evidence;
use super::fitted::{Fitted, Ground};
use super::found::Found;
use super::free::{FreeFunction, Seat};
use super::hold_out::{Blocks, held_out_squares_m2, rms_mm};
use super::left_over::left_over;
use super::nameless::{Nameless, nameless};
use super::regressors::Regressors;
use super::ripple::JointRipple;
use super::search::search_from;
use super::stability::stability;

/// The answer in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// What is left is noise.
    NothingMissing,
    /// What was missing has names, and with them only noise is left.
    Explained,
    /// Something was found, and something without a name is left.
    PartlyExplained,
    /// There is structure, and no name fits it.
    Unexplained,
}

/// Distances before or after, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Of the fit.
    pub fitted: Figures,
    /// Of records held out, root mean square, mm.
    pub held_out_rms_mm: f64,
}

/// A fitted number of a finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The number.
    pub value: f64,
    /// Its standard uncertainty.
    pub sigma: f64,
}

/// A cause that another recording would have to tell from a finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Rival {
    /// The effect's id.
    pub effect: &'static str,
    /// Its place.
    pub location: Location,
}

/// A missing cause with a name.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The effect at its place.
    pub instance: EffectInstance,
    /// Its numbers.
    pub values: Vec<Value>,
    /// Held-out root mean square without and with it, all others modelled, mm.
    pub held_out_rms_mm: [f64; 2],
    /// Probability of as large a gain by chance, everything that was looked at counted.
    pub p_value: f64,
    /// Part of random halves of the records that would have shown it; `None` where that was not asked (curves).
    pub stability: Option<f64>,
    /// Part of the error before, in squares, that it explains.
    pub share: f64,
    /// Those that this recording cannot tell from it.
    pub alternatives: Vec<Rival>,
    /// Between which orders that of a periodic error lies with 95 %.
    pub order_95: Option<[f64; 2]>,
}

/// Structure without a name.
#[derive(Clone, Debug)]
pub struct Unexplained {
    /// Its size, root mean square distance, mm.
    pub rms_mm: f64,
    /// Probability of as much by chance.
    pub p_value: f64,
    /// Where it sits and what it depends on, the strongest first.
    pub functions: Vec<FreeFunction>,
}

/// What a recording says about a model.
pub struct Diagnosis<'a> {
    /// Standing or moving.
    pub kind: Kind,
    /// Records in the recording.
    pub records: usize,
    /// Standard deviation of the noise per axis, m.
    pub noise_sigma_m: f64,
    /// What the updated model leaves beside it, m.
    pub unexplained_sigma_m: f64,
    /// The model as given, refitted.
    pub before: Errors,
    /// With the findings.
    pub after: Errors,
    /// In a word.
    pub verdict: Verdict,
    /// In order of what they explain.
    pub findings: Vec<Finding>,
    /// What has structure and no name.
    pub unexplained: Option<Unexplained>,
    /// Names of the gross errors.
    pub outliers: Vec<String>,
    /// What to measure next.
    pub next_measurements: Vec<Advice>,
    /// The fit with the findings.
    pub estimate: Estimate<'a>,
    /// What has no name, learned, where that helps.
    pub learned: Option<Nameless<'a>>,
}

/// Residuals of all records over those of the ones that agreed, up to which all of them agree.
const AS_NEAR: f64 = 1.2;
/// Rounds of search and sorting out gross errors.
const ROUNDS: usize = 2;

/// Says what physics a model leaves out.
///
/// # Errors
/// [`Refusal`], as for a calibration: the recording is not of this robot, or too small.
pub fn diagnose<'a>(given: &ArmModel, recordings: &'a [Recording], seed: u64) -> Result<Diagnosis<'a>, Refusal> {
    let kind = Kind::of(recordings);
    let base = baseline(given, recordings, seed)?;
    let Searched { mut found, mut bare, kept } = match explained_crowd(&base, kind, seed)? {
        Some(searched) => searched,
        None => searched(&base, &base.identified.clone()?, kind, seed)?,
    };
    // Now that nothing is missing any more that the stated compliances could stand in for.
    for fitted in [&mut found.fitted, &mut bare] {
        fitted.estimate = trusting(&fitted.estimate)?;
    }
    let outliers = (0..base.problem.records.len())
        .filter(|index| !kept.contains(index))
        .map(|index| base.problem.records[index].observation.id.clone())
        .chain(base.left_out.iter().map(|left| left.id.clone()))
        .collect();
    let before_squares = held_out_m2(&bare, &found.blocks, None);
    let before = errors(&bare.estimate, rms_mm(&before_squares));
    let after_squares = held_out_m2(&found.fitted, &found.blocks, None);
    let after = errors(&found.fitted.estimate, rms_mm(&after_squares));
    let mut findings = findings(&found, after.held_out_rms_mm, seed);
    findings.extend(curves(&found, after.held_out_rms_mm));
    findings.sort_by(|a, b| b.share.total_cmp(&a.share));
    let unexplained = unexplained(&found)?;
    let verdict = match (findings.is_empty(), &unexplained) {
        (true, None) => Verdict::NothingMissing,
        (false, None) => Verdict::Explained,
        (false, Some(_)) => Verdict::PartlyExplained,
        (true, Some(_)) => Verdict::Unexplained,
    };
    let left = left_over(&found, &base)?;
    let learned = nameless(&found, seed)?;
    let mut diagnosis = Diagnosis {
        kind,
        records: recordings.iter().map(|recording| recording.observations.len()).sum(),
        noise_sigma_m: left.noise_sigma_m,
        unexplained_sigma_m: match &learned {
            Some(learned) => left.beyond_noise_m(&learned.estimate.spread),
            None => left.structure_sigma_m,
        },
        before,
        after,
        verdict,
        findings,
        unexplained,
        outliers,
        next_measurements: Vec::new(),
        estimate: found.fitted.estimate,
        learned,
    };
    diagnosis.next_measurements = next_measurements(&diagnosis)?;
    Ok(diagnosis)
}

/// What a search has found, and in which records.
struct Searched<'a> {
    found: Found<'a>,
    /// The fit to the same records without it.
    bare: Fitted<'a>,
    kept: Vec<usize>,
}

/// Searches, sorts out gross errors beside what was found, and searches again.
fn searched<'a>(base: &Baseline<'a>, start: &Identified<'a>, kind: Kind, seed: u64) -> Result<Searched<'a>, NoPose> {
    let mut kept = start.kept.clone();
    let (unknowns, estimate) = match doubting(&base.unknowns, &start.estimate) {
        Some(unknowns) => (unknowns.clone(), refitted(&start.estimate, &unknowns)?),
        None => (base.unknowns.clone(), start.estimate.clone()),
    };
    let mut bare = Fitted::bare(estimate);
    let mut round = 0;
    loop {
        round += 1;
        let ground = Ground {
            problem: base.problem.subset(&kept),
            stated: base.stated,
            state: start.estimate.fit.state.clone(),
            unknowns: unknowns.clone(),
            ripple: None,
        };
        let lines = search_from(&ground, bare.clone(), kind, seed)?;
        let found = match with_curves(&ground, &lines, kind, seed)? {
            Some(curves) => curves,
            None => lines,
        };
        let again = still_good(&base.problem, &found.fitted.estimate, &kept)?;
        if again == kept || round == ROUNDS {
            return Ok(Searched { found, bare, kept });
        }
        kept = again;
        bare = Ground { problem: base.problem.subset(&kept), ..ground }.fit(&[])?;
    }
}

/// A search in all records, where many stand off together (a late step, a second load) and what it finds explains at least
/// half of them: it then leaves the rest as near as those that agreed were to each other.
fn explained_crowd<'a>(base: &Baseline<'a>, kind: Kind, seed: u64) -> Result<Option<Searched<'a>>, NoPose> {
    let Some(crowd) = &base.crowd else { return Ok(None) };
    let all = searched(base, &crowd.all, kind, seed)?;
    let estimate = &all.found.fitted.estimate;
    let apart = base.problem.records.len() - all.kept.len();
    let explains = !all.found.fitted.terms.is_empty()
        && 2 * apart <= crowd.apart
        && estimate.spread.sigma_m <= AS_NEAR * crowd.agreed_sigma_m;
    Ok(explains.then_some(all))
}

/// The records that are no gross errors beside what was found. Many that are off by one and the same joint are physics.
fn still_good(problem: &Problem<'_>, estimate: &Estimate<'_>, kept: &[usize]) -> Result<Vec<usize>, NoPose> {
    let mut in_fit = vec![false; problem.records.len()];
    for &index in kept {
        in_fit[index] = true;
    }
    let limit = robust::limit(problem.records.len());
    let mut good: Vec<bool> =
        deviations(problem, estimate, &in_fit)?.into_iter().map(|deviation| deviation <= limit).collect();
    let far: Vec<usize> = (0..good.len()).filter(|&index| !good[index]).collect();
    for index in of_one_joint(problem, estimate, &far)? {
        good[index] = true;
    }
    Ok((0..good.len()).filter(|&index| good[index]).collect())
}

fn held_out_m2(fitted: &Fitted<'_>, blocks: &Blocks, without: Option<usize>) -> Vec<f64> {
    held_out_squares_m2(&fitted.estimate.problem, blocks, &fitted.projection(without))
}

fn errors(estimate: &Estimate<'_>, held_out_rms_mm: f64) -> Errors {
    let lengths = robust::lengths_of(&estimate.problem, &estimate.fit.residuals);
    let nothing = Figures { records: 0, mean_mm: 0.0, rms_mm: 0.0, std_mm: 0.0, max_mm: 0.0, p95_mm: 0.0 };
    Errors { fitted: Figures::of(&lengths).unwrap_or(nothing), held_out_rms_mm }
}

fn findings(found: &Found<'_>, held_out_rms_mm: f64, seed: u64) -> Vec<Finding> {
    let fitted = &found.fitted;
    // Sums of squares in metres: whitened, the fits with and without have noise levels of their own.
    let sigma_m = fitted.estimate.spread.sigma_m;
    (0..fitted.terms.len())
        .map(|term| {
            let candidate = &fitted.terms[term];
            let review = &found.reviews[term];
            let (values, sigmas) = fitted.values_of(term);
            let squares = held_out_m2(fitted, &found.blocks, Some(term));
            let looked_at = evidence::looked_at(candidate.places);
            let gain = &review.gain;
            let explained_m2 = gain.explained * sigma_m.powi(2);
            Finding {
                instance: candidate.instances[0],
                values: named_values(&candidate.instances, &values, &sigmas),
                held_out_rms_mm: [rms_mm(&squares), held_out_rms_mm],
                p_value: evidence::p_value(gain.explained, gain.rank, review.cost, review.freedom, looked_at),
                stability: Some(stability(fitted, term, seed)),
                share: (explained_m2 / found.bare_m2.max(f64::MIN_POSITIVE)).min(1.0),
                alternatives: review
                    .rivals
                    .iter()
                    .map(|rival| Rival { effect: rival.id(), location: *rival.location() })
                    .collect(),
                order_95: review.order_95,
            }
        })
        .collect()
}

/// The curves of joints as findings: each by its strongest line.
fn curves(found: &Found<'_>, held_out_rms_mm: f64) -> Vec<Finding> {
    let fitted = &found.fitted;
    let Some(effect) = by_id("joint_periodic") else { return Vec::new() };
    let sigma_m = fitted.estimate.spread.sigma_m;
    let finding = |one: &JointRipple| {
        let (explained, evidence, projection) = one.gain(fitted);
        let squares = held_out_squares_m2(&fitted.estimate.problem, &found.blocks, &projection);
        let value = |name, [value, sigma]: [f64; 2]| Value { name, unit: "rad", value, sigma };
        Finding {
            instance: EffectInstance {
                effect,
                location: Location { order: Some(one.spectrum.line.order), ..Location::at_joint(one.joint) },
            },
            values: vec![value("amplitude", one.spectrum.line.amplitude_rad), value("rms_of_all_orders", one.rms_rad)],
            held_out_rms_mm: [rms_mm(&squares), held_out_rms_mm],
            p_value: evidence::p_value_of_evidence(evidence),
            stability: None,
            share: (explained * sigma_m.powi(2) / found.bare_m2.max(f64::MIN_POSITIVE)).min(1.0),
            alternatives: Vec::new(),
            order_95: None,
        }
    };
    fitted.ripple.iter().flat_map(|ripple| &ripple.joints).map(finding).collect()
}

/// A number within this part of its uncertainty of zero is where its prior has put it: the recording says nothing of it, as it
/// does of a tool's turn about a point that is all that was measured.
const UNTOLD: f64 = 1e-6;

fn named_values(instances: &[EffectInstance], values: &DVector<f64>, sigmas: &DVector<f64>) -> Vec<Value> {
    instances
        .iter()
        .flat_map(|instance| instance.effect.meta().parameters)
        .zip(values.iter().zip(sigmas.iter()))
        .map(|(meta, (&value, &sigma))| Value { name: meta.name, unit: meta.unit, value, sigma })
        .filter(|told| told.value.abs() > UNTOLD * told.sigma)
        .collect()
}

fn unexplained(found: &Found<'_>) -> Result<Option<Unexplained>, NoPose> {
    if found.free.is_empty() {
        return Ok(None);
    }
    let estimate = &found.fitted.estimate;
    let regressors = Regressors::new(&estimate.problem, &estimate.fit.state)?;
    let projection = found.fitted.projection(None);
    let mut cost = projection.cost;
    let mut left = projection.clone();
    let mut parts: Vec<(f64, f64, FreeFunction)> = Vec::new();
    for function in &found.free {
        let columns = function.columns(&regressors);
        let gain = left.gain(&columns);
        let freedom = left.rows as f64 - left.free as f64;
        let looked_at = evidence::looked_at(super::free::free_functions(&regressors).len() as f64);
        let p_value = evidence::p_value(gain.explained, gain.rank, left.cost, freedom, looked_at);
        parts.push((gain.explained, p_value, function.clone()));
        left = left.with_smooth(&columns);
    }
    cost -= left.cost;
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let sigma_m = estimate.spread.sigma_m;
    let records = estimate.problem.records.len() as f64;
    Ok(Some(Unexplained {
        rms_mm: 1e3 * sigma_m * (cost.max(0.0) / records).sqrt(),
        p_value: parts.iter().map(|part| part.1).fold(1.0, f64::min),
        functions: parts.into_iter().map(|(_, _, function)| function).collect(),
    }))
}

impl Unexplained {
    /// What it depends on, each variable once.
    pub fn depends_on(&self) -> Vec<String> {
        let mut words: Vec<String> = Vec::new();
        for variable in self.functions.iter().flat_map(|function| &function.variables) {
            let word = variable.word();
            if !words.contains(&word) {
                words.push(word);
            }
        }
        words
    }

    /// Where the strongest part sits.
    pub fn location(&self) -> Location {
        use crate::model::effect::MovingFrame;
        let frame = |frame| Location { frame: Some(frame), ..Location::default() };
        match self.functions.first().map(|function| function.seat) {
            Some(Seat::Joint(joint)) => Location::at_joint(joint),
            Some(Seat::Base) => frame(MovingFrame::Base),
            Some(Seat::Tool) => frame(MovingFrame::Tool),
            Some(Seat::Tracker(_)) | None => Location::default(),
        }
    }

    /// The same in words.
    pub fn place(&self) -> String {
        match self.functions.first().map(|function| function.seat) {
            Some(Seat::Tracker(at_mm)) => {
                let [x_m, y_m] = at_mm.map(|mm| 1e-3 * f64::from(mm));
                format!("measurement (as if by a tracker at x {x_m:.1}, y {y_m:.1} m in the robot base)")
            }
            _ => self.location().to_string(),
        }
    }
}

//! Judges a diagnosis against what was concealed. Reads what every user can read: the JSON of the contract.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::ask::ask;
use crate::cause::{Cause, Frame};
use crate::trial::{Concealed, Hardship, Spec, Trial, Truth};

/// What became of a concealed cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// Right name, right place.
    Placed,
    /// Another name that these records cannot tell from it, and the truth stands among its alternatives.
    Equivalent,
    /// Right name at another place.
    Misplaced,
    /// Without a name and told as unexplained, where there is none to give.
    Flagged,
    /// Named causes: not seen. Nameless ones: not told as unexplained.
    Missed,
}

impl Fate {
    pub fn right(self) -> bool {
        matches!(self, Self::Placed | Self::Equivalent | Self::Flagged)
    }
}

/// A concealed cause and its fate, for the tables.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Judged {
    pub kind: String,
    /// What it was meant to be, and is, over the noise.
    pub wanted: f64,
    pub level: f64,
    pub fate: Fate,
}

/// A trial's outcome: one line of the results.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Outcome {
    pub number: u64,
    pub group: String,
    pub moving: bool,
    pub arm: String,
    pub hardships: Vec<String>,
    pub causes: Vec<Judged>,
    /// Names that are wrong: effect and location.
    pub wrong: Vec<(String, Value)>,
    /// All that was found.
    pub found: Vec<(String, Value)>,
    pub unexplained: bool,
    /// Whether what has no name was told to sit at its joint; `None` where there is none, or it sits at none.
    pub located: Option<bool>,
    pub verdict: String,
    /// Share of the missing error that the updated model recovers on unseen poses.
    pub recovered: Option<f64>,
    /// Gross errors found, and there.
    pub outliers: [usize; 2],
    /// Good records called gross errors.
    pub accused: usize,
    /// Noise as told over noise as it is.
    pub noise_ratio: Option<f64>,
    pub seconds: f64,
    /// Why there was no diagnosis.
    pub refused: Option<String>,
}

impl Outcome {
    /// Something was named where nothing was there.
    pub fn alarmed(&self) -> bool {
        !self.wrong.is_empty()
    }
}

/// Records that differ by less than this many standard deviations in all cannot tell two names apart: at 5 a test between
/// the two errs once in 160 times, with the refit of both not yet counted.
const APART: f64 = 5.0;

/// Runs the diagnosis on the files of a trial and judges it.
pub fn judge(spec: &Spec, trial: &Trial) -> Outcome {
    let truth = &trial.truth;
    let mut outcome = Outcome {
        number: spec.number,
        group: spec.group.to_string(),
        moving: spec.moving,
        arm: truth.arm.to_string(),
        hardships: spec.hardships.iter().map(|hardship| hardship.words().to_string()).collect(),
        causes: Vec::new(),
        wrong: Vec::new(),
        found: Vec::new(),
        unexplained: false,
        located: None,
        verdict: String::new(),
        recovered: None,
        outliers: [0, truth.outliers.len()],
        accused: 0,
        noise_ratio: None,
        seconds: 0.0,
        refused: None,
    };
    let answer = match ask(trial) {
        Ok(answer) => answer,
        Err(refusal) => {
            outcome.refused = Some(refusal);
            outcome.causes = fates(spec, truth, &Value::Null);
            return outcome;
        }
    };
    let report = answer.report;
    outcome.seconds = answer.seconds;
    outcome.causes = fates(spec, truth, &report);
    outcome.found = names(&report["findings"]);
    outcome.wrong = outcome.found.iter().filter(|found| !justified(spec, truth, &report, found)).cloned().collect();
    outcome.unexplained = !report["unexplained"].is_null();
    let nameless = truth.concealed.iter().find(|one| name_of(&one.cause).is_none());
    outcome.located = nameless
        .and_then(|one| one.cause.joint())
        .map(|joint| report["unexplained"]["location"]["joint"].as_u64() == Some(joint as u64 + 1));
    outcome.verdict = report["verdict"].as_str().unwrap_or_default().to_string();
    let told: BTreeSet<&str> = report["outliers"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    outcome.outliers[0] = truth.outliers.iter().filter(|id| told.contains(id.as_str())).count();
    outcome.accused = told.len() - outcome.outliers[0];
    let noise_mm = report["recording"]["noise_sigma_mm"].as_f64();
    outcome.noise_ratio = noise_mm.map(|noise_mm| noise_mm / (1e3 * truth.sigma_m));
    if let Some(predicted) = answer.predicted_m.filter(|predicted| predicted.len() == truth.points_m.len()) {
        let squares: f64 = predicted.iter().zip(&truth.points_m).map(|(one, point)| (one - point).norm_squared()).sum();
        let missing = truth.concealed.iter().map(|one| (one.level * truth.sigma_m).powi(2)).sum::<f64>() * 3.0;
        if missing > 0.0 {
            outcome.recovered = Some(1.0 - (squares / truth.points_m.len() as f64 / missing).sqrt());
        }
    }
    outcome
}

fn names(list: &Value) -> Vec<(String, Value)> {
    let all = list.as_array().into_iter().flatten();
    all.map(|one| (one["effect"].as_str().unwrap_or_default().to_string(), one["location"].clone())).collect()
}

fn fates(spec: &Spec, truth: &Truth, report: &Value) -> Vec<Judged> {
    let fate = |index: usize, one: &Concealed| {
        let Some(_) = name_of(&one.cause) else {
            return if report["unexplained"].is_object() { Fate::Flagged } else { Fate::Missed };
        };
        let findings: Vec<&Value> = report["findings"].as_array().into_iter().flatten().collect();
        let mut fate = Fate::Missed;
        for finding in findings {
            let (effect, location) = (finding["effect"].as_str().unwrap_or_default(), &finding["location"]);
            if accepts(&one.cause, effect, location, truth) {
                return Fate::Placed;
            }
            if is_equivalent(finding, index, truth) {
                fate = Fate::Equivalent;
            } else if fate == Fate::Missed && name_of(&one.cause) == Some(effect) {
                fate = Fate::Misplaced;
            }
        }
        fate
    };
    let pairs = truth.concealed.iter().enumerate().zip(&spec.wanted);
    pairs
        .map(|((index, one), (_, wanted))| Judged {
            kind: one.kind.to_string(),
            wanted: *wanted,
            level: one.level,
            fate: fate(index, one),
        })
        .collect()
}

/// True for a finding that names something that is there, or that these records cannot tell from it, or that the
/// hardships of the trial themselves put there.
fn justified(spec: &Spec, truth: &Truth, report: &Value, found: &(String, Value)) -> bool {
    let (effect, location) = found;
    if truth.concealed.iter().any(|one| accepts(&one.cause, effect, location, truth)) {
        return true;
    }
    if by_hardship(spec, effect, location) {
        return true;
    }
    // Told as one of several, the truth among them.
    let beside = report["findings"]
        .as_array()
        .into_iter()
        .flatten()
        .find(|one| one["effect"].as_str() == Some(effect.as_str()) && one["location"] == *location);
    beside.is_some_and(|finding| (0..truth.concealed.len()).any(|index| is_equivalent(finding, index, truth)))
}

/// True when a finding offers a concealed cause beside its own name, and the records cannot tell the two.
fn is_equivalent(finding: &Value, index: usize, truth: &Truth) -> bool {
    let apart = |effect: &str| truth.bench.apart(index, effect, &finding["location"]);
    offered(finding, &truth.concealed[index].cause, truth)
        && finding["effect"].as_str().and_then(apart).is_some_and(|apart| apart < APART)
}

/// True when a finding names the truth among its alternatives, or another order of it within its uncertainty.
fn offered(finding: &Value, cause: &Cause, truth: &Truth) -> bool {
    let beside = names(&finding["alternatives"]);
    let within = |order: f64| {
        let end = |index: usize| finding["order_ci95"][index].as_f64();
        let told = end(0).zip(end(1)).is_some_and(|(low, high)| (low..=high).contains(&order));
        let mut location = finding["location"].clone();
        location["order"] = order.into();
        told && accepts(cause, finding["effect"].as_str().unwrap_or_default(), &location, truth)
    };
    let order = match cause {
        Cause::Periodic { order, .. } => Some(*order),
        _ => None,
    };
    beside.iter().any(|(effect, location)| accepts(cause, effect, location, truth)) || order.is_some_and(within)
}

/// What a hardship puts into the records under a name of the table.
fn by_hardship(spec: &Spec, effect: &str, location: &Value) -> bool {
    let joint = location["joint"].as_u64().unwrap_or(0);
    // A tracker set up anew is a base that moved once, by as much as its registration errs.
    (spec.has(Hardship::MovedStation) && effect == "step_shift" && location["frame"] == "base")
        // A payload that nobody declared is a payload error; only its product with the compliances shows.
        || (spec.has(Hardship::PayloadUnknown) && matches!(effect, "payload_error" | "joint_compliance"))
        // A reading before the arm has settled lags its approach.
        || (spec.has(Hardship::Unsettled) && joint <= 3 && matches!(effect, "backlash" | "friction_windup"))
}

/// The name in the contract's table; `None` for what has none.
pub fn name_of(cause: &Cause) -> Option<&'static str> {
    Some(match cause {
        Cause::Compliance { .. } => "joint_compliance",
        Cause::Stiffening { .. } => "joint_stiffening",
        Cause::Beam { .. } => "link_flexibility",
        Cause::Backlash { .. } => "backlash",
        Cause::Windup { .. } => "friction_windup",
        Cause::Periodic { .. } => "joint_periodic",
        Cause::GearRatio { .. } => "gear_ratio",
        Cause::Coupling { .. } => "joint_coupling",
        Cause::Wobble { .. } => "axis_wobble",
        Cause::Balancer { .. } => "gravity_compensator",
        Cause::Payload { .. } => "payload_error",
        Cause::Tilt { .. } => "gravity_tilt",
        Cause::Foundation { .. } => "base_compliance",
        Cause::Growth { .. } => "thermal_growth",
        Cause::Drift { .. } => "drift",
        Cause::Step { .. } => "step_shift",
        Cause::Clock => "time_offset",
        Cause::Lag { .. } => "servo_lag",
        Cause::Inertial { .. } => "inertial_deflection",
        _ => return None,
    })
}

/// True when this is the right name at the right place.
fn accepts(cause: &Cause, effect: &str, location: &Value, truth: &Truth) -> bool {
    let at = |key: &str, index: usize| location[key].as_u64() == Some(index as u64 + 1);
    let order = |wanted: f64| location["order"].as_f64().is_some_and(|order| (order - wanted).abs() < 0.1);
    let frame_is =
        |frame: Frame| location["frame"].as_str() == Some(if frame == Frame::Base { "base" } else { "tool" });
    let lost_motion = matches!(effect, "backlash" | "friction_windup");
    let named = name_of(cause) == Some(effect);
    match *cause {
        // On joints that gravity does not load nothing but the approach decides: the two are one.
        Cause::Backlash { joint, .. } | Cause::Windup { joint } if matches!(joint, 0 | 3 | 5) => {
            lost_motion && at("joint", joint)
        }
        Cause::Periodic { joint, order: wanted, .. } => named && at("joint", joint) && order(wanted),
        // Through a straight spring a balancer is a once-a-turn error of its joint.
        Cause::Balancer { joint, .. } => at("joint", joint) && (named || (effect == "joint_periodic" && order(1.0))),
        Cause::Coupling { joint, source } => named && at("joint", joint) && at("source_joint", source),
        Cause::Beam { link, .. } | Cause::Growth { link } => named && at("link", link),
        Cause::Drift { frame, .. } => named && frame_is(frame),
        Cause::Step { frame, at, .. } => {
            let when = location["at_s"].as_f64();
            named && frame_is(frame) && when.is_none_or(|when| (when / truth.whole_s - at).abs() < 0.1)
        }
        _ => named && cause.joint().is_none_or(|joint| at("joint", joint)),
    }
}

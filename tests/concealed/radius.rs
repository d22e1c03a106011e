//! Does `u95_mm` hold? The default pipeline of `calibrate` on concealed arms, its radii on fresh poses against the truth.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;

use falsetarget::base::text::Source;
use falsetarget::files::{recording, robot};
use falsetarget::identify::calibrate::{Options, calibrate};
use falsetarget::identify::predict::predict;
use falsetarget::identify::summary::summarise;
use falsetarget::measure::observation::Observation;
use falsetarget::model::arm::ArmModel;

use crate::trial::{Spec, Trial, build};

/// What came of one recording.
pub struct Held {
    pub records: usize,
    pub noise_mm: f64,
    pub noise_stated: bool,
    pub causes: usize,
    /// Part of the fresh poses whose true point lies within the radius.
    pub within: f64,
    /// RMS distance of the fresh poses from the truth, mm.
    pub missed_mm: f64,
    /// RMS of the radii, mm.
    pub radius_mm: f64,
    /// What stands beside the causes, for a person.
    pub note: String,
}

/// Calibrates (`whole`: named physics and a learner too) and looks at fresh poses.
fn held(spec: &Spec, trial: &Trial, whole: bool) -> Option<Held> {
    let robot = robot::read(&Source::new("robot.yaml", trial.robot_text.as_str())).expect("a robot file");
    let read = |name: &str, text: &str| recording::read(&Source::new(name, text), &robot).expect("a recording");
    let recordings = [read("recording.csv", &trial.recording_text)];
    let start = ArmModel::nominal(robot.clone());
    let mut outcome = calibrate(&start, &recordings, &Options::default(), &mut |_| {}).ok()?;
    let mut note = String::new();
    if whole {
        let named = falsetarget::diagnose::calibration::add(&mut outcome, &recordings, 1).ok()?;
        let learned = falsetarget::learn::calibration::add(&mut outcome, 1).ok()?;
        let names: Vec<&str> = named.iter().map(|one| one.effect.meta().id).collect();
        note = format!("{names:?} {}", learned.candidates.get(learned.chosen).map_or("", |one| one.name));
    }
    let (model, report) = summarise(&outcome, &recordings).ok()?;
    let fresh = read("poses.csv", &trial.poses_text);
    let observations: Vec<&Observation> = fresh.observations.iter().collect();
    let predicted = predict(&model.arm, model.uncertainty.as_ref(), &model.stations, &observations).ok()?;
    let pairs: Vec<(f64, f64)> = predicted
        .iter()
        .zip(&trial.truth.points_m)
        .filter_map(|(one, point)| Some(((one.position_m - point).norm(), one.u95_m?)))
        .collect();
    let count = pairs.len() as f64;
    let rms_mm =
        |numbers: &mut dyn Iterator<Item = f64>| 1e3 * (numbers.map(|one| one * one).sum::<f64>() / count).sqrt();
    Some(Held {
        records: spec.records,
        noise_mm: 1e3 * trial.truth.sigma_m,
        noise_stated: spec.noise_stated,
        causes: spec.wanted.len(),
        within: pairs.iter().filter(|(away, radius)| away <= radius).count() as f64 / count,
        missed_mm: rms_mm(&mut pairs.iter().map(|pair| pair.0)),
        radius_mm: rms_mm(&mut pairs.iter().map(|pair| pair.1)),
        note: format!("{:?} {note} unexplained {:.4}", spec.wanted, report.rest.unexplained_sigma_mm),
    })
}

/// All of these, a recording a core.
pub fn study(specs: &[Spec], whole: bool) -> Vec<Held> {
    let (next, all) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let worker = || {
        while let Some(spec) = specs.get(next.fetch_add(1, Ordering::Relaxed)) {
            let Some(held) = held(spec, &build(spec), whole) else { continue };
            println!(
                "{} {:>4} records noise {:.3}{} causes {} within {:.3} missed {:.4} u95 {:.4} {}",
                spec.number,
                held.records,
                held.noise_mm,
                if held.noise_stated { " stated" } else { "" },
                held.causes,
                held.within,
                held.missed_mm,
                held.radius_mm,
                held.note
            );
            all.lock().expect("the results").push(held);
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..available_parallelism().map_or(1, usize::from) {
            scope.spawn(worker);
        }
    });
    all.into_inner().expect("the results")
}

/// Pooled coverage, its spread over the recordings, and the error against the noise, of those that `which` takes.
pub fn tell(name: &str, all: &[Held], which: impl Fn(&Held) -> bool) -> f64 {
    let mut parts: Vec<f64> = all.iter().filter(|held| which(held)).map(|held| held.within).collect();
    let ratio: Vec<f64> =
        all.iter().filter(|held| which(held)).map(|held| (held.missed_mm / held.noise_mm).ln()).collect();
    if parts.is_empty() {
        return f64::NAN;
    }
    parts.sort_by(f64::total_cmp);
    let count = parts.len();
    let mean = parts.iter().sum::<f64>() / count as f64;
    let at = |share: f64| 100.0 * parts[((count - 1) as f64 * share).round() as usize];
    println!(
        "| {name} | {count} | {:.1} | {:.0} | {:.0} | {:.0} | {:.2} |",
        100.0 * mean,
        at(0.0),
        at(0.1),
        at(0.5),
        (ratio.iter().sum::<f64>() / count as f64).exp()
    );
    mean
}

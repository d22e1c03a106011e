use falsetarget::base::text::Source;
use falsetarget::files::{recording, robot};
use falsetarget::geometry::pose::Pose;
use falsetarget::identify::problem::*;
use falsetarget::identify::*;
use falsetarget::learn::*;
use falsetarget::measure::observation::*;
use falsetarget::model::arm::ArmModel;
use std::time::Instant;
fn figures(s: &state::State, p: &Problem) -> String {
    if p.records.is_empty() {
        return "-".to_string();
    }
    stat(&robust::lengths_of(p, &p.residuals(s).unwrap()))
}
fn stat(l: &[f64]) -> String {
    let n = l.len() as f64;
    format!(
        "n {} mean {:.4} rms {:.4} max {:.4}",
        l.len(),
        l.iter().sum::<f64>() / n * 1e3,
        (l.iter().map(|x| x * x).sum::<f64>() / n).sqrt() * 1e3,
        l.iter().cloned().fold(0.0, f64::max) * 1e3
    )
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let rob = robot::read(&Source::new("r", std::fs::read(&args[1]).unwrap())).map_err(|e| e.diagnostic).unwrap();
    let rec =
        recording::read(&Source::new("c", std::fs::read(&args[2]).unwrap()), &rob).map_err(|e| e.diagnostic).unwrap();
    let most: usize = args.get(3).map_or(100000, |s| s.parse().unwrap());
    let finest: f64 = args.get(4).map_or(40.0, |s| s.parse().unwrap());
    let holdout = args.get(5);
    let mut model = ArmModel::nominal(rob.clone());
    let obs: Vec<&Observation> = rec.observations.iter().filter(|o| o.measured.is_some()).collect();
    let prepared = model.prepared();
    let flanges: Vec<Pose> =
        obs.iter().map(|o| prepared.at(&o.numbers_rad, &o.conditions, None).unwrap().base_t_flange).collect();
    drop(prepared);
    let pts: Vec<_> = obs.iter().map(|o| o.measured.unwrap().position_m).collect();
    if rob.base.is_none() || rob.tool.is_none() {
        let p = place::place(&flanges, &pts, rob.tool.map(|t| t.translation), place::Handedness::Right).unwrap();
        if rob.base.is_none() {
            model.measuring_t_base = p.measuring_t_base;
        }
        if rob.tool.is_none() {
            model.flange_t_tool = Pose::from_translation(p.tool_m);
        }
    }
    let mk = |o: Vec<&'static Observation>| Problem {
        records: o
            .iter()
            .map(|o| Record {
                observation: o,
                measured: o.measured.unwrap(),
                station: 0,
                sigma_m: o.sigma_m.unwrap_or(prior::reach_m(&rob) * estimate::START_PER_REACH),
                sigma_rad: 1e-5,
            })
            .collect(),
    };
    let leaked: &'static [Observation] = Box::leak(rec.observations.clone().into_boxed_slice());
    let any_set = leaked.iter().any(|o| o.set.is_some());
    let mut idv: Vec<&'static Observation> = leaked
        .iter()
        .filter(|o| o.measured.is_some() && (!any_set || matches!(o.set, Some(SetName::Identify | SetName::Train))))
        .collect();
    if idv.len() > most {
        let step = idv.len() as f64 / most as f64;
        idv = (0..most).map(|k| idv[(k as f64 * step) as usize]).collect();
    }
    let idp = mk(idv);
    let mut val = mk(leaked.iter().filter(|o| o.set == Some(SetName::Validate)).collect());
    if let Some(h) = holdout {
        let rec2 =
            recording::read(&Source::new("c", std::fs::read(h).unwrap()), &rob).map_err(|e| e.diagnostic).unwrap();
        val = mk(Box::leak(rec2.observations.clone().into_boxed_slice()).iter().collect());
    }
    let state0 = state::State::new(model.clone());
    let torque = idp.largest_torque_nm(&state0);
    let ids = unknown::model_ids(&model, unknown::Scope::Everything, false);
    let unknowns = ids.iter().map(|&i| prior::unknown_of(i, &model, &torque)).collect();
    let sel = identifiability::select(&idp, &state0, unknowns, 1).unwrap();
    let t = Instant::now();
    let found = identify::identify(&idp, state0.clone(), &sel.free, false).unwrap();
    let est = found.estimate;
    println!(
        "identified in {:?}, excluded {}, sigma {:.4}",
        t.elapsed(),
        found.excluded.len(),
        est.spread.sigma_m * 1e3
    );
    println!("ident {} | val {}", figures(&est.fit.state, &idp), figures(&est.fit.state, &val));
    let t = Instant::now();
    let s = samples::Samples::new(&est.problem, &est.fit.state, &sel.free).unwrap();
    let fold_of = folds::folds(&s.observations, 8, 1);
    println!("samples {:?}", t.elapsed());
    let sig: Vec<f64> = est.problem.records.iter().map(|r| r.sigma_m).collect();
    for family in [None, Some(term::Family::Own), Some(term::Family::Loaded), Some(term::Family::Crossed)] {
        let t = Instant::now();
        let terms = family.map_or(vec![], |f| term::terms(&s, f, finest));
        let r = additive::Regression::new(&s, &est.fit.state, &sel.free, terms, &fold_of);
        let t1 = t.elapsed();
        let fit = r.fit(None, None).unwrap();
        let t2 = t.elapsed();
        let held = r.held_out(Some(&fit.variances)).unwrap();
        let t3 = t.elapsed();
        let lengths: Vec<f64> = held.iter().zip(&sig).map(|(h, s)| h.norm() * s).collect();
        let mut state = est.fit.state.clone();
        r.move_geometry(&fit, &sel.free, &mut state);
        let cols = fit.posterior.mean.len();
        state.model.learner = Some(r.curves(&fit).into());
        println!(
            "{family:?} cols {cols} noise {:.4} determined {:.1} logev {:.1}  setup {t1:?} fit {t2:?} cv {t3:?}",
            fit.variances.noise.sqrt() * sig[0] * 1e3,
            fit.posterior.determined,
            fit.posterior.log_evidence
        );
        println!("   cv {} | train {} | val {}", stat(&lengths), figures(&state, &est.problem), figures(&state, &val));
    }
}

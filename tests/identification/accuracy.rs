//! What the whole pipeline reaches on the recordings on the shelf, on the records that it never saw.

use falsetarget::identify::report::Report;

use crate::shelf::{by_the_paper, calibrated, learned, missed_mm, recording_of, robot_of, validation};

fn learned_report(folder: &str, file: &str) -> Report {
    learned(&robot_of(folder), &[recording_of(folder, file)]).1
}

#[test]
fn the_paper_s_protocol_ends_below_a_quarter_of_geometry_and_compliance() {
    let report = learned_report("hh800-class", "recording.csv");
    let (physics, learner) = (validation(&report, "geometry_compliance"), validation(&report, "learner"));
    assert!(learner.mean_mm <= 0.25 * physics.mean_mm, "{learner:?} after {physics:?}");
    assert!(learner.max_mm <= 0.35 * physics.max_mm, "{learner:?} after {physics:?}");
}

#[test]
fn the_paper_s_network_helps() {
    let (robot, recording) = (robot_of("hh800-class"), recording_of("hh800-class", "recording.csv"));
    let (_, report) = by_the_paper(&robot, &[recording]);
    let (physics, network) = (validation(&report, "geometry_compliance"), validation(&report, "network"));
    assert!(network.mean_mm < physics.mean_mm && network.max_mm < physics.max_mm, "{network:?} after {physics:?}");
}

#[test]
fn a_real_ur5_reaches_the_best_that_is_known() {
    let learner = validation(&learned_report("ur5", "grid.csv"), "learner");
    assert!(learner.mean_mm <= 0.057 && learner.max_mm <= 0.15, "{learner:?}");
}

#[test]
fn a_real_ur10_reaches_the_best_that_is_known() {
    let learner = validation(&learned_report("ur10", "series-d.csv"), "learner");
    assert!(learner.mean_mm <= 0.100 && learner.rms_mm <= 0.114 && learner.max_mm <= 0.33, "{learner:?}");
}

#[test]
fn where_nothing_is_missing_the_learner_adds_nothing() {
    for (folder, sigma_mm) in [("null-a", 0.04), ("null-b", 0.06), ("null-c", 0.02)] {
        let (robot, recording) = (robot_of(folder), recording_of(folder, "recording.csv"));
        let without = missed_mm(&calibrated(&robot, std::slice::from_ref(&recording)).expect("a model").0, folder);
        let with = missed_mm(&learned(&robot, &[recording]).0, folder);
        assert!(with <= without && with <= 0.6 * sigma_mm, "{folder}: {with} mm, without {without} mm");
    }
}

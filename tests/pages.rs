//! Pages: whole, self-contained, and safe from whatever names files have.

#![allow(clippy::expect_used, reason = "a test may stop where its own preparation fails")]

use falsetarget::base::text::Source;
use falsetarget::diagnose::diagnosis::{Verdict, diagnose};
use falsetarget::files::{recording, robot};
use falsetarget::identify::calibrate::{Options, calibrate};
use falsetarget::identify::report::Figures;
use falsetarget::identify::summary::summarise;
use falsetarget::identify::validate::{Residual, Validation};
use falsetarget::measure::recording::Recording;
use falsetarget::model::arm::ArmModel;
use falsetarget::model::effect::Location;
use falsetarget::report::diagnosis::{
    AlternativePart, DiagnosisReport, ErrorPart, EvidencePart, FindingPart, LearnedPart, NextPart, ParameterPart,
    RecordingPart, UnexplainedPart,
};
use falsetarget::report::html::{self, DiagnosisPage};
use falsetarget::report::sketch::{Sketch, sketch};
use falsetarget::report::trace::{Trace, TracePoint, trace};

/// A name as nobody should give it.
const NASTY: &str = "</title><script>alert(\"x\")</script>'&\u{1}";

/// Every tag that is opened is closed, in the right order, and nothing is fetched or run.
fn assert_sound(page: &str) {
    assert!(page.starts_with("<!DOCTYPE html>\n"));
    assert!(!page.contains("<script") && !page.contains("http") && !page.contains("src="), "{page}");
    assert!(!page.contains("NaN") && !page.contains("inf\"") && !page.contains('\u{1}'));
    // The style sheet holds no tags, text none either: they are escaped.
    let mut open: Vec<&str> = Vec::new();
    for tag in page.split('<').skip(2).map(|rest| rest.split('>').next().expect("a part")) {
        let name = tag.trim_start_matches('/').split([' ', '/']).next().expect("a name");
        match tag {
            _ if tag.ends_with('/') || name == "meta" => {}
            _ if tag.starts_with('/') => assert_eq!(open.pop(), Some(name), "at <{tag}>"),
            _ => open.push(name),
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

fn errors(mm: f64) -> ErrorPart {
    ErrorPart { mean_mm: mm, rms_mm: mm, max_mm: 3.0 * mm, heldout_rms_mm: mm }
}

fn report() -> DiagnosisReport {
    let location = Location { joint: Some(2), ..Location::default() };
    let finding = FindingPart {
        effect: "backlash",
        location,
        parameters: vec![ParameterPart { name: "gap", value: 2e-4, unit: "rad", ci95: [1.9e-4, 2.1e-4] }],
        share: 0.7,
        evidence: EvidencePart {
            heldout_rms_before_mm: 0.3,
            heldout_rms_after_mm: 0.1,
            p_value: 0.0,
            stability: Some(1.0),
        },
        alternatives: vec![AlternativePart { effect: "friction_windup", location }],
        order_ci95: None,
        statement: "Joint 2 has play.".into(),
    };
    DiagnosisReport {
        schema: "falsetarget/diagnosis/1",
        recording: RecordingPart { records: 3, used: 2, kind: "static", noise_sigma_mm: 0.04 },
        before: errors(0.3),
        after: errors(0.1),
        verdict: Verdict::PartlyExplained,
        statement: "Joint 2 has play.".into(),
        findings: vec![finding],
        unexplained: Some(UnexplainedPart {
            rms_mm: 0.05,
            p_value: 1e-9,
            depends_on: vec!["q4".into()],
            location: Location { joint: Some(5), ..Location::default() },
            learned: Some(LearnedPart { heldout_rms_before_mm: 0.2, heldout_rms_after_mm: 0.1 }),
            statement: "Something at joint 5.".into(),
        }),
        outliers: vec![NASTY.into()],
        stations: Vec::new(),
        next_measurements: vec![NextPart { why: "not told".into(), what: "more poses".into() }],
    }
}

fn cloud(sense: i8) -> Trace {
    let point = |x: f64| TracePoint { id: NASTY.into(), x, before: 0.2 * x, after: 0.01, sense };
    Trace {
        against: "joint 2, deg".into(),
        error: "mrad".into(),
        points: vec![point(-3.0), point(f64::NAN), point(5.0)],
    }
}

#[test]
fn a_diagnosis_is_a_whole_page() {
    let report = report();
    let sketch = Sketch {
        foot: [0.0, 0.0],
        joints: (1..=6).map(|n| [0.2 * f64::from(n), 0.3 * f64::from(n)]).collect(),
        flange: [1.4, 1.8],
        tool: [1.5, 1.7],
    };
    let (traces, unexplained) = ([cloud(1)], [cloud(0)]);
    let recordings = [NASTY.to_string()];
    let page = html::diagnosis(&DiagnosisPage {
        robot: NASTY,
        recordings: &recordings,
        report: &report,
        traces: &traces,
        unexplained: &unexplained,
        sketch: Some(&sketch),
    });
    assert_sound(&page);
    // First the sentence, then figures; arm, bars, two plots of the finding, one of the rest.
    let sentence = page.find("Joint 2 has play.").expect("the sentence");
    assert!(sentence < page.find("class=\"tile\"").expect("tiles"));
    assert_eq!(page.matches("<svg ").count(), 5);
    assert!(page.contains("J2 (1)") && page.contains("J5 (?)"), "culprits are marked");
    assert!(page.contains("as learned: held-out RMS 0.200 -&gt; 0.100 mm"));
    assert!(page.contains("friction_windup") && page.contains("more poses") && page.contains("&lt; 1e-100"));
    // Two points that have a place, not the third.
    assert_eq!(page.matches("<title>&lt;/title&gt;").count(), 2 + 2 + 2);
}

#[test]
fn a_diagnosis_of_nothing_is_a_page_too() {
    let report = DiagnosisReport {
        verdict: Verdict::NothingMissing,
        findings: Vec::new(),
        unexplained: None,
        outliers: Vec::new(),
        ..report()
    };
    let page = html::diagnosis(&DiagnosisPage {
        robot: "r",
        recordings: &[],
        report: &report,
        traces: &[],
        unexplained: &[],
        sketch: None,
    });
    assert_sound(&page);
    assert!(!page.contains("Findings"));
}

#[test]
fn a_validation_is_a_whole_page() {
    let figures = Figures { records: 2, mean_mm: 0.1, rms_mm: 0.1, std_mm: 0.0, max_mm: 0.2, p95_mm: 0.2 };
    let residual = |length_mm: f64, u95_mm: Option<f64>| Residual {
        id: NASTY.into(),
        line: 2,
        residual_mm: [length_mm, 0.0, 0.0],
        length_mm,
        u95_mm,
    };
    let validation = Validation {
        schema: "falsetarget/validation/1",
        records: 2,
        nominal: Some(figures),
        model: Some(figures),
        registered: None,
        within_u95: Some(0.5),
        p_value: Some(0.1),
        passed: false,
        notes: vec![NASTY.into()],
        residuals: vec![residual(0.1, Some(0.2)), residual(0.2, None)],
    };
    let page = html::validation(NASTY, NASTY, &validation);
    assert_sound(&page);
    assert!(page.contains("The model does not hold."));
    let furthest = page.split("The furthest off").nth(1).expect("the table");
    assert!(furthest.find("0.2000").expect("first") < furthest.find("0.1000").expect("second"));
}

/// A recording that comes with the tool.
fn shipped(folder: &str) -> (ArmModel, Recording) {
    let source = |file: &str| {
        let path = format!("{}/calibration/recordings/{folder}/{file}", env!("CARGO_MANIFEST_DIR"));
        Source::new(file.to_string(), std::fs::read(path).expect("a file"))
    };
    let robot = robot::read(&source("robot.yaml")).expect("a robot");
    let recording = recording::read(&source("recording.csv"), &robot).expect("a recording");
    (ArmModel::nominal(robot), recording)
}

#[test]
fn a_calibration_is_a_whole_page() {
    let (arm, mut recording) = shipped("null-c");
    recording.name = NASTY.into();
    recording.observations[3].id = NASTY.into();
    // A gross error, so that there is something to list.
    recording.observations[3].measured.as_mut().expect("measured").position_m.x += 0.05;
    let recordings = [recording];
    let outcome = calibrate(&arm, &recordings, &Options::default(), &mut |_| {}).expect("a calibration");
    let (_, report) = summarise(&outcome, &recordings).expect("a report");
    let page = html::calibration(&report);
    assert_sound(&page);
    for part in
        ["Stage by stage", "What is left", "Identified numbers", "What the records can tell", "Records left out"]
    {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn a_trace_shows_what_the_records_have() {
    let (arm, recording) = shipped("worn-gears");
    let recordings = [recording];
    let diagnosis = diagnose(&arm, &recordings, 1).expect("a diagnosis");
    // The truth beside these files: joint 1 has 0.22 mrad of play, so it stands 0.11 mrad to either side.
    let play = diagnosis.findings.iter().find(|one| one.instance.location.joint == Some(1)).expect("joint 1");
    let shown = trace(&diagnosis.estimate, &play.instance);
    assert_eq!(shown.error, "angle error of joint 1, mrad");
    let mean = |sense: i8, of: fn(&TracePoint) -> f64| {
        let own: Vec<f64> = shown.points.iter().filter(|point| point.sense == sense).map(of).collect();
        assert!(own.len() > 80);
        own.iter().sum::<f64>() / own.len() as f64
    };
    assert!(
        (mean(1, |point| point.before) + 0.11).abs() < 0.01 && (mean(-1, |point| point.before) - 0.11).abs() < 0.01
    );
    assert!(mean(1, |point| point.after).abs() < 0.01 && mean(-1, |point| point.after).abs() < 0.01);
    // Joint 4 errs by 0.6 mrad twice a turn.
    let wave = diagnosis.findings.iter().find(|one| one.instance.location.joint == Some(4)).expect("joint 4");
    let shown = trace(&diagnosis.estimate, &wave.instance);
    assert_eq!(shown.against, "joint 4, deg");
    let [mut sines, mut squares] = [0.0; 2];
    for point in &shown.points {
        let fitted = wave.values[0].value.atan2(wave.values[1].value);
        let unit = (2.0 * point.x.to_radians() - fitted).cos();
        sines += unit * point.before;
        squares += unit * unit;
    }
    assert!((sines / squares - 0.603).abs() < 0.03, "{}", sines / squares);
    assert!(sketch(&diagnosis.estimate).is_some_and(|sketch| sketch.joints.len() == 6));
}

//! Asks for a diagnosis: the library, or a program on files (`FALSETARGET_BIN`), which gives the same answers.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use falsetarget::base::text::Source;
use falsetarget::diagnose::diagnosis::diagnose;
use falsetarget::diagnose::updated::updated;
use falsetarget::files::{recording, robot};
use falsetarget::identify::predict::predict;
use falsetarget::measure::observation::Observation;
use falsetarget::model::arm::ArmModel;
use falsetarget::report::diagnosis::DiagnosisReport;
use nalgebra::Vector3;
use serde_json::Value;

use crate::trial::Trial;

/// Time that a program has for its answer, whatever else the machine does.
const MOST: Duration = Duration::from_secs(300);

/// What a diagnosis said.
pub struct Answer {
    /// The contract's JSON.
    pub report: Value,
    /// Where the updated model has the poses to predict, m.
    pub predicted_m: Option<Vec<Vector3<f64>>>,
    /// How long it took.
    pub seconds: f64,
}

/// Asks; the error is a refusal in words.
pub fn ask(trial: &Trial) -> Result<Answer, String> {
    match std::env::var("FALSETARGET_BIN") {
        Ok(program) => command(&program, trial),
        Err(_) => library(trial),
    }
}

fn library(trial: &Trial) -> Result<Answer, String> {
    let robot = robot::read(&Source::new("robot.yaml", trial.robot_text.as_str())).expect("a robot file");
    let read = |name: &str, text: &str| recording::read(&Source::new(name, text), &robot).expect("a recording");
    let recordings = [read("recording.csv", &trial.recording_text)];
    let begun = Instant::now();
    let diagnosis =
        diagnose(&ArmModel::nominal(robot.clone()), &recordings, 1).map_err(|refusal| refusal.to_string())?;
    let seconds = begun.elapsed().as_secs_f64();
    let report = serde_json::to_value(DiagnosisReport::new(&diagnosis)).expect("a report");
    let held = read("poses.csv", &trial.poses_text);
    let records: Vec<&Observation> = held.observations.iter().collect();
    let model = updated(&diagnosis, &recordings);
    let predicted = predict(&model.arm, None, &model.stations, &records);
    let points = |all: Vec<falsetarget::identify::predict::Predicted>| all.iter().map(|one| one.position_m).collect();
    Ok(Answer { report, predicted_m: predicted.ok().map(points), seconds })
}

fn command(program: &str, trial: &Trial) -> Result<Answer, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name);
    for (name, text) in
        [("robot.yaml", &trial.robot_text), ("recording.csv", &trial.recording_text), ("poses.csv", &trial.poses_text)]
    {
        fs::write(place(name), text).expect("a file");
    }
    let run = |words: &[&str]| run(Command::new(program).args(words).current_dir(folder.path()));
    let begun = Instant::now();
    let complaint = run(&[
        "diagnose",
        "--model",
        "robot.yaml",
        "--recording",
        "recording.csv",
        "-o",
        "updated.yaml",
        "--json",
        "d.json",
    ]);
    let seconds = begun.elapsed().as_secs_f64();
    let report = fs::read(place("d.json")).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let Some(report) = report else { return Err(complaint) };
    run(&["predict", "--model", "updated.yaml", "--recording", "poses.csv", "-o", "p.csv"]);
    Ok(Answer { report, predicted_m: points_of(&place("p.csv")), seconds })
}

/// Runs a program until it ends or its time is up; what it said.
fn run(command: &mut Command) -> String {
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("a program");
    let begun = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if begun.elapsed() > MOST {
            let _ = child.kill();
            return format!("no answer within {MOST:?}");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output().expect("what it said");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The points of a file that `predict` wrote, m.
fn points_of(path: &Path) -> Option<Vec<Vector3<f64>>> {
    let mut rows = csv::Reader::from_path(path).ok()?;
    let heads = rows.headers().ok()?.clone();
    let column = |name: &str| heads.iter().position(|head| head == name);
    let columns = [column("x_mm")?, column("y_mm")?, column("z_mm")?];
    rows.records()
        .map(|row| {
            let row = row.ok()?;
            let mut point = Vector3::zeros();
            for (axis, &column) in columns.iter().enumerate() {
                point[axis] = 1e-3 * row.get(column)?.parse::<f64>().ok()?;
            }
            Some(point)
        })
        .collect()
}

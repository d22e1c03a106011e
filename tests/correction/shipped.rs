//! Every shipped program with the robot it is meant for: `programs/jobs.yaml`.

use std::path::{Path, PathBuf};

use falsetarget::base::edit::EditSet;
use falsetarget::base::text::{Source, Span};
use falsetarget::files::builtin::by_name;
use falsetarget::files::cell::{self, Cell};
use falsetarget::geometry::pose::pose_difference;
use falsetarget::kinematics::controller::Controller;
use falsetarget::model::arm::ArmModel;
use falsetarget::program::dialect::{self, DIALECTS, Dialect};
use falsetarget::program::number::NumberField;
use falsetarget::program::target::{Program, Target, TargetValue};
use falsetarget::rewrite::class::Class;
use falsetarget::rewrite::correct::{Job, Options, correct};
use falsetarget::rewrite::outcome::Outcome;
use falsetarget::rewrite::play::play;
use falsetarget::rewrite::split::split;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;

use super::spoil::spoil;
use super::{LANDS_WITHIN_M, LANDS_WITHIN_RAD};

#[derive(Deserialize)]
struct Shipped {
    program: String,
    /// The other files of the job.
    #[serde(default)]
    with: Vec<String>,
    /// Files that the job shares with others.
    #[serde(default)]
    shared: Vec<String>,
    robot: String,
    cell: Option<String>,
    #[serde(default)]
    refused: usize,
}

fn programs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("programs")
}

fn shipped() -> Vec<Shipped> {
    let text = std::fs::read_to_string(programs().join("jobs.yaml")).expect("programs/jobs.yaml");
    serde_yaml::from_str(&text).expect("a list of jobs")
}

/// A shipped program, read.
struct Read {
    /// The files of the job, then those that it shares.
    sources: Vec<Source>,
    /// How many of them are its own.
    own: usize,
    dialect: &'static dyn Dialect,
    program: Program,
    cell: Cell,
}

impl Read {
    fn new(job: &Shipped) -> Self {
        let names = std::iter::once(&job.program).chain(&job.with).chain(&job.shared);
        let source = |name: &String| {
            Source::new(name.clone(), std::fs::read(programs().join(name)).unwrap_or_else(|_| panic!("no {name}")))
        };
        let sources: Vec<Source> = names.map(source).collect();
        let own = 1 + job.with.len();
        let dialect = dialect::detect(&sources[0]).expect("a known language");
        let program = Self::program(dialect, &sources, own);
        let cell = job.cell.as_ref().map(|path| {
            let bytes = std::fs::read(programs().join(path)).expect("the cell file");
            cell::read(&Source::new(path.clone(), bytes)).expect("a sound cell file")
        });
        Self { sources, own, dialect, program, cell: cell.unwrap_or_default() }
    }

    fn program(dialect: &dyn Dialect, sources: &[Source], own: usize) -> Program {
        let mut program = dialect.read(sources);
        program.read_only = (own..sources.len()).collect();
        program
    }

    /// The job with edits made, read again.
    fn with_edits(&self, edits: &[EditSet]) -> Self {
        let edited = |(source, edits): (&Source, &EditSet)| {
            Source::new(source.name(), edits.apply(source.bytes()).expect("disjoint edits"))
        };
        let sources: Vec<Source> = self.sources.iter().zip(edits).map(edited).collect();
        let program = Self::program(self.dialect, &sources, self.own);
        Self { sources, own: self.own, dialect: self.dialect, program, cell: self.cell.clone() }
    }

    /// The program with a declaration for each setting that a target is used with.
    fn split(&self, outcome: &Outcome) -> Self {
        self.with_edits(&split(&self.sources, &self.program, outcome))
    }

    fn correct(&self, model: &ArmModel, controller: &Controller, options: &Options) -> Outcome {
        let rules = self.dialect.meta().numbers;
        let job = Job { sources: &self.sources, program: &self.program, rules, cell: &self.cell };
        correct(&job, model, controller, options)
    }
}

#[test]
fn every_dialect_ships_three_programs_and_every_program_is_listed() {
    let jobs = shipped();
    for dialect in DIALECTS {
        for file in files_below(&programs().join(dialect.meta().id)) {
            let bytes = std::fs::read(&file).expect("a file");
            if dialect.recognises(&Source::new("", bytes)) {
                let path = file.strip_prefix(programs()).expect("inside").to_string_lossy().replace('\\', "/");
                let holds =
                    |job: &Shipped| job.program == path || job.with.contains(&path) || job.shared.contains(&path);
                assert!(jobs.iter().any(holds), "{path} is not in programs/jobs.yaml");
            }
        }
        let count = jobs.iter().filter(|job| job.program.starts_with(&format!("{}/", dialect.meta().id))).count();
        assert!(count >= 3, "{} ships {count} programs", dialect.meta().id);
    }
}

/// The files of a folder and of the folders in it: a language may want a folder a program.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|_| panic!("no {}", folder.display())).flatten();
    entries
        .flat_map(|entry| if entry.path().is_dir() { files_below(&entry.path()) } else { vec![entry.path()] })
        .collect()
}

#[test]
fn without_error_every_program_comes_out_byte_for_byte() {
    for job in shipped() {
        let read = Read::new(&job);
        let robot = by_name(&job.robot).expect("built in").expect("sound");
        let controller = Controller::new(&robot);
        for joint_targets in [false, true] {
            let outcome = read.correct(
                &ArmModel::controller(robot.clone()),
                &controller,
                &Options { joint_targets, ..Options::default() },
            );
            assert!(outcome.edits.iter().all(EditSet::is_empty), "{} changes", job.program);
            assert_eq!(outcome.count(Class::Refused), 0, "{}: {:?}", job.program, first_refused(&outcome));
        }
    }
}

fn first_refused(outcome: &Outcome) -> Option<&String> {
    outcome.targets.iter().find(|target| target.class == Class::Refused)?.reason.as_ref()
}

#[test]
fn with_errors_every_program_lands_and_only_digits_of_targets_change() {
    let mut random = ChaCha8Rng::seed_from_u64(800);
    let mut landed = 0;
    for job in shipped() {
        let read = Read::new(&job);
        let robot = by_name(&job.robot).expect("built in").expect("sound");
        let controller = Controller::new(&robot);
        let model = spoil(robot, &mut random);
        let options = Options { joint_targets: true, ..Options::default() };
        let outcome = read.correct(&model, &controller, &options);
        assert_eq!(outcome.count(Class::Refused), job.refused, "{}: {:?}", job.program, first_refused(&outcome));
        landed += assert_lands(&read, &outcome, &model, &controller);
    }
    assert!(landed > 6000, "only {landed} arrivals were checked");
}

/// The spot line welds one part in two fixtures with the same points: with a declaration for each fixture every point
/// lands, and before correction the arm goes where it went.
#[test]
fn shared_targets_land_when_each_setting_has_its_own() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut count = 0;
    for job in shipped().iter().filter(|job| job.refused > 0) {
        let read = Read::new(job);
        let robot = by_name(&job.robot).expect("built in").expect("sound");
        let controller = Controller::new(&robot);
        let model = spoil(robot, &mut random);
        let outcome = read.correct(&model, &controller, &Options::default());
        let shared = outcome.targets.iter().filter(|target| target.shared).count();
        assert_eq!(shared, job.refused, "{}", job.program);

        let apart = read.split(&outcome);
        assert_eq!(apart.program.targets.len(), read.program.targets.len() + shared, "one copy each");
        let (before, after) = (
            play(&read.program, &read.cell, &model, &controller),
            play(&apart.program, &apart.cell, &model, &controller),
        );
        assert_eq!(before.len(), after.len());
        for (one, other) in before.iter().zip(&after) {
            assert_eq!((one.written, one.landed), (other.written, other.landed), "{}", job.program);
        }
        let corrected = apart.correct(&model, &controller, &Options::default());
        assert_eq!(corrected.count(Class::Refused), 0, "{:?}", first_refused(&corrected));
        assert_eq!(corrected.count(Class::Computed), 0);
        assert_eq!(assert_lands(&apart, &corrected, &model, &controller), after.len());
        count += shared;
    }
    assert_eq!(count, 15);
}

/// The corrected program lands, and differs in digits alone; gives the number of arrivals.
fn assert_lands(read: &Read, outcome: &Outcome, model: &ArmModel, controller: &Controller) -> usize {
    let mut landed = 0;
    assert!(outcome.edits[read.own..].iter().all(EditSet::is_empty), "{}: shared files", read.sources[0].name());
    let again = read.with_edits(&outcome.edits);
    for file in 0..read.own {
        assert_same_but_digits(read, &again, outcome, file);
    }
    let reread = &again.program;
    let before = play(&read.program, &read.cell, model, controller);
    let after = play(reread, &read.cell, model, controller);
    assert_eq!(before.len(), after.len(), "{}", read.sources[0].name());
    for (meant, arrival) in before.iter().zip(&after) {
        let result = &outcome.targets[arrival.target];
        if result.class != Class::Corrected {
            continue;
        }
        let (shift, turn) = pose_difference(&arrival.landed, &meant.written);
        // A displaced target has the orientation of its base; what that leaves is in the report.
        let displaced = matches!(read.program.targets[arrival.target].value, TargetValue::Displaced(_));
        let left_rad = result.figures.as_ref().map_or(0.0, |figures| figures.orientation_left_rad);
        let allowed_rad = LANDS_WITHIN_RAD + if displaced { left_rad } else { 0.0 };
        // A target that writes the tool's axis alone asks for no turn about it.
        let turn_rad = match has_axis_alone(&read.program.targets[arrival.target].value) {
            true => arrival.landed.rotation.column(2).cross(&meant.written.rotation.column(2)).norm(),
            false => turn.norm(),
        };
        assert!(
            shift.norm() < LANDS_WITHIN_M && turn_rad < allowed_rad,
            "{}, target {}: {:.2e} m, {turn_rad:.2e} rad",
            read.sources[0].name(),
            arrival.target,
            shift.norm(),
        );
        landed += 1;
    }
    landed
}

fn has_axis_alone(value: &TargetValue) -> bool {
    matches!(value, TargetValue::Cartesian(numbers) if numbers.convention.spin_rule().is_some())
}

/// Between targets every byte is as it was; inside a corrected one, every byte that is not part of a number. Where the
/// language has fixed columns, the blanks in front of a number make room for it; where it leaves out zeros, what stands
/// around a number comes with it.
fn assert_same_but_digits(read: &Read, corrected: &Read, outcome: &Outcome, file: usize) {
    let (source, again, reread) = (&read.sources[file], &corrected.sources[file], &corrected.program);
    assert_eq!(read.program.targets.len(), reread.targets.len(), "{}", source.name());
    let (mut here, mut there) = (0, 0);
    let mut pairs: Vec<_> = read.program.targets.iter().zip(&reread.targets).zip(&outcome.targets).collect();
    pairs.retain(|((target, _), _)| target.file == file);
    pairs.sort_by_key(|((target, _), _)| target.span);
    for ((target, changed), result) in pairs {
        let gap = (Span::new(here, target.span.start), Span::new(there, changed.span.start));
        assert_eq!(source.slice(gap.0), again.slice(gap.1), "{} before a target", source.name());
        let (inside, inside_now) = (source.slice(target.span), again.slice(changed.span));
        if result.class == Class::Corrected {
            let columns = has_columns(&target.value);
            let rest = |text: &[u8]| without_numbers(text, columns);
            let inside_now = without_insertions(target, changed, again);
            assert_eq!(rest(inside), rest(&inside_now), "{}", source.name());
            if columns {
                assert_eq!(inside.len(), inside_now.len(), "{}: the columns moved", source.name());
            }
        } else {
            assert_eq!(inside, inside_now, "{}", source.name());
        }
        (here, there) = (target.span.end, changed.span.end);
    }
    let rest = |source: &Source, from: usize| source.slice(Span::new(from, usize::MAX)).to_vec();
    assert_eq!(rest(source, here), rest(again, there), "{} at the end", source.name());
}

/// The text of a corrected target without what was put around numbers that were not written before.
fn without_insertions(target: &Target, changed: &Target, again: &Source) -> Vec<u8> {
    let mut text = again.slice(changed.span).to_vec();
    let mut inserted: Vec<_> = fields(&target.value)
        .into_iter()
        .zip(fields(&changed.value))
        .filter(|(_, now)| now.insertion.is_none())
        .filter_map(|(before, now)| Some((before.insertion.clone()?, now.span())))
        .collect();
    inserted.sort_by_key(|(_, span)| std::cmp::Reverse(*span));
    for (insertion, span) in inserted {
        let whole = Span::new(span.start - insertion.before.len(), span.end + insertion.after.len());
        let expected = [insertion.before.as_bytes(), again.slice(span), insertion.after.as_bytes()].concat();
        assert_eq!(again.slice(whole), expected, "{}", again.name());
        text.drain(whole.start - changed.span.start..whole.end - changed.span.start);
    }
    text
}

fn fields(value: &TargetValue) -> Vec<&NumberField> {
    match value {
        TargetValue::Cartesian(numbers) => numbers.position.iter().chain(&numbers.orientation).collect(),
        TargetValue::Joint(numbers) => numbers.joints.iter().collect(),
        TargetValue::Displaced(_) | TargetValue::Counts | TargetValue::Unwritten => Vec::new(),
    }
}

fn has_columns(value: &TargetValue) -> bool {
    match value {
        TargetValue::Cartesian(numbers) => numbers.position.iter().any(|field| field.column().is_some()),
        TargetValue::Joint(numbers) => numbers.joints.iter().any(|field| field.column().is_some()),
        TargetValue::Displaced(_) | TargetValue::Counts | TargetValue::Unwritten => false,
    }
}

fn without_numbers(text: &[u8], columns: bool) -> Vec<u8> {
    let of_number = |byte: &u8| matches!(byte, b'0'..=b'9' | b'.' | b'-' | b'+') || (columns && *byte == b' ');
    text.iter().copied().filter(|byte| !of_number(byte)).collect()
}

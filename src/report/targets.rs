//! `falsetarget/targets/1`: what `inspect --json` and `correct --report` say.

use std::collections::BTreeSet;

use serde::Serialize;

use crate::base::text::Source;
use crate::base::units::mm_from_m;
use crate::geometry::orientation::quaternion_from_rotation;
use crate::program::dialect::Dialect;
use crate::program::target::{Program, Reference, Target, TargetValue};
use crate::rewrite::class::{Class, class_by_text};
use crate::rewrite::outcome::{Outcome, TargetOutcome};
use crate::rewrite::written_pose;

/// The word in the first line.
pub const SCHEMA: &str = "falsetarget/targets/1";

/// The whole report.
#[derive(Clone, Debug, Serialize)]
pub struct TargetsReport<'a> {
    schema: &'static str,
    /// One a file.
    pub files: Vec<FileReport<'a>>,
    /// Counts over all files.
    pub summary: Summary,
}

/// Counts by class.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Summary {
    /// Rewritten, or correctable.
    pub corrected: usize,
    /// Joint targets left alone.
    pub joint: usize,
    /// Known only at run time.
    pub computed: usize,
    /// Without a solution.
    pub refused: usize,
    /// Files.
    pub files: usize,
}

/// One file.
#[derive(Clone, Debug, Serialize)]
pub struct FileReport<'a> {
    /// Its path, as given.
    pub path: &'a str,
    /// The id of its dialect.
    pub dialect: &'static str,
    encoding: String,
    newline: String,
    /// Its targets, in the order of the text.
    pub targets: TargetList<'a>,
}

/// The targets of a file. Each is described when it is asked for: a large program has millions.
#[derive(Clone, Copy, Debug)]
pub struct TargetList<'a> {
    sources: &'a [Source],
    program: &'a Program,
    outcome: Option<&'a Outcome>,
    file: usize,
}

impl<'a> TargetList<'a> {
    /// The targets that concern the job, with what became of them.
    fn targets(self) -> impl Iterator<Item = (&'a Target, Option<&'a TargetOutcome>)> {
        let own = move |target: &Target| target.file == self.file && self.program.concerns(target);
        let result = move |index: usize| self.outcome.and_then(|outcome| outcome.targets.get(index));
        let all = self.program.targets.iter().enumerate().filter(move |(_, target)| own(target));
        all.map(move |(index, target)| (target, result(index)))
    }

    /// Each of them, in the order of the text.
    pub fn iter(self) -> impl Iterator<Item = TargetReport> {
        self.targets().map(move |(target, result)| target_report(self.sources, self.program, target, result))
    }

    fn classes(self) -> impl Iterator<Item = Class> {
        let by_text = move |target| class_by_text(self.program, self.sources, target).0;
        self.targets().map(move |(target, result)| result.map_or_else(|| by_text(target), |result| result.class))
    }
}

impl Serialize for TargetList<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

/// One target.
#[derive(Clone, Debug, Serialize)]
pub struct TargetReport {
    /// Its name; null for an inline target.
    pub name: Option<String>,
    /// Line on which it starts.
    pub line: usize,
    /// Byte offsets of the whole target.
    pub span: [usize; 2],
    /// `cartesian` or `joint`.
    pub kind: &'static str,
    /// What became of it.
    pub class: Class,
    /// Why, where it was left alone.
    pub reason: Option<String>,
    motion: Option<String>,
    tool: Option<String>,
    frame: Option<String>,
    uses: Vec<usize>,
    /// The file of those lines, where it is another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    uses_path: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    xyz_mm: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    quat_wxyz: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    joints_deg: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    external_axes: Vec<(String, f64)>,
    /// Distance between the written and the corrected target.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub correction_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    correction_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    iterations: Option<usize>,
    /// Orientation error that stays, for displaced targets.
    #[serde(skip_serializing_if = "Option::is_none")]
    orientation_left_deg: Option<f64>,
    /// How well the model knows where the real arm lands; null where the model does not say.
    u95_mm: Option<f64>,
}

impl<'a> TargetsReport<'a> {
    /// From files, in their order.
    pub fn new(files: Vec<FileReport<'a>>) -> Self {
        // A file that several jobs share is listed with each.
        let paths: BTreeSet<&str> = files.iter().map(|file| file.path).collect();
        let mut summary = Summary { files: paths.len(), ..Summary::default() };
        for class in files.iter().flat_map(|file| file.targets.classes()) {
            match class {
                Class::Corrected => summary.corrected += 1,
                Class::Joint => summary.joint += 1,
                Class::Computed => summary.computed += 1,
                Class::Refused => summary.refused += 1,
            }
        }
        Self { schema: SCHEMA, files, summary }
    }
}

impl TargetReport {
    /// Motion, tool, frame and numbers in one line.
    pub fn describe(&self) -> String {
        let or_dash = |text: &Option<String>| text.clone().unwrap_or_else(|| "-".into());
        let numbers = match (&self.xyz_mm, &self.joints_deg) {
            (Some(xyz), _) => format!("[{:.3}, {:.3}, {:.3}] mm", xyz[0], xyz[1], xyz[2]),
            (None, Some(joints)) => {
                let joints: Vec<String> = joints.iter().map(|angle| format!("{angle:.3}")).collect();
                format!("[{}] deg", joints.join(", "))
            }
            (None, None) => String::new(),
        };
        let (motion, tool, frame) = (or_dash(&self.motion), or_dash(&self.tool), or_dash(&self.frame));
        format!("{motion:<8} tool {tool:<10} frame {frame:<10} {numbers}").trim_end().to_string()
    }
}

/// The reports of the files of one job: by the text alone, or with what `outcome` says. Files that the job only reads
/// are listed where they hold targets.
pub fn files<'a>(
    sources: &'a [Source],
    dialect: &dyn Dialect,
    program: &'a Program,
    outcome: Option<&'a Outcome>,
) -> Vec<FileReport<'a>> {
    let targets = |file: usize| TargetList { sources, program, outcome, file };
    let report = |(file, source): (usize, &'a Source)| FileReport {
        path: source.name(),
        dialect: dialect.meta().id,
        encoding: source.encoding(dialect.meta().code_page).to_string(),
        newline: source.newline().to_string(),
        targets: targets(file),
    };
    let listed =
        |(file, _): &(usize, &Source)| !program.read_only.contains(file) || targets(*file).targets().next().is_some();
    sources.iter().enumerate().filter(listed).map(report).collect()
}

fn target_report(
    sources: &[Source],
    program: &Program,
    target: &Target,
    result: Option<&TargetOutcome>,
) -> TargetReport {
    let (class, reason) = match result {
        Some(result) => (result.class, result.reason.clone()),
        None => class_by_text(program, sources, target),
    };
    let figures = result.and_then(|result| result.figures.as_ref());
    let pose = written_pose(program, &target.value);
    let first = target.uses.first();
    TargetReport {
        name: target.name.clone(),
        line: sources[target.file].line(target.span.start),
        span: [target.span.start, target.span.end],
        kind: target.kind(),
        class,
        reason,
        motion: first.map(|one| one.motion.to_string()),
        tool: first.and_then(|one| spoken(&one.tool)),
        frame: first.and_then(|one| spoken(&one.frame)),
        uses: target.uses.iter().map(|one| sources[one.file].line(one.span.start)).collect(),
        uses_path: first.filter(|one| one.file != target.file).map(|one| sources[one.file].name().to_string()),
        xyz_mm: pose.map(|pose| pose.translation.map(|length| tidy(mm_from_m(length))).into()),
        quat_wxyz: pose.map(|pose| quaternion_from_rotation(&pose.rotation)),
        joints_deg: match &target.value {
            TargetValue::Joint(numbers) => Some(numbers.numbers_rad().map(|angle| tidy(angle.to_degrees()))),
            _ => None,
        },
        external_axes: target.external_axes.iter().map(|axis| (axis.name.clone(), axis.value)).collect(),
        correction_mm: figures.map(|figures| mm_from_m(figures.correction_m)),
        correction_deg: figures.map(|figures| figures.correction_rad.to_degrees()),
        iterations: figures.map(|figures| figures.iterations),
        orientation_left_deg: figures
            .map(|figures| figures.orientation_left_rad.to_degrees())
            .filter(|_| matches!(target.value, TargetValue::Displaced(_))),
        u95_mm: None,
    }
}

/// What a unit conversion leaves beyond a nanometre is not worth writing.
fn tidy(number: f64) -> f64 {
    (number * 1e9).round() / 1e9
}

fn spoken(reference: &Reference) -> Option<String> {
    match reference {
        Reference::Unnamed => None,
        Reference::Named(name) => Some(name.to_string()),
        Reference::Runtime(reason) => Some(format!("? ({reason})")),
    }
}

//! What looks wrong in a job: a missing end, too few axes, positions in metres.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::target::{CartesianNumbers, Program, Reference, Target, TargetValue};

use super::expression::Goal;
use super::header::{Generation, Header};
use super::reader::JobFile;
use super::target::ROBOT_AXES;
use super::written_pose::{Coordinates, WrittenPose};

/// No arm puts its tool this near to the origin of its base: such a position is in metres.
const NEAREST_POSITION_MM: f64 = 10.0;

/// A job ends with `END`. One that stops without it inside of a bracket, or right behind a pose that may lack its
/// suffix, cannot be trusted: joint values without their `A` read as base coordinates.
pub(super) fn end(index: usize, source: &Source, file: &JobFile, diagnostics: &mut Vec<Diagnostic>) {
    if file.ends || (file.header.line.is_none() && file.motions.is_empty()) {
        return;
    }
    let last = file.last_statement;
    if let Some((statement, motion)) = file.motions.last()
        && statement.span == last
        && matches!(motion.goal, Some(Goal::Broken(_)))
    {
        return; // It has its own finding.
    }
    let stops_here = last.end == source.bytes().len();
    let text = source.slice(last);
    let count = |wanted: u8| text.iter().filter(|&&byte| byte == wanted).count();
    let finding = if count(b'(') > count(b')') || count(b'[') > count(b']') {
        Diagnostic::error("truncated", "the job stops in the middle of a statement")
    } else if stops_here && file.header.generation == Generation::Hi5 && may_lack_suffix(text) {
        Diagnostic::error("truncated", "the job stops behind a pose whose coordinate suffix may be cut off")
    } else {
        Diagnostic::warning("missing-end", "the job has no END: it may have been cut off")
    };
    let at_end = Span::new(source.bytes().len(), source.bytes().len());
    diagnostics.push(finding.at(index, if stops_here { last } else { at_end }, "the text stops here"));
}

/// A tuple at the end that has no suffix, or one to which a digit may belong.
fn may_lack_suffix(statement: &[u8]) -> bool {
    let Some(close) = statement.iter().rposition(|&byte| byte == b')') else { return false };
    match statement[close + 1..].to_ascii_uppercase().as_slice() {
        [] => true,
        [b'U', digits @ ..] => digits.iter().all(u8::is_ascii_digit),
        _ => false,
    }
}

/// Checks the positions of one file.
pub(super) fn targets(index: usize, program: &mut Program) {
    let mut findings = Vec::new();
    let targets: Vec<&Target> = program.targets.iter().filter(|target| target.file == index).collect();
    findings.extend(metres(index, &targets));
    program.diagnostics.extend(findings);
}

/// A pose needs a value for every axis of the header, and for the six of the arm in any case.
pub(super) fn axis_count(index: usize, header: &Header, pose: &WrittenPose) -> Option<Diagnostic> {
    let total = header.total_axes.unwrap_or_else(|| pose.axes.len().max(ROBOT_AXES)).max(ROBOT_AXES);
    let written = pose.axes.len();
    if pose.coordinates == Coordinates::Encoder || written == total {
        return None;
    }
    let message = format!("the job has {total} axes, this pose has values for {written}");
    let finding = if written < total {
        Diagnostic::error("axis-count", message)
    } else {
        Diagnostic::warning("axis-count", message)
    };
    Some(finding.at(index, pose.span, format!("{written} of {total}")))
}

fn metres(index: usize, targets: &[&Target]) -> Option<Diagnostic> {
    let near = |target: &&&Target| {
        cartesian(target).is_some_and(|numbers| {
            let [x, y, z] = numbers.position.each_ref().map(|field| field.value);
            let distance = x.hypot(y).hypot(z);
            distance > 0.0 && distance < NEAREST_POSITION_MM && in_base_frame(target)
        })
    };
    let first = targets.iter().find(near)?;
    let count = targets.iter().filter(near).count();
    let message =
        format!("{count} positions lie within {NEAREST_POSITION_MM} mm of the robot's base: are they in metres?");
    let help = "positions of a JOB are millimetres";
    Some(Diagnostic::warning("unit-scale", message).at(index, first.span, "in metres?").help(help))
}

fn cartesian(target: &Target) -> Option<&CartesianNumbers> {
    match &target.value {
        TargetValue::Cartesian(numbers) => Some(numbers),
        _ => None,
    }
}

fn in_base_frame(target: &Target) -> bool {
    target.uses.iter().all(|used| used.frame == Reference::Unnamed)
}

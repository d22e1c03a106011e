//! What looks wrong in a job: a missing end, too few axes, positions in metres, a base that may travel.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::target::{CartesianNumbers, Program, Reference, Target, TargetValue};

use super::expression::Goal;
use super::header::Header;
use super::reader::JobFile;
use super::target::ROBOT_AXES;
use super::written_pose::{Coordinates, WrittenPose};

/// No arm puts its tool this near to the origin of its base: such a position is in metres.
const NEAREST_POSITION_MM: f64 = 10.0;

/// A job ends with `END`. One that stops without it, right behind a pose that may lack its suffix, cannot be trusted:
/// joint values without their `A` read as base coordinates.
pub(super) fn end(index: usize, source: &Source, file: &JobFile, diagnostics: &mut Vec<Diagnostic>) {
    if file.ends || (file.header.line.is_none() && file.motions.is_empty()) {
        return;
    }
    let last = match file.motions.last() {
        Some((statement, motion)) if statement.span == file.last_statement => Some(motion),
        _ => None,
    };
    let stops_here = file.last_statement.end == source.bytes().len();
    let finding = match last.and_then(|motion| motion.goal.as_ref().map(|goal| (goal, motion.goal_ends_statement))) {
        // Has its own finding.
        Some((Goal::Broken(_), _)) => return,
        Some((Goal::Written(pose), true)) if stops_here && may_lack_suffix(source, pose.span, &pose.coordinates) => {
            Diagnostic::error("truncated", "the job stops behind a pose whose coordinate suffix may be cut off")
        }
        _ => Diagnostic::warning("missing-end", "the job has no END: it may have been cut off"),
    };
    let at_end = Span::new(source.bytes().len(), source.bytes().len());
    let place = if stops_here { file.last_statement } else { at_end };
    diagnostics.push(finding.at(index, place, "the text stops here"));
}

fn may_lack_suffix(source: &Source, pose: Span, coordinates: &Coordinates) -> bool {
    let bracketed = source.slice(pose).first() == Some(&b'(');
    bracketed && matches!(coordinates, Coordinates::Base | Coordinates::User(_))
}

/// Checks the positions of one file.
pub(super) fn targets(index: usize, header: &Header, program: &mut Program) {
    let mut findings = Vec::new();
    let targets: Vec<&Target> = program.targets.iter().filter(|target| target.file == index).collect();
    findings.extend(metres(index, &targets));
    let in_base = |target: &&&Target| cartesian(target).is_some() && in_base_frame(target);
    if header.auxiliary_axes.is_some_and(|count| count > 0)
        && let Some(first) = targets.iter().find(in_base)
    {
        let message =
            "the job has additional axes: base coordinates are taken for those of a robot that does not travel";
        findings.push(Diagnostic::note("travel-axis", message).at(index, first.span, ""));
    }
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

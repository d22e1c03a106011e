//! What looks wrong in a job: positions that are cut off, a missing end, metres, calls out of the job.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Span;
use crate::program::flow::States;
use crate::program::scan::Cursor;
use crate::program::target::{Reference, Target, TargetValue};

use super::aggregate::aggregate;
use super::job::{Job, Kind};
use super::setting::{BASE, FOREIGN, SETTINGS, TOOL};
use super::targets::Targets;

/// Fewer targets than this say nothing about their unit.
const MIN_TARGETS: usize = 5;
/// An arm reaches metres: coordinates that all stay below this many millimetres are metres.
const METRES_BELOW: f64 = 5.0;

/// Says where the braces of declared and assigned values do not close.
pub(super) fn open_values(job: &Job<'_>, targets: &mut Targets<'_, '_>) {
    for routine in &job.routines {
        for statement in &routine.statements {
            if !matches!(statement.kind, Kind::Declaration | Kind::Assignment) {
                continue;
            }
            let bytes = job.bytes(statement.file);
            let text = &bytes[statement.span.start..statement.span.end];
            let Some(brace) = text.iter().position(|&byte| byte == b'{') else { continue };
            let mut cursor = Cursor::new(bytes, Span::new(statement.span.start + brace, statement.span.end));
            let before = text[..brace].trim_ascii_end();
            if before.last() == Some(&b'=')
                && let Err(unclosed) = aggregate(bytes, &mut cursor)
            {
                targets.broken(statement.file, unclosed);
            }
        }
    }
}

/// Says once that tool and base are taken to stay over calls of routines that the job does not hold.
pub(super) fn foreign_calls(job: &Job<'_>, states: &States<SETTINGS>) -> Option<Diagnostic> {
    let motions = job.routines.iter().zip(states).flat_map(|(routine, states)| routine.statements.iter().zip(states));
    let mut over_calls =
        motions.filter(|(statement, _)| statement.kind == Kind::Motion).filter_map(|(statement, state)| {
            let set = [TOOL, BASE].iter().any(|&index| matches!(state.get(index), Reference::Named(_)));
            match state.get(FOREIGN) {
                Reference::Named(routine) if set => Some((statement, routine.clone())),
                _ => None,
            }
        });
    let (statement, routine) = over_calls.next()?;
    let message =
        format!("`{routine}` is not in the files of this job: it is taken to leave $TOOL and $BASE as they are");
    Some(Diagnostic::note("foreign-call", message).at(statement.file, statement.span, "this motion comes after it"))
}

/// Routines and data lists without their end.
pub(super) fn open_ends(job: &Job<'_>) -> Vec<Diagnostic> {
    let finding = |&(file, span): &(usize, Span)| {
        Diagnostic::warning("missing-end", "this has no END: the file may have been cut off").at(file, span, "")
    };
    job.open_ends.iter().map(finding).collect()
}

/// Positions that are metres.
pub(super) fn metres(targets: &[Target]) -> Option<Diagnostic> {
    let (mut count, mut small, mut fractions) = (0, true, false);
    let mut first = None;
    for target in targets.iter().filter(|target| target.computed.is_none()) {
        let TargetValue::Cartesian(numbers) = &target.value else { continue };
        first.get_or_insert(target);
        count += 1;
        small &= numbers.position.iter().all(|field| field.value.abs() < METRES_BELOW);
        fractions |= numbers.position.iter().any(|field| field.decimals() > 0 && field.value != 0.0);
    }
    let first = first.filter(|_| count >= MIN_TARGETS && small && fractions)?;
    let message = format!("all {count} positions lie within {METRES_BELOW} mm of their bases: are they in metres?");
    Some(Diagnostic::warning("unit-scale", message).at(first.file, first.span, "KRL counts in millimetres"))
}

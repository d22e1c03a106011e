//! What a correction says on standard error: what was found, what was left alone, and why.

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::text::Source;
use crate::program::target::Target;
use crate::report::tally::Tally;
use crate::rewrite::class::Class;
use crate::rewrite::outcome::{Outcome, TargetOutcome};

use super::console::Console;
use super::job::Loaded;

/// Targets of one kind that are listed one by one; the rest is counted (the report has them all).
const LISTED: usize = 20;
/// Lines of moves named beside a target.
const LINES: usize = 4;

/// Says what happened to the targets of a program.
pub fn targets(console: &Console, loaded: &Loaded, outcome: &Outcome) {
    let Loaded { sources, program, .. } = loaded;
    let is_own = |finding: &&Diagnostic| finding.place.as_ref().is_none_or(|place| place.file < loaded.own);
    for diagnostic in program.diagnostics.iter().filter(is_own) {
        console.diagnostic(sources, diagnostic);
    }
    for class in [Class::Refused, Class::Computed, Class::Joint] {
        let of_class = || {
            let all = outcome.targets.iter().zip(&program.targets);
            all.filter(move |(result, target)| result.class == class && program.concerns(target))
        };
        let count = of_class().count();
        if class == Class::Joint && count > 0 {
            console.say(&format!("{count} joint target(s) left alone; --joint-targets corrects them"));
            continue;
        }
        for (result, target) in of_class().take(LISTED) {
            console.diagnostic(sources, &finding(sources, result, target));
        }
        if count > LISTED {
            console.say(&format!("... and {} more {}; --report lists them all", count - LISTED, class.word()));
        }
    }
    console.say(&summary(sources[0].name(), &Tally::of(program, outcome, loaded.own)));
}

fn finding(sources: &[Source], result: &TargetOutcome, target: &Target) -> Diagnostic {
    let name = target.name.as_deref().map(|name| format!("`{name}` ")).unwrap_or_default();
    let reason = result.reason.as_deref().unwrap_or_default();
    let (severity, fate) = match result.class {
        Class::Refused => (Severity::Error, "refused"),
        _ => (Severity::Warning, "left alone"),
    };
    let message = format!("target {name}{fate}: {reason}");
    let finding = Diagnostic { severity, ..Diagnostic::error(result.class.word(), message) };
    finding.at(target.file, target.span, used_in(sources, target))
}

/// The lines of the moves that go there, where they are other lines than the target's own.
fn used_in(sources: &[Source], target: &Target) -> String {
    let own = sources[target.file].line(target.span.start);
    let mut lines: Vec<usize> = Vec::new();
    for one in &target.uses {
        let line = sources[one.file].line(one.span.start);
        if (one.file != target.file || line != own) && !lines.contains(&line) {
            lines.push(line);
        }
    }
    let named: Vec<String> = lines.iter().take(LINES).map(usize::to_string).collect();
    match lines.len() {
        0 => String::new(),
        1 => format!("used in line {}", named[0]),
        count if count <= LINES => format!("used in lines {}", named.join(", ")),
        count => format!("used in lines {} and {} more", named.join(", "), count - LINES),
    }
}

fn summary(name: &str, tally: &Tally) -> String {
    format!(
        "{name}: {} corrected (by {:.3} mm in the mean, {:.3} mm at most), {} joint, {} computed, {} refused",
        tally.corrected,
        tally.mean_mm(),
        tally.largest_mm(),
        tally.joint,
        tally.computed,
        tally.refused
    )
}

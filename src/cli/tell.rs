//! What a correction says on standard error: what was found, what was left alone, and why.

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::text::Source;
use crate::program::target::Target;
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
    for diagnostic in &program.diagnostics {
        console.diagnostic(sources, diagnostic);
    }
    for class in [Class::Refused, Class::Computed, Class::Joint] {
        let of_class = || outcome.targets.iter().zip(&program.targets).filter(move |(result, _)| result.class == class);
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
    console.say(&summary(sources[0].name(), outcome));
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

fn summary(name: &str, outcome: &Outcome) -> String {
    let corrections: Vec<f64> = outcome
        .targets
        .iter()
        .filter_map(|target| target.figures.as_ref())
        .map(|figures| figures.correction_m)
        .collect();
    // An empty sum is -0.0.
    let mean_mm = (corrections.iter().sum::<f64>() + 0.0) / corrections.len().max(1) as f64 * 1e3;
    let largest_mm = corrections.iter().copied().fold(0.0, f64::max) * 1e3;
    format!(
        "{name}: {} corrected (by {mean_mm:.3} mm in the mean, {largest_mm:.3} mm at most), {} joint, {} computed, {} refused",
        outcome.count(Class::Corrected),
        outcome.count(Class::Joint),
        outcome.count(Class::Computed),
        outcome.count(Class::Refused)
    )
}

//! Findings about the numbers of targets: quaternions that are none, metres where millimetres belong.

use crate::base::diagnostic::Diagnostic;
use crate::program::target::{Reference, Target, TargetValue};

/// How far the length of a quaternion may be from one. Real programs with four decimals stay below 1e-4; a controller
/// refuses what is not a unit quaternion, and beyond this the numbers are not one rounded.
const MAX_LENGTH_ERROR: f64 = 0.01;
/// Fewer targets than this say nothing about their unit in a work object.
const MIN_TARGETS: usize = 5;
/// An arm reaches metres: coordinates that all stay below this many millimetres are metres.
const METRES_BELOW: f64 = 5.0;

/// Findings about all targets of a job.
pub fn check_numbers(targets: &[Target]) -> Vec<Diagnostic> {
    let mut findings = Vec::new();
    let (mut count, mut small, mut fractions, mut from_base) = (0, true, false, true);
    for target in targets {
        let TargetValue::Cartesian(numbers) = &target.value else { continue };
        let length = numbers.orientation.iter().map(|field| field.value * field.value).sum::<f64>().sqrt();
        if (length - 1.0).abs() > MAX_LENGTH_ERROR {
            let message = format!("the quaternion has length {length:.4}, a rotation has length 1");
            findings.push(Diagnostic::error("quaternion", message).at(target.file, target.span, "this target"));
        }
        count += 1;
        from_base &= target.uses.iter().all(|used| is_base(&used.frame));
        small &= numbers.position.iter().all(|field| field.value.abs() < METRES_BELOW);
        fractions |= numbers.position.iter().any(|field| field.decimals() > 0 && field.value != 0.0);
    }
    // No arm reaches into its own base, so that there one target is enough.
    let telling = count >= MIN_TARGETS || count > 0 && from_base;
    if let (true, Some(first)) = (telling && small && fractions, targets.first()) {
        let message = format!("all {count} targets lie within {METRES_BELOW} mm of their frames: are they in metres?");
        let warning = Diagnostic::warning("unit-scale", message).at(first.file, first.span, "RAPID counts in mm");
        findings.push(warning);
    }
    findings
}

fn is_base(frame: &Reference) -> bool {
    matches!(frame, Reference::Named(name) if name.eq_ignore_ascii_case("wobj0"))
}

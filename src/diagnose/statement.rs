//! A diagnosis in sentences.

use super::diagnosis::{Diagnosis, Finding, Unexplained, Verdict};

/// The first sentence of a diagnosis: what a person wants to know.
pub fn headline(diagnosis: &Diagnosis<'_>) -> String {
    let (before, after) = (diagnosis.before.held_out_rms_mm, diagnosis.after.held_out_rms_mm);
    let noise_mm = 1e3 * diagnosis.noise_sigma_m * 3f64.sqrt();
    match diagnosis.verdict {
        Verdict::NothingMissing => format!(
            "Nothing is missing: what the refitted model leaves ({before:.3} mm RMS held out) is noise without structure."
        ),
        Verdict::Explained | Verdict::PartlyExplained => {
            let first = diagnosis.findings.first().map_or_else(String::new, of_finding);
            let more = match diagnosis.findings.len() {
                0 | 1 => String::new(),
                count => format!(" {} more found.", count - 1),
            };
            format!("{first}{more} All together: held-out RMS {before:.3} -> {after:.3} mm (noise {noise_mm:.3}).")
        }
        Verdict::Unexplained => diagnosis.unexplained.as_ref().map_or_else(String::new, of_unexplained),
    }
}

/// A finding in a sentence.
pub fn of_finding(finding: &Finding) -> String {
    let meta = finding.instance.effect.meta();
    let values = finding.values.iter().map(|value| format!("{} {}", value.name, with_unit(value.value, value.unit)));
    let order = finding.order_95.map(|[low, high]| format!("order between {low:.2} and {high:.2}"));
    let numbers: Vec<String> = values.chain(order).collect();
    let [before, after] = finding.held_out_rms_mm;
    format!(
        "{}: {} ({}): {:.0} % of the remaining error; held-out RMS {before:.3} -> {after:.3} mm.",
        capitalised(&finding.instance.location.to_string()),
        meta.title,
        numbers.join(", "),
        100.0 * finding.share,
    )
}

/// Structure without a name in a sentence.
pub fn of_unexplained(unexplained: &Unexplained) -> String {
    format!(
        "{:.3} mm RMS at the {} follow {} in a way that no known effect has.",
        unexplained.rms_mm,
        unexplained.place(),
        unexplained.depends_on().join(" and ")
    )
}

fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "rad" => format!("{:.3} mrad", 1e3 * value),
        "m" => format!("{:.3} mm", 1e3 * value),
        "s" => format!("{:.3} ms", 1e3 * value),
        "1" => format!("{value:.2e}"),
        _ => format!("{value:.3e} {unit}"),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

//! A diagnosis in sentences.

use crate::measure::recording::Kind;

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
    let numbers: Vec<String> =
        finding.values.iter().map(|value| format!("{} {}", value.name, with_unit(value.value, value.unit))).collect();
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
        unexplained.location(),
        unexplained.depends_on().join(" and ")
    )
}

/// What to measure to settle what this recording leaves open: why, what.
pub fn next_measurements(diagnosis: &Diagnosis<'_>) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for finding in &diagnosis.findings {
        let name = finding.instance.effect.meta().id;
        for rival in &finding.alternatives {
            let why = format!(
                "{name} at the {} and {} at the {} explain these records equally well",
                finding.instance.location, rival.effect, rival.location
            );
            all.push((why, separating(name, rival.effect)));
        }
    }
    if let Some(unexplained) = &diagnosis.unexplained {
        let variables = unexplained.depends_on().join(" and ");
        let why = format!("structure at the {} follows {variables} and has no name", unexplained.location());
        let what = format!(
            "move {variables} alone through the whole range in 40 stops, all else still; once more with no payload and \
             once from the other side"
        );
        all.push((why, what));
    }
    if diagnosis.findings.is_empty() && diagnosis.kind == Kind::Static {
        let floor = 1e3 * diagnosis.noise_sigma_m;
        let why = format!("effects below about {:.3} mm would not show in this recording", 0.3 * floor);
        let what = "twice as many poses, ten of them repeated five times and from both sides, some without payload";
        all.push((why, what.into()));
    }
    all
}

/// The measurement that tells two effects apart.
fn separating(one: &str, other: &str) -> String {
    let either = |id: &str| one == id || other == id;
    let text = if either("backlash") && either("friction_windup") {
        "stop at 10 poses from both sides of that joint, five with its axis tilted so that gravity loads it (or push the \
         arm by hand): play then takes the side of the load, wind-up stays with the approach"
    } else if either("drift") || either("step_shift") || either("thermal_growth") {
        "measure three control poses every 25 records, one of them with the arm folded, and a reflector on the base"
    } else if either("base_compliance") {
        "put a reflector on the base and measure it with the arm stretched out in four directions"
    } else if either("payload_error") || either("joint_compliance") || either("joint_stiffening") {
        "15 poses twice, with the full payload and with none"
    } else if either("gravity_tilt") {
        "level the base or measure it with an inclinometer; 12 poses stretched out, every 30 deg of joint 1"
    } else if either("joint_periodic") || either("gear_ratio") || either("joint_coupling") {
        "turn that joint alone through its whole range in 72 stops, once with payload and once without"
    } else if either("servo_lag") || either("time_offset") || either("inertial_deflection") {
        "the same path at half and at full speed, and back again"
    } else {
        "the same poses with another payload, from the other side, and in another order"
    };
    text.into()
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

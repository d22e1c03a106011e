//! The page of a diagnosis.

use crate::diagnose::diagnosis::Verdict;
use crate::model::effect::{Location, by_id};
use crate::report::diagnosis::{DiagnosisReport, ErrorPart, FindingPart, probability};
use crate::report::sketch::Sketch;
use crate::report::trace::Trace;

use super::arm::{Mark, arm};
use super::bars::{Bar, bars};
use super::markup::{Markup, short};
use super::scatter::{Cloud, Scatter};
use super::{page, tile};

/// What the page of a diagnosis shows.
pub struct DiagnosisPage<'a> {
    /// The robot's name.
    pub robot: &'a str,
    /// The recordings' names.
    pub recordings: &'a [String],
    /// The diagnosis.
    pub report: &'a DiagnosisReport,
    /// A trace for each finding, in their order.
    pub traces: &'a [Trace],
    /// What is left without a name, against what it depends on.
    pub unexplained: &'a [Trace],
    /// The arm.
    pub sketch: Option<&'a Sketch>,
}

/// Colours of findings in the bars, in turn.
const COLOURS: [&str; 4] = ["blue", "orange", "green", "violet"];
/// Outliers named one by one.
const LISTED: usize = 60;

/// Writes the page.
pub fn diagnosis(shown: &DiagnosisPage<'_>) -> String {
    let report = shown.report;
    let mut body = Markup::default();
    let class = match report.verdict {
        Verdict::NothingMissing | Verdict::Explained => "class=\"first good\"",
        Verdict::PartlyExplained => "class=\"first\"",
        Verdict::Unexplained => "class=\"first bad\"",
    };
    body.element("p", class, &report.statement);
    tiles(report, &mut body);
    body.raw("<div class=\"side\">\n");
    if let Some(sketch) = shown.sketch {
        body.raw("<figure>\n");
        arm(sketch, &marks(report), &mut body);
        body.element("figcaption", "", "The arm from the side in one of the recorded poses; findings by their number.");
        body.raw("</figure>\n");
    }
    contributions(report, &mut body);
    body.raw("</div>\n");
    findings(shown, &mut body);
    unexplained(shown, &mut body);
    rest(report, &mut body);
    page("Diagnosis", &format!("{}, {}", shown.robot, shown.recordings.join(", ")), body)
}

fn tiles(report: &DiagnosisReport, body: &mut Markup) {
    let noise_mm = report.recording.noise_sigma_mm * 3f64.sqrt();
    body.raw("<div class=\"tiles\">\n");
    tile(&format!("{} mm", short(report.before.heldout_rms_mm)), "held-out RMS, refitted model as given", body);
    if !report.findings.is_empty() {
        tile(&format!("{} mm", short(report.after.heldout_rms_mm)), "held-out RMS with the findings", body);
    }
    tile(&format!("{} mm", short(noise_mm)), "RMS of the measuring noise", body);
    let records = format!("{} of {}", report.recording.used, report.recording.records);
    tile(&records, &format!("{} records used", report.recording.kind), body);
    body.raw("</div>\n");
}

fn marks(report: &DiagnosisReport) -> Vec<Mark> {
    let named = report.findings.iter().enumerate();
    let mut marks: Vec<Mark> =
        named.map(|(index, finding)| Mark { location: finding.location, word: (index + 1).to_string() }).collect();
    marks.extend(report.unexplained.iter().map(|one| Mark { location: one.location, word: "?".into() }));
    marks
}

fn title(effect: &str, location: &Location) -> String {
    let title = by_id(effect).map_or(effect, |effect| effect.meta().title);
    format!("{location}: {title}")
}

/// What each finding explains, what is left without a name, and noise: in squares of the error before.
fn contributions(report: &DiagnosisReport, body: &mut Markup) {
    let mut rows: Vec<Bar> = report
        .findings
        .iter()
        .enumerate()
        .map(|(index, finding)| Bar {
            name: format!("{}  {} ({})", index + 1, finding.effect, finding.location),
            value: finding.share,
            words: format!("{:.1} %", 100.0 * finding.share),
            colour: COLOURS[index % COLOURS.len()],
        })
        .collect();
    let left = (1.0 - report.findings.iter().map(|finding| finding.share).sum::<f64>()).clamp(0.0, 1.0);
    let squares = (report.before.rms_mm * report.before.rms_mm).max(f64::MIN_POSITIVE);
    let nameless = report.unexplained.as_ref().map_or(0.0, |one| (one.rms_mm * one.rms_mm / squares).min(left));
    let mut further = |name: String, value: f64, colour| {
        rows.push(Bar { name, value, words: format!("{:.1} %", 100.0 * value), colour });
    };
    if let Some(unexplained) = &report.unexplained {
        further(format!("?  without a name ({})", unexplained.location), nameless, "red");
    }
    further("noise".into(), left - nameless, "grey");
    body.raw("<figure>\n");
    bars("shares of the error", 1.0, &rows, body);
    body.element("figcaption", "", "Shares of the remaining error of the refitted model, in squares.");
    body.raw("</figure>\n");
}

fn findings(shown: &DiagnosisPage<'_>, body: &mut Markup) {
    let report = shown.report;
    if report.findings.is_empty() {
        return;
    }
    body.element("h2", "", "Findings");
    let rows: Vec<Vec<String>> = report
        .findings
        .iter()
        .enumerate()
        .map(|(index, finding)| {
            vec![
                (index + 1).to_string(),
                finding.effect.to_string(),
                finding.location.to_string(),
                parameters(finding),
                format!("{:.1}", 100.0 * finding.share),
                short(finding.evidence.heldout_rms_before_mm),
                short(finding.evidence.heldout_rms_after_mm),
                probability(finding.evidence.p_value),
            ]
        })
        .collect();
    let heads = ["", "effect", "at", "value (95 % interval)", "share, %", "held out without, mm", "with, mm", "p"];
    body.table(&heads, 4, &rows);
    for (index, finding) in report.findings.iter().enumerate() {
        body.element("h3", "", &format!("{}  {}", index + 1, title(finding.effect, &finding.location)));
        body.element("p", "", &finding.statement);
        if let Some(effect) = by_id(finding.effect) {
            body.element("p", "class=\"note\"", &format!("Signature: {}.", effect.meta().signature));
        }
        if !finding.alternatives.is_empty() {
            let all: Vec<String> =
                finding.alternatives.iter().map(|one| format!("{} ({})", one.effect, one.location)).collect();
            body.element("p", "", &format!("This recording cannot tell it from: {}.", all.join("; ")));
        }
        if let Some(trace) = shown.traces.get(index) {
            before_and_after(trace, body);
        }
    }
}

fn parameters(finding: &FindingPart) -> String {
    let all: Vec<String> = finding
        .parameters
        .iter()
        .map(|one| {
            let [low, high] = one.ci95.map(short);
            let unit = if one.unit == "1" { "" } else { one.unit };
            format!("{} {} ({low} to {high}) {unit}", one.name, short(one.value))
        })
        .collect();
    all.join("; ")
}

fn before_and_after(trace: &Trace, body: &mut Markup) {
    if trace.points.is_empty() {
        return;
    }
    let senses: &[(i8, &str, &str)] = if trace.points.iter().any(|point| point.sense != 0) {
        &[(1, "from below", "blue"), (-1, "from above", "orange"), (0, "not known", "grey")]
    } else {
        &[(0, "", "blue")]
    };
    let holds: Vec<f64> = trace.points.iter().flat_map(|point| [point.before, point.after]).collect();
    body.raw("<figure class=\"side\">\n");
    for (title, after) in [("without the finding", false), ("with it", true)] {
        let clouds = senses
            .iter()
            .map(|(sense, name, colour)| Cloud {
                name: if trace.points.iter().any(|point| point.sense == *sense) { name } else { "" },
                colour,
                points: trace
                    .points
                    .iter()
                    .filter(|point| point.sense == *sense)
                    .map(|point| (point.x, if after { point.after } else { point.before }, point.id.as_str()))
                    .collect(),
            })
            .collect();
        let (x_label, y_label) = (trace.against.as_str(), trace.error.as_str());
        Scatter { title, x_label, y_label, clouds, y_holds: holds.clone() }.draw(body);
    }
    body.raw("</figure>\n");
}

fn unexplained(shown: &DiagnosisPage<'_>, body: &mut Markup) {
    let Some(unexplained) = &shown.report.unexplained else { return };
    body.element("h2", "", "Without a name");
    body.element("p", "", &unexplained.statement);
    let p = format!("p: {}; it depends on {}.", probability(unexplained.p_value), unexplained.depends_on.join(", "));
    body.element("p", "class=\"note\"", &p);
    if let Some(learned) = &unexplained.learned {
        body.element("p", "class=\"note\"", &learned.statement());
    }
    body.raw("<figure class=\"side\">\n");
    for trace in shown.unexplained {
        let points = trace.points.iter().map(|point| (point.x, point.after, point.id.as_str())).collect();
        let clouds = vec![Cloud { name: "", colour: "red", points }];
        let (x_label, y_label) = (trace.against.as_str(), trace.error.as_str());
        Scatter { title: "what is left", x_label, y_label, clouds, y_holds: Vec::new() }.draw(body);
    }
    if let [one, other] = shown.unexplained
        && one.points.iter().any(|point| point.after < 0.0)
    {
        map(one, other, body);
    }
    body.raw("</figure>\n");
}

/// What is left over the plane of two variables: what is a pattern there need show in neither alone.
fn map(one: &Trace, other: &Trace, body: &mut Markup) {
    let cloud = |name, colour, positive: bool| Cloud {
        name,
        colour,
        points: one
            .points
            .iter()
            .zip(&other.points)
            .filter(|(point, _)| (point.after >= 0.0) == positive)
            .map(|(point, across)| (point.x, across.x, point.id.as_str()))
            .collect(),
    };
    let clouds = vec![cloud("further than modelled", "blue", true), cloud("less far", "orange", false)];
    let (x_label, y_label) = (one.against.as_str(), other.against.as_str());
    Scatter { title: "its sign", x_label, y_label, clouds, y_holds: Vec::new() }.draw(body);
}

fn rest(report: &DiagnosisReport, body: &mut Markup) {
    if !report.outliers.is_empty() {
        body.element("h2", "", "Gross errors");
        let named: Vec<&str> = report.outliers.iter().take(LISTED).map(String::as_str).collect();
        let more = report.outliers.len().saturating_sub(LISTED);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        body.element("p", "", &format!("Left out: records {}{more}.", named.join(", ")));
    }
    if !report.next_measurements.is_empty() {
        body.element("h2", "", "What to measure next");
        let rows: Vec<Vec<String>> =
            report.next_measurements.iter().map(|next| vec![next.what.clone(), next.why.clone()]).collect();
        body.table(&["measure", "because"], 2, &rows);
    }
    let sides = |name: &str, part: &ErrorPart| {
        let mut row = vec![name.to_string()];
        row.extend([part.mean_mm, part.rms_mm, part.max_mm, part.heldout_rms_mm].map(short));
        row
    };
    body.element("h2", "", "Figures");
    let rows = [sides("refitted model as given", &report.before), sides("with the findings", &report.after)];
    body.table(&["distances, mm", "mean", "RMS", "largest", "held-out RMS"], 1, &rows);
}

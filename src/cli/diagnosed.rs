//! What a diagnosis says on a terminal: the sentence that a person reads first, then the findings, the largest first.

use crate::diagnose::diagnosis::Verdict;
use crate::identify::station_report::StationReport;
use crate::report::diagnosis::{DiagnosisReport, FindingPart, LearnedPart, probability};

use super::console::{Console, Tone};

/// Says it.
pub fn tell(report: &DiagnosisReport, console: &Console) {
    let tone = match report.verdict {
        Verdict::NothingMissing | Verdict::Explained => Tone::Good,
        Verdict::PartlyExplained => Tone::Mixed,
        Verdict::Unexplained => Tone::Bad,
    };
    console.say(&console.toned(tone, &report.statement));
    if !report.findings.is_empty() {
        table(&report.findings, console);
    }
    if let Some(unexplained) = &report.unexplained {
        console.say(&format!("without a name: {}", unexplained.statement));
        let not_learned = || "The updated model has no part for it.".to_string();
        console.say(&unexplained.learned.as_ref().map_or_else(not_learned, LearnedPart::statement));
    }
    for note in report.stations.iter().filter_map(StationReport::note) {
        console.say(&note);
    }
    if !report.outliers.is_empty() {
        console.say(&format!("left out: records {}", report.outliers.join(", ")));
    }
    for next in &report.next_measurements {
        console.say(&format!("next: {}, because {}", next.what, next.why));
    }
}

fn table(findings: &[FindingPart], console: &Console) {
    let rows: Vec<[String; 5]> = findings
        .iter()
        .map(|finding| {
            let evidence = &finding.evidence;
            let held_out = format!("{:.3} -> {:.3}", evidence.heldout_rms_before_mm, evidence.heldout_rms_after_mm);
            [
                format!("{:.1} %", 100.0 * finding.share),
                finding.effect.to_string(),
                finding.location.to_string(),
                held_out,
                probability(evidence.p_value),
            ]
        })
        .collect();
    let heads = ["share", "effect", "at", "held-out RMS, mm", "p"];
    let wide: [usize; 5] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].len()).fold(heads[column].len(), usize::max));
    let line = |cells: [&str; 5]| {
        let [share, effect, at, held_out, p] = cells;
        let text = format!(
            "  {share:>0$}  {effect:<1$}  {at:<2$}  {held_out:<3$}  {p:<4$}",
            wide[0], wide[1], wide[2], wide[3], wide[4]
        );
        text.trim_end().to_string()
    };
    console.say(&console.toned(Tone::Quiet, &line(heads)));
    for (row, finding) in rows.iter().zip(findings) {
        console.say(&line(row.each_ref().map(String::as_str)));
        let aside = " ".repeat(wide[0] + 4);
        for value in &finding.parameters {
            let [low, high] = value.ci95;
            let unit = if value.unit == "1" { "" } else { value.unit };
            console.say(&format!("{aside}{} {:.3e} ({low:.3e} to {high:.3e}) {unit}", value.name, value.value));
        }
        for rival in &finding.alternatives {
            console.say(&format!("{aside}or {} at the {}: this recording cannot tell", rival.effect, rival.location));
        }
    }
}

//! The page of a calibration.

use crate::identify::report::{Figures, ParameterReport, Report, ResidualReport};

use super::bars::{Bar, bars};
use super::markup::{Markup, short};
use super::residuals::{Lengths, coordinates, lengths};
use super::{page, tile};

/// Writes the page.
pub fn calibration(report: &Report) -> String {
    let mut body = Markup::default();
    body.element("p", "class=\"first\"", &sentence(report));
    tiles(report, &mut body);
    for note in &report.notes {
        body.element("p", "class=\"note\"", note);
    }
    stages(report, &mut body);
    left(report, &mut body);
    numbers(report, &mut body);
    identifiability(report, &mut body);
    records(report, &mut body);
    let names: Vec<&str> = report.recordings.iter().map(|recording| recording.name.as_str()).collect();
    page("Calibration", &format!("{}, {}", report.robot, names.join(", ")), body)
}

/// The figures that count: those of records that the fit did not see, where there are any.
fn judged(report: &Report, stage: usize) -> Option<Figures> {
    let stage = report.stages.get(stage)?;
    stage.validate.or(stage.identify)
}

fn sentence(report: &Report) -> String {
    let last = report.stages.len().saturating_sub(1);
    match (judged(report, 0), judged(report, last), report.stages.last().is_some_and(|stage| stage.validate.is_some()))
    {
        (Some(first), Some(found), held_out) => format!(
            "From {} to {} mm in the mean ({} to {} mm at most) over {} records{}.",
            short(first.mean_mm),
            short(found.mean_mm),
            short(first.max_mm),
            short(found.max_mm),
            found.records,
            if held_out { " that the fit did not see" } else { ", the very ones of the fit" },
        ),
        _ => "Nothing to compare.".into(),
    }
}

fn tiles(report: &Report, body: &mut Markup) {
    body.raw("<div class=\"tiles\">\n");
    tile(&format!("{} mm", short(report.rest.noise_sigma_mm)), "noise per axis", body);
    tile(&format!("{} mm", short(report.rest.unexplained_sigma_mm)), "per axis that the model does not explain", body);
    let rank = format!("{} of {}", report.observability.rank, report.observability.unknowns);
    tile(&rank, "numbers that the records determine", body);
    tile(&short(report.observability.condition), "condition number", body);
    tile(&report.left_out.len().to_string(), "records left out", body);
    body.raw("</div>\n");
}

fn stages(report: &Report, body: &mut Markup) {
    body.element("h2", "", "Stage by stage");
    let cells = |figures: &Option<Figures>| -> Vec<String> {
        let numbers = figures.map(|one| [one.mean_mm, one.rms_mm, one.max_mm].map(short));
        numbers.map_or_else(|| vec!["-".to_string(); 3], |numbers| numbers.to_vec())
    };
    let trained = report.stages.iter().any(|stage| stage.train.is_some());
    let rows: Vec<Vec<String>> = report
        .stages
        .iter()
        .map(|stage| {
            let mut row = vec![stage.name.replace('_', " "), stage.free.to_string()];
            row.extend(cells(&stage.identify));
            row.extend(if trained { cells(&stage.train) } else { Vec::new() });
            row.extend(cells(&stage.validate));
            row
        })
        .collect();
    let mut heads = vec!["distances, mm", "free", "identify: mean", "RMS", "largest"];
    heads.extend(if trained { &["train: mean", "RMS", "largest"][..] } else { &[] });
    heads.extend(["validate: mean", "RMS", "largest"]);
    body.table(&heads, 1, &rows);
    let means: Vec<(String, f64)> = (0..report.stages.len())
        .filter_map(|index| Some((report.stages[index].name.replace('_', " "), judged(report, index)?.mean_mm)))
        .collect();
    let full = means.iter().map(|mean| mean.1).fold(0.0, f64::max);
    let rows: Vec<Bar> = means
        .into_iter()
        .map(|(name, value)| Bar { name, value, words: format!("{} mm", short(value)), colour: "blue" })
        .collect();
    body.raw("<figure>\n");
    bars("mean distance by stage", full, &rows, body);
    body.raw("</figure>\n");
}

fn left(report: &Report, body: &mut Markup) {
    body.element("h2", "", "What is left");
    let of_set = |wanted: Option<&str>| -> Vec<(usize, f64, &str)> {
        let own = |(place, residual): (usize, &'_ ResidualReport)| {
            (place + 1, residual.length_mm, residual.used, residual.set)
        };
        report
            .residuals
            .iter()
            .enumerate()
            .map(|(place, residual)| (own((place, residual)), residual.id.as_str()))
            .filter(|((_, _, used, set), _)| *used && *set == wanted)
            .map(|((place, length, ..), id)| (place, length, id))
            .collect()
    };
    let sets = [
        (Some("identify"), "identify", "blue"),
        (Some("train"), "train", "violet"),
        (Some("validate"), "validate", "orange"),
        (None, "in no set", "grey"),
    ];
    let sets: Vec<Lengths<'_>> =
        sets.into_iter().map(|(set, name, colour)| Lengths { name, colour, records: of_set(set) }).collect();
    let sets: Vec<Lengths<'_>> = sets.into_iter().filter(|set| !set.records.is_empty()).collect();
    let last = report.stages.last().and_then(|stage| stage.validate.or(stage.identify));
    let marks: Vec<(f64, &str)> =
        last.map(|figures| vec![(figures.mean_mm, "mean"), (figures.p95_mm, "95 %")]).unwrap_or_default();
    lengths(&sets, &marks, body);
    let used = report.residuals.iter().filter(|residual| residual.used);
    let records: Vec<([f64; 3], &str)> = used.map(|residual| (residual.residual_mm, residual.id.as_str())).collect();
    coordinates(&records, body);
}

fn numbers(report: &Report, body: &mut Markup) {
    body.element("h2", "", "Identified numbers");
    let row = |one: &ParameterReport| {
        vec![
            one.name.clone(),
            one.unit.to_string(),
            short(one.value),
            short(one.sigma),
            short(one.magnitude_mm),
            one.inflation.map_or_else(|| "\u{221e}".into(), short),
            format!("{:.2}", one.remaining),
        ]
    };
    let rows: Vec<Vec<String>> = report.parameters.iter().map(row).collect();
    body.table(&["number", "unit", "value", "uncertainty", "magnitude, mm", "inflation", "remaining"], 2, &rows);
    let meaning = "Magnitude: what an error of the prior's size does to a coordinate. Inflation: of the variance by the other \
                   numbers. Remaining: uncertainty after over before.";
    body.element("p", "class=\"note\"", meaning);
}

fn identifiability(report: &Report, body: &mut Markup) {
    body.element("h2", "", "What the records can tell");
    if !report.undetermined.is_empty() {
        let all = report.undetermined.join(", ");
        body.element("p", "", &format!("Not told by these records, held near nominal by their priors: {all}."));
    }
    if !report.redundant.is_empty() {
        let rows: Vec<Vec<String>> = report
            .redundant
            .iter()
            .map(|one| {
                let with: Vec<String> = one
                    .coupled_with
                    .iter()
                    .map(|other| format!("{} \u{d7} {}", short(other.factor), other.name))
                    .collect();
                vec![one.name.clone(), with.join(", ")]
            })
            .collect();
        body.table(&["redundant", "a unit of it is the same as"], 2, &rows);
    }
    if !report.correlated.is_empty() {
        let pairs = report.correlated.iter();
        let rows: Vec<Vec<String>> =
            pairs.map(|pair| vec![pair.a.clone(), pair.b.clone(), format!("{:.3}", pair.correlation)]).collect();
        body.table(&["known only together", "with", "correlation"], 2, &rows);
    }
    let indices: Vec<String> = report
        .observability
        .indices
        .iter()
        .enumerate()
        .map(|(index, o)| format!("O{} {}", index + 1, short(*o)))
        .collect();
    body.element("p", "class=\"note\"", &format!("Observability indices: {}.", indices.join(", ")));
}

fn records(report: &Report, body: &mut Markup) {
    if report.left_out.is_empty() {
        return;
    }
    body.element("h2", "", "Records left out");
    let rows: Vec<Vec<String>> = report
        .left_out
        .iter()
        .map(|one| {
            let place = format!("{}, line {}", one.recording, one.line);
            vec![one.id.clone(), place, one.reason.clone(), one.away_mm.map_or_else(|| "-".into(), short)]
        })
        .collect();
    body.table(&["record", "where", "why", "off, mm"], 3, &rows);
}

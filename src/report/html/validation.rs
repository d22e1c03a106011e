//! The page of a validation.

use crate::identify::validate::{Residual, Validation};

use super::markup::{Markup, short};
use super::residuals::{Lengths, coordinates, lengths};
use super::scatter::{Cloud, Scatter};
use super::{page, tile};

/// Records listed one by one: the furthest off.
const WORST: usize = 15;

/// Writes the page of `validation` of this model with this recording.
pub fn validation(model: &str, recording: &str, validation: &Validation) -> String {
    let mut body = Markup::default();
    let (class, verdict) = match validation.passed {
        true => ("class=\"first good\"", "The model holds."),
        false => ("class=\"first bad\"", "The model does not hold."),
    };
    body.element("p", class, verdict);
    for note in &validation.notes {
        body.element("p", "", note);
    }
    tiles(validation, &mut body);
    let rows =
        [("nominal", validation.nominal), ("model", validation.model), ("model, registered", validation.registered)];
    let rows: Vec<Vec<String>> = rows
        .into_iter()
        .filter_map(|(name, figures)| Some((name, figures?)))
        .map(|(name, f)| {
            let mut row = vec![name.to_string(), f.records.to_string()];
            row.extend([f.mean_mm, f.rms_mm, f.p95_mm, f.max_mm].map(short));
            row
        })
        .collect();
    body.table(&["distances, mm", "records", "mean", "RMS", "95 %", "largest"], 1, &rows);
    body.element("h2", "", "What is left");
    let records = validation.residuals.iter().enumerate();
    let records = records.map(|(place, one)| (place + 1, one.length_mm, one.id.as_str())).collect();
    let marks: Vec<(f64, &str)> =
        validation.model.map(|figures| vec![(figures.mean_mm, "mean"), (figures.p95_mm, "95 %")]).unwrap_or_default();
    lengths(&[Lengths { name: "", colour: "blue", records }], &marks, &mut body);
    body.raw("<div class=\"side\">\n");
    let left: Vec<([f64; 3], &str)> =
        validation.residuals.iter().map(|one| (one.residual_mm, one.id.as_str())).collect();
    coordinates(&left, &mut body);
    claimed(&validation.residuals, &mut body);
    body.raw("</div>\n");
    worst(&validation.residuals, &mut body);
    page("Validation", &format!("{model}, {recording}"), body)
}

fn tiles(validation: &Validation, body: &mut Markup) {
    body.raw("<div class=\"tiles\">\n");
    if let Some(figures) = validation.model {
        tile(&format!("{} mm", short(figures.mean_mm)), "mean distance", body);
        tile(&format!("{} mm", short(figures.max_mm)), "largest distance", body);
    }
    if let Some(within) = validation.within_u95 {
        tile(&format!("{:.1} %", 100.0 * within), "within the radius that should hold 95 %", body);
    }
    tile(&validation.records.to_string(), "records", body);
    body.raw("</div>\n");
}

/// What was claimed against what came.
fn claimed(residuals: &[Residual], body: &mut Markup) {
    let points: Vec<(f64, f64, &str)> =
        residuals.iter().filter_map(|one| Some((one.u95_mm?, one.length_mm, one.id.as_str()))).collect();
    if points.is_empty() {
        return;
    }
    body.raw("<figure>\n");
    Scatter {
        title: "distance against the claimed 95 % radius",
        x_label: "radius claimed, mm",
        y_label: "distance, mm",
        clouds: vec![Cloud { name: "", colour: "blue", points }],
        y_holds: vec![0.0],
    }
    .draw(body);
    body.element("figcaption", "", "The noise of the measurement comes on top of the claimed radius.");
    body.raw("</figure>\n");
}

fn worst(residuals: &[Residual], body: &mut Markup) {
    let mut order: Vec<&Residual> = residuals.iter().collect();
    order.sort_by(|a, b| b.length_mm.total_cmp(&a.length_mm));
    let rows: Vec<Vec<String>> = order
        .into_iter()
        .take(WORST)
        .map(|one| {
            let mut row = vec![one.id.clone(), one.line.to_string()];
            row.extend(one.residual_mm.map(short));
            row.push(short(one.length_mm));
            row.push(one.u95_mm.map_or_else(|| "-".into(), short));
            row
        })
        .collect();
    body.element("h2", "", "The furthest off");
    body.table(&["record", "line", "x, mm", "y, mm", "z, mm", "distance, mm", "claimed, mm"], 1, &rows);
}

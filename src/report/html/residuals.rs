//! Plots of what a model leaves, record by record.

use super::bars::histogram;
use super::markup::Markup;
use super::scatter::{Cloud, Scatter};

/// Lengths of one set of records.
pub struct Lengths<'a> {
    /// The set.
    pub name: &'a str,
    /// A colour of the style sheet.
    pub colour: &'a str,
    /// Place in the recording, length in mm, the record's name.
    pub records: Vec<(usize, f64, &'a str)>,
}

/// Draws lengths in the order of the records, and how often they occur.
pub fn lengths(sets: &[Lengths<'_>], marks: &[(f64, &str)], page: &mut Markup) {
    let clouds = sets
        .iter()
        .filter(|set| !set.records.is_empty())
        .map(|set| Cloud {
            name: if sets.len() > 1 { set.name } else { "" },
            colour: set.colour,
            points: set.records.iter().map(|(place, length, name)| (*place as f64, *length, *name)).collect(),
        })
        .collect();
    page.raw("<figure class=\"side\">\n");
    Scatter {
        title: "in the order of the records",
        x_label: "record",
        y_label: "distance, mm",
        clouds,
        y_holds: vec![0.0],
    }
    .draw(page);
    let all: Vec<f64> = sets.iter().flat_map(|set| set.records.iter().map(|record| record.1)).collect();
    histogram("how often", "distance, mm", &all, marks, page);
    page.raw("</figure>\n");
}

/// Draws the three coordinates of what is left against the place in the recording.
pub fn coordinates(records: &[([f64; 3], &str)], page: &mut Markup) {
    let axes = [("x", "blue", 0), ("y", "orange", 1), ("z", "green", 2)];
    let clouds = axes
        .iter()
        .map(|(name, colour, axis)| Cloud {
            name,
            colour,
            points: records.iter().enumerate().map(|(at, (left, id))| (at as f64 + 1.0, left[*axis], *id)).collect(),
        })
        .collect();
    page.raw("<figure>\n");
    Scatter {
        title: "by coordinate",
        x_label: "record",
        y_label: "model minus measurement, mm",
        clouds,
        y_holds: vec![0.0],
    }
    .draw(page);
    page.raw("</figure>\n");
}

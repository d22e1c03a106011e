//! Reports as pages: one file that needs nothing else, drawn as SVG, for screens light and dark and for paper.

mod arm;
mod axis;
mod bars;
mod calibration;
mod diagnosis;
mod markup;
mod residuals;
mod scatter;
mod validation;

pub use calibration::calibration;
pub use diagnosis::{DiagnosisPage, diagnosis};
pub use validation::validation;

use markup::{Markup, escaped};

/// A whole page around its body.
fn page(title: &str, of: &str, body: Markup) -> String {
    let mut page = Markup::default();
    page.raw("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    page.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    let heading = format!("{title}: {of}");
    page.element("title", "", &heading);
    page.raw(format_args!("<style>\n{}</style>\n</head>\n<body>\n<main>\n", include_str!("style.css")));
    page.element("h1", "", title);
    page.raw(format_args!("<p class=\"of\">{}</p>\n", escaped(of)));
    page.raw(body.into_string());
    let by = concat!("Written by ", env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"), ".");
    page.element("p", "class=\"note\"", by);
    page.raw("</main>\n</body>\n</html>\n");
    page.into_string()
}

/// A number with a word under it.
fn tile(number: &str, word: &str, body: &mut Markup) {
    body.raw(format_args!("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", escaped(number), escaped(word)));
}

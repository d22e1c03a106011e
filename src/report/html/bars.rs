//! Lying bars, one a row, and histograms.

use super::axis::Axis;
use super::markup::{Markup, escaped};

/// A bar.
pub struct Bar {
    /// Beside it.
    pub name: String,
    /// Its length.
    pub value: f64,
    /// What stands at its end.
    pub words: String,
    /// A colour of the style sheet.
    pub colour: &'static str,
}

const WIDTH: f64 = 560.0;
const ROW: f64 = 26.0;
const NAMES: f64 = 220.0;
const WORDS: f64 = 100.0;

/// Draws bars on one scale from zero to `full`.
pub fn bars(title: &str, full: f64, rows: &[Bar], page: &mut Markup) {
    let height = ROW * rows.len() as f64 + 4.0;
    let scale = Axis::from_zero(full, NAMES, WIDTH - WORDS);
    let (title, track) = (escaped(title), WIDTH - WORDS - NAMES);
    page.raw(format_args!(
        "<svg viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" role=\"img\" aria-label=\"{title}\">\n"
    ));
    for (index, bar) in rows.iter().enumerate() {
        let top = ROW * index as f64 + 4.0;
        let base = top + 14.0;
        let long = (scale.px(bar.value.clamp(0.0, full)) - NAMES).max(1.0);
        let (name, words, before) = (escaped(&bar.name), escaped(&bar.words), NAMES - 10.0);
        let after = WIDTH - WORDS + 10.0;
        page.raw(format_args!("<text x=\"{before}\" y=\"{base}\" text-anchor=\"end\">{name}</text>"));
        page.raw(format_args!(
            "<rect class=\"track\" x=\"{NAMES}\" y=\"{top}\" width=\"{track}\" height=\"18\" rx=\"3\"/>"
        ));
        page.raw(format_args!(
            "<rect class=\"{}\" x=\"{NAMES}\" y=\"{top}\" width=\"{long:.1}\" height=\"18\" rx=\"3\"/>",
            bar.colour
        ));
        page.raw(format_args!("<text x=\"{after}\" y=\"{base}\">{words}</text>\n"));
    }
    page.raw("</svg>\n");
}

/// Bins of a histogram.
const BINS: usize = 24;

/// Draws how often lengths occur, with marks at some of them.
pub fn histogram(title: &str, x_label: &str, lengths: &[f64], marks: &[(f64, &str)], page: &mut Markup) {
    let most = lengths.iter().copied().filter(|length| length.is_finite()).fold(0.0f64, f64::max);
    let x = Axis::from_zero(1.02 * most, 58.0, 428.0);
    let mut counts = [0usize; BINS];
    for length in lengths.iter().filter(|length| length.is_finite()) {
        let bin = (length / (1.02 * most).max(f64::MIN_POSITIVE) * BINS as f64) as usize;
        counts[bin.min(BINS - 1)] += 1;
    }
    let y = Axis::from_zero(1.08 * counts.iter().copied().max().unwrap_or(1) as f64, 256.0, 30.0);
    let [title, x_label] = [title, x_label].map(escaped);
    page.raw(format_args!("<svg viewBox=\"0 0 440 300\" width=\"440\" role=\"img\" aria-label=\"{title}\">\n"));
    for (number, word) in y.ticks() {
        let at = y.px(number);
        page.raw(format_args!("<line class=\"grid\" x1=\"58\" y1=\"{at:.1}\" x2=\"428\" y2=\"{at:.1}\"/>"));
        page.raw(format_args!(
            "<text class=\"soft\" x=\"52\" y=\"{:.1}\" text-anchor=\"end\">{word}</text>\n",
            at + 4.0
        ));
    }
    let wide = (428.0 - 58.0) / BINS as f64;
    for (bin, count) in counts.iter().enumerate() {
        let (left, top) = (58.0 + wide * bin as f64, y.px(*count as f64));
        let (width, tall) = (wide - 1.0, 256.0 - top);
        page.raw(format_args!(
            "<rect class=\"blue\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{tall:.1}\"/>\n"
        ));
    }
    for (number, word) in x.ticks() {
        let at = x.px(number);
        page.raw(format_args!("<text class=\"soft\" x=\"{at:.1}\" y=\"272\" text-anchor=\"middle\">{word}</text>\n"));
    }
    for (place, (length, word)) in marks.iter().filter(|(length, _)| x.holds(*length)).enumerate() {
        let (at, low, word) = (x.px(*length), 42.0 + 14.0 * place as f64, escaped(word));
        page.raw(format_args!("<line class=\"zero\" x1=\"{at:.1}\" y1=\"30\" x2=\"{at:.1}\" y2=\"256\"/>"));
        page.raw(format_args!("<text x=\"{:.1}\" y=\"{low}\">{word}</text>\n", at + 4.0));
    }
    page.raw("<path class=\"axis\" d=\"M58 30V256H428\"/>\n");
    page.raw(format_args!("<text x=\"58\" y=\"16\" font-weight=\"600\">{title}</text>"));
    page.raw(format_args!("<text x=\"243\" y=\"292\" text-anchor=\"middle\">{x_label}</text>\n</svg>\n"));
}

//! The arm from the side with what is wrong marked on it.

use crate::model::effect::{Location, MovingFrame};
use crate::report::sketch::Sketch;

use super::markup::{Markup, escaped};

const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 340.0;
const MARGIN: f64 = 56.0;
/// Joints nearer than this have labels that touch, px.
const CLOSE: f64 = 30.0;

/// Something marked: where, and the word beside it.
pub struct Mark {
    /// Where it sits.
    pub location: Location,
    /// Its number in the table.
    pub word: String,
}

/// Draws the arm; marks that sit on no part of it (clocks) stand below.
pub fn arm(sketch: &Sketch, marks: &[Mark], page: &mut Markup) {
    let points: Vec<[f64; 2]> =
        [sketch.foot].into_iter().chain(sketch.joints.iter().copied()).chain([sketch.flange, sketch.tool]).collect();
    let Some(place) = placed(&points) else { return };
    page.raw(format_args!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" role=\"img\" aria-label=\"the arm from the side\">\n"
    ));
    let words = |of: &dyn Fn(&Location) -> bool| -> String {
        let own: Vec<&str> = marks.iter().filter(|mark| of(&mark.location)).map(|mark| mark.word.as_str()).collect();
        own.join(", ")
    };
    let class = |words: &str| if words.is_empty() { "" } else { " culprit" };
    let base = words(&|at| at.base == Some(true) || at.frame == Some(MovingFrame::Base));
    let [x, y] = place(&sketch.foot);
    page.raw(format_args!(
        "<line class=\"ground{}\" x1=\"{:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{y:.1}\"/>\n",
        class(&base),
        x - 44.0,
        x + 44.0
    ));
    label([x, y + 20.0], 0.0, &base, "base", page);
    // A label stands beside the arm, on the side that looks up from where the arm comes.
    let beside = |index: usize, off_px: f64| {
        let [[x1, y1], [x2, y2]] = [place(&points[index - 1]), place(&points[index])];
        let long = (x2 - x1).hypot(y2 - y1).max(1e-9);
        [off_px * (y2 - y1) / long, -off_px * (x2 - x1) / long]
    };
    for index in 0..points.len() - 1 {
        // Link n runs from joint n to the next; before joint 1 stands the pedestal, beyond the flange the tool.
        let link = words(&|at| index >= 1 && index < points.len() - 2 && at.link == Some(index));
        let [[x1, y1], [x2, y2]] = [place(&points[index]), place(&points[index + 1])];
        page.raw(format_args!(
            "<line class=\"link{}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>\n",
            class(&link)
        ));
        if !link.is_empty() {
            let [dx, dy] = beside(index + 1, -18.0);
            label([0.5 * (x1 + x2) + dx, 0.5 * (y1 + y2) + dy + 4.0], dx, &link, "", page);
        }
    }
    let mut side = 1.0;
    for (index, joint) in sketch.joints.iter().enumerate() {
        // Labels of joints that stand close together stand on either side.
        let [[x1, y1], [x2, y2]] = [place(&points[index]), place(joint)];
        side = if (x2 - x1).hypot(y2 - y1) < CLOSE { -side } else { 1.0 };
        let own = words(&|at| at.joint == Some(index + 1));
        let [x, y] = place(joint);
        page.raw(format_args!("<circle class=\"joint{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"7\"/>\n", class(&own)));
        let [dx, dy] = beside(index + 1, 18.0 * side);
        label([x + dx, y + dy + 4.0], dx, &own, &format!("J{}", index + 1), page);
    }
    let tool = words(&|at| at.payload == Some(true) || at.frame == Some(MovingFrame::Tool));
    let [x, y] = place(&sketch.tool);
    page.raw(format_args!("<circle class=\"joint{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\"/>\n", class(&tool)));
    label([x + 10.0, y + 14.0], 1.0, &tool, "tool", page);
    let clock = words(&|at| at.clock == Some(true));
    if !clock.is_empty() {
        label([MARGIN, HEIGHT - 8.0], 1.0, &clock, "clocks", page);
    }
    page.raw("</svg>\n");
}

/// A word at a place; `aside` says to which side of it the word runs.
fn label([x, y]: [f64; 2], aside: f64, culprit: &str, name: &str, page: &mut Markup) {
    let anchor = match aside {
        _ if aside < -4.0 => "end",
        _ if aside > 0.5 => "start",
        _ => "middle",
    };
    let (class, text) = match (culprit.is_empty(), name.is_empty()) {
        (true, _) => ("soft", name.to_string()),
        (false, true) => ("culprit", format!("({culprit})")),
        (false, false) => ("culprit", format!("{name} ({culprit})")),
    };
    let text = escaped(&text);
    page.raw(format_args!(
        "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>\n"
    ));
}

/// From metres in the picture's plane to its pixels: the same scale both ways, upright.
fn placed(points: &[[f64; 2]]) -> Option<impl Fn(&[f64; 2]) -> [f64; 2] + use<>> {
    let extreme =
        |axis: usize, start: f64, pick: fn(f64, f64) -> f64| points.iter().map(|point| point[axis]).fold(start, pick);
    let [left, low] = [0, 1].map(|axis| extreme(axis, f64::INFINITY, f64::min));
    let [right, high] = [0, 1].map(|axis| extreme(axis, f64::NEG_INFINITY, f64::max));
    let scale = ((WIDTH - 2.0 * MARGIN) / (right - left)).min((HEIGHT - 2.0 * MARGIN) / (high - low));
    scale.is_finite().then(|| {
        let aside = 0.5 * (WIDTH - scale * (right - left));
        move |point: &[f64; 2]| [aside + scale * (point[0] - left), HEIGHT - MARGIN - scale * (point[1] - low)]
    })
}

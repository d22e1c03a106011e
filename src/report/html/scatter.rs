//! A cloud of points.

use super::axis::Axis;
use super::markup::{Markup, escaped};

/// Points of one colour.
pub struct Cloud<'a> {
    /// What they are; no legend where it is empty.
    pub name: &'a str,
    /// A colour of the style sheet.
    pub colour: &'a str,
    /// Places and names.
    pub points: Vec<(f64, f64, &'a str)>,
}

/// A cloud of points with its axes.
pub struct Scatter<'a> {
    /// Above the plot.
    pub title: &'a str,
    /// Below it.
    pub x_label: &'a str,
    /// Beside it.
    pub y_label: &'a str,
    /// The points.
    pub clouds: Vec<Cloud<'a>>,
    /// Numbers that the vertical axis must hold: so that two plots can be compared.
    pub y_holds: Vec<f64>,
}

const WIDTH: f64 = 440.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 44.0;
/// Points drawn: more would only blacken the plot and fatten the page.
const MOST_POINTS: usize = 3000;

impl Scatter<'_> {
    /// Draws it.
    pub fn draw(&self, page: &mut Markup) {
        let all = || self.clouds.iter().flat_map(|cloud| &cloud.points);
        let x = Axis::over(all().map(|point| point.0), LEFT, WIDTH - RIGHT);
        let y = Axis::over(all().map(|point| point.1).chain(self.y_holds.iter().copied()), HEIGHT - BOTTOM, TOP);
        let title = escaped(self.title);
        page.raw(format_args!(
            "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" role=\"img\" aria-label=\"{title}\">\n"
        ));
        self.frame(&x, &y, page);
        let step = all().count().div_ceil(MOST_POINTS).max(1);
        for cloud in &self.clouds {
            for (at, up, name) in cloud.points.iter().step_by(step) {
                if at.is_finite() && up.is_finite() {
                    let (cx, cy) = (x.px(*at), y.px(*up));
                    let name = escaped(name);
                    let colour = cloud.colour;
                    page.raw(format_args!(
                        "<circle class=\"dot {colour}\" cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"2.6\"><title>{name}</title></circle>\n"
                    ));
                }
            }
        }
        self.legend(page);
        page.raw("</svg>\n");
    }

    fn frame(&self, x: &Axis, y: &Axis, page: &mut Markup) {
        let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        for (number, word) in x.ticks() {
            let at = x.px(number);
            page.raw(format_args!("<line class=\"grid\" x1=\"{at:.1}\" y1=\"{TOP}\" x2=\"{at:.1}\" y2=\"{bottom}\"/>"));
            let below = bottom + 16.0;
            page.raw(format_args!(
                "<text class=\"soft\" x=\"{at:.1}\" y=\"{below}\" text-anchor=\"middle\">{word}</text>\n"
            ));
        }
        for (number, word) in y.ticks() {
            let at = y.px(number);
            let class = if number == 0.0 { "zero" } else { "grid" };
            page.raw(format_args!(
                "<line class=\"{class}\" x1=\"{LEFT}\" y1=\"{at:.1}\" x2=\"{right}\" y2=\"{at:.1}\"/>"
            ));
            let (beside, base) = (LEFT - 6.0, at + 4.0);
            page.raw(format_args!(
                "<text class=\"soft\" x=\"{beside}\" y=\"{base:.1}\" text-anchor=\"end\">{word}</text>\n"
            ));
        }
        page.raw(format_args!("<path class=\"axis\" d=\"M{LEFT} {TOP}V{bottom}H{right}\"/>\n"));
        let [title, x_label, y_label] = [self.title, self.x_label, self.y_label].map(escaped);
        let (middle, low, upright) = (0.5 * (LEFT + right), HEIGHT - 8.0, 0.5 * (TOP + bottom));
        page.raw(format_args!("<text x=\"{LEFT}\" y=\"16\" font-weight=\"600\">{title}</text>\n"));
        page.raw(format_args!("<text x=\"{middle}\" y=\"{low}\" text-anchor=\"middle\">{x_label}</text>\n"));
        page.raw(format_args!(
            "<text x=\"14\" y=\"{upright}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {upright})\">{y_label}</text>\n"
        ));
    }

    fn legend(&self, page: &mut Markup) {
        let mut at = WIDTH - RIGHT;
        for cloud in self.clouds.iter().rev().filter(|cloud| !cloud.name.is_empty()) {
            let name = escaped(cloud.name);
            page.raw(format_args!("<text class=\"soft\" x=\"{at:.1}\" y=\"16\" text-anchor=\"end\">{name}</text>"));
            at -= 7.0 * cloud.name.chars().count() as f64 + 6.0;
            page.raw(format_args!("<circle class=\"{}\" cx=\"{at:.1}\" cy=\"12\" r=\"4\"/>\n", cloud.colour));
            at -= 12.0;
        }
    }
}

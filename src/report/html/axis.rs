//! From numbers to places in a drawing, with round ticks.

/// A linear scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    low: f64,
    high: f64,
    from_px: f64,
    to_px: f64,
}

/// Ticks wanted on an axis.
const TICKS: f64 = 5.0;

impl Axis {
    /// A scale over these numbers, widened a little; numbers that are not finite are passed over.
    pub fn over(numbers: impl IntoIterator<Item = f64>, from_px: f64, to_px: f64) -> Self {
        let (low, high) = numbers
            .into_iter()
            .filter(|number| number.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| (low.min(number), high.max(number)));
        let (low, high) = match (low <= high, high - low) {
            (false, _) => (0.0, 1.0),
            (true, width) if width <= 1e-12 * high.abs().max(1e-12) => (low - 0.5, high + 0.5),
            (true, width) => (low - 0.04 * width, high + 0.04 * width),
        };
        Self { low, high, from_px, to_px }
    }

    /// A scale from zero up.
    pub fn from_zero(high: f64, from_px: f64, to_px: f64) -> Self {
        Self { low: 0.0, high: if high > 0.0 && high.is_finite() { high } else { 1.0 }, from_px, to_px }
    }

    /// The place of a number, px.
    pub fn px(&self, number: f64) -> f64 {
        self.from_px + (number - self.low) / (self.high - self.low) * (self.to_px - self.from_px)
    }

    /// True for numbers on the axis.
    pub fn holds(&self, number: f64) -> bool {
        (self.low..=self.high).contains(&number)
    }

    /// Round numbers on the axis, with their words.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let step = round_step((self.high - self.low) / TICKS);
        let digits = (-step.log10().floor()).max(0.0) as usize;
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last.min(first + 20))
            .map(|index| {
                let number = index as f64 * step;
                let word =
                    if (1e-4..1e6).contains(&step) { format!("{number:.digits$}") } else { format!("{number:.1e}") };
                (number, word.replace('-', "\u{2212}"))
            })
            .collect()
    }
}

/// The next of 1, 2, 5 times a power of ten.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let lead = step / power;
    let round = [1.0, 2.0, 5.0].into_iter().find(|round| lead <= *round).unwrap_or(10.0);
    round * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_on_the_axis() {
        let axis = Axis::over([-0.93, 0.2, f64::NAN, 1.04], 0.0, 100.0);
        let ticks = axis.ticks();
        assert!(ticks.iter().all(|(number, _)| axis.holds(*number)));
        assert_eq!(
            ticks.iter().map(|tick| tick.1.as_str()).collect::<Vec<_>>(),
            ["\u{2212}1.0", "\u{2212}0.5", "0.0", "0.5", "1.0"]
        );
        assert!(Axis::over([], 0.0, 1.0).px(0.5).is_finite());
        assert!(Axis::over([3.0, 3.0], 0.0, 1.0).px(3.0).is_finite());
    }
}

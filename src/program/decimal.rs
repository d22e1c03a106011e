//! Numbers with a fixed count of digits after the point: what a file can hold.

/// A number rounded to some decimals: what is written, and what will be read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decimal {
    exact: f64,
    decimals: usize,
    /// The number in units of its last digit, where it is small enough to be held exactly.
    units: Option<i64>,
}

/// Powers of ten that are exact doubles, by their exponent.
pub(super) const POWERS_OF_TEN: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
/// Units up to which a product with a power of ten is off by less than [`UNSURE`].
const MOST_UNITS: f64 = 1e12;
/// A fraction this near to a half is left to the exact algorithm of the standard library.
const UNSURE: f64 = 1e-3;

impl Decimal {
    /// The nearest number with this many digits after the point, as `format!` rounds.
    pub fn nearest(exact: f64, decimals: usize) -> Self {
        Self { exact, decimals, units: units(exact, decimals) }
    }

    /// The number as it will be read back: the double nearest to the decimal.
    pub fn value(&self) -> f64 {
        match self.units {
            // Both are integers that a double holds, so that the quotient is the correctly rounded one (Clinger 1990).
            Some(units) => units as f64 / POWERS_OF_TEN[self.decimals],
            None => self.text().parse().unwrap_or(self.exact),
        }
    }

    /// The number as it is written; zero has no sign.
    pub fn text(&self) -> String {
        let decimals = self.decimals;
        let Some(units) = self.units else {
            let mut text = format!("{:.decimals$}", self.exact);
            if text.starts_with('-') && text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.')) {
                text.remove(0);
            }
            return text;
        };
        // From the last digit to the first.
        let mut reversed = [b'0'; 32];
        let (mut rest, mut length) = (units.unsigned_abs(), 0);
        while rest > 0 || length <= decimals + usize::from(decimals > 0) {
            if decimals > 0 && length == decimals {
                reversed[length] = b'.';
            } else {
                reversed[length] = b'0' + (rest % 10) as u8;
                rest /= 10;
            }
            length += 1;
        }
        if units < 0 {
            reversed[length] = b'-';
            length += 1;
        }
        reversed[..length].iter().rev().map(|&byte| char::from(byte)).collect()
    }
}

/// The nearest count of units, where doubles can tell it.
fn units(exact: f64, decimals: usize) -> Option<i64> {
    let scaled = exact * POWERS_OF_TEN.get(decimals)?;
    if scaled.is_nan() || scaled.abs() >= MOST_UNITS {
        return None;
    }
    let below = scaled as i64;
    let fraction = (scaled - below as f64).abs();
    if (fraction - 0.5).abs() < UNSURE {
        return None;
    }
    Some(if fraction < 0.5 { below } else { below + if scaled < 0.0 { -1 } else { 1 } })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn by_the_standard_library(exact: f64, decimals: usize) -> (String, f64) {
        let text = format!("{exact:.decimals$}");
        let value: f64 = text.parse().expect("a number");
        let text = if value == 0.0 { text.trim_start_matches('-').to_owned() } else { text };
        (text, value)
    }

    #[test]
    fn hard_cases_round_as_the_standard_library_does() {
        let numbers =
            [0.0, -0.0, 0.5, 1.5, -2.5, 0.125, 999.9996, -0.0004, 1e-30, 123456.7895, 9.5, 1e17, -1e9, 0.0005];
        for exact in numbers {
            for decimals in 0..18 {
                let decimal = Decimal::nearest(exact, decimals);
                let (text, value) = by_the_standard_library(exact, decimals);
                assert_eq!((decimal.text(), decimal.value()), (text, value), "{exact} to {decimals}");
            }
        }
    }

    proptest! {
        #[test]
        fn any_number_rounds_as_the_standard_library_does(exact in -1e7..1e7, decimals in 0usize..17) {
            let decimal = Decimal::nearest(exact, decimals);
            prop_assert_eq!((decimal.text(), decimal.value()), by_the_standard_library(exact, decimals));
        }

        #[test]
        fn numbers_at_a_tie_round_as_the_standard_library_does(units in -1_000_000i64..1_000_000, decimals in 0usize..6) {
            let exact = (units as f64 + 0.5) / 10f64.powi(decimals as i32);
            let decimal = Decimal::nearest(exact, decimals);
            prop_assert_eq!((decimal.text(), decimal.value()), by_the_standard_library(exact, decimals));
        }
    }
}

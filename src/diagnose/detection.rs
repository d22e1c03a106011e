//! The smallest fine error that a recording can show.

use crate::model::robot::DOF;

use super::evidence::{DECIDES, looked_at};

/// Orders a revolution that a search goes through, times two: independent lines on one revolution.
const LINES: f64 = 424.0;

/// Amplitude of the smallest line that a search over orders would believe, rad, where the records sample the joint's angle at
/// random.
///
/// A line of amplitude A takes away `A^2 S / 2` of the sum of squares, S the sum of the squared levers over the noise; it must be
/// `N (1 - exp(-(k ln N + 2 ln M + 6) / N))` for its evidence to decide (see [`super::evidence::penalised`]), with k = 3 numbers
/// (two sizes and the order) and M lines that were looked at.
///
/// # Arguments
/// * `lever` - root of S, 1/rad
/// * `rows` - coordinates, N
pub fn smallest_line_rad(lever: f64, rows: usize) -> f64 {
    let rows = rows.max(1) as f64;
    let price = 3.0 * rows.ln() + 2.0 * looked_at(DOF as f64 * LINES).ln() + DECIDES;
    let needed = rows * -(-price / rows).exp_m1();
    (2.0 * needed).sqrt() / lever.max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_times_the_records_halve_the_limit() {
        // Levers of one metre against 0.05 mm, on 720 and 2880 coordinates of which two in three move.
        let lever = |rows: f64| (rows * (1.0f64 / 5e-5).powi(2) / 3.0).sqrt();
        let few = smallest_line_rad(lever(720.0), 720);
        let many = smallest_line_rad(lever(2880.0), 2880);
        assert!((many / few - 0.5).abs() < 0.06, "{few} {many}");
        // The rule of thumb (2 sigma / L) sqrt(F / N) with F = 15 on 240 poses: 0.025 mrad.
        assert!(few > 1.5e-5 && few < 6e-5, "{few}");
    }
}

//! Where a program lands on a real arm: the table *intended / lands / lands corrected*.

use std::fmt::Write;

use crate::geometry::pose::{Pose, pose_difference};

/// One target on the real arm, in the target's frame.
#[derive(Clone, Debug)]
pub struct Landing {
    /// Name, or line where it has none.
    pub label: String,
    /// Where the program means it.
    pub intended: Pose,
    /// Where the program as written lands.
    pub uncorrected: Pose,
    /// Where the corrected program lands.
    pub corrected: Option<Pose>,
    /// True when the corrected program says the same here: a joint target, or one that is known only at run time.
    pub left_alone: bool,
}

impl Landing {
    /// Distance, m, and turn, rad, from the intended pose to where the program as written lands.
    pub fn miss(&self) -> (f64, f64) {
        miss(&self.intended, &self.uncorrected)
    }

    /// The same for the corrected program.
    pub fn corrected_miss(&self) -> Option<(f64, f64)> {
        self.corrected.as_ref().map(|landed| miss(&self.intended, landed))
    }
}

fn miss(intended: &Pose, landed: &Pose) -> (f64, f64) {
    let (shift, turn) = pose_difference(landed, intended);
    (shift.norm(), turn.norm())
}

/// The table of the first `rows` landings, and the figures over all.
pub fn table(landings: &[Landing], rows: usize) -> String {
    let mut out = String::new();
    let corrected = landings.iter().any(|landing| landing.corrected.is_some());
    let _ = write!(out, "{:<14} {:>32}  {:>32}  {:>9}", "target", "intended x y z, mm", "lands, mm", "off by");
    let _ = writeln!(
        out,
        "{}",
        if corrected { format!("  {:>32}  {:>9}", "corrected lands, mm", "off by") } else { String::new() }
    );
    for landing in landings.iter().take(rows) {
        let _ = write!(
            out,
            "{:<14} {}  {}  {:>9.4}",
            landing.label,
            position(&landing.intended),
            position(&landing.uncorrected),
            landing.miss().0 * 1e3
        );
        if let (Some(landed), Some((miss_m, _))) = (&landing.corrected, landing.corrected_miss()) {
            let _ = write!(out, "  {}  {:>9.4}", position(landed), miss_m * 1e3);
        }
        out.push('\n');
    }
    if landings.len() > rows {
        let _ = writeln!(out, "... and {} more", landings.len() - rows);
    }
    figures(&mut out, "as written", landings.iter().map(Landing::miss));
    if corrected {
        let rewritten = landings.iter().filter(|landing| !landing.left_alone);
        figures(&mut out, "corrected", rewritten.filter_map(Landing::corrected_miss));
        let left = landings.iter().filter(|landing| landing.left_alone).count();
        if left > 0 {
            let _ = writeln!(out, "left alone   {left} targets land as before");
        }
    }
    out
}

fn position(pose: &Pose) -> String {
    let [x, y, z]: [f64; 3] = (pose.translation * 1e3).into();
    format!("{x:>10.4} {y:>10.4} {z:>10.4}")
}

fn figures(out: &mut String, what: &str, misses: impl Iterator<Item = (f64, f64)>) {
    let misses: Vec<(f64, f64)> = misses.collect();
    if misses.is_empty() {
        return;
    }
    let count = misses.len() as f64;
    let mean_mm = misses.iter().map(|miss| miss.0).sum::<f64>() / count * 1e3;
    let largest_mm = misses.iter().map(|miss| miss.0).fold(0.0, f64::max) * 1e3;
    let largest_deg = misses.iter().map(|miss| miss.1).fold(0.0, f64::max).to_degrees();
    let _ = writeln!(
        out,
        "{what:<12} {} targets: mean {mean_mm:.4} mm, largest {largest_mm:.4} mm, largest turn {largest_deg:.5} deg",
        misses.len()
    );
}

//! What tracker and controller write down: noise, gross errors, missing columns.

use std::fmt::Write;

use falsetarget::model::robot::{DOF, Robot};
use nalgebra::{Isometry3, Point3, Vector3};

use crate::dice::Dice;
use crate::motion::Moment;
use crate::trial::{Hardship, Spec};

/// What was there to be measured.
pub struct Measured<'a> {
    pub robot: &'a Robot,
    pub moments: &'a [Moment],
    pub points_m: &'a [Vector3<f64>],
    pub sigma_m: f64,
    pub reach_m: f64,
}

/// Ambient temperature at the start, deg C.
const AMBIENT_C: f64 = 22.0;

/// The recording as a file, and the names of its gross errors.
pub fn written(spec: &Spec, measured: &Measured<'_>, dice: &mut Dice) -> (String, Vec<String>) {
    let mut text = header(spec, true);
    let mut outliers = Vec::new();
    // Set up anew and registered to where it stood before, as well as registration goes.
    let elsewhere = Isometry3::new(dice.normals() * 1.5e-3, dice.normals() * 1e-3);
    let moves_at = dice.between(0.35, 0.65);
    for (index, (moment, point)) in measured.moments.iter().zip(measured.points_m).enumerate() {
        let id = (index + 1).to_string();
        let mut seen = point + noise(spec, measured, point, dice);
        if spec.has(Hardship::Outliers) && dice.chance(0.02) {
            seen += dice.direction() * measured.sigma_m * dice.between(15.0, 80.0);
            outliers.push(id.clone());
        }
        let second = spec.has(Hardship::MovedStation) && moment.fraction > moves_at;
        if second {
            seen = (elsewhere * Point3::from(seen)).coords;
        }
        row(spec, measured.robot, &id, moment, &mut text);
        if spec.has(Hardship::MovedStation) {
            let _ = write!(text, ",{}", if second { "S2" } else { "S1" });
        }
        if !spec.has(Hardship::NoTemperature) {
            let _ = write!(text, ",{:.2}", AMBIENT_C + moment.warmer_k + 0.05 * dice.normal());
        }
        if spec.noise_stated {
            let _ = write!(text, ",{:.5}", 1e3 * measured.sigma_m);
        }
        seen.iter().for_each(|x| {
            let _ = write!(text, ",{:.4}", 1e3 * x);
        });
        text.push('\n');
    }
    (text, outliers)
}

/// Poses to predict, as a file: everything is known here that the recording holds.
pub fn poses(spec: &Spec, robot: &Robot, moments: &[Moment]) -> String {
    let mut text = header(spec, false);
    for (index, moment) in moments.iter().enumerate() {
        row(spec, robot, &(index + 1).to_string(), moment, &mut text);
        if spec.has(Hardship::MovedStation) {
            text.push_str(",S1");
        }
        if !spec.has(Hardship::NoTemperature) {
            let _ = write!(text, ",{:.4}", AMBIENT_C + moment.warmer_k);
        }
        text.push('\n');
    }
    text
}

fn header(spec: &Spec, measured: bool) -> String {
    let mut names = vec!["id".to_string()];
    let mut numbered = |before: &str, after: &str| (1..=DOF).for_each(|n| names.push(format!("{before}{n}{after}")));
    numbered("q", "_deg");
    if spec.moving {
        numbered("qd", "_deg_s");
        numbered("qdd", "_deg_s2");
    }
    if !spec.has(Hardship::NoDir) {
        numbered("dir", "");
    }
    let mut optional = |name: &str, wanted: bool| {
        if wanted {
            names.push(name.to_string());
        }
    };
    optional("t_s", !spec.has(Hardship::NoTime));
    optional("payload_kg", !spec.has(Hardship::PayloadUnknown));
    optional("station", spec.has(Hardship::MovedStation));
    optional("temp_c", !spec.has(Hardship::NoTemperature));
    optional("sigma_mm", measured && spec.noise_stated);
    ["x_mm", "y_mm", "z_mm"].iter().for_each(|name| optional(name, measured));
    names.join(",") + "\n"
}

fn row(spec: &Spec, robot: &Robot, id: &str, moment: &Moment, text: &mut String) {
    let _ = write!(text, "{id}");
    let mut numbers = |of: &[f64; DOF], digits: usize| {
        of.iter().for_each(|number| {
            let _ = write!(text, ",{number:.digits$}");
        });
    };
    let step = if spec.has(Hardship::Quantised) { 0.005 } else { 1e-5 };
    numbers(&moment.numbers.map(|angle| (angle.to_degrees() / step).round() * step), 5);
    if let (true, Some(motion)) = (spec.moving, &moment.motion) {
        numbers(&motion.speeds(moment.time_s).map(f64::to_degrees), 5);
        numbers(&motion.accelerations(moment.time_s).map(f64::to_degrees), 4);
    }
    if !spec.has(Hardship::NoDir) {
        numbers(&moment.approach, 0);
    }
    if !spec.has(Hardship::NoTime) {
        let _ = write!(text, ",{:.3}", moment.time_s);
    }
    if !spec.has(Hardship::PayloadUnknown) {
        let _ = write!(text, ",{}", robot.payload.mass_kg);
    }
}

/// Noise with the stated standard deviation per axis.
fn noise(spec: &Spec, measured: &Measured<'_>, point: &Vector3<f64>, dice: &mut Dice) -> Vector3<f64> {
    let mut noise = dice.normals() * measured.sigma_m;
    if spec.has(Hardship::HeavyTails) {
        // Student's t with 4 degrees of freedom, at the same standard deviation.
        let chi2: f64 = (0..4).map(|_| dice.normal().powi(2)).sum();
        noise *= (4.0 / chi2).sqrt() * 0.5f64.sqrt();
    }
    if spec.has(Hardship::DirectedNoise) {
        // A tracker sees along its beam better than across, and across the worse the further away.
        let stands = Vector3::new(1.5, -1.2, 0.3) * measured.reach_m;
        let ray = point - stands;
        let (beam, far) = (ray.normalize(), ray.norm() / (2.0 * measured.reach_m));
        let along = beam * beam.dot(&noise);
        noise = 0.4 * along + (noise - along) * (0.6 + 0.6 * far);
    }
    noise
}

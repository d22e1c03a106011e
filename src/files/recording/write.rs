//! Writing recordings and predictions.

use std::fmt::Write;

use nalgebra::Vector3;

use crate::base::units::{deg_from_rad, mm_from_m};
use crate::geometry::orientation::OrientationConvention;
use crate::measure::observation::Observation;

/// Where the tool point will be.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// The record's name.
    pub id: String,
    /// Position in the measuring frame, m.
    pub position_m: Vector3<f64>,
    /// Radius in which the real point lies with 95 %, m; `None` where the model does not know its own uncertainty.
    pub u95_m: Option<f64>,
}

/// The text of a prediction file: `id`, `x_mm`, `y_mm`, `z_mm`, `u95_mm` (empty where unknown).
pub fn write_predictions(predictions: &[Prediction]) -> String {
    let mut text = String::from("id,x_mm,y_mm,z_mm,u95_mm\n");
    for prediction in predictions {
        text.push_str(&quoted(&prediction.id));
        for length_m in prediction.position_m.iter() {
            push(&mut text, mm_from_m(*length_m), 5);
        }
        match prediction.u95_m {
            Some(radius_m) => push(&mut text, mm_from_m(radius_m), 5),
            None => text.push(','),
        }
        text.push('\n');
    }
    text
}

/// What an optional column says of a record.
type Cell = fn(&Observation) -> Option<String>;

/// The text of a recording. A column is there when any record has something to say in it.
pub fn write_observations(observations: &[Observation]) -> String {
    let any = |has: fn(&Observation) -> bool| observations.iter().any(has);
    let speeds = any(|record| record.conditions.speed_rad_s.is_some());
    let accelerations = any(|record| record.conditions.acceleration_rad_s2.is_some());
    let approaches = any(|record| record.conditions.approach.iter().any(|&sense| sense != 0.0));
    let measured = any(|record| record.measured.is_some());
    let rotations = any(|record| record.measured.is_some_and(|measured| measured.rotation.is_some()));
    let mut optional: Vec<(&str, Cell)> = vec![
        ("t_s", |record| record.conditions.time_s.map(|time| decimals(time, 4))),
        ("temp_c", |record| record.conditions.temperature_c.map(|temperature| decimals(temperature, 3))),
        ("payload_kg", |record| record.conditions.payload.map(|payload| payload.mass_kg.to_string())),
        ("sigma_mm", |record| record.sigma_m.map(|sigma| decimals(mm_from_m(sigma), 5))),
        ("sigma_deg", |record| record.sigma_rad.map(|sigma| decimals(deg_from_rad(sigma), 6))),
        ("set", |record| record.set.map(|set| set.word().to_string())),
        ("station", |record| record.station.as_deref().map(quoted)),
    ];
    optional.retain(|(_, value)| observations.iter().any(|record| value(record).is_some()));

    let mut text = String::from("id");
    let mut head = |wanted: bool, names: &dyn Fn(usize) -> String, count: usize| {
        for index in (0..count).filter(|_| wanted) {
            text.push(',');
            text.push_str(&names(index));
        }
    };
    head(true, &|joint| format!("q{}_deg", joint + 1), 6);
    head(speeds, &|joint| format!("qd{}_deg_s", joint + 1), 6);
    head(accelerations, &|joint| format!("qdd{}_deg_s2", joint + 1), 6);
    head(approaches, &|joint| format!("dir{}", joint + 1), 6);
    head(measured, &|axis| ["x_mm", "y_mm", "z_mm"][axis].to_string(), 3);
    head(rotations, &|axis| ["rx_deg", "ry_deg", "rz_deg"][axis].to_string(), 3);
    head(true, &|column| optional[column].0.to_string(), optional.len());
    text.push('\n');

    for record in observations {
        text.push_str(&quoted(&record.id));
        let conditions = &record.conditions;
        let mut cells = |wanted: bool, numbers: Option<&[f64]>, count: usize, scale: fn(f64) -> f64, places: usize| {
            for index in (0..count).filter(|_| wanted) {
                match numbers.and_then(|numbers| numbers.get(index)) {
                    Some(&number) => push(&mut text, scale(number), places),
                    None => text.push(','),
                }
            }
        };
        cells(true, Some(&record.numbers_rad), 6, deg_from_rad, 6);
        cells(speeds, conditions.speed_rad_s.as_ref().map(|x| &x[..]), 6, deg_from_rad, 6);
        cells(accelerations, conditions.acceleration_rad_s2.as_ref().map(|x| &x[..]), 6, deg_from_rad, 6);
        cells(approaches, Some(&conditions.approach), 6, |sense| sense, 0);
        let position = record.measured.map(|measured| measured.position_m);
        cells(measured, position.as_ref().map(|x| x.as_slice()), 3, mm_from_m, 5);
        let angles = record.measured.and_then(|measured| measured.rotation);
        let angles = angles.map(|rotation| OrientationConvention::FixedXyz.numbers(&rotation, &[0.0; 3]));
        cells(rotations, angles.as_deref(), 3, deg_from_rad, 7);
        for (_, value) in &optional {
            text.push(',');
            text.push_str(&value(record).unwrap_or_default());
        }
        text.push('\n');
    }
    text
}

fn push(text: &mut String, number: f64, places: usize) {
    text.push(',');
    text.push_str(&decimals(number, places));
}

fn decimals(number: f64, places: usize) -> String {
    let mut text = String::new();
    // Adding zero turns -0 into 0. Writing into a string cannot fail.
    let _ = write!(text, "{:.places$}", number + 0.0);
    text
}

fn quoted(word: &str) -> String {
    if word.contains([',', '"', '\n', '\r', ';']) { format!("\"{}\"", word.replace('"', "\"\"")) } else { word.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::text::Source;
    use crate::files::builtin;
    use crate::files::recording::read;
    use crate::geometry::pose::rotation_from_vector;
    use crate::measure::fixture::observation;
    use crate::measure::observation::{Measured, SetName};

    #[test]
    fn a_recording_goes_round() {
        let robot = builtin::by_name("hh800-class").expect("built in").expect("sound");
        let mut record = observation([0.1, -0.2, 0.3, -0.4, 0.5, -0.6]);
        record.id = "a,\"b\"".into();
        record.set = Some(SetName::Validate);
        record.station = Some("S2".into());
        record.conditions.approach = [1.0, -1.0, 0.0, 1.0, 1.0, -1.0];
        record.conditions.speed_rad_s = Some([0.1; 6]);
        record.conditions.time_s = Some(12.5);
        record.sigma_m = Some(4e-5);
        record.measured = Some(Measured {
            position_m: Vector3::new(1.0, -2.0, 0.5),
            rotation: Some(rotation_from_vector(&Vector3::new(0.3, 0.2, -1.0))),
        });
        let text = write_observations(&[record.clone(), observation([0.0; 6])]);
        let back = read(&Source::new("r.csv", text.clone()), &robot).expect(&text);
        let again = &back.observations[0];
        assert_eq!(again.id, record.id);
        assert_eq!((again.set, &again.station), (record.set, &record.station));
        assert_eq!(again.conditions.approach, record.conditions.approach);
        assert_eq!(again.conditions.time_s, Some(12.5));
        let (a, b) = (again.measured.expect("measured"), record.measured.expect("measured"));
        assert!((a.position_m - b.position_m).norm() < 1e-8);
        assert!((a.rotation.expect("turned") - b.rotation.expect("turned")).norm() < 1e-8);
        assert!((again.numbers_rad[1] - record.numbers_rad[1]).abs() < 1e-8);
        assert_eq!(back.observations[1].measured, None);
    }

    #[test]
    fn predictions_have_the_columns_of_the_contract() {
        let prediction = Prediction { id: "7".into(), position_m: Vector3::new(1.0, -0.0, 0.25), u95_m: Some(1.25e-4) };
        let text = write_predictions(&[prediction]);
        assert_eq!(text, "id,x_mm,y_mm,z_mm,u95_mm\n7,1000.00000,0.00000,250.00000,0.12500\n");
    }
}

//! From exact numbers to written ones: as few digits as the file has, as many as a micrometre needs.

use nalgebra::Matrix3;

use crate::base::edit::EditSet;
use crate::base::text::Source;
use crate::geometry::orientation::OrientationNumbers;
use crate::geometry::pose::{Pose, vector_from_rotation};
use crate::program::decimal::Decimal;
use crate::program::number::{NumberField, NumberRules, written};
use crate::program::target::{CartesianNumbers, JointNumbers, Units, position_m};

/// Error that rounding may make: 0.9 um and 0.9 urad.
const ROUNDING: f64 = 0.9e-6;
/// Change of an orientation, rad, below which its numbers stay as they are.
const SAME_ORIENTATION: f64 = 1e-9;

/// Decimals at which even the worst rounding of three numbers stays below [`ROUNDING`].
fn decimals_that_suffice(unit_size: f64) -> usize {
    // sqrt(3)/2 units in the last place at worst.
    let needed = (unit_size * 0.87 / ROUNDING).log10().ceil();
    if needed > 0.0 { needed as usize } else { 0 }
}

/// The numbers of a group, rounded: to the decimals of the file where `error` of the rounded numbers is small enough,
/// else to as many as always suffice.
fn rounded<const N: usize>(
    fields: &[NumberField],
    exact: &[f64; N],
    unit_size: f64,
    rules: &NumberRules,
    error: impl Fn(&[f64]) -> f64,
) -> [Decimal; N] {
    let own = |at: usize| fields.get(at).map_or(0, |field| field.decimals().min(rules.max_decimals));
    let as_in_file: [Decimal; N] = std::array::from_fn(|at| Decimal::nearest(exact[at], own(at)));
    let values = as_in_file.map(|decimal| decimal.value());
    if error(&values[..fields.len().min(N)]) <= ROUNDING {
        return as_in_file;
    }
    let enough = decimals_that_suffice(unit_size).min(rules.max_decimals);
    std::array::from_fn(|at| Decimal::nearest(exact[at], own(at).max(enough)))
}

/// Adds the edits of a group and gives the numbers as they will be read.
fn push_group<const N: usize>(
    edits: &mut EditSet,
    source: &Source,
    fields: &[NumberField],
    exact: &[f64; N],
    decimals: &[Decimal; N],
) -> [f64; N] {
    let mut as_read = *exact;
    for ((field, (&number, decimal)), read) in fields.iter().zip(exact.iter().zip(decimals)).zip(&mut as_read) {
        let rounded = decimal.value();
        // A number that does not change keeps its spelling; a default that is left out stays out.
        if rounded == field.value || (number - field.value).abs() < f64::EPSILON * 16.0 * number.abs() {
            *read = field.value;
            write_repeated(edits, source, field);
            continue;
        }
        let (span, text) = written(field, source.slice(field.span()), decimal);
        edits.push(span, text);
        *read = rounded;
    }
    as_read
}

/// Writes a pose into the numbers of a target; gives the pose as it will be read back.
pub fn write_pose(
    edits: &mut EditSet,
    source: &Source,
    numbers: &CartesianNumbers,
    rules: &NumberRules,
    pose: &Pose,
) -> Pose {
    let translation = write_position(edits, source, &numbers.position, numbers.units, rules, &pose.translation);
    let near = numbers.orientation_in_radians();
    let as_written = numbers.convention.rotation(&near).unwrap_or_else(Matrix3::identity);
    let turned_by = |rotation: &Matrix3<f64>| vector_from_rotation(&(pose.rotation * rotation.transpose())).norm();
    if turned_by(&as_written) < SAME_ORIENTATION {
        numbers.orientation.iter().for_each(|field| write_repeated(edits, source, field));
        return Pose { rotation: as_written, translation };
    }
    let angles = numbers.convention.has_angles();
    let unit = if angles { numbers.units.angle_rad() } else { 1.0 };
    let exact = numbers.convention.numbers(&pose.rotation, &near).map(|number| number / unit).padded();
    let read = |values: &[f64]| {
        let in_radians: OrientationNumbers = values.iter().map(|value| value * unit).collect();
        numbers.convention.rotation(&in_radians)
    };
    // A quaternion's components turn twice as far as they change; those of a tool axis less.
    let unit_size = if angles { unit } else { 2.0 };
    let fields = &numbers.orientation;
    let error = |values: &[f64]| read(values).map_or(f64::INFINITY, |rotation| turned_by(&rotation));
    let decimals = rounded(fields, &exact, unit_size, rules, error);
    let as_read = push_group(edits, source, fields, &exact, &decimals);
    Pose { rotation: read(&as_read[..fields.len().min(4)]).unwrap_or(pose.rotation), translation }
}

/// Writes out a number that is left out because it is that of the target before.
fn write_repeated(edits: &mut EditSet, source: &Source, field: &NumberField) {
    if field.repeats() {
        let (span, text) = written(field, source.slice(field.span()), &Decimal::nearest(field.value, field.decimals()));
        edits.push(span, text);
    }
}

/// Writes out all numbers that a target leaves out because they are those of the target before, as they are: for a
/// target that is not corrected, in a program in which others are.
pub fn write_all_repeated(edits: &mut EditSet, source: &Source, numbers: &CartesianNumbers) {
    numbers.position.iter().chain(&numbers.orientation).for_each(|field| write_repeated(edits, source, field));
}

/// Writes three lengths; gives them as they will be read back, m.
pub fn write_position(
    edits: &mut EditSet,
    source: &Source,
    position: &[NumberField; 3],
    units: Units,
    rules: &NumberRules,
    exact_m: &nalgebra::Vector3<f64>,
) -> nalgebra::Vector3<f64> {
    let unit = units.length_m();
    let exact: [f64; 3] = exact_m.map(|length| units.from_m(length)).into();
    let error = |values: &[f64]| values.iter().zip(&exact).map(|(a, b)| ((a - b) * unit).powi(2)).sum::<f64>().sqrt();
    let decimals = rounded(position, &exact, unit, rules, error);
    position_m(push_group(edits, source, position, &exact, &decimals), units)
}

/// Writes six joint values; gives them as they will be read back, rad.
pub fn write_joints(
    edits: &mut EditSet,
    source: &Source,
    numbers: &JointNumbers,
    rules: &NumberRules,
    exact_rad: &[f64; 6],
    reach_m: f64,
) -> [f64; 6] {
    let unit = numbers.units.angle_rad();
    let exact = exact_rad.map(|angle| angle / unit);
    // A joint's error moves the tool by at most its angle times the reach.
    let error =
        |values: &[f64]| values.iter().zip(&exact).map(|(a, b)| (a - b).abs() * unit * reach_m.max(1.0)).sum::<f64>();
    let decimals = rounded(&numbers.joints, &exact, unit * 2.0 * reach_m.max(1.0), rules, error);
    push_group(edits, source, &numbers.joints, &exact, &decimals).map(|number| number * unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::number::number_at;

    fn fields(text: &str) -> [NumberField; 3] {
        let mut at = 0;
        std::array::from_fn(|_| {
            let field = number_at(text.as_bytes(), at).expect("a number");
            at = field.span().end + 1;
            field
        })
    }

    fn rewritten(text: &str, exact_mm: [f64; 3]) -> String {
        let source = Source::new("t", text);
        let mut edits = EditSet::default();
        let exact_m = nalgebra::Vector3::from(exact_mm) * 1e-3;
        write_position(&mut edits, &source, &fields(text), Units::MM_DEG, &NumberRules::default(), &exact_m);
        String::from_utf8(edits.apply(source.bytes()).expect("disjoint")).expect("ascii")
    }

    #[test]
    fn the_files_own_decimals_stay_where_they_suffice() {
        assert_eq!(rewritten("1.000,2.000,3.000", [1.1234, 2.0001, 3.0]), "1.123,2.000,3.000");
        assert_eq!(rewritten("1.0,2.0,3.0", [1.5, 2.0, 3.0]), "1.5,2.0,3.0");
    }

    #[test]
    fn numbers_that_repeat_are_written_out_even_where_they_stay() {
        let source = Source::new("t", "G1 X1.0 Y2.0");
        let number = |at| number_at(source.bytes(), at).expect("a number");
        let insertion = crate::program::number::Insertion { before: " Z".into(), after: String::new(), repeats: true };
        let fields = [number(4), number(9), NumberField::left_out(12, 3.0, 1, insertion)];
        let mut edits = EditSet::default();
        let exact_m = nalgebra::Vector3::new(1.0e-3, 2.5e-3, 3.0e-3);
        write_position(&mut edits, &source, &fields, Units::MM_DEG, &NumberRules::default(), &exact_m);
        assert_eq!(edits.apply(source.bytes()).as_deref(), Ok(&b"G1 X1.0 Y2.5 Z3.0"[..]));
    }

    #[test]
    fn decimals_are_added_where_a_micrometre_needs_them() {
        assert_eq!(rewritten("1.0,2.0,3.0", [1.1234, 2.0, 3.0]), "1.123,2.0,3.0");
        assert_eq!(rewritten("1,2,3", [1.1234, 2.25, 3.0]), "1.123,2.250,3");
        assert_eq!(decimals_that_suffice(1e-3), 3);
        assert_eq!(decimals_that_suffice(1f64.to_radians()), 5);
        assert_eq!(decimals_that_suffice(1.0), 6);
    }
}

//! `POS(..)`, `XTNDPOS(..)`, `{..}` and configuration strings.

use std::ops::Range;

use crate::geometry::orientation::OrientationConvention;
use crate::program::dialect::script::{Kind, Position, Text, joints_of, pose_of};
use crate::program::target::{Configuration, ExternalAxis, TargetValue};

/// Joints or numbers of a pose.
const AXES: usize = 6;
/// The joints whose turns `T1`, `T2`, `T3` count.
const TURNS: [(&str, usize); 3] = [("T1:", 3), ("T2:", 5), ("T3:", 2)];

/// Reads a literal; `None` for anything else.
pub(super) fn position(text: Text<'_>, range: &Range<usize>) -> Option<Position> {
    match text.word(range.start).as_str() {
        "POS" => pose(text, range),
        "XTNDPOS" => extended(text, range),
        "" => joints(text, range),
        _ => None,
    }
}

/// What stands between the brackets of a literal that fills the range.
fn inside(text: Text<'_>, open: usize, range: &Range<usize>) -> Option<Vec<Range<usize>>> {
    let (parts, close) = text.parts(open, range.end)?;
    (close + 1 == range.end).then_some(parts)
}

fn pose(text: Text<'_>, range: &Range<usize>) -> Option<Position> {
    let parts = text.is(range.start + 1, b'(').then(|| inside(text, range.start + 1, range))??;
    let span = text.span(range);
    if parts.len() < AXES {
        return Some(Position::plain(span, Err(format!("{} numbers where a position has six", parts.len()))));
    }
    let numbers = match text.numbers(&parts[..AXES]) {
        Ok(numbers) => numbers,
        Err(part) => return Some(Position::plain(span, Err(computed(text, &part)))),
    };
    let value = pose_of(&numbers, OrientationConvention::EulerZyz).map(TargetValue::Cartesian);
    let configuration = match parts.get(AXES) {
        None => Configuration::default(),
        Some(part) if part.len() == 1 && text.kind(part.start) == Some(Kind::Text) => configuration(&text.show(part)),
        // A configuration that is computed leaves the numbers as they are.
        Some(_) => Configuration::default(),
    };
    let value = value.ok_or_else(|| "no position".to_owned());
    Some(Position { span, value, configuration, external_axes: Vec::new() })
}

fn extended(text: Text<'_>, range: &Range<usize>) -> Option<Position> {
    let parts = text.is(range.start + 1, b'(').then(|| inside(text, range.start + 1, range))??;
    let mut position = pose(text, parts.first()?)?;
    let aux = parts.last().filter(|part| text.is(part.start, b'(') || text.is(part.start, b'{'));
    let values = aux.and_then(|part| inside(text, part.start, part)).unwrap_or_default();
    let axes = values.iter().enumerate().filter_map(|(index, part)| {
        Some(ExternalAxis { name: format!("AUX{}", index + 1), value: text.number(part)?.value })
    });
    position.external_axes = axes.collect();
    position.span = text.span(range);
    Some(position)
}

fn joints(text: Text<'_>, range: &Range<usize>) -> Option<Position> {
    let parts = text.is(range.start, b'{').then(|| inside(text, range.start, range))??;
    let span = text.span(range);
    if parts.len() < AXES {
        return Some(Position::plain(span, Err("not all joints are given".into())));
    }
    let numbers = match text.numbers(&parts) {
        Ok(numbers) => numbers,
        Err(part) => return Some(Position::plain(span, Err(computed(text, &part)))),
    };
    let value = joints_of(&numbers[..AXES]).map(TargetValue::Joint).ok_or_else(|| "no position".to_owned());
    let more = numbers.iter().skip(AXES).enumerate();
    let axes = more.map(|(index, field)| ExternalAxis { name: format!("AUX{}", index + 1), value: field.value });
    Some(Position { span, value, configuration: Configuration::default(), external_axes: axes.collect() })
}

fn computed(text: Text<'_>, part: &Range<usize>) -> String {
    format!("a part of the position is computed (`{}`)", text.show(part))
}

/// `'S E W T1:0 T2:-1'`; an empty string asks for nothing: programs that do not care have it.
fn configuration(text: &str) -> Configuration {
    let words: Vec<String> = text.trim_matches('\'').split_whitespace().map(str::to_uppercase).collect();
    if words.is_empty() {
        return Configuration::default();
    }
    let has = |word: &str| Some(words.iter().any(|other| other == word));
    let turns = TURNS.iter().filter_map(|&(mark, joint)| {
        let turns: i32 = words.iter().find_map(|word| word.strip_prefix(mark))?.parse().ok()?;
        let middle = 360.0 * f64::from(turns);
        Some((joint, middle - 180.0, middle + 180.0))
    });
    Configuration {
        joint_intervals_deg: turns.collect(),
        rear: has("S"),
        elbow_down: has("E"),
        wrist_negative: has("W"),
        near_joints_deg: None,
    }
}

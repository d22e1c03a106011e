//! Point files: `Point1 { nNumber=0 sLabel="pick" rX=.. }`, one entry a line.

use std::collections::{HashMap, HashSet};

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::orientation::OrientationConvention;
use crate::program::number::{NumberField, number_at};
use crate::program::scan::Cursor;
use crate::program::target::{CartesianNumbers, Configuration, ExternalAxis, Program, TargetValue, Units};

use super::macros::Macros;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
const KEYS: [&str; 6] = ["rX", "rY", "rZ", "rU", "rV", "rW"];
/// Values of the seventh joint and of additional axes.
const FURTHER: [&str; 3] = ["rR", "rS", "rT"];

/// The value of a point.
#[derive(Clone, Debug)]
pub(super) struct Point {
    /// File of the job.
    pub file: usize,
    /// From `Point1` to the brace that closes, or the position in a program.
    pub span: Span,
    /// For people: the label, or `P3`.
    pub shown: String,
    /// x, y, z, U, V, W, or joint values.
    pub value: TargetValue,
    /// Why the numbers are not those at run time.
    pub computed: Option<String>,
    /// Hand, elbow, flags.
    pub configuration: Configuration,
    /// R, S, T, as far as any point of the file uses them.
    pub external_axes: Vec<ExternalAxis>,
    /// The local that it is given in.
    pub local: u32,
}

/// All points of a job, by number.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// The points.
    pub all: HashMap<u32, Point>,
    /// Numbers by label in lower case.
    pub labels: HashMap<String, u32>,
    /// Names that stand for points and numbers.
    pub macros: Macros,
}

/// True for the first line that RC+ writes.
pub(super) fn is_point_file(source: &Source) -> bool {
    let bytes = source.bytes();
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes).starts_with(b"ENVT0100,")
}

/// Reads a point file.
pub(super) fn read(source: &Source, file: usize, points: &mut Points, program: &mut Program) {
    let bytes = source.bytes();
    let mut open: Option<Block> = None;
    let (mut count, mut joints) = (0, None);
    for line in source.lines() {
        let mut cursor = Cursor::new(bytes, line);
        cursor.skip_blanks();
        if let Some(block) = &mut open {
            if cursor.eat(b'}') {
                block.span.end = cursor.offset();
                let block = open.take().unwrap_or_default();
                count += 1;
                add(source, file, block, points, program);
                continue;
            }
            if let Some(key) = cursor.name() {
                cursor.skip_blanks();
                if cursor.eat(b'=') {
                    cursor.skip_blanks();
                    let value = Span::new(cursor.offset(), cursor.offset() + cursor.rest().trim_ascii_end().len());
                    block.entries.push((String::from_utf8_lossy(cursor.slice(key)).into_owned(), value));
                }
            }
            continue;
        }
        let Some(name) = cursor.name() else { continue };
        let word = cursor.slice(name);
        cursor.skip_blanks();
        if word.starts_with(b"Point") && cursor.eat(b'{') {
            open = Some(Block { span: Span::new(name.start, line.end), entries: Vec::new() });
        } else if word == b"nNumberOfJoints" && cursor.eat(b'=') {
            joints = cursor.number().map(|number| number.value);
        }
    }
    leave_out_unused_axes(file, points);
    let end = Span::new(bytes.len(), bytes.len());
    if open.is_some() {
        let message = "a point is not closed: the file may have been cut off";
        program.diagnostics.push(Diagnostic::error("truncated", message).at(file, end, "the text stops here"));
    }
    let head = source.lines().next().unwrap_or_default();
    if joints == Some(4.0) {
        let message = "the points are those of a robot with four axes";
        program.diagnostics.push(Diagnostic::warning("four-axes", message).at(file, head, ""));
    }
    if count > 0 {
        let message = "the size and checksum (DS, CS) of a point file are left as they are";
        let help = "where RC+ does not open a corrected file, import its points into a file that RC+ wrote";
        program.diagnostics.push(Diagnostic::note("checksum", message).at(file, head, "").help(help));
    }
}

/// RC+ writes R, S and T with every point; the robot has those that are not zero everywhere.
fn leave_out_unused_axes(file: usize, points: &mut Points) {
    let own = |point: &&mut Point| point.file == file;
    let used: HashSet<String> = points
        .all
        .values()
        .filter(|point| point.file == file)
        .flat_map(|point| &point.external_axes)
        .filter(|axis| axis.value != 0.0)
        .map(|axis| axis.name.clone())
        .collect();
    points.all.values_mut().filter(own).for_each(|point| point.external_axes.retain(|axis| used.contains(&axis.name)));
}

#[derive(Debug, Default)]
struct Block {
    span: Span,
    entries: Vec<(String, Span)>,
}

fn add(source: &Source, file: usize, block: Block, points: &mut Points, program: &mut Program) {
    let bytes = source.bytes();
    let entry = |key: &str| block.entries.iter().find(|(name, _)| name == key).map(|(_, span)| *span);
    let field = |key: &str| -> Option<NumberField> {
        let span = entry(key)?;
        let field = number_at(&bytes[span.start..span.end], 0)?;
        (field.span().len() == span.len()).then(|| field.at(span.start))
    };
    let integer = |key: &str| field(key).map(|field| field.value as i64);
    let Some(number) = integer("nNumber").and_then(|number| u32::try_from(number).ok()) else {
        let message = "a point without a number";
        program.diagnostics.push(Diagnostic::error("broken-point", message).at(file, block.span, ""));
        return;
    };
    let label =
        entry("sLabel").map(|span| source.text(span).trim_matches('"').to_owned()).filter(|text| !text.is_empty());
    let shown = label.clone().unwrap_or_else(|| format!("P{number}"));
    let fields: Option<Vec<NumberField>> = KEYS.iter().map(|key| field(key)).collect();
    let value = match fields.and_then(|fields| <[NumberField; 6]>::try_from(fields).ok()) {
        Some(fields) => TargetValue::Cartesian(Box::new(pose(fields))),
        None => TargetValue::Unwritten,
    };
    let broken = matches!(value, TargetValue::Unwritten);
    if broken {
        let message = format!("`{shown}` has coordinates that are no numbers");
        program.diagnostics.push(Diagnostic::error("broken-point", message).at(file, block.span, ""));
    }
    let untaught = integer("nUndefined").is_some_and(|undefined| undefined != 0);
    let reason = if broken { "its coordinates cannot be read" } else { "it is not taught (nUndefined)" };
    let mut computed = (broken || untaught).then(|| reason.to_owned());
    if points.all.get(&number).is_some_and(|known| known.file != file) {
        computed = Some("several point files give it: which one is loaded is known only at run time".into());
    }
    let further =
        FURTHER.iter().filter_map(|key| Some(ExternalAxis { name: key[1..].to_owned(), value: field(key)?.value }));
    let configuration = configuration(&integer);
    let local = integer("nLocal").and_then(|local| u32::try_from(local).ok()).unwrap_or_default();
    if let Some(label) = label {
        points.labels.insert(label.to_lowercase(), number);
    }
    let external_axes = further.collect();
    let point = Point { file, span: block.span, shown, value, computed, configuration, external_axes, local };
    points.all.insert(number, point);
}

/// x, y, z, U, V, W.
pub(super) fn pose(fields: [NumberField; 6]) -> CartesianNumbers {
    let [x, y, z, u, v, w] = fields;
    CartesianNumbers {
        position: [x, y, z],
        orientation: [u, v, w].into(),
        convention: OrientationConvention::EulerZyx,
        units: Units::MM_DEG,
    }
}

fn configuration(integer: &impl Fn(&str) -> Option<i64>) -> Configuration {
    let mut asked = Configuration::default();
    let side = |key: &str| match integer(key) {
        Some(1) => Some(false),
        Some(2) => Some(true),
        _ => None,
    };
    asked.rear = side("nHand");
    asked.elbow_down = side("nElbow");
    for (key, joint) in [("nJ4Flag", 3), ("nJ6Flag", 5)] {
        if integer(key) == Some(0) {
            asked.joint_intervals_deg.push((joint, -180.0, 180.0));
        }
    }
    asked
}

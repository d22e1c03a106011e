//! Statements into targets.

use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::orientation::OrientationConvention;
use crate::program::dialect::stated::Stated;
use crate::program::number::{Insertion, NumberField};
use crate::program::shared::Shared;
use crate::program::target::{
    CartesianNumbers, Configuration, LengthUnit, PathKind, Program, Reference, Target, TargetValue, Units, Use, Way,
};

use super::statement::{Part, Statement, parts};

/// Numbers of a point.
const POINT: usize = 3;
/// Numbers of a point with an axis.
const POINT_AND_AXIS: usize = 6;

/// True when three of five statements have the form of the format, with a `GOTO` to numbers among them.
pub(super) fn recognises(source: &Source) -> bool {
    let (mut statements, mut others, mut goes) = (0, 0, false);
    for part in parts(source) {
        match part {
            Part::Statement(statement) => {
                statements += 1;
                goes |= statement.major == "GOTO" && statement.numbers(source, POINT).is_some();
            }
            Part::Opaque => others += 1,
            Part::Comment(_) => {}
        }
    }
    goes && statements * 2 >= others * 3
}

/// Reads the files; each has its own modes.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    for (file, source) in sources.iter().enumerate() {
        Reader::new(source, file).read(&mut program);
    }
    program
}

/// A file while it is read.
struct Reader<'a> {
    source: &'a Source,
    file: usize,
    stated: Stated,
    units: Option<LengthUnit>,
    tool: Option<Reference>,
    /// The coordinate system that was given first.
    system: Option<String>,
    /// A second one, with its line.
    other_system: Option<String>,
    /// The axis of the motion before.
    axis: Option<Vec<NumberField>>,
    /// Why moves do not go where they say: the word that began it, and the reason.
    elsewhere: Vec<(&'static str, String)>,
    rapid: bool,
    arcs: Vec<Span>,
    without_axis: Vec<Span>,
    ways: Shared<Way>,
}

/// Words behind which points are not where the tool goes, and what the words do.
const ELSEWHERE: [(&str, &str); 8] = [
    ("CYCLE", "a cycle"),
    ("TRACUT", "transformed"),
    ("ORIGIN", "shifted"),
    ("TRANS", "shifted"),
    ("COPY", "copied"),
    ("ROTATE", "on a turned table"),
    ("ROTABL", "on a turned table"),
    ("CUTCOM", "beside the path by the tool's radius"),
];

impl<'a> Reader<'a> {
    fn new(source: &'a Source, file: usize) -> Self {
        Self {
            source,
            file,
            stated: Stated::default(),
            units: None,
            tool: None,
            system: None,
            other_system: None,
            axis: None,
            elsewhere: Vec::new(),
            rapid: false,
            arcs: Vec::new(),
            without_axis: Vec::new(),
            ways: Shared::default(),
        }
    }

    fn read(mut self, program: &mut Program) {
        let first = program.targets.len();
        for part in parts(self.source) {
            match part {
                Part::Comment(text) => {
                    self.stated.read(self.source, self.file, text, &mut program.diagnostics);
                }
                Part::Statement(statement) => self.statement(&statement, program),
                Part::Opaque => {}
            }
        }
        if let Some(target) = program.targets.get(first) {
            self.findings(target.span, program);
        }
    }

    fn findings(&self, place: Span, program: &mut Program) {
        let mut say = |code, message: String, at: Span, help: &str| {
            program.diagnostics.push(Diagnostic::error(code, message).at(self.file, at, "").help(help));
        };
        match self.stated.orientation {
            Some(OrientationConvention::ToolAxis(_)) => {}
            Some(_) => say("orientation-missing", "a tool axis is no other orientation".into(), place, STATE),
            None => {
                say("orientation-missing", "how the tool is turned about its axis stands nowhere".into(), place, STATE)
            }
        }
        if self.units.or(self.stated.length).is_none() {
            say("unit-missing", "the unit of lengths stands nowhere: no UNITS".into(), place, STATE);
        }
        if let Some(arc) = self.arcs.first() {
            let message =
                format!("{} arcs about a centre: corrected ends would not lie on the circle", self.arcs.len());
            say("arc-by-centre", message, *arc, "let the CAM system write arcs as short lines");
        }
        if let Some(place) = self.without_axis.first() {
            let message = format!(
                "{} points without a tool axis: a correction tilts the tool, which three numbers cannot hold",
                self.without_axis.len()
            );
            say("axis-missing", message, *place, "let the CAM system write tool axes (MULTAX/ON)");
        }
    }

    fn statement(&mut self, statement: &Statement, program: &mut Program) {
        let word = |index| statement.word(self.source, index);
        let line = self.source.line(statement.span.start);
        match statement.major.as_str() {
            "UNITS" => {
                self.units = match word(0).as_ref() {
                    "MM" => Some(LengthUnit::Millimetre),
                    "INCHES" | "INCH" => Some(LengthUnit::Inch),
                    _ => None,
                }
            }
            "LOADTL" | "TOOLNO" => self.tool = Some(tool(&word(0))),
            "LOAD" if word(0) == "TOOL" => self.tool = Some(tool(&word(1))),
            "MSYS" => {
                let system = self.source.text(statement.span).to_ascii_uppercase();
                match &self.system {
                    Some(first) if *first != system => {
                        self.other_system = Some(format!("another coordinate system since line {line} (MSYS)"));
                    }
                    Some(_) => self.other_system = None,
                    None => self.system = Some(system),
                }
            }
            "RAPID" => self.rapid = true,
            "FROM" => self.axis = statement.numbers(self.source, POINT_AND_AXIS).map(|all| all[POINT..].to_vec()),
            "CIRCLE" | "MOVARC" => self.arcs.push(statement.span),
            "TLON" | "INDIRV" | "GOFWD" => self.arcs.push(statement.span),
            "GODLTA" => self.computed(statement, "relative to the position before".into(), program),
            "MACRO" | "CALL" | "LOOPST" | "JUMPTO" => self.axis = None,
            "GOTO" => self.go(statement, program),
            major => {
                if let Some(&(begun, what)) = ELSEWHERE.iter().find(|(begun, _)| *begun == major) {
                    self.elsewhere.retain(|(other, _)| *other != begun);
                    let zero =
                        statement.numbers(self.source, POINT).is_some_and(|all| all.iter().all(|one| one.value == 0.0));
                    if !zero && !matches!(word(0).as_ref(), "OFF" | "NOMORE") {
                        self.elsewhere.push((begun, format!("{what} since line {line} ({begun})")));
                    }
                }
            }
        }
    }

    fn go(&mut self, statement: &Statement, program: &mut Program) {
        let axis_follows = statement.minors.len() >= POINT_AND_AXIS;
        let count = if axis_follows { POINT_AND_AXIS } else { POINT };
        let Some(mut numbers) = statement.numbers(self.source, count) else {
            self.axis = None;
            return self.computed(statement, "the point is a name or incomplete".into(), program);
        };
        let axis = match (numbers.split_off(POINT), &self.axis) {
            (written, _) if written.len() == POINT => written,
            (_, Some(before)) => left_out(statement.minors[POINT - 1].end, before),
            (_, None) => {
                self.without_axis.push(statement.span);
                return self.computed(statement, "no tool axis is known".into(), program);
            }
        };
        let [Some(x), Some(y), Some(z)] = [0, 1, 2].map(|index| numbers.get(index).cloned()) else { return };
        self.axis = Some(axis.clone());
        let elsewhere = self.elsewhere.last().map(|(_, reason)| reason.clone()).or_else(|| self.other_system.clone());
        if let Some(reason) = elsewhere {
            return self.computed(statement, reason, program);
        }
        let value = CartesianNumbers {
            position: [x, y, z],
            orientation: axis.into_iter().collect(),
            convention: self.stated.orientation.unwrap_or(OrientationConvention::FixedXyz),
            units: Units {
                length: self.units.or(self.stated.length).unwrap_or(LengthUnit::Millimetre),
                radians: false,
            },
        };
        self.push(statement, TargetValue::Cartesian(Box::new(value)), None, program);
    }

    fn computed(&mut self, statement: &Statement, reason: String, program: &mut Program) {
        self.push(statement, TargetValue::Unwritten, Some(reason), program);
    }

    fn push(&mut self, statement: &Statement, value: TargetValue, computed: Option<String>, program: &mut Program) {
        let rapid = std::mem::take(&mut self.rapid);
        let way = Way {
            motion: Arc::from(if rapid { "RAPID" } else { statement.major.as_str() }),
            path: if rapid { PathKind::Other } else { PathKind::Linear },
            tool: self.tool.clone().unwrap_or_else(|| self.stated.tool.clone()),
            frame: self.stated.frame.clone(),
            grip_load: Reference::Unnamed,
            computed: None,
        };
        let one = Use::new(self.file, statement.span, self.ways.share(way));
        program.targets.push(Target {
            file: self.file,
            name: None,
            span: statement.span,
            value,
            computed,
            configuration: Configuration::unsaid(),
            external_axes: Vec::new(),
            rides_along: false,
            uses: vec![one],
        });
    }
}

const STATE: &str = "state it before the first GOTO: `$$ falsetarget: units=mm orientation=tool-axis,+x` when the tool's X \
                     points as far as it can along X of the work";

fn tool(number: &str) -> Reference {
    match number.parse::<u32>() {
        Ok(number) => Reference::Named(format!("T{number}").into()),
        Err(_) => Reference::Runtime("the tool's number is no number".into()),
    }
}

/// The axis of the motion before, to be written behind the point.
fn left_out(at: usize, before: &[NumberField]) -> Vec<NumberField> {
    let insertion = Insertion { before: ",".into(), after: String::new(), repeats: true };
    let left_out = |field: &NumberField| NumberField::left_out(at, field.value, field.decimals(), insertion.clone());
    before.iter().map(left_out).collect()
}

//! The programs of a job: motions become targets.

use std::collections::HashMap;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::orientation::OrientationConvention;
use crate::program::gather::{Gathered, plain};
use crate::program::number::NumberField;
use crate::program::selection::{InForce, Selections};
use crate::program::target::{
    CartesianNumbers, Definition, ExternalAxis, JointNumbers, Program, Reference, Target, TargetValue, Units, Use, Way,
};

use super::line::{Goal, Line, Motion, is_numbered, jumps, read as read_line};

/// Reads the files; pose variables are known in their own program only, for nothing tells which one ran before.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    let mut targets = Gathered::default();
    for (file, source) in sources.iter().enumerate() {
        One::read(file, source, &mut program).finish(&mut targets);
    }
    targets.finish(&mut program);
    program
}

/// Keys of pose variables that each file has room for: their numbers have sixteen bits.
const VARIABLES_A_FILE: usize = 1 << 16;

struct Variable {
    span: Span,
    numbers: Option<Vec<NumberField>>,
    changed: Option<String>,
    /// The coordinates of all motions that go there, where they agree.
    coordinates: Option<String>,
}

struct One<'a> {
    file: usize,
    source: &'a Source,
    motions: Vec<(Span, Motion, Option<String>)>,
    variables: HashMap<u32, Variable>,
    pinned: HashMap<u32, String>,
    frames: Selections,
    joins: Vec<usize>,
}

impl<'a> One<'a> {
    fn read(file: usize, source: &'a Source, program: &mut Program) -> Self {
        let mut one = Self {
            file,
            source,
            motions: Vec::new(),
            variables: HashMap::new(),
            pinned: HashMap::new(),
            frames: Selections::default(),
            joins: Vec::new(),
        };
        let (mut shift, mut ends) = (None, false);
        let jumps_to_numbers = source.lines().any(|span| jumps(source.bytes(), span));
        for span in source.lines() {
            if jumps_to_numbers && is_numbered(source.bytes(), span) {
                one.joins.push(span.start);
            }
            let line = source.line(span.start);
            let Some(read) = read_line(source.bytes(), span) else { continue };
            let runtime = |what: &str| format!("{what} is set in line {line}");
            match read {
                Line::Motion(motion) => one.motions.push((span, motion, shift.clone())),
                Line::Variable(number, place, numbers) => {
                    let changed = numbers.is_none().then(|| format!("P{number} is computed in line {line}"));
                    let again = format!("P{number} is set again in line {line}");
                    one.variables
                        .entry(number)
                        .and_modify(|variable| {
                            variable.changed.get_or_insert(again);
                        })
                        .or_insert(Variable { span: place, numbers, changed, coordinates: None });
                }
                Line::Frame(number, points) => {
                    for point in points {
                        let reason = format!("line {line} makes a frame of it: a correction would move that frame");
                        one.pinned.entry(point).or_insert(reason);
                    }
                    if let Some(number) = number {
                        let value = Err(runtime(&format!("user coordinate system {number}")));
                        program.frames.insert(number.to_string(), Definition { file, span, value });
                    }
                }
                Line::Select(number) => {
                    let selected = match number {
                        Some(0) => Reference::Unnamed,
                        Some(number) => Reference::Named(number.to_string().into()),
                        None => Reference::Runtime(format!("the coordinate system is selected in line {line}")),
                    };
                    one.frames.push(span.start, selected);
                }
                Line::Tool(Some(number)) => {
                    let value = Err(runtime(&format!("tool {number}")));
                    program.tools.insert(number.to_string(), Definition { file, span, value });
                }
                Line::Tool(None) => {
                    let message = "the number of the tool that is set here is known only at run time";
                    program.diagnostics.push(Diagnostic::warning("runtime-definition", message).at(file, span, ""));
                }
                Line::Shift => shift = Some(format!("displaced by the shift in line {line}")),
                Line::Join => one.joins.push(span.start),
                Line::End => ends = true,
            }
        }
        if !one.motions.is_empty() && !ends {
            let end = Span::new(source.bytes().len(), source.bytes().len());
            let message = "the program has no END: it may have been cut off";
            program.diagnostics.push(Diagnostic::warning("missing-end", message).at(file, end, "the text stops here"));
        }
        one
    }

    fn finish(mut self, targets: &mut Gathered) {
        for (_, motion, _) in &self.motions {
            let Goal::Variable(number, _) = motion.goal else { continue };
            let Some(variable) = self.variables.get_mut(&number) else { continue };
            let known = variable.coordinates.get_or_insert_with(|| motion.coordinates.clone());
            if *known != motion.coordinates {
                variable.changed.get_or_insert_with(|| "it is used as a pose and as joint values".into());
            }
        }
        for (span, motion, shift) in &self.motions {
            let frame = match self.frames.at(span.start + 1, &self.joins) {
                InForce::Nothing => Reference::Unnamed,
                InForce::Known(selected) => selected.clone(),
                InForce::Open => Reference::Runtime("which coordinate system holds here depends on the way".into()),
            };
            let one = Use::new(
                self.file,
                *span,
                Way {
                    motion: "MOVEX".into(),
                    path: motion.path,
                    tool: motion.tool.map_or(Reference::Unnamed, |tool| Reference::Named(tool.to_string().into())),
                    frame: if motion.coordinates == "X" { frame } else { Reference::Unnamed },
                    grip_load: Reference::Unnamed,
                    computed: shift.clone(),
                },
            );
            self.goal(motion, one, targets);
        }
    }

    fn goal(&self, motion: &Motion, one: Use, targets: &mut Gathered) {
        let external_axes: Vec<ExternalAxis> =
            motion.further.iter().map(|(name, value)| ExternalAxis { name: name.clone(), value: *value }).collect();
        let unwritten = |targets: &mut Gathered, span: Span, reason: &str, one| {
            targets.unwritten(&self.source.text(span), span, reason.to_owned(), one);
        };
        match &motion.goal {
            Goal::Other(span) => unwritten(targets, *span, "where it goes is known only at run time", one),
            Goal::Written(span, numbers) => match value(numbers.as_deref(), &motion.coordinates) {
                Ok(value) => {
                    let target = targets.inline(Target { external_axes, ..plain(self.file, *span, value) });
                    target.add_use(one);
                }
                Err(reason) => unwritten(targets, *span, &reason, one),
            },
            Goal::Variable(number, span) => {
                let Some(variable) = self.variables.get(number) else {
                    return unwritten(targets, *span, "the program gives it no value", one);
                };
                match (&variable.changed, value(variable.numbers.as_deref(), &motion.coordinates)) {
                    (None, Ok(value)) => {
                        let key = self.file * VARIABLES_A_FILE + *number as usize;
                        targets.add_use(key, one, || Target {
                            name: Some(format!("P{number}")),
                            computed: self.pinned.get(number).cloned(),
                            external_axes,
                            ..plain(self.file, variable.span, value)
                        });
                    }
                    (Some(reason), _) => unwritten(targets, *span, reason, one),
                    (None, Err(reason)) => unwritten(targets, *span, &reason, one),
                }
            }
        }
    }
}

/// Six numbers as a pose or joint values.
fn value(numbers: Option<&[NumberField]>, coordinates: &str) -> Result<TargetValue, String> {
    let Some(numbers) = numbers else { return Err("its numbers are computed".into()) };
    let Ok(fields) = <[NumberField; 6]>::try_from(numbers.to_vec()) else {
        return Err(format!("it has {} numbers", numbers.len()));
    };
    match coordinates {
        "J" => Ok(TargetValue::Joint(Box::new(JointNumbers { joints: fields, units: Units::MM_DEG }))),
        "X" => {
            let [x, y, z, rz, ry, rx] = fields;
            Ok(TargetValue::Cartesian(Box::new(CartesianNumbers {
                position: [x, y, z],
                orientation: [rz, ry, rx].into(),
                convention: OrientationConvention::EulerZyx,
                units: Units::MM_DEG,
            })))
        }
        other => Err(format!("what coordinates of the kind `{other}` mean is not known here")),
    }
}

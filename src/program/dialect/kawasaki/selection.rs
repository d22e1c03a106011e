//! `TOOL`, `BASE` and `WEIGHT`: what is in force at a motion.

use std::collections::{HashMap, HashSet};

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::base::units::m_from_mm;
use crate::geometry::pose::Pose;
use crate::program::selection::{InForce, Selections};
use crate::program::target::{Definition, FrameData, LoadData, Program, Reference, ToolData};

use super::assignment::Placed;
use super::expression::{Expression, pose_numbers};
use super::section::Body;
use super::statement::Statement;
use super::value::Values;

/// Names under which the selections of the system data are filed; no variable is spelled so.
const SYSTEM_TOOL: &str = "TOOL of the system data";
const SYSTEM_BASE: &str = "BASE of the system data";

/// The selections of one file.
#[derive(Debug, Default)]
pub(super) struct InFile {
    tools: Selections,
    bases: Selections,
    weights: Selections,
    joins: Vec<usize>,
    loads: HashMap<String, LoadData>,
    selects_tool: bool,
}

/// What is in force at a place.
#[derive(Clone, Debug)]
pub(super) struct Setting {
    /// The tool.
    pub tool: Reference,
    /// The base.
    pub base: Reference,
    /// Known only at run time, or nothing: the load belongs to the tool where it is known.
    pub load: Reference,
}

/// Tool and base as a save's system data has them, and the tools of block steps.
pub(super) fn define_system(file: usize, line: Span, word: &str, values: &[f64], program: &mut Program) {
    let field = |at: usize| crate::program::number::NumberField {
        span: Span::default(),
        value: values[at],
        decimals: 0,
        insertion: None,
        column: None,
    };
    let Some(pose) = pose_numbers(std::array::from_fn(field)).pose() else { return };
    match word.strip_prefix("TOOL") {
        Some("") => tool(program, file, line, SYSTEM_TOOL, pose, None),
        Some(number) => tool(program, file, line, number, pose, None),
        None => frame(program, file, line, SYSTEM_BASE, pose),
    }
}

fn tool(program: &mut Program, file: usize, span: Span, name: &str, pose: Pose, load: Option<LoadData>) {
    let value = Ok(ToolData { pose, held_by_robot: true, load });
    program.tools.insert(Program::key(name), Definition { file, span, value });
}

/// Defines a frame of the job.
pub(super) fn frame(program: &mut Program, file: usize, span: Span, name: &str, pose: Pose) {
    let value = Ok(FrameData { pose, held_by_robot: false });
    program.frames.insert(Program::key(name), Definition { file, span, value });
}

impl InFile {
    /// Follows the statements of a file.
    pub fn of(
        file: usize,
        source: &Source,
        bodies: &[Body],
        statements: &[&Placed],
        values: &Values,
        program: &mut Program,
    ) -> Self {
        let mut found = Self::default();
        let quiet = quiet(bodies, statements);
        let mut current = None;
        for placed in statements {
            let offset = placed.span.start;
            if current != Some(placed.scope) {
                // A program starts with whatever was selected last, perhaps by itself.
                found.joins.push(offset);
                current = Some(placed.scope);
            }
            match &placed.statement {
                Statement::Tool(expression) => {
                    let (selected, pose) = selected(source, placed, expression, values, "tool");
                    if let (Reference::Named(name), Some(pose)) = (&selected, pose) {
                        tool(program, file, placed.span, name, pose, None);
                    }
                    found.tools.push(offset, selected);
                    found.selects_tool = true;
                }
                Statement::Base(expression) => {
                    let (selected, pose) = selected(source, placed, expression, values, "base");
                    if let (Reference::Named(name), Some(pose)) = (&selected, pose) {
                        frame(program, file, placed.span, name, pose);
                    }
                    found.bases.push(offset, selected);
                }
                Statement::Weight(numbers) => found.weight(source, placed, numbers.as_deref()),
                Statement::Join => found.joins.push(offset),
                Statement::Call(callee, _) if !quiet.contains(callee.as_str()) => found.joins.push(placed.span.end),
                _ => {}
            }
        }
        found
    }

    fn weight(&mut self, source: &Source, placed: &Placed, numbers: Option<&[f64]>) {
        let line = source.line(placed.span.start);
        let name = format!("WEIGHT in line {line}");
        let selected = match numbers {
            None => Reference::Runtime(format!("the load is computed in line {line}")),
            Some([mass_kg, x, y, z, ..]) if *mass_kg >= 0.0 => {
                let center_of_mass_m = [m_from_mm(*x), m_from_mm(*y), m_from_mm(*z)];
                self.loads.insert(name.clone(), LoadData { mass_kg: *mass_kg, center_of_mass_m });
                Reference::Named(name.into())
            }
            Some(_) => Reference::Unnamed,
        };
        self.weights.push(placed.span.start, selected);
    }

    /// What is in force at a byte offset; defines the tool with its load in `program`.
    pub fn at(&self, offset: usize, file: usize, span: Span, program: &mut Program) -> Setting {
        let tool_reference = match self.tools.at(offset, &self.joins) {
            InForce::Known(selected) => selected.clone(),
            InForce::Open => open("tools"),
            InForce::Nothing => system(program.tools.contains_key(&Program::key(SYSTEM_TOOL)), SYSTEM_TOOL),
        };
        let base = match self.bases.at(offset, &self.joins) {
            InForce::Known(selected) => selected.clone(),
            InForce::Open => open("bases"),
            InForce::Nothing => system(program.frames.contains_key(&Program::key(SYSTEM_BASE)), SYSTEM_BASE),
        };
        let weight = match self.weights.at(offset, &self.joins) {
            InForce::Known(selected) => selected.clone(),
            InForce::Open => open("loads"),
            InForce::Nothing => Reference::Unnamed,
        };
        match &weight {
            Reference::Runtime(_) => Setting { tool: tool_reference, base, load: weight },
            Reference::Unnamed => Setting { tool: tool_reference, base, load: Reference::Unnamed },
            Reference::Named(name) => {
                let tool = self.loaded(&tool_reference, name, file, span, program);
                Setting { tool, base, load: Reference::Unnamed }
            }
        }
    }

    /// The tool with a load: the load counts where the job has the tool's pose; else the cell file gives both.
    fn loaded(&self, reference: &Reference, weight: &str, file: usize, span: Span, program: &mut Program) -> Reference {
        let Reference::Named(name) = reference else { return reference.clone() };
        let known = program.tools.get(&Program::key(name)).and_then(|tool| tool.value.as_ref().ok());
        let (Some(known), Some(load)) = (known, self.loads.get(weight)) else { return reference.clone() };
        let name = format!("{name}, {weight}");
        tool(program, file, span, &name, known.pose, Some(*load));
        Reference::Named(name.into())
    }

    /// What to know of loads that are not used.
    pub fn check(&self, file: usize, statements: &[&Placed], program: &mut Program) {
        let first = statements.iter().find(|placed| matches!(placed.statement, Statement::Weight(Some(_))));
        if let Some(first) = first.filter(|_| !self.selects_tool) {
            let message = "a load is set, and no tool in the job: the load of the cell file or model is used";
            program.diagnostics.push(Diagnostic::note("weight-not-used", message).at(file, first.span, ""));
        }
    }
}

fn open(what: &str) -> Reference {
    Reference::Runtime(format!("several {what} are selected, and which holds here depends on the way"))
}

fn system(known: bool, name: &str) -> Reference {
    if known { Reference::Named(name.into()) } else { Reference::Unnamed }
}

/// What a statement selects, with its pose where the job has it.
fn selected(
    source: &Source,
    placed: &Placed,
    expression: &Expression,
    values: &Values,
    what: &str,
) -> (Reference, Option<Pose>) {
    let shown = source.text(expression.span).into_owned();
    let line = source.line(placed.span.start);
    let Some(terms) = expression.terms.as_deref() else {
        return (Reference::Runtime(format!("the {what} is computed in line {line}")), None);
    };
    match values.pose(terms, placed.scope) {
        // Local variables of two programs may have one name.
        Ok(pose) if expression.names().iter().any(|name| name.is_local()) => {
            (Reference::Named(format!("{shown} in line {line}").into()), Some(pose))
        }
        Ok(pose) => (Reference::Named(shown.into()), Some(pose)),
        Err((_, true)) => (Reference::Named(shown.into()), None),
        Err((reason, false)) => (Reference::Runtime(format!("the {what} is set in line {line}: {reason}")), None),
    }
}

/// Programs that select nothing, neither themselves nor through what they call.
fn quiet<'a>(bodies: &'a [Body], statements: &[&Placed]) -> HashSet<&'a str> {
    let mut callers: HashMap<&str, Vec<usize>> = HashMap::new();
    let here: HashSet<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
    let mut found = vec![false; bodies.len()];
    let mut open = Vec::new();
    for placed in statements {
        let program = placed.scope.1;
        let selects = match &placed.statement {
            Statement::Tool(_) | Statement::Base(_) | Statement::Weight(_) => true,
            Statement::Call(callee, _) => {
                callers.entry(callee).or_default().push(program);
                !here.contains(callee.as_str())
            }
            _ => false,
        };
        if selects && !std::mem::replace(&mut found[program], true) {
            open.push(program);
        }
    }
    while let Some(program) = open.pop() {
        for &caller in callers.get(bodies[program].name.as_str()).into_iter().flatten() {
            if !std::mem::replace(&mut found[caller], true) {
                open.push(caller);
            }
        }
    }
    bodies.iter().zip(found).filter(|(_, selects)| !*selects).map(|(body, _)| body.name.as_str()).collect()
}

//! `TOOL`, `BASE` and `WEIGHT`: what is in force at a motion.

use std::collections::HashMap;
use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::base::units::m_from_mm;
use crate::geometry::pose::Pose;
use crate::program::flow::{State, Step, follow, left_over};
use crate::program::target::{Definition, FrameData, LoadData, Program, Reference, ToolData};

use super::assignment::Placed;
use super::expression::{Expression, pose_numbers};
use super::section::Body;
use super::statement::{Statement, Way};
use super::value::Values;

/// Names under which the selections of the system data are filed; no variable is spelled so.
const SYSTEM_TOOL: &str = "TOOL of the system data";
const SYSTEM_BASE: &str = "BASE of the system data";

const TOOL: usize = 0;
const BASE: usize = 1;
const WEIGHT: usize = 2;

/// What every statement of a job finds selected.
#[derive(Debug, Default)]
pub(super) struct InForceAt {
    /// By number of the statement.
    states: Vec<Option<Arc<State<3>>>>,
    /// What a program finds that selects nothing before, by kind.
    before: [Reference; 3],
    loads: HashMap<String, LoadData>,
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
    let field = |at: usize| crate::program::number::NumberField::unplaced(values[at]);
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
    let value = Ok(FrameData { pose, held_by_robot: false, on: None });
    program.frames.insert(Program::key(name), Definition { file, span, value });
}

impl InForceAt {
    /// Follows the programs of a job.
    pub fn of(
        sources: &[Source],
        bodies: &[Vec<Body>],
        statements: &[Placed],
        values: &Values,
        program: &mut Program,
    ) -> Self {
        let mut found = Self { states: vec![None; statements.len()], ..Self::default() };
        let mut first_of_file = Vec::new();
        let mut routines = 0;
        for programs in bodies {
            first_of_file.push(routines);
            routines += programs.len();
        }
        let named = |(at, body): (usize, &Body)| (body.name.clone(), at);
        let by_name: HashMap<String, usize> = bodies.iter().flatten().enumerate().map(named).collect();
        let mut steps: Vec<Vec<Way>> = vec![Vec::new(); routines];
        let mut places = Vec::with_capacity(statements.len());
        let mut selections: [Vec<Reference>; 3] = Default::default();
        for placed in statements {
            let source = &sources[placed.scope.0];
            let routine = first_of_file[placed.scope.0] + placed.scope.1;
            let set = match &placed.statement {
                Statement::Tool(expression) => {
                    let (selected, pose) = selected(source, placed, expression, values, "tool");
                    if let (Reference::Named(name), Some(pose)) = (&selected, pose) {
                        tool(program, placed.scope.0, placed.span, name, pose, None);
                    }
                    Some((TOOL, selected))
                }
                Statement::Base(expression) => {
                    let (selected, pose) = selected(source, placed, expression, values, "base");
                    if let (Reference::Named(name), Some(pose)) = (&selected, pose) {
                        frame(program, placed.scope.0, placed.span, name, pose);
                    }
                    Some((BASE, selected))
                }
                Statement::Weight(numbers) => Some((WEIGHT, found.weight(source, placed, numbers.as_deref()))),
                _ => None,
            };
            let step = match (&placed.statement, set) {
                (_, Some((kind, selected))) => {
                    selections[kind].push(selected.clone());
                    Step::Sets(vec![(kind, selected)])
                }
                (Statement::Flow(way), _) => way.clone(),
                (Statement::Call(callee, _), _) => {
                    by_name.get(callee).map_or(Step::Plain, |callee| Step::Calls(*callee))
                }
                _ => Step::Plain,
            };
            places.push((routine, steps[routine].len()));
            steps[routine].push(step);
        }
        steps.iter_mut().for_each(|steps| pair_blocks(steps));
        let states = follow(&steps);
        let state = |&(routine, step): &(usize, usize)| Some(Arc::clone(states.get(routine)?.get(step)?));
        found.states = places.iter().map(state).collect();
        let system_tool = system(program.tools.contains_key(&Program::key(SYSTEM_TOOL)), SYSTEM_TOOL);
        let system_base = system(program.frames.contains_key(&Program::key(SYSTEM_BASE)), SYSTEM_BASE);
        found.before = [
            left_over(&selections[TOOL], system_tool, "tool"),
            left_over(&selections[BASE], system_base, "base"),
            left_over(&selections[WEIGHT], Reference::Unnamed, "load"),
        ];
        let first = statements.iter().find(|placed| matches!(placed.statement, Statement::Weight(Some(_))));
        if let Some(first) = first.filter(|_| selections[TOOL].is_empty()) {
            let message = "a load is set, and no tool in the job: the load of the cell file or model is used";
            program.diagnostics.push(Diagnostic::note("weight-not-used", message).at(first.scope.0, first.span, ""));
        }
        found
    }

    fn weight(&mut self, source: &Source, placed: &Placed, numbers: Option<&[f64]>) -> Reference {
        let line = source.line(placed.span.start);
        match numbers {
            None => Reference::Runtime(format!("the load is computed in line {line}")),
            Some([mass_kg, x, y, z, ..]) if *mass_kg >= 0.0 => {
                let name = format!("WEIGHT {mass_kg},{x},{y},{z}");
                let center_of_mass_m = [m_from_mm(*x), m_from_mm(*y), m_from_mm(*z)];
                self.loads.insert(name.clone(), LoadData { mass_kg: *mass_kg, center_of_mass_m });
                Reference::Named(name.into())
            }
            Some(_) => Reference::Unnamed,
        }
    }

    /// What is in force at a statement; defines the tool with its load in `program`.
    pub fn at(&self, number: usize, placed: &Placed, program: &mut Program) -> Setting {
        let state = self.states.get(number).and_then(Option::as_ref);
        let get = |kind: usize| match state.map(|state| state.get(kind)) {
            None | Some(Reference::Unnamed) => self.before[kind].clone(),
            Some(selected) => selected.clone(),
        };
        let (tool, base) = (get(TOOL), get(BASE));
        match get(WEIGHT) {
            Reference::Unnamed => Setting { tool, base, load: Reference::Unnamed },
            Reference::Named(weight) => {
                let tool = self.loaded(&tool, &weight, placed, program);
                Setting { tool, base, load: Reference::Unnamed }
            }
            unknown => Setting { tool, base, load: unknown },
        }
    }

    /// The tool with a load: the load counts where the job has the tool's pose; else the cell file gives both.
    fn loaded(&self, reference: &Reference, weight: &str, placed: &Placed, program: &mut Program) -> Reference {
        let Reference::Named(name) = reference else { return reference.clone() };
        let loaded = format!("{name}, {weight}");
        if !program.tools.contains_key(&Program::key(&loaded)) {
            let known = program.tools.get(&Program::key(name)).and_then(|tool| tool.value.as_ref().ok());
            let (Some(known), Some(load)) = (known, self.loads.get(weight)) else { return reference.clone() };
            tool(program, placed.scope.0, placed.span, &loaded, known.pose, Some(*load));
        }
        Reference::Named(loaded.into())
    }
}

/// `END` ends whichever block is open.
fn pair_blocks(steps: &mut [Way]) {
    let mut open = Vec::new();
    for step in steps {
        match step {
            Step::If | Step::Switch => open.push(false),
            Step::Loop => open.push(true),
            Step::EndLoop => {
                open.pop();
            }
            Step::EndBranches => match open.pop() {
                Some(true) => *step = Step::EndLoop,
                Some(false) => {}
                None => *step = Step::Plain,
            },
            _ => {}
        }
    }
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

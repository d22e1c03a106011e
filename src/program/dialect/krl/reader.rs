//! The whole job: routines, variables and settings first, then every motion in turn.

use crate::base::text::Source;
use crate::program::flow::{Step as FlowStep, follow};
use crate::program::target::Program;

use super::calls::mark_changes;
use super::checks;
use super::frames::call;
use super::job::{Job, Kind, Statement, control_step};
use super::motion::{motion, split_at_with};
use super::setting::{SETTINGS, Sets, Setter};
use super::targets::{Step, Targets};
use super::usage::Settings;
use super::variable::Variables;

/// Reads the files of one job.
pub(super) fn read(sources: &[Source]) -> Program {
    let job = Job::read(sources);
    let mut variables = Variables::of(&job);
    mark_changes(&job, &mut variables);
    let mut setter = Setter::new(&job, &variables);
    let steps: Vec<Vec<FlowStep<SETTINGS>>> =
        (0..job.routines.len()).map(|index| steps(&job, index, &mut setter)).collect();
    let states = follow(&steps);
    let mut targets = Targets::new(&job, &variables);
    let mut settings = Settings::default();
    for (index, routine) in job.routines.iter().enumerate().filter(|(_, routine)| !routine.is_data) {
        let mut block: Option<Sets> = None;
        for (statement, state) in routine.statements.iter().zip(&states[index]) {
            let bytes = job.bytes(statement.file);
            match statement.kind {
                Kind::SplineBegin => {
                    let with = split_at_with(bytes, statement.span).1;
                    block = Some(with.map(|span| setter.with(index, statement.file, span)).unwrap_or_default());
                }
                Kind::SplineEnd => block = None,
                Kind::Motion => {
                    let motion = motion(bytes, statement.span);
                    let mut with = block.clone().unwrap_or_default();
                    with.extend(motion.with.map(|span| setter.with(index, statement.file, span)).unwrap_or_default());
                    let step = Step { routine: index, statement, motion: &motion, state, with: &with };
                    targets.add(&step, &setter.frames, &mut settings);
                }
                _ => {}
            }
        }
    }
    let mut program = Program::default();
    checks::open_values(&job, &mut targets);
    targets.finish(&mut program);
    program.diagnostics.extend(checks::foreign_calls(&job, &states));
    program.diagnostics.extend(checks::open_ends(&job));
    program.diagnostics.extend(checks::metres(&program.targets));
    settings.finish(setter.frames, &mut program);
    program
}

/// What each statement of a routine does to the settings.
fn steps(job: &Job<'_>, index: usize, setter: &mut Setter<'_, '_>) -> Vec<FlowStep<SETTINGS>> {
    let routine = &job.routines[index];
    if routine.is_data {
        return Vec::new();
    }
    setter.forget();
    routine.statements.iter().map(|statement| step(job, index, statement, setter)).collect()
}

fn step(job: &Job<'_>, index: usize, statement: &Statement, setter: &mut Setter<'_, '_>) -> FlowStep<SETTINGS> {
    let bytes = job.bytes(statement.file);
    match statement.kind {
        Kind::Control => {
            setter.forget();
            control_step(bytes, statement.span)
        }
        Kind::Call => {
            let own = call(bytes, statement.span).and_then(|(callee, _)| job.routine(&callee));
            match own {
                Some(callee) => {
                    setter.forget();
                    FlowStep::Calls(callee)
                }
                None => sets(setter.sets(index, statement)),
            }
        }
        Kind::Assignment => sets(setter.sets(index, statement)),
        _ => FlowStep::Plain,
    }
}

fn sets(sets: Sets) -> FlowStep<SETTINGS> {
    if sets.is_empty() { FlowStep::Plain } else { FlowStep::Sets(sets) }
}

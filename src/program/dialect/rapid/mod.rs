//! ABB RAPID (IRC5 and OmniCore: `.mod`, `.modx`, `.sys`, `.prg`).
//!
//! What is read: declarations of positions, tools, work objects and loads; every instruction that moves to a position,
//! with the settings that change where it leads. Files of one job see each other's global names, as the modules of one
//! task do. Reading goes from tokens over statements and declarations to moves; no step fails, whatever the bytes.
//!
//! Source: ABB, Technical reference manual, RAPID Overview (3HAC050947) and RAPID Instructions, Functions and Data
//! Types (3HAC050917).

mod argument;
mod change;
mod check;
mod configuration;
mod cutter;
mod definition;
mod displacement;
mod flow;
mod follow;
mod motion;
mod moves;
mod position;
mod recognise;
mod statement;
mod symbol;
mod ties;
mod token;

#[cfg(test)]
mod tests;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Source;
use crate::program::gather::in_order;
use crate::program::number::NumberRules;
use crate::program::target::{Program, Target, TargetValue};
use crate::program::ties::Ties;

use super::{Dialect, Meta};

use change::Changes;
use flow::Flow;
use position::Positions;
use symbol::{Job, Storage};

/// ABB RAPID.
pub struct Rapid;

static META: Meta = Meta {
    id: "rapid",
    title: "ABB RAPID",
    extensions: &["mod", "modx", "sys", "sysx", "prg"],
    code_page: None,
    numbers: NumberRules { max_decimals: 9, integers_may_gain_point: true },
};

impl Dialect for Rapid {
    fn meta(&self) -> &'static Meta {
        &META
    }

    fn recognises(&self, source: &Source) -> bool {
        recognise::is_rapid(source)
    }

    fn ties(&self, source: &Source) -> Ties {
        ties::ties(source)
    }

    fn joined_folders(&self) -> &'static [&'static str] {
        &["PROGMOD", "SYSMOD"]
    }

    fn read(&self, files: &[Source]) -> Program {
        let mut program = Program::default();
        let job = Job::read(files, &mut program.diagnostics);
        let changes = Changes::of(&job);
        let keys = definition::read_definitions(&job, &changes, &mut program);
        let flow = Flow::of(&job, &keys);
        let mut positions = Positions::new(&job, &changes);
        moves::read_moves(&job, &keys, &flow, &mut positions);
        let note = saved_back(&job, &positions);
        let declarations = positions.declarations();
        let elements = positions.element_mentions();
        program.targets = in_file_order(positions.targets);
        program.note_replaceable(&elements);
        let declared = |target: &Target| declarations.get(&(target.file, target.span)).cloned();
        let by_index = program.targets.iter().enumerate();
        program.declarations = by_index.filter_map(|(index, target)| Some((index, declared(target)?))).collect();
        program.diagnostics.extend(check::check_numbers(&program.targets));
        program.diagnostics.extend(note);
        program
    }
}

/// One note when targets are `PERS`: what the controller saves replaces what the file says.
fn saved_back(job: &Job, positions: &Positions) -> Option<Diagnostic> {
    let mut persistent = job.symbols.iter().enumerate().filter(|(index, symbol)| {
        let correctable = |target: &usize| positions.targets[*target].computed.is_none();
        let targets = positions.of_symbol(*index).unwrap_or_default();
        symbol.storage == Storage::Persistent && targets.iter().any(correctable)
    });
    let (_, first) = persistent.next()?;
    let (file, count) = (first.scope.file, 1 + persistent.count());
    let span = job.files[file].span(&first.tokens);
    let message = format!("{count} positions are `PERS`: a controller saves their present value back into the module");
    let help = "load the corrected module with the program stopped, and save nothing from the controller over it";
    Some(Diagnostic::note("pers-saved-back", message).at(file, span, "such as this").help(help))
}

/// The targets that moves reach, sorted by their place; displacements keep pointing at their base.
fn in_file_order(mut targets: Vec<Target>) -> Vec<Target> {
    let mut wanted: Vec<bool> = targets.iter().map(|target| !target.uses.is_empty()).collect();
    for target in &targets {
        if let TargetValue::Displaced(displacement) = &target.value {
            wanted[displacement.base] = true;
        }
    }
    let mut order: Vec<usize> = (0..targets.len()).filter(|&index| wanted[index]).collect();
    order.sort_by_key(|&index| (targets[index].file, targets[index].span));
    let mut new_place = vec![0; wanted.len()];
    for (place, &index) in order.iter().enumerate() {
        new_place[index] = place;
    }
    for target in &mut targets {
        if let TargetValue::Displaced(displacement) = &mut target.value {
            displacement.base = new_place[displacement.base];
        }
    }
    in_order(targets, &order)
}

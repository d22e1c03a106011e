//! Programs and the locations that a controller saves apart from them (`SAVE/P`, `SAVE/L`).
//!
//! A file of locations alone gives them to the programs beside it. A file that holds programs of its own gives nothing:
//! it may be the save of another robot. Programs of one name exclude each other.

use std::collections::HashSet;

use crate::base::text::Source;
use crate::program::scan::Cursor;
use crate::program::ties::{Given, NameHash, Ties, name_hash};

use super::expression::{Expression, Name, name};
use super::motion::Goal;
use super::section::sections;
use super::statement::{Statement, statements};

/// The names that a file gives to the other files of its folder, and takes from them.
pub(super) fn ties(source: &Source) -> Ties {
    let sections = sections(source);
    let located = |line| {
        let mut cursor = Cursor::new(source.bytes(), line);
        cursor.skip_blanks();
        name(&mut cursor).map(|name| name.base)
    };
    let own: HashSet<String> = sections.locations.iter().filter_map(|&line| located(line)).collect();
    if sections.programs.is_empty() {
        let given = |base: &String| Given { name: name_hash(base), is_position: true };
        return Ties { gives: sorted(own.iter().map(given)), takes: Vec::new() };
    }
    let program = |name: &str| Given { name: name_hash(&format!("program {name}")), is_position: false };
    let gives = sorted(sections.programs.iter().map(|body| program(&body.name)));
    let mut takes: HashSet<NameHash> = HashSet::new();
    for line in sections.programs.iter().flat_map(|body| &body.lines) {
        for statement in statements(source.bytes(), *line) {
            let mut take = |name: &Name| {
                if !name.is_local() && !own.contains(&name.base) {
                    takes.insert(name_hash(&name.base));
                }
            };
            let expression = |value: &Expression, take: &mut dyn FnMut(&Name)| {
                value.names().into_iter().for_each(take);
            };
            match &statement {
                Statement::Motion(motion) => {
                    if let Goal::Location(goal) = &motion.goal {
                        expression(goal, &mut take);
                    }
                }
                Statement::Point { name, value, .. } => {
                    take(name);
                    expression(value, &mut take);
                }
                Statement::Tool(value) | Statement::Base(value) => expression(value, &mut take),
                Statement::Here(name) => take(name),
                Statement::Call(_, handed) => handed.iter().flatten().for_each(take),
                Statement::Weight(_) | Statement::ElbowDown(_) | Statement::Flow(_) => {}
            }
        }
    }
    Ties { gives, takes: sorted(takes.into_iter()) }
}

fn sorted<T: Ord>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut all: Vec<T> = all.collect();
    all.sort_unstable();
    all.dedup();
    all
}

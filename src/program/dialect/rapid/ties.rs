//! The names that a module gives to the other modules of its task, and takes from them.

use std::collections::HashSet;

use crate::base::text::Source;
use crate::program::ties::{Given, Ties, name_hash};

use super::position::is_position_type;
use super::symbol::Job;
use super::token::TokenKind;

/// Reads the declarations of a module and every name that stands in it.
pub fn ties(source: &Source) -> Ties {
    // What is wrong with the module is said when its job is read.
    let job = Job::read(std::slice::from_ref(source), &mut Vec::new());
    let own: HashSet<u64> = job.declared_names().map(name_hash).collect();
    let given =
        |(name, data_type): (&str, &str)| Given { name: name_hash(name), is_position: is_position_type(data_type) };
    let mut gives: Vec<Given> = job.global_names().map(given).collect();
    gives.sort();
    gives.dedup();
    let mut takes: HashSet<u64> = HashSet::new();
    for text in &job.files {
        for at in 0..text.tokens.len() {
            // `\WObj` is the name of an argument.
            let is_argument = at > 0 && text.is_symbol(at - 1, b'\\');
            if text.kind(at) == Some(TokenKind::Name) && !is_argument {
                takes.insert(name_hash(&text.key(at)));
            }
        }
    }
    let mut takes: Vec<u64> = takes.into_iter().filter(|name| !own.contains(name)).collect();
    takes.sort_unstable();
    Ties { gives, takes }
}

//! Targets that are used with several tools, frames or loads: no single value lands for all, so that each setting gets
//! a declaration of its own.
//!
//! A copy of the declaration is put behind it under a new name, and the moves of the other settings name the copy. An
//! element of an array, or a numbered constant that all jobs of a controller share, has no name to spare: there the
//! moves of the other settings get the written value itself. The program that comes out goes to the same places as
//! before; it is then corrected like any other.

use std::collections::{BTreeMap, HashSet};

use crate::base::edit::EditSet;
use crate::base::text::{Source, Span};
use crate::program::target::{Declaration, Mention, Program, Reference, TargetValue, Use};

use super::outcome::Outcome;

/// Longest identifier of the languages that declare positions by name (RAPID).
const LONGEST_NAME: usize = 32;

/// What stands between a target and the flange, as the move says it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Setting(String, String, String);

/// The edits of each file of a job that give every shared target one declaration a setting. Empty where there is
/// nothing to split: no shared target, or none in a language that allows it.
pub fn split(sources: &[Source], program: &Program, outcome: &Outcome) -> Vec<EditSet> {
    let mut edits = vec![EditSet::default(); sources.len()];
    let mut taken = identifiers(sources);
    let shared = outcome.targets.iter().enumerate().filter(|(_, target)| target.shared);
    for (index, _) in shared {
        if let Some(declaration) = program.declarations.get(&index) {
            split_target(sources, program, index, declaration, &mut taken, &mut edits);
        } else if let Some(mentions) = program.replaceable.get(&index) {
            replace_names(sources, program, index, mentions, &mut edits);
        }
    }
    edits
}

fn split_target(
    sources: &[Source],
    program: &Program,
    index: usize,
    declaration: &Declaration,
    taken: &mut HashSet<String>,
    edits: &mut [EditSet],
) {
    let target = &program.targets[index];
    let source = &sources[target.file];
    let own = source.text(declaration.name).into_owned();
    let mut mentions = declaration.mentions.clone();
    mentions.sort();
    let mut names: BTreeMap<Setting, String> = BTreeMap::new();
    let mut copies = Vec::new();
    for one in moves(program, index) {
        // The setting of the first move keeps the name.
        let count = names.len();
        let name = names.entry(Setting::of(one)).or_insert_with(|| match count {
            0 => own.clone(),
            _ => {
                let name = fresh_name(taken, &own);
                taken.insert(Program::key(&name));
                copies.push(name.clone());
                name
            }
        });
        if *name == own {
            continue;
        }
        mentions_in(&mentions, one).for_each(|place| edits[one.file].push(place, name.as_bytes()));
    }
    let end = line_end_behind(source, declaration.statement.end);
    let (line_end, indent) = (newline(source), indentation(source, declaration.statement.start));
    let mut insertion = Vec::new();
    for name in copies {
        insertion.extend_from_slice(line_end);
        insertion.extend_from_slice(source.slice(indent));
        insertion.extend_from_slice(source.slice(Span::new(declaration.statement.start, declaration.name.start)));
        insertion.extend_from_slice(name.as_bytes());
        insertion.extend_from_slice(source.slice(Span::new(declaration.name.end, declaration.statement.end)));
    }
    edits[target.file].push(Span::new(end, end), insertion);
}

/// Where a language takes a written value in the place of a name, the moves of all settings but the first get it.
fn replace_names(sources: &[Source], program: &Program, index: usize, mentions: &[Mention], edits: &mut [EditSet]) {
    let target = &program.targets[index];
    let value = sources[target.file].slice(target.span);
    // What is written by a function (`Pose(..)`) cannot be told to stand everywhere.
    if !matches!(value, [b'(' | b'[' | b'{', ..] | [b'p', b'[', ..]) {
        return;
    }
    let mut mentions = mentions.to_vec();
    mentions.sort();
    let all = moves(program, index);
    let Some(first) = all.first().map(|one| Setting::of(one)) else { return };
    for one in all.into_iter().filter(|one| Setting::of(one) != first) {
        mentions_in(&mentions, one).for_each(|place| edits[one.file].push(place, value));
    }
}

/// The places in a move at which sorted mentions stand.
fn mentions_in<'a>(mentions: &'a [Mention], one: &'a Use) -> impl Iterator<Item = Span> + 'a {
    let from = mentions.partition_point(|mention| *mention < (one.file, one.span));
    let inside = mentions[from..].iter().take_while(|(file, at)| *file == one.file && one.span.contains(*at));
    inside.map(|(_, place)| *place)
}

/// The moves to a target and to those displaced from it, in the order of the text.
fn moves(program: &Program, index: usize) -> Vec<&Use> {
    let displaced_from = |value: &TargetValue| match value {
        TargetValue::Displaced(displacement) => Some(displacement.base),
        _ => None,
    };
    let belong = program
        .targets
        .iter()
        .enumerate()
        .filter(|(other, target)| *other == index || displaced_from(&target.value) == Some(index));
    let mut all: Vec<&Use> = belong.flat_map(|(_, target)| &target.uses).filter(|one| one.computed.is_none()).collect();
    all.sort_by_key(|one| (one.file, one.span.start));
    all.dedup_by_key(|one| (one.file, one.span.start));
    all
}

impl Setting {
    fn of(one: &Use) -> Self {
        let key = |reference: &Reference| match reference {
            Reference::Unnamed => String::new(),
            Reference::Named(name) => Program::key(name),
            Reference::Runtime(reason) => format!("? {reason}"),
        };
        Self(key(&one.tool), key(&one.frame), key(&one.grip_load))
    }
}

/// Every word of the files that could be an identifier, in lower case.
fn identifiers(sources: &[Source]) -> HashSet<String> {
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_' || !byte.is_ascii();
    let words = |source: &Source| -> HashSet<String> {
        let words = source.bytes().split(|byte| !is_part(byte)).filter(|word| !word.is_empty());
        words.map(|word| Program::key(&String::from_utf8_lossy(word))).collect()
    };
    sources.iter().flat_map(words).collect()
}

/// `pS101_2`, or the next number whose name stands nowhere in the job.
fn fresh_name(taken: &HashSet<String>, own: &str) -> String {
    let mut number = 2usize;
    loop {
        let suffix = format!("_{number}");
        let room = LONGEST_NAME.saturating_sub(suffix.len());
        let name = own.chars().take(room).collect::<String>() + &suffix;
        if !taken.contains(&Program::key(&name)) {
            return name;
        }
        number += 1;
    }
}

/// The end of the line, where nothing but blanks and a comment follows; else the place itself.
fn line_end_behind(source: &Source, at: usize) -> usize {
    let bytes = source.bytes();
    let rest = bytes[at..].iter().position(|byte| matches!(byte, b'\n' | b'\r')).map_or(bytes.len(), |n| at + n);
    let behind = source.slice(Span::new(at, rest)).trim_ascii();
    if behind.is_empty() || behind.starts_with(b"!") { rest } else { at }
}

fn newline(source: &Source) -> &'static [u8] {
    match source.newline() {
        crate::base::text::Newline::CrLf => b"\r\n",
        crate::base::text::Newline::Cr => b"\r",
        _ => b"\n",
    }
}

/// The blanks before a statement that begins its line.
fn indentation(source: &Source, at: usize) -> Span {
    let before = &source.bytes()[..at];
    let blanks = before.iter().rev().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
    let begins_line = before[..at - blanks].last().is_none_or(|byte| matches!(byte, b'\n' | b'\r'));
    Span::new(if begins_line { at - blanks } else { at }, at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fresh_names_are_short_and_stand_nowhere() {
        let taken = identifiers(&[Source::new("t", "MoveL P1,v1; x{P1_2}:=1; ! p1_4")]);
        assert_eq!(fresh_name(&taken, "p1"), "p1_3");
        let long = "p".repeat(LONGEST_NAME);
        assert_eq!(fresh_name(&taken, &long), format!("{}_2", "p".repeat(LONGEST_NAME - 2)));
    }

    #[test]
    fn copies_go_behind_a_comment_but_not_behind_code() {
        let commented = Source::new("t", "CONST a; ! b\nc");
        assert_eq!(line_end_behind(&commented, 8), 12);
        let crowded = Source::new("t", "CONST a; PROC b()\n");
        assert_eq!(line_end_behind(&crowded, 8), 8);
        assert_eq!(indentation(&crowded, 9), Span::new(9, 9));
        assert_eq!(indentation(&Source::new("t", "x\n \tCONST"), 4), Span::new(2, 4));
    }
}

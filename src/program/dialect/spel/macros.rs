//! `#define PICK P3`: names that stand for points and numbers, in program files and in the files that they `#include`.
//!
//! Every file of the project counts, included or not: a name that two files define differently means nothing.

use std::collections::HashMap;

use crate::base::text::Source;
use crate::program::number::starts_with_word;

/// What the names of a project stand for, in lower case on both sides.
#[derive(Debug, Default)]
pub(super) struct Macros(HashMap<String, Option<String>>);

/// Names that stand for names are followed this deep.
const MAX_DEPTH: usize = 8;

impl Macros {
    /// Adds the definitions of a file.
    pub fn read(&mut self, source: &Source) {
        for line in source.lines() {
            let text = source.slice(line).trim_ascii();
            if !starts_with_word(text, "#define") {
                continue;
            }
            let rest = String::from_utf8_lossy(&text["#define".len()..]).to_lowercase();
            let (name, value) = rest.trim().split_once([' ', '\t']).unwrap_or((rest.trim(), ""));
            let value = value.split('\'').next().unwrap_or_default().trim().to_owned();
            let known = self.0.entry(name.to_owned()).or_insert_with(|| Some(value.clone()));
            if known.as_ref() != Some(&value) {
                *known = None;
            }
        }
    }

    /// What a name stands for in the end: itself where nothing defines it, nothing where definitions differ.
    pub fn meaning<'a>(&'a self, name: &'a str) -> &'a str {
        let mut meaning = name;
        for _ in 0..MAX_DEPTH {
            match self.0.get(meaning) {
                Some(Some(next)) => meaning = next,
                Some(None) => return "",
                None => return meaning,
            }
        }
        ""
    }
}

/// True for a file to include: its name says so, and nothing but definitions, conditions and comments stands in it.
pub(super) fn is_include(source: &Source) -> bool {
    const DIRECTIVES: [&str; 7] = ["#define", "#undef", "#include", "#ifdef", "#ifndef", "#else", "#endif"];
    let lines = || source.lines().map(|line| source.slice(line).trim_ascii()).filter(|line| !line.is_empty());
    let belongs = |line: &[u8]| line.starts_with(b"'") || DIRECTIVES.iter().any(|word| starts_with_word(line, word));
    let named = source.name().to_ascii_lowercase().ends_with(".inc");
    named && lines().all(belongs) && lines().any(|line| starts_with_word(line, "#define"))
}

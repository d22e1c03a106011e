//! Variables: what is assigned where, and which value a use of one sees.

use std::collections::HashMap;
use std::ops::Range;

use super::statement::Program;
use super::token::{Kind, Text};

/// `name = value`, `global name = value`, `name[2] = value`.
#[derive(Clone, Debug)]
pub(super) struct Assignment {
    /// Statement of the file.
    pub statement: usize,
    /// Its tokens behind `=`; `None` for a part of the variable.
    pub value: Option<Range<usize>>,
    function: usize,
}

/// All assignments of a file by name.
#[derive(Debug, Default)]
pub(super) struct Variables(HashMap<Vec<u8>, Named>);

/// The variables of one name.
#[derive(Debug, Default)]
struct Named {
    shared: Group,
    /// By function.
    local: HashMap<usize, Group>,
}

/// The assignments of one variable, in the order of the text.
#[derive(Debug, Default)]
struct Group {
    all: Vec<Assignment>,
    /// The first that sets only a part.
    part: Option<usize>,
    /// All stand in one function.
    in_one_function: bool,
}

impl Group {
    fn push(&mut self, one: Assignment) {
        let same_as_first = self.all.first().is_none_or(|first| first.function == one.function);
        self.in_one_function = same_as_first && (self.in_one_function || self.all.is_empty());
        if one.value.is_none() {
            self.part.get_or_insert(self.all.len());
        }
        self.all.push(one);
    }
}

/// Reads an assignment; `None` when the statement is another one.
fn assignment(text: Text<'_>, tokens: &Range<usize>) -> Option<(Vec<u8>, bool, Option<Range<usize>>)> {
    let scope = text.word(tokens.start);
    let at = tokens.start + usize::from(matches!(scope, b"global" | b"local"));
    let name = text.word(at);
    if name.is_empty() || at >= tokens.end {
        return None;
    }
    let local = scope == b"local";
    let is_equals = |at: usize| at < tokens.end && text.is(at, b'=') && !text.is(at + 1, b'=');
    if is_equals(at + 1) {
        return Some((name.to_vec(), local, Some(at + 2..tokens.end)));
    }
    if text.is(at + 1, b'[') {
        let (_, close) = text.parts(at + 1, tokens.end)?;
        return is_equals(close + 1).then(|| (name.to_vec(), local, None));
    }
    // `name.x = 1` changes a member.
    let member = text.is(at + 1, b'.') && is_equals(at + 3);
    member.then(|| (name.to_vec(), local, None))
}

impl Variables {
    /// Collects them.
    pub fn of(text: Text<'_>, program: &Program) -> Self {
        let mut all: HashMap<Vec<u8>, Named> = HashMap::new();
        for (index, statement) in program.statements.iter().enumerate() {
            if let Some((name, local, value)) = assignment(text, &statement.tokens) {
                let function = statement.function;
                let named = all.entry(name).or_default();
                let group = if local { named.local.entry(function).or_default() } else { &mut named.shared };
                group.push(Assignment { statement: index, function, value });
            }
        }
        Self(all)
    }

    /// The assignment whose value a statement sees.
    ///
    /// # Errors
    /// Why it is known only at run time.
    pub fn seen(&self, text: Text<'_>, program: &Program, name: &[u8], at: usize) -> Result<&Assignment, String> {
        let shown = String::from_utf8_lossy(name);
        let function = program.statements.get(at).map_or(0, |statement| statement.function);
        if program.functions[function].parameters.iter().any(|parameter| parameter == name) {
            return Err(format!("`{shown}` is a parameter of the function"));
        }
        let named = self.0.get(name);
        let group = named.map(|named| named.local.get(&function).unwrap_or(&named.shared));
        let line = |one: &Assignment| {
            let first = program.statements[one.statement].tokens.start;
            text.tokens.get(first).map_or(0, |token| text.source.line(token.span.start))
        };
        let Some((first, rest, group)) = group.and_then(|group| Some((group.all.first()?, &group.all[1..], group)))
        else {
            return Err(format!("`{shown}` gets no value in this file"));
        };
        if let Some(part) = group.part {
            return Err(format!("a part of `{shown}` is set in line {}", line(&group.all[part])));
        }
        let Some(second) = rest.first() else { return Ok(first) };
        let straight = group.in_one_function && first.function == function && !program.functions[function].branches;
        let before = group.all.partition_point(|one| one.statement < at);
        match before.checked_sub(1).filter(|_| straight) {
            Some(index) => Ok(&group.all[index]),
            None => Err(format!("`{shown}` is set more than once, in lines {} and {}", line(first), line(second))),
        }
    }
}

/// True for an expression that is one name.
pub(super) fn is_single(text: Text<'_>, range: &Range<usize>) -> bool {
    range.len() == 1 && text.tokens.get(range.start).is_some_and(|token| token.kind == Kind::Name)
}

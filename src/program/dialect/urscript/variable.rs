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
    /// Function of the statement.
    pub function: usize,
    /// Its tokens behind `=`; `None` for an element of the variable.
    pub value: Option<Range<usize>>,
    local: bool,
}

/// All assignments of a file by name.
#[derive(Debug, Default)]
pub(super) struct Variables(HashMap<Vec<u8>, Vec<Assignment>>);

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
        let mut all: HashMap<Vec<u8>, Vec<Assignment>> = HashMap::new();
        for (index, statement) in program.statements.iter().enumerate() {
            if let Some((name, local, value)) = assignment(text, &statement.tokens) {
                let function = statement.function;
                all.entry(name).or_default().push(Assignment { statement: index, function, value, local });
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
        let all = self.0.get(name).map(Vec::as_slice).unwrap_or_default();
        let own = || all.iter().filter(|one| one.local && one.function == function);
        let found: Vec<&Assignment> =
            if own().next().is_some() { own().collect() } else { all.iter().filter(|one| !one.local).collect() };
        let line = |one: &Assignment| {
            let first = program.statements[one.statement].tokens.start;
            text.tokens.get(first).map_or(0, |token| text.source.line(token.span.start))
        };
        if let Some(element) = found.iter().find(|one| one.value.is_none()) {
            return Err(format!("a part of `{shown}` is set in line {}", line(element)));
        }
        match found[..] {
            [] => Err(format!("`{shown}` gets no value in this file")),
            [one] => Ok(one),
            [first, second, ..] => {
                let straight =
                    !program.functions[function].branches && found.iter().all(|one| one.function == function);
                let before = found.partition_point(|one| one.statement < at);
                match before.checked_sub(1).filter(|_| straight) {
                    Some(index) => Ok(found[index]),
                    None => {
                        Err(format!("`{shown}` is set more than once, in lines {} and {}", line(first), line(second)))
                    }
                }
            }
        }
    }
}

/// True when a token ends an expression: nothing of it may follow.
pub(super) fn is_single(text: Text<'_>, range: &Range<usize>) -> bool {
    range.len() == 1 && text.tokens.get(range.start).is_some_and(|token| token.kind == Kind::Name)
}

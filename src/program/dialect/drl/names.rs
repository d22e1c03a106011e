//! Names in their scopes: what a function assigns is its own, unless it says `global`.

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use crate::program::dialect::script::{Kind, Text, Tokens};

/// The functions of a file and what they assign.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// The scope of each statement; 0 is what stands outside of all functions.
    scopes: Vec<usize>,
    parents: Vec<usize>,
    values: HashMap<(usize, Vec<u8>), Assigned>,
    globals: HashSet<(usize, Vec<u8>)>,
}

/// What is assigned to a name.
#[derive(Debug, Default)]
struct Assigned {
    value: Option<(Range<usize>, usize)>,
    changed: Option<String>,
}

/// What a name stands for.
pub(super) struct Meaning {
    /// Tells the names of different scopes apart.
    pub key: String,
    /// Its tokens, or why there are none.
    pub value: Result<Range<usize>, String>,
}

impl Names {
    /// Follows the statements of a file.
    pub fn of(text: Text<'_>, tokens: &Tokens) -> Self {
        let mut names = Self { parents: vec![0], ..Self::default() };
        // Indentation and scope of the functions that are open.
        let mut open: Vec<(usize, usize)> = Vec::new();
        for statement in &tokens.statements {
            let indent = indent(text, statement);
            while open.last().is_some_and(|&(outer, _)| indent <= outer) {
                open.pop();
            }
            let scope = open.last().map_or(0, |&(_, scope)| scope);
            names.scopes.push(scope);
            if text.word(statement.start) == "DEF" {
                names.parents.push(scope);
                let inner = names.parents.len() - 1;
                open.push((indent, inner));
                let parameters = text.parts(statement.start + 2, statement.end).map(|(parts, _)| parts);
                for parameter in parameters.unwrap_or_default() {
                    let name = name(text, parameter.start);
                    names.change(inner, name, "a parameter of the function");
                }
            } else {
                names.statement(text, statement, scope);
            }
        }
        names
    }

    fn statement(&mut self, text: Text<'_>, statement: &Range<usize>, scope: usize) {
        let first = text.word(statement.start);
        if first == "GLOBAL" {
            let named = statement.clone().skip(1).filter(|&at| text.kind(at) == Some(Kind::Name));
            self.globals.extend(named.map(|at| (scope, name(text, at))));
            return;
        }
        if first == "FOR" {
            let bound = statement.clone().skip(1).take_while(|&at| text.word(at) != "IN");
            for at in bound.filter(|&at| text.kind(at) == Some(Kind::Name)) {
                self.change(scope, name(text, at), "set by a loop");
            }
            return;
        }
        let Some(equals) = equals(text, statement) else { return };
        let line = text.line(statement.start);
        let operator = equals > statement.start + 1 && is_operator(text.kind(equals - 1));
        let left = statement.start..equals - usize::from(operator);
        if left.len() == 1 && !operator {
            self.assign(scope, name(text, left.start), equals + 1..statement.end, line);
            return;
        }
        // Elements, several names, `+=`: the names outside of brackets change.
        let mut depth = 0_usize;
        for at in left {
            match text.kind(at) {
                Some(Kind::Symbol(b'[' | b'(')) => depth += 1,
                Some(Kind::Symbol(b']' | b')')) => depth = depth.saturating_sub(1),
                Some(Kind::Name) if depth == 0 => {
                    self.change(scope, name(text, at), &format!("changed in line {line}"));
                }
                _ => {}
            }
        }
    }

    fn entry(&mut self, scope: usize, name: Vec<u8>) -> &mut Assigned {
        let scope = if self.globals.contains(&(scope, name.clone())) { 0 } else { scope };
        self.values.entry((scope, name)).or_default()
    }

    fn assign(&mut self, scope: usize, name: Vec<u8>, value: Range<usize>, line: usize) {
        let assigned = self.entry(scope, name);
        match &assigned.value {
            Some((_, first)) => {
                assigned.changed.get_or_insert(format!("set more than once, in lines {first} and {line}"));
            }
            None => assigned.value = Some((value, line)),
        }
    }

    fn change(&mut self, scope: usize, name: Vec<u8>, how: &str) {
        self.entry(scope, name).changed.get_or_insert_with(|| how.to_owned());
    }

    /// What the name at a token stands for, in a statement.
    pub fn meaning(&self, text: Text<'_>, at: usize, statement: usize) -> Meaning {
        let name = name(text, at);
        let shown = String::from_utf8_lossy(&name).into_owned();
        let mut scope = self.scopes.get(statement).copied().unwrap_or(0);
        loop {
            let here = self.values.get(&(scope, name.clone()));
            if let Some(assigned) = here.filter(|_| !self.globals.contains(&(scope, name.clone())) || scope == 0) {
                let value = match (&assigned.changed, &assigned.value) {
                    (Some(how), _) => Err(format!("`{shown}` is {how}")),
                    (None, Some((value, _))) => Ok(value.clone()),
                    (None, None) => Err(format!("`{shown}` gets no value")),
                };
                return Meaning { key: format!("{scope} {shown}"), value };
            }
            if scope == 0 {
                return Meaning {
                    key: format!("0 {shown}"),
                    value: Err(format!("`{shown}` gets no value in this file")),
                };
            }
            scope = self.parents[scope];
        }
    }
}

/// Names are told apart by case.
fn name(text: Text<'_>, at: usize) -> Vec<u8> {
    text.source.slice(text.span(&(at..at + 1))).to_vec()
}

/// Bytes before the statement in its line.
pub(super) fn indent(text: Text<'_>, statement: &Range<usize>) -> usize {
    let start = text.span(statement).start;
    text.source.line_column(start).column - 1
}

/// The `=` of an assignment, outside of brackets.
fn equals(text: Text<'_>, statement: &Range<usize>) -> Option<usize> {
    let mut depth = 0_usize;
    for at in statement.clone() {
        match text.kind(at) {
            Some(Kind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
            Some(Kind::Symbol(b')' | b']' | b'}')) => depth = depth.saturating_sub(1),
            Some(Kind::Symbol(b'=')) if depth == 0 => {
                let compares = text.is(at + 1, b'=')
                    || at == statement.start
                    || matches!(text.kind(at - 1), Some(Kind::Symbol(b'=' | b'!' | b'<' | b'>')));
                return (!compares).then_some(at);
            }
            _ => {}
        }
    }
    None
}

fn is_operator(kind: Option<Kind>) -> bool {
    matches!(kind, Some(Kind::Symbol(b'+' | b'-' | b'*' | b'/' | b'%' | b'|' | b'&')))
}

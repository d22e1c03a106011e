//! What statements do to variables: values written out once are constants, all others are known only at run time.

use std::collections::HashMap;

use crate::base::text::{Source, Span};

use super::expression::{Index, Name, Term};
use super::section::Body;
use super::statement::Statement;
use super::value::{Key, Scope, Value, Values, key, literal};

/// A statement of a program with its place.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// File and program.
    pub scope: Scope,
    /// Without its comment.
    pub span: Span,
    /// What it does.
    pub statement: Statement,
}

/// Changes of one variable.
#[derive(Debug, Default)]
struct Changes {
    count: usize,
    reason: String,
    /// The value written out by the first.
    literal: Option<Value>,
}

/// Finds all changes and gives the variables their values, or the reason why they have none.
///
/// Returns why a location must keep its numbers, by index of its value: a tool, base or frame is made of it.
pub(super) fn apply(
    sources: &[Source],
    bodies: &[Vec<Body>],
    statements: &[Placed],
    values: &mut Values,
) -> HashMap<usize, String> {
    let mut changes: HashMap<Key, Changes> = HashMap::new();
    let mut note = |name: &Name, scope: Scope, reason: String, literal: Option<Value>| {
        let one = changes.entry(key(name, scope)).or_default();
        if one.count == 0 {
            (one.reason, one.literal) = (reason, literal);
        }
        one.count += 1;
    };
    for placed in statements {
        let source = &sources[placed.scope.0];
        let line = || source.line(placed.span.start);
        match &placed.statement {
            Statement::Point { name, partial, value } => {
                let shown = source.text(name.span);
                let constant = !partial && name.index != Index::Variable;
                let literal = constant.then(|| literal(source, placed.scope.0, &shown, value)).flatten();
                note(name, placed.scope, format!("`{shown}` is set at run time in line {}", line()), literal);
            }
            Statement::Here(name) => {
                note(name, placed.scope, format!("`{}` is taught by HERE in line {}", name.key(), line()), None);
            }
            _ => {}
        }
    }
    let parameters = changed_parameters(bodies, statements, |key| changes.contains_key(key));
    for placed in statements {
        let Statement::Call(callee, handed) = &placed.statement else { continue };
        for (place, name) in handed.iter().enumerate() {
            let Some(name) = name else { continue };
            // A parameter that the called program only reads keeps its value.
            if parameters.get(callee).is_some_and(|changed| !changed.get(place).copied().unwrap_or(true)) {
                continue;
            }
            let line = sources[placed.scope.0].line(placed.span.start);
            let reason = format!("handed to `{callee}` in line {line}, which may change it");
            let one = changes.entry(key(name, placed.scope)).or_default();
            if one.count == 0 {
                one.reason = reason;
            }
            one.count += 1;
        }
    }
    for (key, change) in changes {
        match change.literal {
            Some(literal) if change.count == 1 => values.set(key, literal),
            _ => values.mark_changed(key, change.reason),
        }
    }
    values.finish();
    pinned(sources, statements, values)
}

/// Of every program, which of its parameters it may change.
fn changed_parameters(
    bodies: &[Vec<Body>],
    statements: &[Placed],
    is_changed: impl Fn(&Key) -> bool,
) -> HashMap<String, Vec<bool>> {
    let mut handed_on: HashMap<Key, ()> = HashMap::new();
    for placed in statements {
        if let Statement::Call(_, handed) = &placed.statement {
            handed.iter().flatten().for_each(|name| {
                handed_on.insert(key(name, placed.scope), ());
            });
        }
    }
    let mut all = HashMap::new();
    for (file, programs) in bodies.iter().enumerate() {
        for (place, body) in programs.iter().enumerate() {
            let changed = body.parameters.iter().map(|parameter| {
                let bare = parameter.trim_end_matches("[]").to_owned();
                let key = (Some((file, place)), bare);
                is_changed(&key) || handed_on.contains_key(&key)
            });
            all.insert(body.name.clone(), changed.collect());
        }
    }
    all
}

/// Locations of which a tool, base or frame is made: with a correction that would move.
fn pinned(sources: &[Source], statements: &[Placed], values: &Values) -> HashMap<usize, String> {
    let mut all = HashMap::new();
    let mut pin = |names: Vec<&Name>, placed: &Placed, what: &str| {
        for name in names {
            if let super::value::Found::Values(found) = values.find(name, placed.scope) {
                let line = sources[placed.scope.0].line(placed.span.start);
                for value in found {
                    let reason = format!("line {line} makes a {what} of it: a correction would move that {what}");
                    all.entry(value).or_insert(reason);
                }
            }
        }
    };
    for placed in statements {
        match &placed.statement {
            Statement::Tool(expression) => pin(expression.names(), placed, "tool"),
            Statement::Base(expression) => pin(expression.names(), placed, "base"),
            Statement::Point { value, .. } => {
                for term in value.terms.iter().flatten() {
                    if let Term::Frame(names) = term {
                        pin(names.iter().collect(), placed, "frame");
                    }
                }
            }
            _ => {}
        }
    }
    all
}

//! What is handed to routines and functions: a routine may change what it is handed, unless it says `:IN`.

use crate::base::text::Span;
use crate::program::scan::Cursor;

use super::job::{Job, Kind};
use super::reference::reference;
use super::statement::{is_name_byte, key, name, trimmed};
use super::variable::Variables;

/// Functions of the system that take positions and frames and leave them as they are.
const READING: &[&str] = &[
    "bas",
    "stool",
    "stool2",
    "sbase",
    "sload",
    "sipo_mode",
    "inverse",
    "forward",
    "inv_pos",
    "varstate",
    "ek",
    "eb",
    "eb_abs",
    "lk",
    "eo",
    "abs",
    "sqrt",
    "sin",
    "cos",
    "tan",
    "acos",
    "atan2",
    "svel_cp",
    "svel_joint",
    "sacc_cp",
    "sacc_joint",
    "sapo",
    "sapo_ptp",
    "sori_typ",
    "sjerk",
    "sgear_jerk",
    "scirc_type",
    "use_cm_pro_values",
];

/// Words before a parenthesis that call nothing.
const WORDS: &[&str] = &["if", "while", "until", "for", "switch", "case", "and", "or", "not", "exor", "return", "wait"];

/// Marks every variable that is handed to something which may change it.
pub(super) fn mark_changes(job: &Job<'_>, variables: &mut Variables) {
    for (index, routine) in job.routines.iter().enumerate().filter(|(_, routine)| !routine.is_data) {
        for statement in routine.statements.iter().filter(|one| !matches!(one.kind, Kind::Motion | Kind::Declaration)) {
            let bytes = job.bytes(statement.file);
            for (callee, place, argument) in arguments(bytes, statement.span) {
                if READING.contains(&callee.as_str())
                    || WORDS.contains(&callee.as_str())
                    || only_in(job, &callee, place)
                {
                    continue;
                }
                let mut cursor = Cursor::new(bytes, trimmed(bytes, argument));
                let Some(found) = reference(bytes, &mut cursor).filter(|_| cursor.at_end()) else { continue };
                let line = job.sources[statement.file].line(statement.span.start);
                let text = job.sources[statement.file].text(found.span).into_owned();
                let reason = format!("`{text}` is handed to `{callee}` in line {line}, which may change it");
                variables.change(job, index, &found, reason);
            }
        }
    }
}

fn only_in(job: &Job<'_>, callee: &str, place: usize) -> bool {
    match job.routine(callee) {
        Some(routine) => job.routines[routine].parameters.get(place).is_some_and(|(_, only_in)| *only_in),
        None => job.externals.get(callee).and_then(|all| all.get(place)).copied().unwrap_or(false),
    }
}

/// The arguments of all calls in a statement: callee in lower case, place, text.
fn arguments(bytes: &[u8], statement: Span) -> Vec<(String, usize, Span)> {
    let mut cursor = Cursor::new(bytes, statement);
    let mut open: Vec<(String, usize, usize)> = Vec::new();
    let mut found = Vec::new();
    let mut last_name = None;
    let mut in_string = false;
    while let Some(byte) = cursor.peek() {
        let at = cursor.offset();
        if in_string || byte == b'"' {
            in_string ^= byte == b'"';
            cursor.bump();
            continue;
        }
        if is_name_byte(byte) {
            last_name = name(&mut cursor);
            if last_name.is_none() {
                cursor.skip_while(is_name_byte);
            }
            continue;
        }
        cursor.bump();
        match byte {
            b'(' => open.push((last_name.take().map(|span| key(bytes, span)).unwrap_or_default(), 0, at + 1)),
            b',' | b')' => {
                if let Some((callee, place, start)) = open.last_mut() {
                    if !callee.is_empty() {
                        found.push((callee.clone(), *place, Span::new(*start, at)));
                    }
                    *place += 1;
                    *start = at + 1;
                }
                if byte == b')' {
                    open.pop();
                }
            }
            _ => {}
        }
        if !byte.is_ascii_whitespace() {
            last_name = None;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_of_nested_calls() {
        let bytes = b"x = foo(a[1], bar (b)) + (c)";
        let all = arguments(bytes, Span::new(0, bytes.len()));
        let texts: Vec<_> = all
            .iter()
            .map(|(callee, place, span)| {
                (callee.as_str(), *place, String::from_utf8_lossy(&bytes[span.start..span.end]))
            })
            .collect();
        assert_eq!(texts, [("foo", 0, "a[1]".into()), ("bar", 0, "b".into()), ("foo", 1, " bar (b)".into())]);
    }
}

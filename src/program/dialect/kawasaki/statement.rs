//! Statements: what each line of a program does to targets, tools and bases.

use crate::base::text::Span;
use crate::program::flow::Step;
use crate::program::number::number_at;
use crate::program::scan::Cursor;

use super::expression::{Expression, Name, name, number};
use super::motion::{Motion, motion};
use super::section::{is_name_part, lower};

/// A step of the program that selects nothing: tool, base and load are followed together.
pub(super) type Way = Step<3>;

/// A statement that matters.
#[derive(Clone, Debug)]
pub(super) enum Statement {
    /// To a location.
    Motion(Motion),
    /// `POINT a = b`; `POINT/X a = b` sets a part.
    Point { name: Name, partial: bool, value: Expression },
    /// `HERE p`.
    Here(Name),
    /// `CALL name(a,b)`: the name in lower case, and the variables that are handed over, by place.
    Call(String, Vec<Option<Name>>),
    /// `TOOL t`.
    Tool(Expression),
    /// `BASE b`.
    Base(Expression),
    /// `WEIGHT m,x,y,z,..`; `None` when a value is computed. Without values, nothing.
    Weight(Option<Vec<f64>>),
    /// `ABOVE` (false) and `BELOW` (true): for the next motion.
    ElbowDown(bool),
    /// Where ways part and meet. Calls are apart.
    Flow(Way),
}

/// Reads one line of a program: its label, and what it does if it is one of these.
pub(super) fn statements(bytes: &[u8], line: Span) -> impl Iterator<Item = Statement> {
    let mut cursor = Cursor::new(bytes, line);
    cursor.skip_blanks();
    let label = label(&mut cursor).then_some(Statement::Flow(Step::Label));
    label.into_iter().chain(statement(cursor, line))
}

fn statement(mut cursor: Cursor<'_>, line: Span) -> Option<Statement> {
    let start = cursor.offset();
    let word = lower(cursor.slice(cursor.clone().skip_while(is_name_part))).to_uppercase();
    cursor.skip_while(is_name_part);
    let whole = Span::new(start, line.end);
    if let Some(motion) = motion(&word, &cursor, whole) {
        return Some(Statement::Motion(motion));
    }
    let mut ahead = cursor;
    ahead.skip_blanks();
    if matches!(ahead.peek(), Some(b'=' | b'[')) {
        return None;
    }
    match word.as_str() {
        "POINT" => {
            let partial = cursor.eat(b'/') && !cursor.skip_while(is_name_part).is_empty();
            cursor.skip_blanks();
            let name = name(&mut cursor)?;
            cursor.skip_blanks();
            if !cursor.eat(b'=') {
                return None;
            }
            Some(Statement::Point { name, partial, value: Expression::read(&mut cursor) })
        }
        "HERE" => {
            cursor.skip_blanks();
            name(&mut cursor).map(Statement::Here)
        }
        "CALL" => {
            cursor.skip_blanks();
            let callee = lower(cursor.slice(cursor.clone().skip_while(is_name_part)));
            cursor.skip_while(is_name_part);
            cursor.skip_blanks();
            let mut handed = Vec::new();
            while matches!(cursor.bump(), Some(b'(' | b',')) {
                let part = Expression::read(&mut cursor);
                handed.push(part.single_name().cloned());
            }
            Some(Statement::Call(callee, handed))
        }
        "TOOL" => Some(Statement::Tool(Expression::read(&mut cursor))),
        "BASE" => Some(Statement::Base(Expression::read(&mut cursor))),
        "WEIGHT" => {
            let mut values = Vec::new();
            loop {
                values.push(number(&mut cursor).value());
                if !cursor.eat(b',') {
                    break;
                }
            }
            Some(Statement::Weight(values.into_iter().collect()))
        }
        "ABOVE" => Some(Statement::ElbowDown(false)),
        "BELOW" => Some(Statement::ElbowDown(true)),
        _ => flow(&word, &cursor).map(Statement::Flow),
    }
}

fn flow(word: &str, cursor: &Cursor<'_>) -> Option<Way> {
    Some(match word {
        // `IF x GOTO 10` opens no block.
        "IF" if cursor.rest().to_ascii_uppercase().ends_with(b"THEN") => Step::If,
        "ELSE" => Step::Else,
        "ELSEIF" => Step::Branch,
        "CASE" | "SCASE" => Step::Switch,
        "VALUE" | "SVALUE" => Step::Branch,
        "ANY" => Step::Else,
        "FOR" | "WHILE" | "DO" => Step::Loop,
        // Both kinds of blocks end with `END`: which one is meant is found where they are counted.
        "END" => Step::EndBranches,
        "UNTIL" => Step::EndLoop,
        "RETURN" => Step::Return,
        "GOTO" if !cursor.rest().to_ascii_uppercase().windows(4).any(|word| word == b" IF ") => Step::Jump,
        _ => return None,
    })
}

/// Skips `10 ` or `name:` at the start of a statement.
fn label(cursor: &mut Cursor<'_>) -> bool {
    let before = *cursor;
    let word = cursor.skip_while(is_name_part);
    let numbered = !word.is_empty() && cursor.slice(word).iter().all(u8::is_ascii_digit);
    cursor.skip_blanks();
    let others = cursor.slice(word).eq_ignore_ascii_case(b"ANY");
    let colon = !word.is_empty() && !others && cursor.eat(b':');
    cursor.skip_blanks();
    if numbered || colon {
        return true;
    }
    *cursor = before;
    false
}

/// A line of system data that gives a tool or base: `TOOL1 93.8 0 102 0 90 0`. The word in upper case, and the numbers.
pub(super) fn system_data(bytes: &[u8], line: Span) -> Option<(String, Vec<f64>)> {
    let mut cursor = Cursor::new(bytes, line);
    cursor.skip_blanks();
    let word = lower(cursor.slice(cursor.clone().skip_while(is_name_part))).to_uppercase();
    cursor.skip_while(is_name_part);
    let known =
        word == "BASE" || word.strip_prefix("TOOL").is_some_and(|rest| rest.bytes().all(|b| b.is_ascii_digit()));
    if !known {
        return None;
    }
    let mut values = Vec::new();
    loop {
        cursor.skip_blanks();
        let Some(field) = number_at(cursor.rest(), 0) else { break };
        values.push(field.value);
        cursor.seek(cursor.offset() + field.span().end);
    }
    (cursor.at_end() && values.len() >= 6).then_some((word, values))
}

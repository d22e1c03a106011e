//! Functions and statements: lines, divided at semicolons, without comments.

use crate::base::text::{Source, Span};
use crate::program::flow::Step;
use crate::program::number::starts_with_word;
use crate::program::scan::Cursor;

/// One function.
#[derive(Clone, Debug)]
pub(super) struct Function {
    /// Lower case.
    pub name: String,
    /// Its statements in order.
    pub statements: Vec<Span>,
}

/// What a program file holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Functions {
    /// In order.
    pub all: Vec<Function>,
    /// The name of the function that has no `Fend`.
    pub open: Option<Span>,
}

/// True when the content can only be SPEL+: a `Function` and a `Fend`, each at the start of a line.
pub(super) fn is_program(source: &Source) -> bool {
    let mut lines = source.lines().map(|line| source.slice(line).trim_ascii_start());
    lines.any(|line| starts_with_word(line, "Function") && line.get(8).is_some_and(|byte| matches!(byte, b' ' | b'\t')))
        && lines.any(|line| starts_with_word(line, "Fend"))
}

/// Divides a program file.
pub(super) fn functions(source: &Source) -> Functions {
    let mut found = Functions::default();
    for line in source.lines() {
        for statement in statements(source.bytes(), line) {
            let mut cursor = Cursor::new(source.bytes(), statement);
            if cursor.eat_word("Function") {
                cursor.skip_blanks();
                let name = cursor.name().unwrap_or(statement);
                let lower = source.text(name).to_lowercase();
                found.all.push(Function { name: lower, statements: Vec::new() });
                found.open = Some(name);
            } else if cursor.eat_word("Fend") {
                found.open = None;
            } else if found.open.is_some()
                && let Some(function) = found.all.last_mut()
            {
                function.statements.push(statement);
            }
        }
    }
    found
}

/// The statements of a line: semicolons divide, an apostrophe begins a comment, both not inside of strings.
fn statements(bytes: &[u8], line: Span) -> Vec<Span> {
    let mut found = Vec::new();
    let (mut quoted, mut start) = (false, line.start);
    let mut add = |start: usize, end: usize| {
        let text = &bytes[start..end];
        let from = start + (text.len() - text.trim_ascii_start().len());
        let to = start + text.trim_ascii_end().len();
        if from < to {
            found.push(Span::new(from, to));
        }
    };
    for (at, &byte) in bytes.iter().enumerate().take(line.end).skip(line.start) {
        match byte {
            b'"' => quoted = !quoted,
            b';' if !quoted => {
                add(start, at);
                start = at + 1;
            }
            b'\'' if !quoted => {
                add(start, at);
                return found;
            }
            _ => {}
        }
    }
    add(start, line.end);
    found
}

/// What a statement does to the order of the program: with what stands behind `Then` in one line, several steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    /// A step of the order.
    Flow(Step<1>),
    /// Anything else: the statement, or the one behind `Then` or `Else`.
    Plain(Span),
}

/// The parts of a statement in order.
pub(super) fn parts(bytes: &[u8], statement: Span) -> Vec<Part> {
    let text = &bytes[statement.start..statement.end];
    let begins = |word: &str| starts_with_word(text, word);
    let has = |word: &str| words(text).any(|(_, found)| found.eq_ignore_ascii_case(word.as_bytes()));
    let one = |step| vec![Part::Flow(step)];
    if begins("If") {
        return condition(bytes, statement);
    }
    if begins("ElseIf") {
        return one(Step::Branch);
    }
    if begins("Else") || begins("Default") {
        return one(Step::Else);
    }
    if begins("EndIf") || begins("Send") {
        return one(Step::EndBranches);
    }
    if begins("Select") {
        return one(Step::Switch);
    }
    if begins("Case") {
        return one(Step::Branch);
    }
    if begins("Do") || begins("For") || begins("While") {
        return one(Step::Loop);
    }
    if begins("Loop") || begins("Next") || begins("Wend") {
        return one(Step::EndLoop);
    }
    if begins("Exit") {
        return one(if has("Function") { Step::Return } else { Step::LeaveLoop });
    }
    if begins("GoTo") {
        return one(Step::Jump);
    }
    let mut cursor = Cursor::new(bytes, statement);
    if cursor.name().is_some() && cursor.eat(b':') && (cursor.at_end() || matches!(cursor.peek(), Some(b' ' | b'\t'))) {
        cursor.skip_blanks();
        let rest = Span::new(cursor.offset(), statement.end);
        let mut found = one(Step::Label);
        if !rest.is_empty() {
            found.push(Part::Plain(rest));
        }
        return found;
    }
    vec![Part::Plain(statement)]
}

/// `If x Then`, or all in one line: `If x Then Go P1 Else Go P2`.
fn condition(bytes: &[u8], statement: Span) -> Vec<Part> {
    let text = &bytes[statement.start..statement.end];
    let place = |word: &str, from: usize| {
        words(text).find(|(at, found)| *at >= from && found.eq_ignore_ascii_case(word.as_bytes())).map(|(at, _)| at)
    };
    let Some(then) = place("Then", 0).map(|at| at + 4) else { return vec![Part::Plain(statement)] };
    let mut found = vec![Part::Flow(Step::If)];
    let otherwise = place("Else", then);
    let inside = |from: usize, to: usize| {
        let trimmed = text[from..to].trim_ascii();
        let start = from + (text[from..to].len() - text[from..to].trim_ascii_start().len());
        Span::new(statement.start + start, statement.start + start + trimmed.len())
    };
    let first = inside(then, otherwise.unwrap_or(text.len()));
    if first.is_empty() && otherwise.is_none() {
        return found;
    }
    found.extend(one_line(bytes, first));
    if let Some(otherwise) = otherwise {
        found.push(Part::Flow(Step::Else));
        found.extend(one_line(bytes, inside(otherwise + 4, text.len())));
    }
    found.push(Part::Flow(Step::EndBranches));
    found
}

/// A statement inside of a line: what opens blocks does not stand there.
fn one_line(bytes: &[u8], statement: Span) -> Vec<Part> {
    let text = &bytes[statement.start..statement.end];
    let begins = |word: &str| starts_with_word(text, word);
    if begins("GoTo") {
        vec![Part::Flow(Step::Jump)]
    } else if begins("Exit") {
        vec![Part::Flow(if begins("Exit Function") { Step::Return } else { Step::LeaveLoop })]
    } else if statement.is_empty() {
        Vec::new()
    } else {
        vec![Part::Plain(statement)]
    }
}

/// The words of a text outside of strings, with their places.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let is_part = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80;
    let (mut at, mut quoted) = (0, false);
    std::iter::from_fn(move || {
        while at < text.len() {
            let start = at;
            if text[at] == b'"' {
                quoted = !quoted;
            }
            if quoted || !is_part(text[at]) {
                at += 1;
                continue;
            }
            while at < text.len() && is_part(text[at]) {
                at += 1;
            }
            return Some((start, &text[start..at]));
        }
        None
    })
}

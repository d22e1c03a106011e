//! Statements and the functions that they belong to.

use std::ops::Range;

use super::token::{Kind, Text, Token};

/// A statement.
#[derive(Clone, Debug)]
pub(super) struct Statement {
    /// Its tokens.
    pub tokens: Range<usize>,
    /// Its function; 0 is what stands outside of all.
    pub function: usize,
}

/// A `def`, `thread` or `sec`.
#[derive(Clone, Debug, Default)]
pub(super) struct Function {
    /// Its name.
    pub name: Vec<u8>,
    /// Names of its parameters.
    pub parameters: Vec<Vec<u8>>,
    /// The function that it stands in.
    pub parent: Option<usize>,
    /// It has branches or loops: its text is not the order in which it runs.
    pub branches: bool,
}

/// A file's statements and functions.
#[derive(Clone, Debug, Default)]
pub(super) struct Program {
    /// In the order of the text.
    pub statements: Vec<Statement>,
    /// The first is what stands outside of all.
    pub functions: Vec<Function>,
    /// Functions and blocks that no `end` closes.
    pub open: usize,
    /// The last statement has a bracket that nothing closes.
    pub unclosed: bool,
}

/// A statement ends with its line, outside of brackets.
pub(super) fn statements(text: Text<'_>) -> Program {
    let mut program = Program { functions: vec![Function::default()], ..Program::default() };
    // Functions (`Some`) and other blocks, innermost last.
    let mut blocks: Vec<Option<usize>> = Vec::new();
    let mut function = 0;
    let (parts, unclosed) = split(text.tokens);
    program.unclosed = unclosed;
    for tokens in parts {
        let first = text.word(tokens.start);
        let closes_itself = tokens.len() > 1 && text.word(tokens.end - 1) == b"end";
        match first {
            b"def" | b"thread" | b"sec" => {
                program.functions.push(opened(text, &tokens, function));
                function = program.functions.len() - 1;
                blocks.push(Some(function));
            }
            b"if" | b"while" | b"for" if !closes_itself => {
                program.functions[function].branches = true;
                blocks.push(None);
            }
            b"if" | b"while" | b"for" | b"else" | b"elif" => program.functions[function].branches = true,
            _ => {}
        }
        program.statements.push(Statement { tokens, function });
        if first == b"end"
            && let Some(Some(closed)) = blocks.pop()
        {
            function = program.functions[closed].parent.unwrap_or(0);
        }
    }
    program.open = blocks.len();
    program
}

fn opened(text: Text<'_>, tokens: &Range<usize>, parent: usize) -> Function {
    let parameters = text.parts(tokens.start + 2, tokens.end).map(|(parts, _)| parts).unwrap_or_default();
    Function {
        name: text.word(tokens.start + 1).to_vec(),
        parameters: parameters.iter().map(|part| text.word(part.start).to_vec()).collect(),
        parent: Some(parent),
        branches: false,
    }
}

/// With it, whether a bracket stays open at the end.
fn split(tokens: &[Token]) -> (Vec<Range<usize>>, bool) {
    let (mut found, mut start, mut depth) = (Vec::new(), 0, 0_usize);
    for (at, token) in tokens.iter().enumerate() {
        match token.kind {
            Kind::Symbol(b'(' | b'[') => depth += 1,
            Kind::Symbol(b')' | b']') => depth = depth.saturating_sub(1),
            Kind::LineEnd if depth == 0 => {
                if start < at {
                    found.push(start..at);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
    if start < tokens.len() {
        found.push(start..tokens.len());
    }
    (found, depth > 0)
}

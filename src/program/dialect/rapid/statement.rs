//! Tokens cut into statements, and what is missing where the text was cut off.

use std::borrow::Cow;
use std::ops::Range;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::target::Program;

use super::cutter::cut;
use super::token::{Token, TokenKind, tokens, tokens_in};

/// What a statement does to the order of execution, or that it is a declaration, an assignment, a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatementKind {
    /// `MODULE name (attributes)`
    Module,
    /// `ENDMODULE`
    EndModule,
    /// `PROC name(parameters)`, `FUNC type name(parameters)`, `TRAP name`
    Routine,
    /// `ENDPROC`, `ENDFUNC`, `ENDTRAP`
    EndRoutine,
    /// `RECORD name`
    Record,
    /// `ENDRECORD`
    EndRecord,
    /// `IF condition THEN`
    If,
    /// `ELSEIF condition THEN` or `CASE values:`
    Branch,
    /// `ELSE` or `DEFAULT:`
    Else,
    /// `ENDIF`, `ENDTEST`
    EndBranches,
    /// `TEST value`
    Test,
    /// `WHILE condition DO`, `FOR ... DO`
    Loop,
    /// `ENDWHILE`, `ENDFOR`
    EndLoop,
    /// `ERROR`, `UNDO`, `BACKWARD`
    Handler,
    /// `name:`
    Label,
    /// `CONST`, `PERS`, `VAR`
    Declaration,
    /// The condition of an `IF` without `THEN`; the next statement depends on it.
    Condition,
    /// `GOTO label`
    Goto,
    /// `RETURN`, `EXIT`, `RAISE`, `RETRY`, `TRYNEXT`: the next statement is not the next step
    Leave,
    /// `... := ...`
    Assignment,
    /// An instruction or procedure with its arguments, or anything else.
    Call,
}

/// A statement, without its semicolon.
#[derive(Clone, Debug)]
pub struct Statement {
    /// What it is.
    pub kind: StatementKind,
    /// Its tokens.
    pub tokens: Range<usize>,
    /// True when it stands behind the condition of an `IF` without `THEN`.
    pub conditional: bool,
}

/// One file, cut up.
pub struct FileText<'a> {
    /// Where it came from.
    pub source: &'a Source,
    /// Its tokens.
    pub tokens: Vec<Token>,
    /// Its statements, in order.
    pub statements: Vec<Statement>,
}

/// More findings of one kind in one file say nothing new.
pub const MAX_FINDINGS: usize = 20;

impl<'a> FileText<'a> {
    /// Cuts up a file; `file` is its place in the job, for findings.
    pub fn read(source: &'a Source, file: usize, findings: &mut Vec<Diagnostic>) -> Self {
        let tokens = tokens(source, usize::MAX);
        let mut text = Self { source, tokens, statements: Vec::new() };
        let (statements, mut said) = cut(&text, file);
        text.statements = statements;
        text.check_ends(file, &mut said);
        findings.append(&mut said);
        text
    }

    /// The tokens in a [`TokenKind::Position`], for those who want its numbers.
    pub fn position(&self, index: usize) -> Option<Self> {
        let position = self.tokens.get(index).filter(|token| token.kind == TokenKind::Position)?;
        let tokens = tokens_in(self.source, position.span());
        Some(Self { source: self.source, tokens, statements: Vec::new() })
    }

    /// The kind of a token, or of nothing.
    pub fn kind(&self, index: usize) -> Option<TokenKind> {
        self.tokens.get(index).map(|token| token.kind)
    }

    /// True when the token is this one byte.
    pub fn is_symbol(&self, index: usize, byte: u8) -> bool {
        self.kind(index) == Some(TokenKind::Symbol(byte))
    }

    /// The bytes of a name, else nothing.
    pub fn word(&self, index: usize) -> &'a [u8] {
        match self.tokens.get(index) {
            Some(token) if token.kind == TokenKind::Name => self.source.slice(token.span()),
            _ => b"",
        }
    }

    /// True when the token is one of these names, in any case.
    pub fn is_word(&self, index: usize, words: &[&str]) -> bool {
        let word = self.word(index);
        // Most tokens are no names.
        !word.is_empty() && words.iter().any(|candidate| word.eq_ignore_ascii_case(candidate.as_bytes()))
    }

    /// The name at a token as symbols are filed: lower case.
    pub fn key(&self, index: usize) -> String {
        Program::key(&self.display(index))
    }

    /// The name at a token as it is written.
    pub fn display(&self, index: usize) -> Cow<'a, str> {
        match self.tokens.get(index) {
            Some(token) if token.kind == TokenKind::Name => self.source.text(token.span()),
            _ => Cow::Borrowed(""),
        }
    }

    /// The place of some tokens.
    pub fn span(&self, range: &Range<usize>) -> Span {
        match (self.tokens.get(range.start), range.end.checked_sub(1).and_then(|last| self.tokens.get(last))) {
            (Some(first), Some(last)) if !range.is_empty() => first.span().to(last.span()),
            (Some(first), _) => Span::new(first.span().start, first.span().start),
            _ => Span::new(self.source.bytes().len(), self.source.bytes().len()),
        }
    }

    /// The line of a token, from one.
    pub fn line(&self, index: usize) -> usize {
        self.source.line(self.span(&(index..index + 1)).start)
    }

    /// The index after the bracket that closes the one at `open`, no further than `end`; `None` when none does.
    pub fn after_group(&self, open: usize, end: usize) -> Option<usize> {
        let mut depth = 0usize;
        for index in open..end {
            match self.kind(index) {
                Some(TokenKind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
                Some(TokenKind::Symbol(b')' | b']' | b'}')) => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        return Some(index + 1);
                    }
                }
                _ => {}
            }
        }
        None
    }

    fn check_ends(&self, file: usize, findings: &mut Vec<Diagnostic>) {
        let mut open_module = None;
        let mut open_routine: Option<usize> = None;
        let mut say = |statement: usize, word: &str| {
            if findings.len() < MAX_FINDINGS {
                let span = self.span(&self.statements[statement].tokens);
                let message = format!("`{word}` is missing: the text is cut off");
                findings.push(Diagnostic::error("truncated", message).at(file, span, "not closed"));
            }
        };
        for (index, statement) in self.statements.iter().enumerate() {
            match statement.kind {
                StatementKind::Module => {
                    if let Some(module) = open_module.replace(index) {
                        say(module, "ENDMODULE");
                    }
                }
                StatementKind::Routine => {
                    if let Some(routine) = open_routine.replace(index) {
                        say(routine, "ENDPROC");
                    }
                }
                StatementKind::EndRoutine => open_routine = None,
                StatementKind::EndModule => {
                    open_module = None;
                    if let Some(routine) = open_routine.take() {
                        say(routine, "ENDPROC");
                    }
                }
                _ => {}
            }
        }
        if let Some(routine) = open_routine {
            say(routine, "ENDPROC");
        }
        if let Some(module) = open_module {
            say(module, "ENDMODULE");
        }
    }
}

//! Where one statement ends and the next begins.
//!
//! Most statements end with `;`. Block words (`PROC name()`, `IF ... THEN`, `ENDIF`) end by themselves. Where a `;` is
//! missing, the cut is made at the next block word, or where a name follows an operand on a new line.

use std::ops::Range;

use crate::base::diagnostic::Diagnostic;

use super::statement::{FileText, MAX_FINDINGS, Statement, StatementKind};
use super::token::TokenKind;

/// Words that can only begin a statement: met inside one, they say that its `;` is missing.
const BLOCK_WORDS: &[&str] = &[
    "MODULE",
    "ENDMODULE",
    "PROC",
    "ENDPROC",
    "FUNC",
    "ENDFUNC",
    "TRAP",
    "ENDTRAP",
    "RECORD",
    "ENDRECORD",
    "IF",
    "ELSEIF",
    "ELSE",
    "ENDIF",
    "FOR",
    "ENDFOR",
    "WHILE",
    "ENDWHILE",
    "TEST",
    "CASE",
    "DEFAULT",
    "ENDTEST",
    "CONST",
    "PERS",
    "VAR",
    "LOCAL",
];

/// Words between operands.
const OPERATOR_WORDS: &[&str] = &["AND", "OR", "XOR", "NOT", "DIV", "MOD", "WITH", "FROM", "TO", "STEP"];

/// Cuts the tokens of a file into statements.
pub fn cut(text: &FileText, file: usize) -> (Vec<Statement>, Vec<Diagnostic>) {
    let mut cutter = Cutter { text, file, at: 0, conditional: false, found: Vec::new(), findings: Vec::new() };
    while cutter.at < text.tokens.len() {
        cutter.step();
    }
    (cutter.found, cutter.findings)
}

struct Cutter<'t, 'a> {
    text: &'t FileText<'a>,
    file: usize,
    at: usize,
    conditional: bool,
    found: Vec<Statement>,
    findings: Vec<Diagnostic>,
}

impl Cutter<'_, '_> {
    fn push(&mut self, kind: StatementKind, tokens: Range<usize>) {
        self.at = tokens.end.max(self.at + 1);
        self.found.push(Statement { kind, tokens, conditional: std::mem::take(&mut self.conditional) });
    }

    fn truncated(&mut self, tokens: &Range<usize>, message: &str) {
        if self.findings.len() < MAX_FINDINGS {
            let place = self.text.span(tokens);
            self.findings.push(Diagnostic::error("truncated", message).at(self.file, place, "ends here"));
        }
    }

    fn step(&mut self) {
        let (text, start) = (self.text, self.at);
        if text.is_symbol(start, b';') {
            self.at += 1;
            return;
        }
        let scoped = usize::from(text.is_word(start, &["LOCAL", "TASK"]));
        let word = text.word(start + scoped).to_ascii_uppercase();
        match word.as_slice() {
            b"MODULE" => {
                let end = self.with_group(start + 2);
                self.push(StatementKind::Module, start..end);
            }
            b"PROC" | b"TRAP" => {
                let end = self.with_group(start + scoped + 2);
                self.push(StatementKind::Routine, start..end);
            }
            b"FUNC" => {
                let end = self.with_group(start + scoped + 3);
                self.push(StatementKind::Routine, start..end);
            }
            b"RECORD" => self.push(StatementKind::Record, start..start + scoped + 2),
            b"CONST" | b"PERS" | b"VAR" => self.simple(StatementKind::Declaration, scoped + 1),
            _ if scoped == 0 => self.inner_step(&word),
            _ => self.simple(StatementKind::Call, 1),
        }
    }

    fn inner_step(&mut self, word: &[u8]) {
        let (text, start) = (self.text, self.at);
        let alone = start..start + 1;
        match word {
            b"ENDMODULE" => self.push(StatementKind::EndModule, alone),
            b"ENDPROC" | b"ENDFUNC" | b"ENDTRAP" => self.push(StatementKind::EndRoutine, alone),
            b"ENDRECORD" => self.push(StatementKind::EndRecord, alone),
            b"ENDIF" | b"ENDTEST" => self.push(StatementKind::EndBranches, alone),
            b"ENDWHILE" | b"ENDFOR" => self.push(StatementKind::EndLoop, alone),
            b"ELSE" => self.push(StatementKind::Else, alone),
            b"ERROR" | b"UNDO" | b"BACKWARD" => {
                let end = self.with_group(start + 1);
                self.push(StatementKind::Handler, start..end);
            }
            b"IF" => self.condition(),
            b"ELSEIF" => self.until(StatementKind::Branch, |text, at| text.is_word(at, &["THEN"])),
            b"WHILE" | b"FOR" => self.until(StatementKind::Loop, |text, at| text.is_word(at, &["DO"])),
            b"CASE" => self.until(StatementKind::Branch, |text, at| text.is_symbol(at, b':')),
            b"DEFAULT" => self.until(StatementKind::Else, |text, at| text.is_symbol(at, b':')),
            b"TEST" => self.test(),
            b"GOTO" => self.simple(StatementKind::Goto, 1),
            b"RETURN" | b"EXIT" | b"RAISE" | b"RETRY" | b"TRYNEXT" => self.simple(StatementKind::Leave, 1),
            _ if text.kind(start) == Some(TokenKind::Name) && text.is_symbol(start + 1, b':') => {
                self.push(StatementKind::Label, start..start + 2);
            }
            _ => self.simple(StatementKind::Call, 1),
        }
    }

    /// `from`, or behind the round brackets that open there.
    fn with_group(&self, from: usize) -> usize {
        let last = self.text.tokens.len();
        if !self.text.is_symbol(from, b'(') {
            return from.min(last);
        }
        // A list of parameters that is never closed ends where the next statement would.
        let ends = |at: usize| {
            self.text.is_symbol(at, b';') || (self.is_block_word(at) && !self.text.is_word(at, &["VAR", "PERS"]))
        };
        let stop = (from..last).find(|&at| ends(at)).unwrap_or(last);
        self.text.after_group(from, stop).unwrap_or(from + 1)
    }

    fn is_block_word(&self, at: usize) -> bool {
        let named = at > 0 && (self.text.is_symbol(at - 1, b'\\') || self.text.is_symbol(at - 1, b'.'));
        !named && self.text.is_word(at, BLOCK_WORDS)
    }

    fn is_operand_end(&self, at: usize) -> bool {
        match self.text.kind(at) {
            Some(TokenKind::Name) => !self.text.is_word(at, OPERATOR_WORDS),
            Some(TokenKind::Number | TokenKind::Text | TokenKind::Position) => true,
            Some(TokenKind::Symbol(byte)) => matches!(byte, b')' | b']' | b'}' | b'#'),
            _ => false,
        }
    }

    fn is_operand_start(&self, at: usize) -> bool {
        match self.text.kind(at) {
            Some(TokenKind::Name) => !self.text.is_word(at, OPERATOR_WORDS),
            Some(TokenKind::Symbol(byte)) => byte == b'%',
            _ => false,
        }
    }

    fn on_new_line(&self, at: usize) -> bool {
        let between =
            crate::base::text::Span::new(self.text.tokens[at - 1].span().end, self.text.tokens[at].span().start);
        self.text.source.slice(between).iter().any(|byte| matches!(byte, b'\n' | b'\r'))
    }

    /// A statement up to its `;`. The first `free` tokens may be followed by a name on a new line.
    fn simple(&mut self, kind: StatementKind, free: usize) {
        let (text, start, last) = (self.text, self.at, self.text.tokens.len());
        let (mut depth, mut assigns, mut at) = (0usize, false, start);
        while at < last && !text.is_symbol(at, b';') {
            let next_statement = depth == 0
                && (kind != StatementKind::Declaration || assigns)
                && at > start + free
                && self.is_operand_end(at - 1)
                && self.is_operand_start(at)
                && !text.is_symbol(at, b'%')
                && self.on_new_line(at);
            if (at > start + free && self.is_block_word(at)) || next_statement {
                break;
            }
            match text.kind(at) {
                Some(TokenKind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
                Some(TokenKind::Symbol(b')' | b']' | b'}')) => depth = depth.saturating_sub(1),
                Some(TokenKind::Assign) if depth == 0 && !self.follows_switch(start, at) => assigns = true,
                _ => {}
            }
            at += 1;
        }
        let tokens = start..at;
        if depth > 0 {
            self.truncated(&tokens, "a bracket is not closed: the text is cut off or damaged");
        } else if !text.is_symbol(at, b';') {
            self.truncated(&tokens, "`;` is missing: the text is cut off or damaged");
        }
        let kind = if kind == StatementKind::Call && assigns { StatementKind::Assignment } else { kind };
        self.push(kind, tokens);
    }

    /// True for the `:=` of an optional argument, `\WObj:=w`.
    fn follows_switch(&self, start: usize, assign: usize) -> bool {
        assign >= start + 2 && self.text.is_symbol(assign - 2, b'\\')
    }

    /// A statement that ends behind a word of its own; without it, before the next `;` or block word.
    fn until(&mut self, kind: StatementKind, is_end: impl Fn(&FileText, usize) -> bool) {
        let (start, last) = (self.at, self.text.tokens.len());
        let mut at = start + 1;
        while at < last {
            if is_end(self.text, at) {
                self.push(kind, start..at + 1);
                return;
            }
            if self.text.is_symbol(at, b';') || self.is_block_word(at) {
                break;
            }
            at += 1;
        }
        self.push(kind, start..at);
    }

    fn test(&mut self) {
        let (start, last) = (self.at, self.text.tokens.len());
        let stop = (start + 1..last).find(|&at| self.text.is_symbol(at, b';') || self.is_block_word(at));
        self.push(StatementKind::Test, start..stop.unwrap_or(last));
    }

    /// `IF condition THEN`, or `IF condition statement;`: there the condition ends where two operands meet.
    fn condition(&mut self) {
        let (text, start, last) = (self.text, self.at, self.text.tokens.len());
        let (mut depth, mut meeting) = (0usize, None);
        let mut at = start + 1;
        while at < last && !text.is_symbol(at, b';') && !self.is_block_word(at) {
            if text.is_word(at, &["THEN"]) {
                self.push(StatementKind::If, start..at + 1);
                return;
            }
            match text.kind(at) {
                Some(TokenKind::Symbol(b'(' | b'[' | b'{')) => depth += 1,
                Some(TokenKind::Symbol(b')' | b']' | b'}')) => depth = depth.saturating_sub(1),
                _ => {}
            }
            let meets = depth == 0 && at > start + 1 && self.is_operand_end(at - 1) && self.is_operand_start(at);
            if meets && meeting.is_none() {
                meeting = Some(at);
            }
            at += 1;
        }
        self.push(StatementKind::Condition, start..meeting.unwrap_or(at));
        self.conditional = true;
    }
}

#[cfg(test)]
mod tests {
    use super::super::statement::StatementKind as K;
    use super::*;
    use crate::base::text::Source;

    fn kinds(text: &str) -> (Vec<K>, Vec<&'static str>) {
        let source = Source::new("t", text);
        let mut findings = Vec::new();
        let cut = FileText::read(&source, 0, &mut findings);
        let codes = findings.iter().map(|finding| finding.code).collect();
        (cut.statements.iter().map(|statement| statement.kind).collect(), codes)
    }

    #[test]
    fn statements_of_every_kind_are_told_apart() {
        let (found, findings) = kinds(
            "MODULE m(SYSMODULE)\nLOCAL PERS num a:=1;\nPROC p(num x\\switch y)\nIF a>1 THEN\nMoveL p1\\ID:=1,v1,z1,t\\WObj:=w;\n\
             ELSEIF a=2 THEN\na:=2;\nELSE\nENDIF\nIF a=1 OR b IncrIt a;\nIF (a=1) a:=3;\nTEST a\nCASE 1,2:\nDEFAULT:\nENDTEST\n\
             FOR i FROM 1 TO 3 DO\nENDFOR\nlabel:\nGOTO label;\nRETURN;\nERROR\nTRYNEXT;\nENDPROC\nENDMODULE\n",
        );
        let expected = [
            K::Module,
            K::Declaration,
            K::Routine,
            K::If,
            K::Call,
            K::Branch,
            K::Assignment,
            K::Else,
            K::EndBranches,
            K::Condition,
            K::Call,
            K::Condition,
            K::Assignment,
            K::Test,
            K::Branch,
            K::Else,
            K::EndBranches,
            K::Loop,
            K::EndLoop,
            K::Label,
            K::Goto,
            K::Leave,
            K::Handler,
            K::Leave,
            K::EndRoutine,
            K::EndModule,
        ];
        assert_eq!(found, expected);
        assert!(findings.is_empty(), "{findings:?}");
    }

    #[test]
    fn a_cut_off_text_is_said_to_be_one() {
        assert_eq!(kinds("MODULE m\nPROC a()\nMoveL p1,v1,z1,t;\nENDPROC\n").1, ["truncated"]);
        assert_eq!(kinds("CONST robtarget p:=[[1,2,3],[1,0,0").1, ["truncated"]);
        assert_eq!(kinds("MoveL p1,v1,z1,t").1, ["truncated"]);
        let (found, findings) = kinds("MoveL p1,v1,z1,t\nMoveL p2,v1,z1,t;\n");
        assert_eq!((found, findings), (vec![K::Call, K::Call], vec!["truncated"]));
        assert_eq!(kinds("MODULE m\nPROC a()\nMoveL p1,v1\nENDPROC\nENDMODULE").1, ["truncated"]);
    }

    #[test]
    fn arguments_may_stand_on_lines_of_their_own() {
        assert!(kinds("MoveL\n p1,\n v1,\n z1,\n t\n \\WObj:=w\n;\nPERS\n robtarget\n p:=\n [[1,2,3]];").1.is_empty());
    }
}

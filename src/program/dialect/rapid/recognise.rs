//! Telling RAPID by its content.

use crate::base::text::Source;

use super::token::{Token, TokenKind, tokens};

/// A program is recognised by its first statements; this many tokens are some thousand lines.
const MAX_TOKENS: usize = 50_000;

const DATA_TYPES: &[&str] = &[
    "robtarget",
    "jointtarget",
    "tooldata",
    "wobjdata",
    "loaddata",
    "speeddata",
    "zonedata",
    "num",
    "dnum",
    "bool",
    "string",
    "pose",
    "pos",
    "orient",
    "confdata",
    "extjoint",
    "robjoint",
    "intnum",
    "clock",
    "signaldi",
    "signaldo",
    "welddata",
    "seamdata",
    "weavedata",
    "spotdata",
    "gundata",
    "byte",
    "iodev",
    "rawbytes",
    "socketdev",
    "stoppointdata",
];

const ATTRIBUTES: &[&str] = &["sysmodule", "noview", "nostepin", "viewonly", "readonly"];

/// True when the text can only be RAPID.
///
/// Proof is any of: a declaration with storage class and RAPID data type, a routine header `PROC name(`, a module
/// header with RAPID's attributes, or a `MoveL`-like instruction with its comma list up to `;`.
pub fn is_rapid(source: &Source) -> bool {
    let text = Text { source, tokens: tokens(source, MAX_TOKENS) };
    (0..text.tokens.len()).any(|at| {
        text.begins_statement(at) && (text.declaration(at) || text.routine(at) || text.module(at) || text.motion(at))
    })
}

struct Text<'a> {
    source: &'a Source,
    tokens: Vec<Token>,
}

impl Text<'_> {
    fn is(&self, at: usize, words: &[&str]) -> bool {
        self.tokens.get(at).is_some_and(|token| {
            let bytes = self.source.slice(token.span());
            token.kind == TokenKind::Name && words.iter().any(|word| bytes.eq_ignore_ascii_case(word.as_bytes()))
        })
    }

    fn kind(&self, at: usize) -> Option<TokenKind> {
        self.tokens.get(at).map(|token| token.kind)
    }

    /// True at the start, behind `;`, and at the first token of a line.
    fn begins_statement(&self, at: usize) -> bool {
        let Some(before) = at.checked_sub(1).and_then(|before| self.tokens.get(before)) else { return true };
        let between = before.span().end..self.tokens[at].span().start;
        before.kind == TokenKind::Symbol(b';')
            || self.source.bytes()[between].iter().any(|byte| matches!(byte, b'\n' | b'\r'))
    }

    fn declaration(&self, at: usize) -> bool {
        let scoped = usize::from(self.is(at, &["local", "task"]));
        let behind = self.kind(at + scoped + 3);
        self.is(at + scoped, &["const", "pers", "var"])
            // No other language says PERS; CONST and VAR need a type that only RAPID has.
            && (self.is(at + scoped, &["pers"]) || self.is(at + scoped + 1, DATA_TYPES))
            && self.kind(at + scoped + 1) == Some(TokenKind::Name)
            && self.kind(at + scoped + 2) == Some(TokenKind::Name)
            && matches!(behind, Some(TokenKind::Assign | TokenKind::Symbol(b';' | b'{')))
    }

    fn routine(&self, at: usize) -> bool {
        let scoped = usize::from(self.is(at, &["local", "task"]));
        self.is(at + scoped, &["proc"])
            && self.kind(at + scoped + 1) == Some(TokenKind::Name)
            && self.kind(at + scoped + 2) == Some(TokenKind::Symbol(b'('))
    }

    fn module(&self, at: usize) -> bool {
        let named = self.is(at, &["module"]) && self.kind(at + 1) == Some(TokenKind::Name);
        let attributes = self.kind(at + 2) == Some(TokenKind::Symbol(b'(')) && self.is(at + 3, ATTRIBUTES);
        // An empty module is all there is to some task's file.
        let empty = self.is(at + 2, &["endmodule"]) && self.tokens.len() == at + 3;
        named && (attributes || empty)
    }

    /// `MoveL p,v,z,t;`: at least three commas outside of brackets, and a semicolon.
    fn motion(&self, at: usize) -> bool {
        if !self.is(at, &["movel", "movej", "movec", "moveabsj"]) {
            return false;
        }
        let opens =
            matches!(self.kind(at + 1), Some(TokenKind::Name | TokenKind::Position | TokenKind::Symbol(b'[' | b'\\')));
        let (mut depth, mut commas) = (0usize, 0);
        for token in self.tokens[at + 1..].iter().take(400) {
            match token.kind {
                TokenKind::Symbol(b'[' | b'(' | b'{') => depth += 1,
                TokenKind::Symbol(b']' | b')' | b'}') => depth = depth.saturating_sub(1),
                TokenKind::Symbol(b',') if depth == 0 => commas += 1,
                TokenKind::Symbol(b';') => return opens && depth == 0 && commas >= 3,
                _ => {}
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is(text: &str) -> bool {
        is_rapid(&Source::new("t", text))
    }

    #[test]
    fn modules_and_snippets_are_recognised() {
        assert!(is("%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\n\nMODULE a\n  PROC main()\n  ENDPROC\nENDMODULE\n"));
        assert!(is("module a(sysmodule)\nendmodule"));
        assert!(is("! points\r\nCONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"));
        assert!(is("MoveJ p1,v100,z10,tool0\\WObj:=w;"));
        assert!(is("  Movel [[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;"));
    }

    #[test]
    fn other_languages_are_not() {
        for text in [
            "",
            "DEF main()\n;FOLD INI\nDECL INT a\nPTP {X 1,Y 2,Z 3,A 0,B 0,C 0}\nLIN P1 C_DIS\nEND\n",
            "/JOB\n//NAME A\n//POS\n///NPOS 1,0,0,0,0,0\nMOVJ C00000 VJ=50.00\nEND\n",
            "def f():\n  movel(p[0.1,0.2,0.3,0,0,0], a=1.2, v=0.25, t=0, r=0)\nend\n",
            "/PROG A\n/MN\n 1:L P[1] 100mm/sec FINE ;\n/POS\n/END\n",
            "Program File Format Version : 1.6  MechType: 370\n     S1   MOVE P,S=60%,A=3,T=1\n     END\n",
            ".PROGRAM a()\n  JMOVE p1\n  LMOVE p2\n.END\n",
            "MODULE fortran\nINTEGER :: a ! comment\nEND MODULE\n",
            "MODULE Oberon;\nPROCEDURE P(a: INTEGER);\nVAR i: INTEGER;\nBEGIN END P;\nEND Oberon.",
        ] {
            assert!(!is(text), "{text}");
        }
    }
}

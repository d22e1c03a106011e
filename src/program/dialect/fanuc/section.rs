//! The sections of a file: `/PROG`, `/ATTR`, `/APPL`, `/MN`, `/POS`, `/END`, each at the start of a line.

use crate::base::text::{Source, Span};
use crate::program::number::starts_with_word;

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// One program of a file; a file of several programs, one after the other, is possible.
#[derive(Clone, Debug, Default)]
pub(super) struct Sections {
    /// The lines of the application header, after `/APPL`.
    pub application: Vec<Span>,
    /// The lines of the statements, after `/MN`.
    pub statements: Vec<Span>,
    /// From behind `/POS` to the next section; `None` when there is none.
    pub points: Option<Span>,
    /// There is an `/END`.
    pub ends: bool,
    /// Where the program ends.
    pub end: usize,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Other,
    Application,
    Statements,
    Points,
}

/// True when the content can only be a FANUC program: `/PROG name` before anything else, and another section mark.
pub(super) fn recognises(source: &Source) -> bool {
    let mut marks = source.lines().map(|line| without_mark(source.slice(line))).filter(|text| !text.is_empty());
    let named = marks.next().is_some_and(|first| {
        starts_with_word(first, "/PROG") && first.get(5).is_some_and(|byte| matches!(byte, b' ' | b'\t'))
    });
    named && marks.any(|text| ["/ATTR", "/APPL", "/MN", "/POS", "/END"].iter().any(|mark| starts_with_word(text, mark)))
}

/// Divides a file into its programs. Text before the first `/PROG` counts as a program of its own if it has sections.
pub(super) fn programs(source: &Source) -> Vec<Sections> {
    let mut found: Vec<Sections> = Vec::new();
    let mut kind = Kind::Other;
    for line in source.lines() {
        let text = without_mark(source.slice(line));
        let begins = |word: &str| starts_with_word(text, word);
        let opens = if text.first() != Some(&b'/') || text.get(1) == Some(&b'/') {
            None
        } else if begins("/PROG") {
            found.push(Sections::default());
            Some(Kind::Other)
        } else if begins("/APPL") {
            Some(Kind::Application)
        } else if begins("/MN") {
            Some(Kind::Statements)
        } else if begins("/POS") {
            Some(Kind::Points)
        } else if begins("/ATTR") || begins("/END") {
            Some(Kind::Other)
        } else {
            None
        };
        if found.is_empty() && opens.is_some() {
            found.push(Sections::default());
        }
        let Some(program) = found.last_mut() else { continue };
        program.end = line.end;
        program.ends |= opens.is_some() && begins("/END");
        match (opens, kind) {
            (Some(opened), _) => {
                kind = opened;
                if opened == Kind::Points && program.points.is_none() {
                    program.points = Some(Span::new(line.end, line.end));
                }
            }
            (None, Kind::Application) => program.application.push(line),
            (None, Kind::Statements) => program.statements.push(line),
            (None, Kind::Points) => {
                if let Some(points) = &mut program.points {
                    points.end = line.end;
                }
            }
            (None, Kind::Other) => {}
        }
    }
    found
}

fn without_mark(text: &[u8]) -> &[u8] {
    text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text)
}

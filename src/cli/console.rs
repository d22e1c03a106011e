//! Messages to standard error: drawn with the line they are about, coloured only on a terminal.

#![allow(clippy::print_stderr, reason = "this is the one place that talks")]

use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::text::Source;

use super::exit::{Exit, Failure};

/// Standard error.
pub struct Console {
    coloured: bool,
    terminal: bool,
    /// What has been said, where it is held back until other files have had their say.
    held: Option<Mutex<String>>,
}

/// How good what is said is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    Good,
    Mixed,
    Bad,
    /// Words that only lead to others.
    Quiet,
}

impl Console {
    pub fn new() -> Self {
        let terminal = std::io::stderr().is_terminal();
        let coloured = terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        Self { coloured, terminal, held: None }
    }

    /// A console for one of many files: what it is told is held until [`Console::release`].
    pub fn holding(&self) -> Self {
        Self { held: Some(Mutex::default()), ..*self }
    }

    /// Says what `other` has held.
    pub fn release(&self, other: Self) {
        if let Some(held) = other.held {
            eprint!("{}", held.into_inner().unwrap_or_else(PoisonError::into_inner));
        }
    }

    /// What it has held, instead of saying it.
    pub fn into_text(self) -> String {
        self.held.map(|held| held.into_inner().unwrap_or_else(PoisonError::into_inner)).unwrap_or_default()
    }

    /// True when a person may be watching: progress is shown only then.
    pub fn is_terminal(&self) -> bool {
        self.terminal
    }

    /// Text in the colour of its tone; as it is where there is no terminal.
    pub fn toned(&self, tone: Tone, text: &str) -> String {
        let code = match tone {
            Tone::Good => "1;32",
            Tone::Mixed => "1;33",
            Tone::Bad => "1;31",
            Tone::Quiet => "2",
        };
        if self.coloured { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_string() }
    }

    /// A plain line.
    pub fn say(&self, line: &str) {
        match &self.held {
            Some(held) => *held.lock().unwrap_or_else(PoisonError::into_inner) += &format!("{line}\n"),
            None => eprintln!("{line}"),
        }
    }

    /// A finding, drawn under its line.
    pub fn diagnostic(&self, sources: &[Source], diagnostic: &Diagnostic) {
        let renderer = if self.coloured { Renderer::styled() } else { Renderer::plain() };
        let level = match diagnostic.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
            Severity::Note => Level::NOTE,
        };
        let title = level.primary_title(diagnostic.message.clone()).id(diagnostic.code);
        let place = diagnostic.place.as_ref().and_then(|place| Some((sources.get(place.file)?, place)));
        let drawn = match place {
            Some((source, place)) => {
                let line = OneLine::new(source, place.span.start, place.span.end);
                let snippet = Snippet::source(line.text)
                    .line_start(line.number)
                    .path(source.name().to_string())
                    .annotation(AnnotationKind::Primary.span(line.start..line.end).label(place.text.clone()));
                let group = title.element(snippet);
                match &diagnostic.help {
                    Some(help) => renderer.render(&[group.element(Level::HELP.message(help.clone()))]),
                    None => renderer.render(&[group]),
                }
            }
            None => match &diagnostic.help {
                Some(help) => renderer
                    .render(&[annotate_snippets::Group::with_title(title).element(Level::HELP.message(help.clone()))]),
                None => renderer.render(&[annotate_snippets::Group::with_title(title)]),
            },
        };
        self.say(&drawn);
    }

    /// A failure, with everything there is to say about it.
    pub fn failure(&self, failure: &Failure) -> Exit {
        if failure.is_broken_pipe() {
            return Exit::Done;
        }
        match failure {
            Failure::Input(error) => {
                self.diagnostic(std::slice::from_ref(&error.source_text), &error.diagnostic);
            }
            Failure::Program(sources, diagnostics) => {
                for diagnostic in diagnostics {
                    self.diagnostic(sources, diagnostic);
                }
            }
            Failure::Recording(refusal) => {
                self.diagnostic(&[], &Diagnostic::error("recording", refusal.to_string()));
            }
            Failure::File { .. } | Failure::Output(_) => {
                self.diagnostic(&[], &Diagnostic::error("file", failure.to_string()));
            }
            Failure::Usage(_) => self.diagnostic(&[], &Diagnostic::error("usage", failure.to_string())),
        }
        Exit::Bad
    }
}

/// The line that a place is on, as text. What follows far behind the place is cut: a message is read, not scrolled.
/// What stands before it is kept, for the column is counted from there.
struct OneLine {
    text: String,
    number: usize,
    start: usize,
    end: usize,
}

/// Bytes of a line shown behind the start of the place.
const SHOWN: usize = 160;

impl OneLine {
    fn new(source: &Source, start: usize, end: usize) -> Self {
        use crate::base::text::Span;
        let bytes = source.bytes();
        let start = start.min(bytes.len());
        let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
        let line_start = bytes[..start].iter().rposition(is_end).map_or(0, |at| at + 1);
        let line_end = bytes[start..].iter().position(is_end).map_or(bytes.len(), |n| start + n).min(start + SHOWN);
        let end = end.clamp(start, line_end);
        // Pieces are decoded apart, so that offsets stay right when a byte becomes two. A terminal would obey control
        // characters.
        let shown =
            |from, to| source.text(Span::new(from, to)).replace(|c: char| c.is_control() && c != '\t', "\u{fffd}");
        let [before, inside, after] =
            [shown(line_start, start), shown(start, end), shown(end, line_end)].map(|text| text.replace('\t', " "));
        let (from, to) = (before.len(), before.len() + inside.len());
        Self { text: before + &inside + &after, number: source.line(start), start: from, end: to }
    }
}

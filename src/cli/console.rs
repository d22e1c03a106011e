//! Messages to standard error: drawn with the line they are about, coloured only on a terminal.

#![allow(clippy::print_stderr, reason = "this is the one place that talks")]

use std::io::IsTerminal;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::text::Source;

use super::exit::{Exit, Failure};

/// Standard error.
pub struct Console {
    renderer: Renderer,
    terminal: bool,
}

impl Console {
    pub fn new() -> Self {
        let terminal = std::io::stderr().is_terminal();
        let coloured = terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        Self { renderer: if coloured { Renderer::styled() } else { Renderer::plain() }, terminal }
    }

    /// True when a person may be watching: progress is shown only then.
    pub fn is_terminal(&self) -> bool {
        self.terminal
    }

    /// A plain line.
    pub fn say(&self, line: &str) {
        eprintln!("{line}");
    }

    /// A finding, drawn under its line.
    pub fn diagnostic(&self, sources: &[Source], diagnostic: &Diagnostic) {
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
                    Some(help) => self.renderer.render(&[group.element(Level::HELP.message(help.clone()))]),
                    None => self.renderer.render(&[group]),
                }
            }
            None => match &diagnostic.help {
                Some(help) => self
                    .renderer
                    .render(&[annotate_snippets::Group::with_title(title).element(Level::HELP.message(help.clone()))]),
                None => self.renderer.render(&[annotate_snippets::Group::with_title(title)]),
            },
        };
        eprintln!("{drawn}");
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
            other => self.diagnostic(&[], &Diagnostic::error("usage", other.to_string())),
        }
        Exit::Bad
    }
}

/// The line that a place is on, as text; columns counted in the text's own bytes. Very long lines are cut around the
/// place: a message is read, not scrolled.
struct OneLine {
    text: String,
    number: usize,
    start: usize,
    end: usize,
}

/// Bytes of a line shown on either side of the place.
const SHOWN: usize = 160;

impl OneLine {
    fn new(source: &Source, start: usize, end: usize) -> Self {
        use crate::base::text::Span;
        let bytes = source.bytes();
        let start = start.min(bytes.len());
        let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
        let line_start =
            bytes[..start].iter().rposition(is_end).map_or(0, |at| at + 1).max(start.saturating_sub(SHOWN));
        let line_end = bytes[start..].iter().position(is_end).map_or(bytes.len(), |n| start + n).min(start + SHOWN);
        let end = end.clamp(start, line_end);
        // Pieces are decoded apart, so that offsets stay right when a byte becomes two.
        let before = source.text(Span::new(line_start, start)).replace('\t', " ");
        let inside = source.text(Span::new(start, end)).replace('\t', " ");
        let after = source.text(Span::new(end, line_end)).replace('\t', " ");
        let (from, to) = (before.len(), before.len() + inside.len());
        Self { text: before + &inside + &after, number: source.line(start), start: from, end: to }
    }
}

//! What there is to say about an input, as plain data; drawing it is the command line's business.

use super::text::Span;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing.
    Note,
    /// The work goes on, but somebody should look.
    Warning,
    /// The work cannot be done.
    Error,
}

/// A place in a file with a short text that stands under it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Which file of the job: an index into its sources.
    pub file: usize,
    /// Where.
    pub span: Span,
    /// What about it; may be empty.
    pub text: String,
}

/// A finding about an input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// A stable word that scripts can match: `unknown-tool`, `truncated`, ...
    pub code: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// One sentence: what is wrong, and what was expected.
    pub message: String,
    /// Where, if it is anywhere in particular.
    pub place: Option<Label>,
    /// What to do about it.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error at no particular place; add one with [`Diagnostic::at`].
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, severity: Severity::Error, message: message.into(), place: None, help: None }
    }

    /// A warning.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// A note.
    pub fn note(code: &'static str, message: impl Into<String>) -> Self {
        Self { severity: Severity::Note, ..Self::error(code, message) }
    }

    /// Says where.
    #[must_use]
    pub fn at(mut self, file: usize, span: Span, text: impl Into<String>) -> Self {
        self.place = Some(Label { file, span, text: text.into() });
        self
    }

    /// Says what to do.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

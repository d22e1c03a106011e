//! What is wrong with a file, with the text it is about.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Source;

/// A file that cannot be used, and why.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}: {}", .source_text.name(), .diagnostic.message)]
pub struct FileError {
    /// The file.
    pub source_text: Box<Source>,
    /// What is wrong, and where.
    pub diagnostic: Box<Diagnostic>,
}

impl FileError {
    /// A finding about a file.
    pub fn new(source: &Source, diagnostic: Diagnostic) -> Self {
        Self { source_text: Box::new(source.clone()), diagnostic: Box::new(diagnostic) }
    }
}

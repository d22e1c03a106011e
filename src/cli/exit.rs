//! How a run ends.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Source;
use crate::files::error::FileError;
use crate::identify::calibrate::Refusal;

/// Exit status, as the contract has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Done.
    Done,
    /// It ran and the answer is no.
    No,
    /// Bad usage or bad input; nothing was written.
    Bad,
}

impl Exit {
    pub fn code(self) -> ExitCode {
        ExitCode::from(match self {
            Exit::Done => 0,
            Exit::No => 1,
            Exit::Bad => 2,
        })
    }
}

/// Why a run could not be done.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A file cannot be read or written.
    #[error("{}: {error}", path.display())]
    File { path: PathBuf, error: io::Error },
    /// A file of the tool's own kind is wrong.
    #[error(transparent)]
    Input(#[from] FileError),
    /// A program is wrong.
    #[error("{} cannot be used", .0.first().map_or("the program", Source::name))]
    Program(Vec<Source>, Vec<Diagnostic>),
    /// The options do not fit together, or name something that does not exist.
    #[error("{0}")]
    Usage(String),
    /// No model can be made from the recording.
    #[error(transparent)]
    Recording(#[from] Refusal),
    /// Standard output went away.
    #[error("standard output: {0}")]
    Output(io::Error),
}

impl Failure {
    pub fn file(path: &Path, error: io::Error) -> Self {
        Failure::File { path: path.to_path_buf(), error }
    }

    /// True when the reader of standard output has closed it: no failure of ours.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Failure::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }
}

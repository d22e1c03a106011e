//! Reading: files into sources, names into robots, programs into targets.

use std::io::Read;
use std::path::{Path, PathBuf};

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::text::{Source, Span};
use crate::files::calibration::{self, Calibration};
use crate::files::cell::{self, Cell};
use crate::files::{builtin, recording, robot};
use crate::measure::recording::Recording;
use crate::model::robot::Robot;
use crate::program::dialect::{self, DIALECTS, Dialect};
use crate::program::target::Program;

use super::exit::Failure;

/// Reads a file.
pub fn source(path: &Path) -> Result<Source, Failure> {
    if path.is_dir() {
        return Err(Failure::Usage(format!("{} is a directory; expected a file", path.display())));
    }
    let bytes = std::fs::read(path).map_err(|error| Failure::file(path, error))?;
    Ok(Source::new(path.display().to_string(), bytes))
}

/// Reads standard input.
pub fn standard_input() -> Result<Source, Failure> {
    let mut bytes = Vec::new();
    std::io::stdin().lock().read_to_end(&mut bytes).map_err(|error| Failure::file(Path::new("<stdin>"), error))?;
    Ok(Source::new("<stdin>", bytes))
}

/// A robot file, or a built-in robot's name.
pub fn robot(argument: &str) -> Result<Robot, Failure> {
    match built_in(argument) {
        Some(robot) => robot,
        None => Ok(robot::read(&named_source(argument)?)?),
    }
}

/// A model file, a robot file, or a built-in robot's name.
pub fn model(argument: &str) -> Result<Calibration, Failure> {
    match built_in(argument) {
        Some(robot) => Ok(Calibration::nominal(robot?)),
        None => Ok(calibration::read(&named_source(argument)?)?),
    }
}

/// A recording of this robot.
pub fn recording(path: &Path, robot: &Robot) -> Result<Recording, Failure> {
    Ok(recording::read(&source(path)?, robot)?)
}

fn built_in(argument: &str) -> Option<Result<Robot, Failure>> {
    if Path::new(argument).exists() {
        return None;
    }
    Some(builtin::by_name(argument)?.map_err(Failure::from))
}

fn named_source(argument: &str) -> Result<Source, Failure> {
    let path = PathBuf::from(argument);
    if !path.exists() && path.extension().is_none() {
        return Err(Failure::Usage(format!(
            "`{argument}` is neither a file nor a built-in robot; `falsetarget robots` lists those"
        )));
    }
    source(&path)
}

/// A cell file, or an empty cell.
pub fn cell(path: Option<&Path>) -> Result<Cell, Failure> {
    match path {
        Some(path) => Ok(cell::read(&source(path)?)?),
        None => Ok(Cell::default()),
    }
}

/// The dialect of a program: as asked for, or as its content says.
pub fn dialect_of(source: &Source, wanted: Option<&'static dyn Dialect>) -> Result<&'static dyn Dialect, Failure> {
    let refuse = |diagnostic: Diagnostic| Err(Failure::Program(Box::new(source.clone()), vec![diagnostic]));
    let first_line = source.lines().next().unwrap_or_default();
    if source.bytes().iter().all(u8::is_ascii_whitespace) {
        return refuse(Diagnostic::error("empty-file", "the program is empty").at(0, Span::new(0, 0), ""));
    }
    let found = dialect::detect(source);
    match (wanted, found) {
        (Some(wanted), Some(found)) if wanted.meta().id != found.meta().id => refuse(
            Diagnostic::error("dialect", format!("this is {}, not {}", found.meta().title, wanted.meta().title))
                .at(0, first_line, "")
                .help(format!("leave --dialect out, or say --dialect {}", found.meta().id)),
        ),
        (Some(wanted), _) => Ok(wanted),
        (None, Some(found)) => Ok(found),
        (None, None) => {
            let known: Vec<&str> = DIALECTS.iter().map(|dialect| dialect.meta().id).collect();
            refuse(
                Diagnostic::error("dialect", "no robot language that this tool knows begins like this")
                    .at(0, first_line, "")
                    .help(format!("known: {}; --dialect NAME takes the file as that language", known.join(", "))),
            )
        }
    }
}

/// A program read from its files.
pub struct Loaded {
    pub sources: Vec<Source>,
    pub dialect: &'static dyn Dialect,
    pub program: Program,
}

/// Reads a program; warnings and notes stay in it for the caller to show.
///
/// # Errors
/// [`Failure::Program`] when its language is unknown, it holds errors, or it was forced into a language in which it
/// has nothing to say.
pub fn program(source: Source, wanted: Option<&'static dyn Dialect>) -> Result<Loaded, Failure> {
    let dialect = dialect_of(&source, wanted)?;
    let sources = vec![source];
    let program = dialect.read(&sources);
    let mut errors: Vec<Diagnostic> =
        program.diagnostics.iter().filter(|finding| finding.severity == Severity::Error).cloned().collect();
    if program.targets.is_empty() && errors.is_empty() && dialect::detect(&sources[0]).is_none() {
        let nothing = format!("nothing in this file reads as {}", dialect.meta().title);
        errors.push(Diagnostic::error("dialect", nothing).at(0, sources[0].lines().next().unwrap_or_default(), ""));
    }
    match errors.is_empty() {
        true => Ok(Loaded { sources, dialect, program }),
        false => Err(Failure::Program(Box::new(sources[0].clone()), errors)),
    }
}

/// For `--dialect`.
pub fn parse_dialect(id: &str) -> Result<&'static dyn Dialect, String> {
    dialect::by_id(id).ok_or_else(|| {
        let known: Vec<&str> = DIALECTS.iter().map(|dialect| dialect.meta().id).collect();
        format!("known dialects are {}", known.join(", "))
    })
}

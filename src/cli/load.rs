//! Reading: files into sources, names into robots.

use std::io::Read;
use std::path::{Path, PathBuf};

use crate::base::text::Source;
use crate::files::calibration::{self, Calibration};
use crate::files::cell::{self, Cell};
use crate::files::{builtin, recording, robot};
use crate::measure::recording::Recording;
use crate::model::robot::Robot;
use crate::program::dialect::{self, DIALECTS, Dialect};

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

/// For `--dialect`.
pub fn parse_dialect(id: &str) -> Result<&'static dyn Dialect, String> {
    dialect::by_id(id).ok_or_else(|| {
        let known: Vec<&str> = DIALECTS.iter().map(|dialect| dialect.meta().id).collect();
        format!("known dialects are {}", known.join(", "))
    })
}

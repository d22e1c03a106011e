//! Jobs: a program read with the files that belong to it.

use std::path::{Path, PathBuf};

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::text::{Source, Span};
use crate::program::dialect::{self, DIALECTS, Dialect};
use crate::program::target::{Program, TargetValue};

use super::exit::Failure;
use super::{census, load};

/// A program read from its files.
pub struct Loaded {
    /// The files of the job, then those that it shares with others.
    pub sources: Vec<Source>,
    /// How many of them are the job's own.
    pub own: usize,
    pub dialect: &'static dyn Dialect,
    pub program: Program,
}

/// Reads a program and what lies beside it on the disk.
///
/// # Errors
/// [`Failure::Program`] when its language is unknown, it holds errors, or it was forced into a language in which it
/// has nothing to say.
pub fn of_file(path: &Path, wanted: Option<&'static dyn Dialect>) -> Result<Loaded, Failure> {
    let mut entries = vec![census::look(path, wanted, true)];
    entries.extend(census::beside(&entries[0]));
    let Some(plan) = census::plans(&entries).into_iter().find(|plan| plan.own.contains(&0)) else {
        let dialect = entries.swap_remove(0).dialect?;
        return Err(Failure::Usage(format!(
            "{}: {}",
            path.display(),
            dialect.map_or("no program", |d| d.meta().title)
        )));
    };
    let paths = |files: &[usize]| files.iter().map(|file| entries[*file].path.clone()).collect::<Vec<PathBuf>>();
    // The file that was asked for comes first.
    let (mut own, shared) = (plan.own, paths(&plan.shared));
    own.sort_by_key(|file| *file != 0);
    of_files(&paths(&own), &shared, plan.dialect)
}

/// Reads the program on standard input, alone.
///
/// # Errors
/// As [`of_file`].
pub fn of_standard_input(wanted: Option<&'static dyn Dialect>) -> Result<Loaded, Failure> {
    let source = load::standard_input()?;
    let dialect = dialect_of(&source, wanted)?;
    read(vec![source], 1, dialect)
}

/// Reads the job that these files are, with files of other jobs that it needs and those that all jobs share.
///
/// # Errors
/// As [`of_file`].
pub fn of_files(own: &[PathBuf], shared: &[PathBuf], dialect: &'static dyn Dialect) -> Result<Loaded, Failure> {
    let mut sources = own.iter().chain(shared).map(|path| load::source(path)).collect::<Result<Vec<_>, _>>()?;
    let first = own.first().map(PathBuf::as_path).unwrap_or(Path::new(""));
    for path in shared_files(first, dialect) {
        let source = load::source(&path)?;
        if dialect.recognises(&source) {
            sources.push(source);
        }
    }
    read(sources, own.len(), dialect)
}

/// Reads sources, the first `own` of them the job's own.
///
/// # Errors
/// As [`of_file`].
pub fn read(sources: Vec<Source>, own: usize, dialect: &'static dyn Dialect) -> Result<Loaded, Failure> {
    let mut program = dialect.read(&sources);
    program.read_only = (own..sources.len()).collect();
    leave_shared_alone(&mut program, &sources, own);
    let is_own = |finding: &&Diagnostic| finding.place.as_ref().is_none_or(|place| place.file < own);
    let is_error = |finding: &&Diagnostic| finding.severity == Severity::Error;
    let mut errors: Vec<Diagnostic> = program.diagnostics.iter().filter(is_own).filter(is_error).cloned().collect();
    if program.targets.is_empty() && errors.is_empty() && dialect::detect(&sources[0]).is_none() {
        let nothing = format!("nothing in this file reads as {}", dialect.meta().title);
        errors.push(Diagnostic::error("dialect", nothing).at(0, sources[0].lines().next().unwrap_or_default(), ""));
    }
    match errors.is_empty() {
        true => Ok(Loaded { sources, own, dialect, program }),
        false => Err(Failure::Program(sources, errors)),
    }
}

/// A position in a shared file is a variable that any other program may set: its value is not known from here.
fn leave_shared_alone(program: &mut Program, sources: &[Source], own: usize) {
    for target in program.targets.iter_mut().filter(|target| target.file >= own) {
        if !matches!(target.value, TargetValue::Joint(_)) {
            let reason =
                || format!("stands in {}, which other programs share and may change", sources[target.file].name());
            target.computed.get_or_insert_with(reason);
        }
    }
}

/// How many folders above a program are searched for shared files: a controller's programs lie three or four below.
const FOLDERS_ABOVE: usize = 6;

/// The files that a job shares with others: beside it, or in a folder above or the `System` folder there.
pub fn shared_files(path: &Path, dialect: &'static dyn Dialect) -> Vec<PathBuf> {
    let own = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let wanted = dialect.shared_files().iter().filter(|name| !name.eq_ignore_ascii_case(own));
    let folder = folder_of(path);
    let absolute = folder.canonicalize().unwrap_or_else(|_| folder.clone());
    // As the user spells the folders, so that the same file has the same name in every job; then beyond.
    let folders = || folder.ancestors().take(FOLDERS_ABOVE).chain(absolute.ancestors().take(FOLDERS_ABOVE));
    let find = |name: &&str| {
        folders().find_map(|folder| file_in(folder, name).or_else(|| file_in(&folder.join("System"), name)))
    };
    wanted.filter_map(find).collect()
}

/// The file of this name in a folder, whatever its case.
fn file_in(folder: &Path, name: &str) -> Option<PathBuf> {
    let exact = folder.join(name);
    if exact.is_file() {
        return Some(exact);
    }
    let found = names_in(folder).into_iter().find(|other| other.eq_ignore_ascii_case(name))?;
    Some(folder.join(found)).filter(|path| path.is_file())
}

/// The folder of a path; `.` for a bare name.
pub fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// The names in a folder, in order; none where it cannot be read.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    names
}

/// The dialect of a program: as asked for, or as its content says.
pub fn dialect_of(source: &Source, wanted: Option<&'static dyn Dialect>) -> Result<&'static dyn Dialect, Failure> {
    let refuse = |diagnostic: Diagnostic| Err(Failure::Program(vec![source.clone()], vec![diagnostic]));
    let first_line = source.lines().next().unwrap_or_default();
    if source.bytes().iter().all(u8::is_ascii_whitespace) {
        return refuse(Diagnostic::error("empty-file", "the program is empty").at(0, Span::new(0, 0), ""));
    }
    if source.is_binary() {
        let message = "this is binary data, not the text of a program";
        let help = "an encoded or encrypted module must be saved as text where it was made";
        return refuse(Diagnostic::error("binary", message).at(0, first_line, "").help(help));
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

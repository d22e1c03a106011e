//! The files that a batch is about, and where each goes.

use std::path::{Path, PathBuf};

use super::exit::Failure;
use super::record;
use super::shop::same_file;

/// One input of a batch.
pub struct Item {
    pub input: PathBuf,
    /// Where its output goes.
    pub output: PathBuf,
    /// Named by the user, not found in a folder: it is an error when it is no program.
    pub is_named: bool,
    /// Named or in a named folder; else it only lies beside one that was named.
    pub is_asked: bool,
}

/// The files that were named or lie in folders that were named.
///
/// # Errors
/// [`Failure`] when a folder cannot be read, or `out_dir` is one of the inputs.
pub fn items(programs: &[PathBuf], out_dir: &Path) -> Result<Vec<Item>, Failure> {
    if programs.is_empty() {
        return Err(Failure::Usage("--out-dir needs at least one PROGRAM or folder".into()));
    }
    if out_dir.exists() && !out_dir.is_dir() {
        return Err(Failure::Usage(format!("--out-dir {} is a file", out_dir.display())));
    }
    let mut items = Vec::new();
    for program in programs {
        if program.is_dir() {
            if same_file(program, out_dir) {
                return Err(Failure::Usage(format!("{} is both input and --out-dir", out_dir.display())));
            }
            walk(program, out_dir, &[out_dir], &mut items)?;
        } else {
            let name =
                program.file_name().ok_or_else(|| Failure::Usage(format!("{} is no file", program.display())))?;
            items.push(Item { input: program.clone(), output: out_dir.join(name), is_named: true, is_asked: true });
        }
    }
    Ok(items)
}

/// Makes sure that each output has a place of its own.
///
/// # Errors
/// [`Failure::Usage`] when two would be written to one place, or one over itself.
pub fn check_places(mut items: Vec<&Item>) -> Result<(), Failure> {
    items.sort_by(|a, b| (&a.output, &a.input).cmp(&(&b.output, &b.input)));
    if let Some(item) = items.iter().find(|item| same_file(&item.input, &item.output)) {
        return Err(Failure::Usage(format!("{} would be overwritten", item.input.display())));
    }
    if let Some(pair) = items.windows(2).find(|pair| pair[0].output == pair[1].output) {
        let (a, b, output) = (pair[0].input.display(), pair[1].input.display(), pair[0].output.display());
        return Err(Failure::Usage(format!("{a} and {b} would both become {output}")));
    }
    Ok(())
}

/// The regular files below a folder. Links to folders are not followed (they may lead back), and results of an earlier
/// run below one of the `apart` folders are no input.
///
/// # Errors
/// [`Failure::File`] when a folder cannot be read.
pub fn walk(folder: &Path, out: &Path, apart: &[&Path], items: &mut Vec<Item>) -> Result<(), Failure> {
    let entries = std::fs::read_dir(folder).map_err(|error| Failure::file(folder, error))?;
    for entry in entries {
        let entry = entry.map_err(|error| Failure::file(folder, error))?;
        let (path, output) = (entry.path(), out.join(entry.file_name()));
        let kind = entry.file_type().map_err(|error| Failure::file(&path, error))?;
        if kind.is_dir() {
            let is_apart = apart.iter().any(|other| same_file(&path, other));
            if !is_apart && entry.file_name() != record::FOLDER {
                walk(&path, &output, apart, items)?;
            }
        } else if path.is_file() {
            items.push(Item { input: path, output, is_named: false, is_asked: true });
        }
    }
    Ok(())
}

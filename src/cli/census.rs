//! What files are, before they are read in earnest: their language, and which of them are one job.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::base::text::Source;
use crate::program::dialect::{self, Dialect};
use crate::program::ties::{Member, Ties, together};

use super::exit::Failure;
use super::{job, load};

/// A file, looked at.
pub struct Entry {
    pub path: PathBuf,
    /// Its language; none for a file of a folder that is no robot program.
    pub dialect: Result<Option<&'static dyn Dialect>, Failure>,
    /// SHA-256 of its bytes.
    pub digest: [u8; 32],
    ties: Ties,
}

/// The files of a job, by what is known before they are read.
pub struct Plan {
    pub dialect: &'static dyn Dialect,
    /// Indices of the entries that are the job's own, a program before its data.
    pub own: Vec<usize>,
    /// Indices of entries that are read with it.
    pub shared: Vec<usize>,
}

/// Looks at a file. One that the user named must be a program, and wanted languages hold for it; what lies in a folder
/// may be anything.
pub fn look(path: &Path, wanted: Option<&'static dyn Dialect>, is_named: bool) -> Entry {
    let nothing = |dialect| Entry { path: path.to_path_buf(), dialect, digest: [0; 32], ties: Ties::default() };
    if !is_named && begins_binary(path) {
        return nothing(Ok(None));
    }
    let source = match load::source(path) {
        Ok(source) => source,
        Err(failure) => return nothing(Err(failure)),
    };
    if !is_named && wanted.is_none() && dialect::detect(&source).is_none() {
        return nothing(Ok(None));
    }
    match job::dialect_of(&source, wanted) {
        Ok(dialect) => Entry {
            digest: Sha256::digest(source.bytes()).into(),
            ties: dialect.ties(&source),
            ..nothing(Ok(Some(dialect)))
        },
        Err(failure) => nothing(Err(failure)),
    }
}

/// Looks at the files beside one that was named alone, as far as they may be of its job: those that end as files of its
/// language do. A report or an export of the same name may be of any size and is not even opened.
pub fn beside(entry: &Entry) -> Vec<Entry> {
    let Ok(Some(dialect)) = entry.dialect else { return Vec::new() };
    let own = name_of(&entry.path);
    let job = dialect.job_of(own);
    let has_ties = entry.ties != Ties::default();
    let is_likely = |path: &PathBuf| {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
        let name = name_of(path);
        *path != entry.path
            && dialect.meta().extensions.contains(&ending.as_str())
            && (has_ties || dialect.job_of(name) == job)
    };
    let all = folders(&entry.path, dialect).into_iter().flat_map(|folder| files_in(&folder));
    let recognised = |entry: &Entry| matches!(&entry.dialect, Ok(Some(other)) if other.meta().id == dialect.meta().id);
    all.filter(is_likely).map(|path| look(&path, None, false)).filter(recognised).collect()
}

/// Puts programs together as jobs, in the order of the first file of each.
pub fn plans(entries: &[Entry]) -> Vec<Plan> {
    let programs: Vec<(usize, &'static dyn Dialect)> = entries
        .iter()
        .enumerate()
        .filter_map(|(index, entry)| Some((index, *entry.dialect.as_ref().ok()?.as_ref()?)))
        .collect();
    let described: Vec<(String, String)> = programs
        .iter()
        .map(|(index, dialect)| {
            let path = &entries[*index].path;
            (format!("{}:{}", dialect.meta().id, place(path, *dialect).display()), dialect.job_of(name_of(path)))
        })
        .collect();
    let members: Vec<Member<'_>> = described
        .iter()
        .zip(&programs)
        .map(|((place, job), (index, _))| Member { place, job, ties: &entries[*index].ties })
        .collect();
    let original = |files: Vec<usize>| files.into_iter().map(|file| programs[file].0).collect::<Vec<usize>>();
    let plan = |group: crate::program::ties::Group| {
        let dialect = programs[group.own[0]].1;
        let mut own = original(group.own);
        // A program before its data: `.src`, `.dat`.
        own.sort_by(|a, b| entries[*b].path.cmp(&entries[*a].path));
        Plan { dialect, own, shared: original(group.shared) }
    };
    together(&members).into_iter().map(plan).collect()
}

/// The folder of a file, those that count as one told by the folder above.
fn place(path: &Path, dialect: &dyn Dialect) -> PathBuf {
    let folder = job::folder_of(path);
    match is_joined(&folder, dialect) {
        true => folder.parent().map(Path::to_path_buf).unwrap_or(folder),
        false => folder,
    }
}

/// The folders that count as one with that of a file.
fn folders(path: &Path, dialect: &dyn Dialect) -> Vec<PathBuf> {
    let folder = job::folder_of(path);
    if !is_joined(&folder, dialect) {
        return vec![folder];
    }
    let above = job::folder_of(&folder);
    let joined = job::names_in(&above).into_iter().map(|name| above.join(name));
    joined.filter(|folder| is_joined(folder, dialect) && folder.is_dir()).collect()
}

fn is_joined(folder: &Path, dialect: &dyn Dialect) -> bool {
    dialect.joined_folders().iter().any(|joined| name_of(folder).eq_ignore_ascii_case(joined))
}

fn files_in(folder: &Path) -> Vec<PathBuf> {
    let plain = folder == Path::new(".");
    let names = job::names_in(folder).into_iter();
    names
        .map(|name| if plain { PathBuf::from(name) } else { folder.join(name) })
        .filter(|path| path.is_file())
        .collect()
}

fn name_of(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).unwrap_or_default()
}

/// Folders hold archives and films beside programs: those are not read whole to know it.
fn begins_binary(path: &Path) -> bool {
    let mut start = Vec::new();
    let read = File::open(path).and_then(|file| file.take(4096).read_to_end(&mut start));
    read.is_ok() && Source::new("", start).is_binary()
}

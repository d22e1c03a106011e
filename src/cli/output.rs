//! Writing: a file appears whole or not at all.

use std::io::Write;
use std::path::Path;

use super::exit::Failure;

/// Says beforehand what would be in the way of [`write`]: so that nothing is written when not all can be.
pub fn check(path: &Path) -> Result<(), Failure> {
    if path.as_os_str() == "-" {
        return Ok(());
    }
    if path.is_dir() {
        return Err(Failure::Usage(format!("{} is a directory; name a file", path.display())));
    }
    let folder = folder_of(path);
    if !folder.is_dir() {
        return Err(Failure::Usage(format!("{}: there is no folder {}", path.display(), folder.display())));
    }
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes bytes to a path, or to standard output for `-`.
///
/// A file is written beside its place under another name, flushed to the disk, and renamed.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if path.as_os_str() == "-" {
        return print(bytes);
    }
    check(path)?;
    // The kind alone: the name of the temporary file says nothing to the user.
    let failure = |error: std::io::Error| Failure::file(path, error.kind().into());
    let file = stage(path, bytes).map_err(failure)?;
    file.persist(path).map(|_| ()).map_err(|error| failure(error.error))
}

/// A file beside its place, complete, without its name.
fn stage(path: &Path, bytes: &[u8]) -> std::io::Result<tempfile::NamedTempFile> {
    let mut file = temporary(path)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    Ok(file)
}

/// An empty file beside a place, with the permissions that it shall have there.
pub fn temporary(path: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let file = tempfile::Builder::new().prefix(".falsetarget-").tempfile_in(folder_of(path))?;
    keep_permissions(path, file.as_file())?;
    Ok(file)
}

/// Writes what will be renamed to `path`, under a name of its own, flushed to the disk.
pub fn write_part(part: &Path, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let write = || {
        let mut file = std::fs::File::create(part)?;
        keep_permissions(path, &file)?;
        file.write_all(bytes)?;
        file.sync_all()
    };
    write().map_err(|error: std::io::Error| Failure::file(path, error.kind().into()))
}

/// A new file gets what the user's mask allows; one that is replaced keeps what it had.
fn keep_permissions(path: &Path, file: &std::fs::File) -> std::io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = std::fs::metadata(path).map_or(0o644, |metadata| metadata.permissions().mode());
        file.set_permissions(std::fs::Permissions::from_mode(mode))?;
    }
    #[cfg(not(unix))]
    let _ = (path, file);
    Ok(())
}

/// Writes bytes to standard output.
pub fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).map_err(Failure::Output)
}

/// Writes a value as JSON with a last newline.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Failure> {
    let mut text = serde_json::to_vec_pretty(value).map_err(|error| Failure::Output(std::io::Error::other(error)))?;
    text.push(b'\n');
    write(path, &text)
}

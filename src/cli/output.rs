//! Writing: a file appears whole or not at all.

use std::io::{BufWriter, IntoInnerError, Write};
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
    write_with(path, |out| out.write_all(bytes))
}

/// The same for what is made as it is written.
fn write_with(path: &Path, content: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Result<(), Failure> {
    if path.as_os_str() == "-" {
        let mut out = BufWriter::new(std::io::stdout().lock());
        return content(&mut out).and_then(|()| out.flush()).map_err(Failure::Output);
    }
    check(path)?;
    // The kind alone: the name of the temporary file says nothing to the user.
    let failure = |error: std::io::Error| Failure::file(path, error.kind().into());
    let staged = || {
        let mut out = BufWriter::new(temporary(path)?);
        content(&mut out)?;
        let file = out.into_inner().map_err(IntoInnerError::into_error)?;
        file.as_file().sync_all()?;
        Ok(file)
    };
    let file = staged().map_err(failure)?;
    file.persist(path).map(|_| ()).map_err(|error| failure(error.error))
}

/// An empty file beside a place, with the permissions that it shall have there.
pub fn temporary(path: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let file = tempfile::Builder::new().prefix(".falsetarget-").tempfile_in(folder_of(path))?;
    keep_permissions(path, file.as_file())?;
    Ok(file)
}

/// Writes what will be renamed to `path`, under a name of its own. Nothing is flushed to the disk: see [`flush`].
pub fn write_part(part: &Path, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let write = || {
        let mut file = std::fs::File::create(part)?;
        keep_permissions(path, &file)?;
        file.write_all(bytes)
    };
    write().map_err(|error: std::io::Error| Failure::file(path, error.kind().into()))
}

/// Makes sure that a file survives a loss of power.
pub fn flush(path: &Path) -> Result<(), Failure> {
    let flushed = std::fs::File::open(path).and_then(|file| file.sync_all());
    flushed.map_err(|error| Failure::file(path, error))
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
    write_with(path, |out| {
        serde_json::to_writer_pretty(&mut *out, value)?;
        out.write_all(b"\n")
    })
}

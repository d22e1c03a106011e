//! Writing: a file appears whole or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

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

/// A file on its way: it stands in its place when it is whole, or not at all.
pub struct Staged {
    /// As the user named it.
    path: PathBuf,
    target: Target,
}

/// Where the bytes of a file go.
enum Target {
    StandardOutput,
    /// A pipe or a device, which nothing may replace.
    Stream(File),
    /// A file beside the place, to be renamed.
    Beside(NamedTempFile, PathBuf),
}

impl Staged {
    /// Begins a file at a path; `-` is standard output. Where the path is a link, the file behind it is meant.
    ///
    /// # Errors
    /// [`Failure::Usage`] as [`check`] has it, or [`Failure::File`].
    pub fn create(path: &Path) -> Result<Self, Failure> {
        check(path)?;
        let open = || {
            if path.as_os_str() == "-" {
                return Ok(Target::StandardOutput);
            }
            if std::fs::metadata(path).is_ok_and(|there| !there.is_file()) {
                return Ok(Target::Stream(File::options().write(true).open(path)?));
            }
            let place = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
            let file = tempfile::Builder::new().prefix(".falsetarget-").tempfile_in(folder_of(&place))?;
            keep_permissions(&place, file.as_file())?;
            Ok(Target::Beside(file, place))
        };
        let target = open().map_err(|error| failure(path, &error))?;
        Ok(Self { path: path.to_path_buf(), target })
    }

    /// Adds bytes.
    ///
    /// # Errors
    /// [`Failure::File`] or [`Failure::Output`].
    pub fn add(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.put(|out| out.write_all(bytes))
    }

    /// Adds what is made as it is written.
    fn put(&mut self, content: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Result<(), Failure> {
        let write = |out: &mut dyn Write| {
            let mut out = BufWriter::new(out);
            content(&mut out).and_then(|()| out.flush())
        };
        match &mut self.target {
            Target::StandardOutput => write(&mut std::io::stdout().lock()).map_err(Failure::Output),
            Target::Stream(file) => write(file).map_err(|error| failure(&self.path, &error)),
            Target::Beside(file, _) => write(file).map_err(|error| failure(&self.path, &error)),
        }
    }

    /// Puts the file in its place, once it is on the disk.
    ///
    /// # Errors
    /// [`Failure::File`]
    pub fn finish(self) -> Result<(), Failure> {
        let Target::Beside(file, place) = self.target else { return Ok(()) };
        let put = || {
            file.as_file().sync_all()?;
            file.persist(place).map_err(|error| error.error)
        };
        put().map(|_| ()).map_err(|error: std::io::Error| failure(&self.path, &error))
    }
}

/// The kind of an error alone: the name of a temporary file says nothing to the user.
fn failure(path: &Path, error: &std::io::Error) -> Failure {
    Failure::file(path, error.kind().into())
}

/// Writes bytes to a path, or to standard output for `-`.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut file = Staged::create(path)?;
    file.add(bytes)?;
    file.finish()
}

/// Writes what will be renamed to `path`, under a name of its own. Nothing is flushed to the disk: see [`flush`].
pub fn write_part(part: &Path, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let write = || {
        let mut file = File::create(part)?;
        keep_permissions(path, &file)?;
        file.write_all(bytes)
    };
    write().map_err(|error: std::io::Error| Failure::file(path, error.kind().into()))
}

/// Makes sure that a file survives a loss of power.
pub fn flush(path: &Path) -> Result<(), Failure> {
    let flushed = File::open(path).and_then(|file| file.sync_all());
    flushed.map_err(|error| Failure::file(path, error))
}

/// A new file gets what the user's mask allows; one that is replaced keeps what it had.
fn keep_permissions(path: &Path, file: &File) -> std::io::Result<()> {
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

/// Writes a value as JSON with a last newline.
pub fn write_json(path: &Path, value: &impl serde::Serialize) -> Result<(), Failure> {
    let mut file = Staged::create(path)?;
    file.put(|out| {
        serde_json::to_writer_pretty(&mut *out, value)?;
        out.write_all(b"\n")
    })?;
    file.finish()
}

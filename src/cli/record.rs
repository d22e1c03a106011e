//! What a batch has finished, kept below its output folder until all is done: a run that was killed is taken up where
//! it stopped.
//!
//! Each job has a file of its own, so that several processes can share one output folder. A job counts as finished
//! when its record was made from the same bytes with the same model, cell and options, and its outputs are still the
//! bytes that were written. Outputs are made in the same folder and renamed to their place.
//!
//! A flush to the disk costs more than the correction of a usual program. So a batch flushes once, when all is done and
//! before its records go: until then a file that a loss of power has emptied is not the one of its record, and its job is
//! done again. Where outputs are taken away as they come, each is flushed before it gets its name.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::report::tally::Tally;

use super::exit::Failure;
use super::output;

/// The folder below the output folder.
pub const FOLDER: &str = ".falsetarget";

/// The records of one output folder.
pub struct Records {
    folder: PathBuf,
    flushing: Flushing,
}

/// When outputs are flushed to the disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flushing {
    /// Each before it gets its name.
    Each,
    /// All of them by [`Records::flush`], when the run is done.
    AtTheEnd,
}

/// A finished job.
#[derive(Serialize, Deserialize)]
pub struct Record {
    /// Hash of all that went in.
    key: String,
    /// Hash of each output.
    outputs: Vec<String>,
    /// Its counts.
    pub tally: Tally,
    /// Its files in the report, one line of JSON each; none when no report was asked for.
    pub reports: Option<Vec<String>>,
}

/// Where a job's record and outputs go.
pub struct Place {
    /// Name of the record: the hash of the first output's name.
    pub name: String,
    /// The outputs.
    pub outputs: Vec<PathBuf>,
}

/// SHA-256 as text.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Records {
    /// Those below an output folder, which need not exist yet.
    pub fn below(out_dir: &Path, flushing: Flushing) -> Self {
        Self { folder: out_dir.join(FOLDER), flushing }
    }

    /// The record of a job, if it is finished and, where `with_reports`, knows what the report wants.
    pub fn finished(&self, place: &Place, key: &str, with_reports: bool) -> Option<Record> {
        let text = std::fs::read(self.file(place)).ok()?;
        let record: Record = serde_json::from_slice(&text).ok()?;
        let as_written = |(path, hash): (&PathBuf, &String)| {
            std::fs::read(path).is_ok_and(|bytes| hex(&Sha256::digest(&bytes)) == *hash)
        };
        let complete = record.outputs.len() == place.outputs.len()
            && place.outputs.iter().zip(&record.outputs).all(as_written)
            && (record.reports.is_some() || !with_reports);
        (record.key == key && complete).then_some(record)
    }

    /// True when this very job was finished before, whatever became of its outputs since.
    pub fn knows(&self, place: &Place, key: &str) -> bool {
        let record = std::fs::read(self.file(place)).ok().and_then(|text| serde_json::from_slice::<Record>(&text).ok());
        record.is_some_and(|record| record.key == key)
    }

    /// Writes the outputs of a job, each whole, and then that it is finished.
    ///
    /// # Errors
    /// [`Failure::File`]
    pub fn finish(
        &self,
        place: &Place,
        files: &[Vec<u8>],
        key: &str,
        tally: Tally,
        reports: Option<Vec<String>>,
    ) -> Result<(), Failure> {
        let create = |folder: &Path| std::fs::create_dir_all(folder).map_err(|error| Failure::file(folder, error));
        create(&self.folder)?;
        let mut staged = Vec::with_capacity(files.len());
        for (number, (path, bytes)) in place.outputs.iter().zip(files).enumerate() {
            create(path.parent().unwrap_or(Path::new(".")))?;
            if !holds(path, bytes) {
                staged.push((self.folder.join(format!("{}.{number}.part", place.name)), path, bytes));
            }
        }
        for (part, path, bytes) in &staged {
            output::write_part(part, path, bytes)?;
            if self.flushing == Flushing::Each {
                output::flush(part)?;
            }
        }
        for (part, path, _) in &staged {
            std::fs::rename(part, path).map_err(|error| Failure::file(path, error))?;
        }
        let outputs = files.iter().map(|bytes| hex(&Sha256::digest(bytes))).collect();
        let record = Record { key: key.to_string(), outputs, tally, reports };
        let file = self.file(place);
        let text = serde_json::to_vec(&record).map_err(|error| Failure::file(&file, error.into()))?;
        // Half a record is none: it may be lost, for then the job is done again.
        std::fs::write(&file, text).map_err(|error| Failure::file(&file, error))
    }

    /// Flushes the outputs of a job that this run or one before it has finished.
    ///
    /// # Errors
    /// [`Failure::File`]
    pub fn flush(&self, place: &Place) -> Result<(), Failure> {
        match self.file(place).exists() {
            true => place.outputs.iter().try_for_each(|path| output::flush(path)),
            false => Ok(()),
        }
    }

    /// Copies a file that is no program to its place, byte for byte.
    ///
    /// # Errors
    /// [`Failure::File`]
    pub fn copy(&self, place: &Place, from: &Path) -> Result<(), Failure> {
        let create = |folder: &Path| std::fs::create_dir_all(folder).map_err(|error| Failure::file(folder, error));
        create(&self.folder)?;
        let part = self.folder.join(format!("{}.part", place.name));
        for output in &place.outputs {
            create(output.parent().unwrap_or(Path::new(".")))?;
            std::fs::copy(from, &part).map_err(|error| Failure::file(from, error))?;
            std::fs::rename(&part, output).map_err(|error| Failure::file(output, error))?;
        }
        Ok(())
    }

    /// Forgets a job.
    pub fn forget(&self, place: &Place) {
        // What is not there need not go.
        let _ = std::fs::remove_file(self.file(place));
    }

    /// Removes the folder when nothing is left in it; all that is in it when no other process can be at work there.
    pub fn close(&self, alone: bool) {
        let _ = if alone { std::fs::remove_dir_all(&self.folder) } else { std::fs::remove_dir(&self.folder) };
    }

    fn file(&self, place: &Place) -> PathBuf {
        self.folder.join(format!("{}.json", place.name))
    }
}

/// True when the file is there with these bytes: it then keeps its time.
fn holds(path: &Path, bytes: &[u8]) -> bool {
    let same_length = std::fs::metadata(path).is_ok_and(|metadata| metadata.len() == bytes.len() as u64);
    same_length && std::fs::read(path).is_ok_and(|there| there == bytes)
}

impl Place {
    /// Of a job with these outputs below `out_dir`.
    pub fn new(out_dir: &Path, outputs: Vec<PathBuf>) -> Self {
        let first = outputs.first().map(|path| path.strip_prefix(out_dir).unwrap_or(path)).unwrap_or(Path::new(""));
        // Only the names, so that every computer of a cluster comes to the same.
        let parts: Vec<String> = first.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        let name = hex(&Sha256::digest(parts.join("/").as_bytes())[..16]);
        Self { name, outputs }
    }

    /// Which of `count` parts of a library the job belongs to, from zero.
    pub fn shard(&self, count: u64) -> u64 {
        u64::from_str_radix(&self.name[..15], 16).unwrap_or_default() % count.max(1)
    }
}

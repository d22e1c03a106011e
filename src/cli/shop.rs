//! What all programs of a run are corrected with: model, cell, options; and the correction of one job.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::base::diagnostic::{Diagnostic, Severity};
use crate::base::edit::EditSet;
use crate::base::text::Source;
use crate::files::calibration::{Calibration, Region};
use crate::files::cell::Cell;
use crate::files::settings::{self, Settings};
use crate::kinematics::controller::Controller;
use crate::program::dialect::Dialect;
use crate::report::targets::{FileReport, files};
use crate::rewrite::class::Class;
use crate::rewrite::correct::{Job, Options, correct};
use crate::rewrite::outcome::Outcome;
use crate::rewrite::split::split;

use super::exit::Failure;
use super::job::{self, Loaded};
use super::load;

/// The options that say how programs are corrected. What a `falsetarget.yaml` in the folder of the programs or above
/// says holds where an option is absent.
#[derive(clap::Args, Default)]
pub struct ShopArgs {
    /// Model of the real robot, a robot file, or a built-in robot's name; a falsetarget.yaml may say it instead
    #[arg(long, value_name = "MODEL")]
    model: Option<String>,
    /// Tools, frames and additional axes that the program names but does not hold
    #[arg(long, value_name = "CELL.yaml")]
    cell: Option<PathBuf>,
    /// Take the programs as this language instead of telling it from their content
    #[arg(long, value_name = "NAME", value_parser = load::parse_dialect)]
    dialect: Option<&'static dyn Dialect>,
    /// Correct joint targets too: they are taken to mean the pose that the nominal robot has there
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    joint_targets: Option<bool>,
    /// Write the file although some targets are refused; those stay as they are
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    allow_partial: Option<bool>,
    /// Give a target that is used with several tools, frames or loads one value for each: copies are put behind the
    /// declaration and the moves name them (RAPID), or the moves get the value itself (RAPID arrays, Hyundai P, KRL,
    /// URScript)
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    split_shared: Option<bool>,
    /// Refuse targets outside the joint region that the recordings covered
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    inside_only: Option<bool>,
    /// Believe the units of a program whose numbers look like metres where millimetres belong
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    trust_units: Option<bool>,
}

/// What every program of a run shares.
pub struct Shop {
    pub dialect: Option<&'static dyn Dialect>,
    pub allow_partial: bool,
    split_shared: bool,
    trust_units: bool,
    calibration: Calibration,
    controller: Controller,
    cell: Cell,
    options: Options,
    /// Tells this model, cell and set of options from any other.
    pub fingerprint: [u8; 32],
}

/// A corrected job, not yet written.
pub struct Corrected {
    pub loaded: Loaded,
    pub outcome: Outcome,
}

impl Shop {
    /// Reads model and cell, as the options or the settings above `programs` name them.
    ///
    /// # Errors
    /// [`Failure`] when one of the files is wrong, or no model is named.
    pub fn open(args: &ShopArgs, programs: &Path) -> Result<Self, Failure> {
        let (folder, settings) = settings_above(programs)?;
        let below = |path: &String| folder.join(path);
        let from_settings = settings.model.as_ref().map(|model| match below(model) {
            file if file.exists() => file.display().to_string(),
            _ => model.clone(),
        });
        let Some(model) = args.model.clone().or(from_settings) else {
            let missing = "which robot? --model MODEL, or a falsetarget.yaml beside the programs that names it";
            return Err(Failure::Usage(missing.into()));
        };
        let cell_path = args.cell.clone().or(settings.cell.as_ref().map(below));
        let calibration = load::model(&model)?;
        let flag = |option: Option<bool>, setting: Option<bool>| option.or(setting).unwrap_or_default();
        let inside_only = match flag(args.inside_only, settings.inside_only) {
            true => Some(region(&model, &calibration)?),
            false => None,
        };
        let options = Options { joint_targets: flag(args.joint_targets, settings.joint_targets), inside_only };
        let mut shop = Self {
            dialect: args.dialect,
            allow_partial: flag(args.allow_partial, settings.allow_partial),
            split_shared: flag(args.split_shared, settings.split_shared),
            trust_units: flag(args.trust_units, settings.trust_units),
            controller: Controller::new(&calibration.arm.robot),
            calibration,
            cell: load::cell(cell_path.as_deref())?,
            options,
            fingerprint: [0; 32],
        };
        shop.fingerprint = shop.fingerprint(&model, cell_path.as_deref());
        Ok(shop)
    }

    fn fingerprint(&self, model: &str, cell: Option<&Path>) -> [u8; 32] {
        let content = |path: &Path| std::fs::read(path).ok();
        let mut hash = Sha256::new();
        let mut add = |bytes: &[u8]| {
            hash.update((bytes.len() as u64).to_le_bytes());
            hash.update(bytes);
        };
        add(env!("CARGO_PKG_VERSION").as_bytes());
        add(&content(Path::new(model)).unwrap_or_else(|| model.as_bytes().to_vec()));
        add(&cell.and_then(content).unwrap_or_default());
        let flags = [self.allow_partial, self.split_shared, self.trust_units, self.options.joint_targets];
        add(&flags.map(u8::from));
        add(&[u8::from(self.options.inside_only.is_some())]);
        hash.finalize().into()
    }

    /// Corrects a job; nothing is written.
    ///
    /// # Errors
    /// [`Failure::Program`] when it holds errors, or numbers in another unit.
    pub fn correct(&self, loaded: Loaded) -> Result<Corrected, Failure> {
        let is_own = |finding: &&Diagnostic| finding.place.as_ref().is_none_or(|place| place.file < loaded.own);
        let mut metres = loaded.program.diagnostics.iter().filter(|finding| finding.code == "unit-scale");
        if let Some(finding) = metres.find(is_own).filter(|_| !self.trust_units) {
            let finding = Diagnostic { severity: Severity::Error, ..finding.clone() }
                .help("convert the program to its language's unit; --trust-units takes the numbers as they are");
            return Err(Failure::Program(loaded.sources, vec![finding]));
        }
        let outcome = self.outcome(&loaded);
        if self.split_shared && outcome.targets.iter().any(|target| target.shared) {
            let edits = split(&loaded.sources, &loaded.program, &outcome);
            if !edits.iter().all(EditSet::is_empty) {
                let loaded = with_edits(loaded, &edits)?;
                let outcome = self.outcome(&loaded);
                return Ok(Corrected { loaded, outcome });
            }
        }
        Ok(Corrected { loaded, outcome })
    }

    fn outcome(&self, loaded: &Loaded) -> Outcome {
        let job = Job {
            sources: &loaded.sources,
            program: &loaded.program,
            rules: loaded.dialect.meta().numbers,
            cell: &self.cell,
        };
        correct(&job, &self.calibration.arm, &self.controller, &self.options)
    }
}

/// The settings file in the folder of the programs, or in the nearest folder above, and where it lies.
fn settings_above(programs: &Path) -> Result<(PathBuf, Settings), Failure> {
    let folder = if programs.is_dir() { programs.to_path_buf() } else { job::folder_of(programs) };
    let folder = folder.canonicalize().unwrap_or(folder);
    for folder in folder.ancestors() {
        let path = folder.join(settings::FILE_NAME);
        if path.is_file() {
            return Ok((folder.to_path_buf(), settings::read(&load::source(&path)?)?));
        }
    }
    Ok((folder, Settings::default()))
}

fn region(model: &str, calibration: &Calibration) -> Result<Region, Failure> {
    let missing = || Failure::Usage(format!("--inside-only: {model} names no calibrated region"));
    calibration.region.ok_or_else(missing)
}

/// The job with edits made, read again.
fn with_edits(loaded: Loaded, edits: &[EditSet]) -> Result<Loaded, Failure> {
    let own = apply(&loaded.sources, loaded.own, edits)?;
    let names = loaded.sources.iter().map(|source| source.name().to_string());
    let mut sources: Vec<Source> = names.zip(own).map(|(name, bytes)| Source::new(name, bytes)).collect();
    sources.extend(loaded.sources.into_iter().skip(loaded.own));
    job::read(sources, loaded.own, loaded.dialect)
}

/// The job's own files with edits made.
fn apply(sources: &[Source], own: usize, edits: &[EditSet]) -> Result<Vec<Vec<u8>>, Failure> {
    let files: Result<_, _> =
        sources.iter().zip(edits).take(own).map(|(source, edits)| edits.apply(source.bytes())).collect();
    files.map_err(|error| Failure::Program(sources.to_vec(), vec![Diagnostic::error("edit", error.to_string())]))
}

impl Corrected {
    /// What happened to its targets.
    pub fn reports(&self) -> Vec<FileReport<'_>> {
        files(&self.loaded.sources, self.loaded.dialect, &self.loaded.program, Some(&self.outcome))
    }

    /// The job's own files, corrected. What is known of their targets goes first: for large programs it takes more room.
    ///
    /// # Errors
    /// [`Failure::Program`] when edits overlap.
    pub fn into_files(self) -> Result<Vec<Vec<u8>>, Failure> {
        let (Loaded { sources, own, program, .. }, Outcome { targets, edits }) = (self.loaded, self.outcome);
        drop((program, targets));
        apply(&sources, own, &edits)
    }

    /// Some target has no solution.
    pub fn is_refused(&self) -> bool {
        self.outcome.count(Class::Refused) > 0
    }

    /// The files that come out other than they went in.
    pub fn changed(&self) -> impl Iterator<Item = usize> + '_ {
        self.outcome.edits.iter().enumerate().filter(|(_, edits)| !edits.is_empty()).map(|(file, _)| file)
    }
}

/// True when both names lead to the same existing file or folder.
pub fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

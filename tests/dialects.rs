//! What every robot language owes, tried on every shipped program and on damaged copies of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use falsetarget::base::text::{Source, Span};
use falsetarget::program::dialect::{DIALECTS, Dialect};
use falsetarget::program::number::{NumberField, number_at};
use falsetarget::program::target::{Program, Target, TargetValue};
use proptest::prelude::*;

fn programs_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("programs")
}

/// The folders of a dialect's shipped programs: its own, and one for each program whose language wants a folder.
fn folders(dialect: &dyn Dialect) -> Vec<PathBuf> {
    let folder = programs_folder().join(dialect.meta().id);
    let entries = std::fs::read_dir(&folder).into_iter().flatten().filter_map(Result::ok);
    let mut folders: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(|path| path.is_dir()).collect();
    folders.push(folder);
    folders.sort();
    folders
}

/// The shipped programs of a folder; notes and cell files beside them are none.
fn in_folder(folder: &Path) -> Vec<Source> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
    let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    let is_program = |path: &PathBuf| {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
        path.is_file() && !matches!(ending.as_str(), "md" | "yaml" | "yml")
    };
    let read = |path: PathBuf| Source::new(path.display().to_string(), std::fs::read(&path).unwrap_or_default());
    paths.into_iter().filter(is_program).map(read).collect()
}

/// All shipped programs of a dialect.
fn shipped(dialect: &dyn Dialect) -> Vec<Source> {
    folders(dialect).iter().flat_map(|folder| in_folder(folder)).collect()
}

/// The shipped jobs of a dialect: files that belong together, then those that all share.
fn jobs(dialect: &dyn Dialect) -> Vec<Vec<Source>> {
    let name = |source: &Source| source.name().rsplit(['/', '\\']).next().unwrap_or_default().to_string();
    let is_shared = |source: &Source| dialect.shared_files().contains(&name(source).as_str());
    let in_one = |folder: &PathBuf| {
        let (shared, own): (Vec<Source>, Vec<Source>) = in_folder(folder).into_iter().partition(is_shared);
        let mut jobs: BTreeMap<String, Vec<Source>> = BTreeMap::new();
        for source in own {
            jobs.entry(dialect.job_of(&name(&source))).or_default().push(source);
        }
        jobs.into_values().map(|own| own.into_iter().chain(shared.clone()).collect()).collect::<Vec<Vec<Source>>>()
    };
    folders(dialect).iter().flat_map(in_one).collect()
}

fn fields(target: &Target) -> Vec<&NumberField> {
    match &target.value {
        TargetValue::Cartesian(numbers) => numbers.position.iter().chain(&numbers.orientation).collect(),
        TargetValue::Joint(numbers) => numbers.joints.iter().collect(),
        TargetValue::Displaced(displacement) => displacement.position.iter().collect(),
        TargetValue::Counts | TargetValue::Unwritten => Vec::new(),
    }
}

/// The laws of spans: everything lies inside its file, and what is said to be a number reads as that number.
fn check_spans(sources: &[Source], program: &Program) -> Result<(), String> {
    let mut seen: Vec<(usize, Span)> = Vec::new();
    for (index, target) in program.targets.iter().enumerate() {
        let place = format!("target {index} {:?} at {:?}", target.name, target.span);
        let whole = |file: usize| sources.get(file).map(|source| Span::new(0, source.bytes().len()));
        let Some((source, file)) = sources.get(target.file).zip(whole(target.file)) else {
            return Err(format!("{place}: in no file"));
        };
        if !file.contains(target.span) {
            return Err(format!("{place}: outside of its file"));
        }
        for field in fields(target) {
            if !target.span.contains(field.span()) {
                return Err(format!("{place}: number {:?} outside of it", field.span()));
            }
            if field.column().is_some_and(|column| !file.contains(column) || !column.contains(field.span())) {
                return Err(format!("{place}: number {:?} outside of its column", field.span()));
            }
            if field.insertion.is_some() {
                continue;
            }
            let again = number_at(source.bytes(), field.span().start);
            if again.as_ref().map(|again| (again.value, again.span())) != Some((field.value, field.span())) {
                return Err(format!("{place}: {:?} is not {}", source.text(field.span()), field.value));
            }
            seen.push((target.file, field.span()));
        }
        if let TargetValue::Displaced(displacement) = &target.value {
            let base = program.targets.get(displacement.base).map(|base| &base.value);
            if !matches!(base, Some(TargetValue::Cartesian(_) | TargetValue::Joint(_))) {
                return Err(format!("{place}: displaces nothing"));
            }
        }
        if matches!(target.value, TargetValue::Unwritten) && target.computed.is_none() {
            return Err(format!("{place}: no numbers and no reason"));
        }
        if let Some(used) =
            target.uses.iter().find(|used| !whole(used.file).is_some_and(|file| file.contains(used.span)))
        {
            return Err(format!("{place}: its use at {:?} is outside of the file", used.span));
        }
    }
    seen.sort();
    match seen.windows(2).find(|pair| pair[0].0 == pair[1].0 && pair[0].1.end > pair[1].1.start) {
        Some(pair) => Err(format!("two numbers share bytes: {pair:?}")),
        None => Ok(()),
    }
}

#[test]
fn every_folder_of_programs_belongs_to_a_dialect() {
    let folders = std::fs::read_dir(programs_folder()).expect("the programs");
    for folder in folders.filter_map(Result::ok).filter(|entry| entry.path().is_dir()) {
        let name = folder.file_name().to_string_lossy().into_owned();
        assert!(DIALECTS.iter().any(|dialect| dialect.meta().id == name), "programs/{name} is no dialect");
    }
}

#[test]
fn every_shipped_program_is_recognised_by_its_own_dialect_only() {
    for dialect in DIALECTS {
        for source in shipped(*dialect) {
            let claimed: Vec<_> =
                DIALECTS.iter().filter(|other| other.recognises(&source)).map(|other| other.meta().id).collect();
            assert_eq!(claimed, [dialect.meta().id], "{}", source.name());
        }
    }
}

#[test]
fn every_shipped_program_has_targets_with_true_spans() {
    for dialect in DIALECTS {
        for sources in jobs(*dialect) {
            let program = dialect.read(&sources);
            assert!(program.targets.iter().any(|target| !target.uses.is_empty()), "{}", sources[0].name());
            check_spans(&sources, &program).unwrap_or_else(|law| panic!("{}: {law}", sources[0].name()));
        }
    }
}

/// A piece of a shipped program, small enough to be damaged many times.
fn pieces() -> Vec<Vec<u8>> {
    let mut pieces = Vec::new();
    for dialect in DIALECTS {
        for source in shipped(*dialect) {
            let bytes = source.bytes();
            let middle = bytes.len() / 2;
            pieces.push(bytes[..bytes.len().min(6000)].to_vec());
            pieces.push(bytes[middle..bytes.len().min(middle + 6000)].to_vec());
        }
    }
    pieces
}

fn read_by_all(bytes: Vec<u8>) -> Result<(), TestCaseError> {
    let source = Source::new("damaged", bytes);
    for dialect in DIALECTS {
        let _ = dialect.recognises(&source);
        let _ = dialect.ties(&source);
        let program = dialect.read(std::slice::from_ref(&source));
        check_spans(std::slice::from_ref(&source), &program)
            .map_err(|law| TestCaseError::fail(format!("{}: {law}", dialect.meta().id)))?;
    }
    Ok(())
}

/// Every shipped job of several files.
fn jobs_of_several_files() -> Vec<(&'static dyn Dialect, Vec<Source>)> {
    let all = DIALECTS.iter().flat_map(|dialect| jobs(*dialect).into_iter().map(move |sources| (*dialect, sources)));
    all.filter(|(_, sources)| sources.len() > 1).collect()
}

#[test]
fn some_dialects_ship_jobs_of_several_files() {
    let ids: std::collections::BTreeSet<_> =
        jobs_of_several_files().iter().map(|(dialect, _)| dialect.meta().id).collect();
    assert!(ids.contains("krl") && ids.len() > 1, "{ids:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn random_bytes_are_read_without_harm(bytes in proptest::collection::vec(any::<u8>(), 0..600)) {
        let source = Source::new("random", bytes.clone());
        let claimed = DIALECTS.iter().filter(|dialect| dialect.recognises(&source)).count();
        prop_assert!(claimed <= 1);
        read_by_all(bytes)?;
    }

    #[test]
    fn damaged_programs_are_read_without_harm(
        piece in any::<prop::sample::Index>(),
        start in any::<prop::sample::Index>(),
        length in 0usize..200,
        filling in proptest::collection::vec(any::<u8>(), 0..8),
    ) {
        let pieces = pieces();
        prop_assume!(!pieces.is_empty());
        let mut bytes = pieces[piece.index(pieces.len())].clone();
        let start = start.index(bytes.len());
        let end = (start + length).min(bytes.len());
        bytes.splice(start..end, filling);
        read_by_all(bytes)?;
    }

    #[test]
    fn cut_off_programs_are_read_without_harm(piece in any::<prop::sample::Index>(), end in any::<prop::sample::Index>()) {
        let pieces = pieces();
        prop_assume!(!pieces.is_empty());
        let mut bytes = pieces[piece.index(pieces.len())].clone();
        bytes.truncate(end.index(bytes.len()));
        read_by_all(bytes)?;
    }

    #[test]
    fn a_damaged_file_harms_no_job(
        job in any::<prop::sample::Index>(),
        file in any::<prop::sample::Index>(),
        start in any::<prop::sample::Index>(),
        length in prop_oneof![0usize..200, Just(usize::MAX)],
        filling in proptest::collection::vec(any::<u8>(), 0..8),
    ) {
        let jobs = jobs_of_several_files();
        let (dialect, mut sources) = jobs[job.index(jobs.len())].clone();
        let file = file.index(sources.len());
        let mut bytes = sources[file].bytes().to_vec();
        let start = start.index(bytes.len().max(1)).min(bytes.len());
        bytes.splice(start..start.saturating_add(length).min(bytes.len()), filling);
        sources[file] = Source::new(sources[file].name().to_string(), bytes);
        let program = dialect.read(&sources);
        check_spans(&sources, &program).map_err(|law| TestCaseError::fail(format!("{}: {law}", dialect.meta().id)))?;
    }
}

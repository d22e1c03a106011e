//! `falsetarget inspect`: what targets a program holds.

use std::collections::BTreeSet;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::program::dialect::Dialect;
use crate::report::targets::{TargetsReport, files};

use super::console::Console;
use super::exit::{Exit, Failure};
use super::job::Loaded;
use super::{job, load, output};

/// List every target of a program: where it stands, what it is, which moves use it, and what `correct` could do with it
///
/// No model is needed: the class says what the text alone tells. `corrected` means correctable. Files that belong to
/// a given one (KUKA .dat beside a .src) are read and listed with it.
#[derive(clap::Args)]
pub struct Args {
    /// Take the files as this language instead of telling it from their content
    #[arg(long, value_name = "NAME", value_parser = load::parse_dialect)]
    dialect: Option<&'static dyn Dialect>,
    /// Print JSON (falsetarget/targets/1)
    #[arg(long)]
    json: bool,
    /// Programs; none, or `-`, reads one from standard input
    #[arg(value_name = "PROGRAM")]
    programs: Vec<PathBuf>,
}

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let mut all = Vec::new();
    let standard_input = [PathBuf::from("-")];
    let programs = if args.programs.is_empty() { &standard_input[..] } else { &args.programs };
    let mut read = BTreeSet::new();
    for path in programs {
        let is_standard_input = path.as_os_str() == "-";
        if !is_standard_input && read.contains(path.display().to_string().as_str()) {
            continue;
        }
        let loaded = match is_standard_input {
            true => job::of_standard_input(args.dialect)?,
            false => job::of_file(path, args.dialect)?,
        };
        // A file that came with an earlier one is listed there.
        read.extend(loaded.sources[..loaded.own].iter().map(|source| source.name().to_string()));
        for diagnostic in &loaded.program.diagnostics {
            console.diagnostic(&loaded.sources, diagnostic);
        }
        all.push(loaded);
    }
    let mut reports = Vec::new();
    for Loaded { sources, dialect, program, .. } in &all {
        reports.extend(files(sources, *dialect, program, None));
    }
    let report = TargetsReport::new(reports);
    if args.json {
        output::write_json(Path::new("-"), &report)?;
    } else {
        tables(&report, &mut BufWriter::new(std::io::stdout().lock())).map_err(Failure::Output)?;
    }
    Ok(if report.summary.refused > 0 { Exit::No } else { Exit::Done })
}

fn tables(report: &TargetsReport<'_>, out: &mut impl Write) -> std::io::Result<()> {
    for file in &report.files {
        writeln!(out, "{} ({})", file.path, file.dialect)?;
        for target in file.targets.iter() {
            let name = target.name.as_deref().unwrap_or("-");
            let reason = target.reason.as_deref().map(|reason| format!("  ({reason})")).unwrap_or_default();
            write!(out, "{:>7}  {:<16} {:<9} {:<9}", target.line, name, target.kind, target.class.word())?;
            writeln!(out, " {}{reason}", target.describe())?;
        }
    }
    let summary = &report.summary;
    writeln!(
        out,
        "{} correctable, {} joint, {} computed, {} refused in {} file(s)",
        summary.corrected, summary.joint, summary.computed, summary.refused, summary.files
    )?;
    out.flush()
}

//! A program file: its name, its parameters and local variables, and its code.

use std::collections::HashSet;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::target::Program;

use super::xml::{Part, parts};

/// One program.
#[derive(Clone, Debug)]
pub(super) struct Code {
    /// File of the job.
    pub file: usize,
    /// As it is called.
    pub name: String,
    /// Names of the parameters, and whether each is passed by reference.
    pub parameters: Vec<(String, bool)>,
    /// Names of parameters and local variables: they hide data of the same name.
    pub own_names: HashSet<String>,
    /// The statements.
    pub text: Span,
}

/// Where version 6 declares names, one element each.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    None,
    Parameters,
    Locals,
}

/// Reads the programs of a file; other files give none.
pub(super) fn read(source: &Source, file: usize, program: &mut Program) -> Vec<Code> {
    let bytes = source.bytes();
    let mut found = Vec::new();
    let mut current: Option<Code> = None;
    let mut section = Section::None;
    for part in parts(bytes).0 {
        match part {
            Part::Open(tag) => {
                let name = tag.text(bytes, "name");
                match (&bytes[tag.name.start..tag.name.end], name, &mut current) {
                    (b"paramSection", ..) if !tag.empty => section = Section::Parameters,
                    (b"localSection", ..) if !tag.empty => section = Section::Locals,
                    (b"Program" | b"program", Some(name), _) => {
                        let (parameters, own_names) = (Vec::new(), HashSet::new());
                        current = Some(Code { file, name, parameters, own_names, text: Span::default() });
                    }
                    (b"Parameter", Some(name), Some(code)) => {
                        let by_reference = tag.text(bytes, "use").is_none_or(|how| how == "reference");
                        code.own_names.insert(name.clone());
                        code.parameters.push((name, by_reference));
                    }
                    (b"Local", Some(name), Some(code)) => {
                        code.own_names.insert(name);
                    }
                    (_, Some(name), Some(code)) if section != Section::None => {
                        code.own_names.insert(name.clone());
                        if section == Section::Parameters {
                            code.parameters.push((name, true));
                        }
                    }
                    _ => {}
                }
            }
            Part::Text(text, closed) => {
                if !closed {
                    let end = Span::new(bytes.len(), bytes.len());
                    let message = "the code is not closed: the file may have been cut off";
                    let finding = Diagnostic::error("truncated", message).at(file, end, "the text stops here");
                    program.diagnostics.push(finding);
                }
                found.extend(current.take().map(|code| Code { text, ..code }));
            }
            Part::Close(name) => {
                if matches!(&bytes[name.start..name.end], b"paramSection" | b"localSection") {
                    section = Section::None;
                }
            }
        }
    }
    found
}

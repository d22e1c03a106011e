//! Modules, routines and the names they declare.

use std::collections::HashMap;
use std::ops::Range;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Source;

use super::argument::list;
use super::statement::{FileText, Statement, StatementKind};
use super::token::TokenKind;

/// How a name holds its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// `CONST`: as the text says, always.
    Constant,
    /// `PERS`: as the text says, until a statement changes it; the controller saves it back.
    Persistent,
    /// `VAR`.
    Variable,
    /// A parameter that receives a value.
    Parameter,
    /// A parameter through which the routine can change the caller's variable (`INOUT`, `VAR`, `PERS`).
    Reference,
}

/// Where a statement stands, for looking names up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Scope {
    /// File of the job.
    pub file: usize,
    /// Module of the job; text outside of any module is one too.
    pub module: usize,
    /// Routine of the job.
    pub routine: Option<usize>,
}

/// A declared name.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// As written.
    pub display: String,
    /// Its data type, lower case.
    pub data_type: String,
    /// How it holds its value.
    pub storage: Storage,
    /// Where it is declared.
    pub scope: Scope,
    /// Number of array dimensions; 0 for a single value.
    pub dimensions: usize,
    /// The tokens behind `:=`.
    pub value: Option<Range<usize>>,
    /// Tokens of the whole declaration.
    pub tokens: Range<usize>,
}

/// A declared procedure, function or trap.
#[derive(Clone, Debug)]
pub struct Routine {
    /// Where it is declared; its own index is in `scope.routine`.
    pub scope: Scope,
    /// What a function returns, lower case.
    pub returns: Option<String>,
    /// Its parameters, as symbols.
    pub parameters: Vec<usize>,
    /// Its statements, without its header.
    pub body: Range<usize>,
}

/// All files of a job with everything that they declare.
pub struct Job<'a> {
    /// The files.
    pub files: Vec<FileText<'a>>,
    /// The scope of each statement of each file.
    pub scopes: Vec<Vec<Scope>>,
    /// All declared names.
    pub symbols: Vec<Symbol>,
    /// All routines.
    pub routines: Vec<Routine>,
    names: Names,
    routine_names: Names,
}

/// What looking a name up gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lookup {
    /// This one.
    Found(usize),
    /// Several modules declare it, and none of them is the one that asks.
    Ambiguous,
    /// No file of the job declares it.
    Unknown,
}

#[derive(Default)]
struct Names {
    in_routine: HashMap<usize, HashMap<String, usize>>,
    in_module: HashMap<usize, HashMap<String, usize>>,
    anywhere: HashMap<String, Vec<usize>>,
}

impl Names {
    fn add(&mut self, key: String, index: usize, scope: Scope, local: bool) {
        if let Some(routine) = scope.routine {
            self.in_routine.entry(routine).or_default().entry(key).or_insert(index);
            return;
        }
        self.in_module.entry(scope.module).or_default().entry(key.clone()).or_insert(index);
        if !local {
            self.anywhere.entry(key).or_default().push(index);
        }
    }

    fn keys(&self) -> impl Iterator<Item = &str> {
        self.in_routine.values().chain(self.in_module.values()).flat_map(HashMap::keys).map(String::as_str)
    }

    fn look_up(&self, key: &str, scope: Scope) -> Lookup {
        let in_routine = scope.routine.and_then(|routine| self.in_routine.get(&routine)?.get(key));
        if let Some(&index) = in_routine.or_else(|| self.in_module.get(&scope.module)?.get(key)) {
            return Lookup::Found(index);
        }
        match self.anywhere.get(key).map(Vec::as_slice) {
            Some([index]) => Lookup::Found(*index),
            Some(_) => Lookup::Ambiguous,
            None => Lookup::Unknown,
        }
    }
}

impl<'a> Job<'a> {
    /// Reads the files of a job as far as declarations go.
    pub fn read(sources: &'a [Source], findings: &mut Vec<Diagnostic>) -> Self {
        let files: Vec<_> =
            sources.iter().enumerate().map(|(index, source)| FileText::read(source, index, findings)).collect();
        let mut job = Self {
            files,
            scopes: Vec::new(),
            symbols: Vec::new(),
            routines: Vec::new(),
            names: Names::default(),
            routine_names: Names::default(),
        };
        let mut modules = 0;
        for file in 0..job.files.len() {
            job.declare_file(file, &mut modules);
        }
        job
    }

    /// Every declared name, global or not.
    pub fn declared_names(&self) -> impl Iterator<Item = &str> {
        self.names.keys().chain(self.routine_names.keys())
    }

    /// The names that other modules of the task see, with the data type of a variable.
    pub fn global_names(&self) -> impl Iterator<Item = (&str, &str)> {
        let variables = self.names.anywhere.iter().flat_map(|(name, all)| all.iter().map(move |index| (name, index)));
        let variables = variables.map(|(name, index)| (name.as_str(), self.symbols[*index].data_type.as_str()));
        variables.chain(self.routine_names.anywhere.keys().map(|name| (name.as_str(), "")))
    }

    /// Looks up a variable.
    pub fn symbol(&self, key: &str, scope: Scope) -> Lookup {
        self.names.look_up(key, scope)
    }

    /// Looks up a variable, with several candidates being none.
    pub fn known_symbol(&self, key: &str, scope: Scope) -> Option<&Symbol> {
        match self.symbol(key, scope) {
            Lookup::Found(index) => Some(&self.symbols[index]),
            _ => None,
        }
    }

    /// Looks up a routine.
    pub fn routine(&self, key: &str, scope: Scope) -> Option<usize> {
        match self.routine_names.look_up(key, Scope { routine: None, ..scope }) {
            Lookup::Found(index) => Some(index),
            _ => None,
        }
    }

    /// The elements of a symbol's value with their index as written: `{2}`, `{1,2}`, or nothing for a single value.
    pub fn elements(&self, symbol: usize) -> Vec<(String, Range<usize>)> {
        let symbol = &self.symbols[symbol];
        let Some(value) = symbol.value.clone() else { return Vec::new() };
        if symbol.dimensions == 0 {
            return vec![(String::new(), value)];
        }
        let text = &self.files[symbol.scope.file];
        let mut level = vec![(String::new(), value)];
        // RAPID knows at most three dimensions.
        for _ in 0..symbol.dimensions.min(3) {
            let inner = level.iter().flat_map(|(index, range)| {
                let elements = list(text, range).unwrap_or_default();
                let numbered = elements.into_iter().enumerate();
                numbered.map(move |(at, element)| (format!("{index},{}", at + 1), element)).collect::<Vec<_>>()
            });
            level = inner.collect();
        }
        level.into_iter().map(|(index, range)| (format!("{{{}}}", index.trim_start_matches(',')), range)).collect()
    }

    fn declare_file(&mut self, file: usize, modules: &mut usize) {
        let statements = std::mem::take(&mut self.files[file].statements);
        let outside = *modules;
        *modules += 1;
        let mut scope = Scope { file, module: outside, routine: None };
        let mut in_record = false;
        let mut scopes = Vec::with_capacity(statements.len());
        for (index, statement) in statements.iter().enumerate() {
            match statement.kind {
                StatementKind::Module => {
                    scope = Scope { file, module: *modules, routine: None };
                    *modules += 1;
                }
                StatementKind::Routine => {
                    scope.routine = None;
                    scope.routine = Some(self.declare_routine(statement, scope, index));
                }
                StatementKind::Record => in_record = true,
                StatementKind::EndRecord => in_record = false,
                StatementKind::Declaration if !in_record => self.declare(statement, scope),
                _ => {}
            }
            scopes.push(scope);
            match statement.kind {
                StatementKind::EndModule => scope = Scope { file, module: outside, routine: None },
                StatementKind::EndRoutine => scope.routine = None,
                _ => {}
            }
            if let Some(routine) = scope.routine {
                self.routines[routine].body.end = index + 1;
            }
        }
        self.files[file].statements = statements;
        self.scopes.push(scopes);
    }

    fn declare_routine(&mut self, statement: &Statement, scope: Scope, index: usize) -> usize {
        let text = &self.files[scope.file];
        let first = statement.tokens.start;
        let local = text.is_word(first, &["LOCAL"]);
        let word = first + usize::from(text.is_word(first, &["LOCAL", "TASK"]));
        let function = text.is_word(word, &["FUNC"]);
        let name = word + 1 + usize::from(function);
        let routine = self.routines.len();
        let inner = Scope { routine: Some(routine), ..scope };
        self.routine_names.add(text.key(name), routine, scope, local);
        let mut entry = Routine {
            scope: inner,
            returns: function.then(|| text.key(word + 1)),
            parameters: Vec::new(),
            body: index + 1..index + 1,
        };
        let mut from = name + 2;
        for at in name + 2..statement.tokens.end {
            let separator = matches!(text.kind(at), Some(TokenKind::Symbol(b',' | b'\\' | b'|' | b')')));
            if separator {
                if from < at {
                    let symbol = parameter(text, from..at, inner);
                    entry.parameters.push(self.symbols.len());
                    self.names.add(symbol.display.to_lowercase(), self.symbols.len(), inner, true);
                    self.symbols.push(symbol);
                }
                from = at + 1;
            }
        }
        self.routines.push(entry);
        routine
    }

    fn declare(&mut self, statement: &Statement, scope: Scope) {
        let text = &self.files[scope.file];
        let Range { start, end } = statement.tokens;
        let local = text.is_word(start, &["LOCAL"]);
        let word = start + usize::from(text.is_word(start, &["LOCAL", "TASK"]));
        let storage = match text.word(word).to_ascii_uppercase().as_slice() {
            b"CONST" => Storage::Constant,
            b"PERS" => Storage::Persistent,
            _ => Storage::Variable,
        };
        let name = word + 2;
        if name >= end || text.kind(name) != Some(TokenKind::Name) {
            return;
        }
        let assign = (name..end).find(|&at| text.kind(at) == Some(TokenKind::Assign));
        let head = name..assign.unwrap_or(end);
        let mut display = text.display(name).into_owned();
        // Off-line programming tools write names such as `Gripper(Closed)`, which controllers refuse.
        if text.is_symbol(name + 1, b'(') {
            display = text.source.text(text.span(&head)).into_owned();
        }
        let dimensions = match (name + 1..head.end).find(|&at| text.is_symbol(at, b'{')) {
            Some(open) => 1 + (open..head.end).filter(|&at| text.is_symbol(at, b',')).count(),
            None => 0,
        };
        let symbol = Symbol {
            data_type: text.key(word + 1),
            storage,
            scope,
            dimensions,
            value: assign.map(|at| at + 1..end),
            tokens: statement.tokens.clone(),
            display,
        };
        self.names.add(symbol.display.to_lowercase(), self.symbols.len(), scope, local);
        self.symbols.push(symbol);
    }
}

fn parameter(text: &FileText, tokens: Range<usize>, scope: Scope) -> Symbol {
    let last_name = tokens.clone().rev().find(|&at| text.kind(at) == Some(TokenKind::Name)).unwrap_or(tokens.start);
    let by_reference = text.is_word(tokens.start, &["INOUT", "VAR", "PERS"]);
    Symbol {
        display: text.display(last_name).into_owned(),
        data_type: if last_name > tokens.start { text.key(last_name - 1) } else { String::new() },
        storage: if by_reference { Storage::Reference } else { Storage::Parameter },
        scope,
        dimensions: usize::from(text.is_symbol(last_name + 1, b'{')),
        value: None,
        tokens,
    }
}

//! The files of a job as statements that belong to routines.

use std::collections::HashMap;

use crate::base::text::{Source, Span};
use crate::program::flow::Step;
use crate::program::scan::Cursor;

use super::reference::reference;
use super::statement::{first_word, key, name, split_at_commas, statements};

/// What a statement is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `PTP`, `LIN`, `SPL_REL` and the like.
    Motion,
    /// `SPLINE`, `PTP_SPLINE`.
    SplineBegin,
    /// `ENDSPLINE`.
    SplineEnd,
    /// `DECL E6POS XP1={..}`, `INT n`.
    Declaration,
    /// `XP1.Z=5`
    Assignment,
    /// `name(..)`
    Call,
    /// A step of the program's order, by its word.
    Control,
    /// Anything else.
    Other,
}

/// One statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Statement {
    /// File of the job.
    pub file: usize,
    /// Its text.
    pub span: Span,
    /// What it is.
    pub kind: Kind,
}

/// A routine, or what stands in a file outside of any: data lists, snippets.
#[derive(Clone, Debug)]
pub(super) struct Routine {
    /// Its file.
    pub file: usize,
    /// Its name in lower case.
    pub name: Option<String>,
    /// Names of its parameters, and whether it cannot change what it is handed.
    pub parameters: Vec<(String, bool)>,
    /// Its statements.
    pub statements: Vec<Statement>,
    /// It is the data list of a `DEFDAT`: nothing in it runs.
    pub is_data: bool,
}

/// All files of a job.
pub(super) struct Job<'a> {
    /// The files.
    pub sources: &'a [Source],
    /// The module of each file: files of one name (`.src` and `.dat`) share their data.
    pub modules: Vec<usize>,
    /// The files of the system, `$config.dat` and the like: their data are global.
    pub is_global: Vec<bool>,
    /// All routines.
    pub routines: Vec<Routine>,
    /// Routines by name.
    by_name: HashMap<String, usize>,
    /// Directions of the parameters of routines that are declared with `EXT`.
    pub externals: HashMap<String, Vec<bool>>,
    /// A routine or data list that is not closed: file and its first statement.
    pub open_ends: Vec<(usize, Span)>,
}

impl<'a> Job<'a> {
    /// Reads statements and routines.
    pub fn read(sources: &'a [Source]) -> Self {
        let stems: Vec<String> = sources.iter().map(|source| stem(source.name())).collect();
        let module = |stem: &String| stems.iter().position(|other| other == stem).unwrap_or_default();
        let mut job = Self {
            sources,
            modules: stems.iter().map(module).collect(),
            is_global: stems.iter().map(|stem| stem.starts_with('$')).collect(),
            routines: Vec::new(),
            by_name: HashMap::new(),
            externals: HashMap::new(),
            open_ends: Vec::new(),
        };
        for file in 0..sources.len() {
            job.read_file(file);
        }
        for (index, routine) in job.routines.iter().enumerate() {
            if let Some(name) = &routine.name {
                job.by_name.entry(name.clone()).or_insert(index);
            }
        }
        job
    }

    /// The bytes of a file.
    pub fn bytes(&self, file: usize) -> &'a [u8] {
        self.sources[file].bytes()
    }

    /// The routine of this name.
    pub fn routine(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    fn read_file(&mut self, file: usize) {
        let source = &self.sources[file];
        let bytes = source.bytes();
        let outside = |is_data| Routine { file, name: None, parameters: Vec::new(), statements: Vec::new(), is_data };
        let mut current = outside(false);
        let mut opened: Option<Span> = None;
        for span in statements(source) {
            let (word, rest) = first_word(bytes, span);
            let (word, rest) = if word == "global" { first_word(bytes, rest) } else { (word, rest) };
            let next = match word.as_str() {
                "def" | "deffct" if !rest.is_empty() => {
                    let (name, parameters) = header(bytes, rest, word == "deffct");
                    opened = Some(span);
                    Some(Routine { name: Some(name), parameters, ..outside(false) })
                }
                "defdat" => {
                    opened = Some(span);
                    Some(outside(true))
                }
                "end" | "endfct" | "enddat" => {
                    opened = None;
                    Some(outside(false))
                }
                "ext" | "extfct" | "extfctp" => {
                    let (name, parameters) = header(bytes, rest, word != "ext");
                    self.externals.insert(name, parameters.into_iter().map(|(_, only_in)| only_in).collect());
                    None
                }
                _ => {
                    current.statements.push(Statement { file, span, kind: kind(bytes, span, &word) });
                    None
                }
            };
            if let Some(next) = next {
                self.routines.push(std::mem::replace(&mut current, next));
            }
        }
        self.routines.push(current);
        self.open_ends.extend(opened.map(|span| (file, span)));
    }
}

/// The name of a file without folder and ending, in lower case.
fn stem(path: &str) -> String {
    let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
    file.rsplit_once('.').map_or(file, |(stem, _)| stem).to_lowercase()
}

/// `BOOL name (a :IN, b :OUT)`: the name and its parameters.
fn header(bytes: &[u8], rest: Span, has_type: bool) -> (String, Vec<(String, bool)>) {
    let mut cursor = Cursor::new(bytes, rest);
    let mut own = name(&mut cursor);
    if has_type {
        if cursor.eat(b'[') {
            cursor.skip_while(|byte| byte != b']');
            cursor.eat(b']');
        }
        cursor.skip_blanks();
        own = name(&mut cursor).or(own);
    }
    cursor.skip_blanks();
    let mut parameters = Vec::new();
    if cursor.eat(b'(') {
        let end = cursor.rest().iter().rposition(|&byte| byte == b')').unwrap_or(cursor.rest().len());
        for part in split_at_commas(bytes, Span::new(cursor.offset(), cursor.offset() + end)) {
            let mut inside = Cursor::new(bytes, part);
            let Some(parameter) = name(&mut inside) else { continue };
            let direction = inside.rest().rsplit(|&byte| byte == b':').next().unwrap_or_default().trim_ascii();
            parameters.push((key(bytes, parameter), direction.eq_ignore_ascii_case(b"in")));
        }
    }
    (own.map(|span| key(bytes, span)).unwrap_or_default(), parameters)
}

fn kind(bytes: &[u8], span: Span, word: &str) -> Kind {
    match word {
        "ptp" | "lin" | "circ" | "sptp" | "slin" | "scirc" | "spl" | "ptp_rel" | "lin_rel" | "circ_rel"
        | "sptp_rel" | "slin_rel" | "scirc_rel" | "spl_rel" => Kind::Motion,
        "spline" | "ptp_spline" => Kind::SplineBegin,
        "endspline" => Kind::SplineEnd,
        "if" | "else" | "endif" | "switch" | "case" | "default" | "endswitch" | "for" | "endfor" | "while"
        | "endwhile" | "repeat" | "until" | "loop" | "endloop" | "goto" | "exit" | "return" | "resume" => Kind::Control,
        "decl" => Kind::Declaration,
        "struc" | "enum" | "signal" | "interrupt" | "trigger" | "wait" | "halt" | "continue" | "brake" | "asyptp"
        | "cirp" | "import" | "channel" | "pulse" | "anout" | "anin" | "digin" | "confirm" | "const_vel"
        | "time_block" | "stop" | "const" => Kind::Other,
        _ => by_shape(bytes, span),
    }
}

/// Statements that begin with a name of the program's own.
fn by_shape(bytes: &[u8], span: Span) -> Kind {
    let mut cursor = Cursor::new(bytes, span);
    if super::statement::first_word(bytes, span).0 == "global" {
        return Kind::Declaration;
    }
    if reference(bytes, &mut cursor).is_none() {
        return Kind::Other;
    }
    cursor.skip_blanks();
    match cursor.bump() {
        Some(b'=') => Kind::Assignment,
        Some(b'(') => Kind::Call,
        // A label.
        Some(b':') if cursor.at_end() => Kind::Control,
        Some(byte) if super::statement::is_name_byte(byte) && !byte.is_ascii_digit() => Kind::Declaration,
        _ => Kind::Other,
    }
}

/// What a control statement does to the order of the program.
pub(super) fn control_step<const N: usize>(bytes: &[u8], span: Span) -> Step<N> {
    match first_word(bytes, span).0.as_str() {
        "if" => Step::If,
        "switch" => Step::Switch,
        "case" => Step::Branch,
        "else" | "default" => Step::Else,
        "endif" | "endswitch" => Step::EndBranches,
        "for" | "while" | "repeat" | "loop" => Step::Loop,
        "endfor" | "endwhile" | "until" | "endloop" => Step::EndLoop,
        "goto" => Step::Jump,
        "exit" => Step::LeaveLoop,
        "return" | "resume" => Step::Return,
        _ => Step::Label,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn routines_and_data_lists() {
        let text = "&ACCESS RVP\nDEF main( )\nINT n\nPTP XP1\nfoo (XP1, 2)\nEND\nGLOBAL DEFFCT REAL[3] f (a:IN,b)\nRETURN\nENDFCT\n";
        let sources = [
            Source::new("x/Main.src", text),
            Source::new("x/main.dat", "DEFDAT MAIN PUBLIC\nEXT BAS (BAS_COMMAND :IN,REAL :IN)\nDECL E6POS XP1={X 1}\n"),
        ];
        let job = Job::read(&sources);
        assert_eq!(job.modules, [0, 0]);
        let main = &job.routines[job.routine("main").expect("main")];
        let kinds: Vec<Kind> = main.statements.iter().map(|statement| statement.kind).collect();
        assert_eq!(kinds, [Kind::Declaration, Kind::Motion, Kind::Call]);
        let function = &job.routines[job.routine("f").expect("f")];
        assert_eq!(function.parameters, [("a".to_string(), true), ("b".to_string(), false)]);
        assert_eq!(job.externals["bas"], [true, true]);
        assert!(job.routines.iter().any(|routine| routine.is_data && routine.statements.len() == 1));
        assert_eq!(job.open_ends.len(), 1);
    }
}

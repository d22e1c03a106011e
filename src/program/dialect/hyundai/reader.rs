//! The whole job: statements sorted into motions, variables, definitions and selections; then every motion gets its
//! target.

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::number::starts_with_word;
use crate::program::scan::Cursor;
use crate::program::selection::Selections;
use crate::program::target::Program;

use super::arc::pair_up;
use super::checks;
use super::definition::{Definitions, Place};
use super::expression::name;
use super::header::{Header, header};
use super::motion::{Motion, motion};
use super::resolve::Resolver;
use super::selection::{Ways, selected};
use super::statement::{Statement, statements};
use super::variable::{Variables, assignment, only_reads};

/// What one file holds besides variables and definitions.
pub(super) struct JobFile {
    /// Its first line.
    pub header: Header,
    /// Its motions in the order of the text.
    pub motions: Vec<(Statement, Motion)>,
    /// `SELUCRD`.
    pub user_frames: Selections,
    /// `seltool n,robot`.
    pub tools: Selections,
    /// Where ways of the program meet, by offset.
    pub joins: Vec<usize>,
    /// It has an `END`.
    pub ends: bool,
    /// Its last statement.
    pub last_statement: Span,
}

/// What all files of a job share.
#[derive(Default)]
struct Shared {
    variables: Variables,
    definitions: Definitions,
    /// Statements that may change the variables which they mention.
    mentions: Vec<Place>,
}

/// Reads the files of one job.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    let mut shared = Shared::default();
    let mut files: Vec<JobFile> =
        sources.iter().enumerate().map(|(index, source)| read_file(index, source, &mut shared)).collect();
    for place in &shared.mentions {
        shared.variables.touch(sources[place.file].bytes(), place);
    }
    for place in &shared.definitions.unnumbered {
        let message = "the number of the tool or frame that is set here is known only at run time";
        program.diagnostics.push(Diagnostic::warning("runtime-definition", message).at(place.file, place.span, ""));
    }
    shared.definitions.finish(&shared.variables, &mut program);
    let mut resolver = Resolver::new(&shared.variables);
    for (index, (file, source)) in files.iter_mut().zip(sources).enumerate() {
        pair_up(
            &mut file.motions.iter_mut().map(|(_, motion)| (motion.word.clone(), &mut motion.path)).collect::<Vec<_>>(),
        );
        resolver.add_file(index, source, file);
        checks::end(index, source, file, &mut program.diagnostics);
    }
    resolver.finish(&mut program);
    for index in 0..files.len() {
        checks::targets(index, &mut program);
    }
    program
}

fn read_file(index: usize, source: &Source, shared: &mut Shared) -> JobFile {
    let bytes = source.bytes();
    let mut file = JobFile {
        header: header(source),
        motions: Vec::new(),
        user_frames: Selections::default(),
        tools: Selections::default(),
        joins: Vec::new(),
        ends: false,
        last_statement: Span::default(),
    };
    let mut ways = Ways::default();
    for statement in statements(source, &file.header) {
        let Statement { span, body, .. } = statement;
        let text = &bytes[body.start..body.end];
        let place = Place { file: index, span, line: source.line(span.start) };
        file.last_statement = span;
        ways.note(bytes, &statement);
        if let Some(motion) = motion(bytes, body, file.header.total_axes) {
            file.motions.push((statement, motion));
            continue;
        }
        file.ends |= starts_with_word(text, "END");
        if let Some(assigned) = assignment(bytes, body) {
            if !shared.definitions.assign(bytes, place, &assigned) {
                shared.variables.assign(bytes, place, &assigned, file.header.total_axes);
            }
        } else if !shared.definitions.mkucrd(bytes, place, body) && !select(bytes, body, &mut file) {
            if starts_with_word(text, "global") {
                declare_globals(bytes, index, body, &mut shared.variables);
            } else if !only_reads(bytes, body) {
                shared.mentions.push(Place { span: body, ..place });
            }
        }
    }
    file.joins = ways.finish();
    file
}

/// Takes `SELUCRD n` and `SELTOOL n,robot`; false for other statements.
fn select(bytes: &[u8], body: Span, file: &mut JobFile) -> bool {
    let mut cursor = Cursor::new(bytes, body);
    let offset = body.start;
    if cursor.eat_word("SELUCRD") {
        file.user_frames.push(offset, selected(&String::from_utf8_lossy(cursor.rest())));
        return true;
    }
    if !cursor.eat_word("SELTOOL") {
        return false;
    }
    let text = String::from_utf8_lossy(cursor.rest());
    let (number, kind) = text.split_once(',').unwrap_or((&text, "robot"));
    if kind.trim().eq_ignore_ascii_case("robot") {
        file.tools.push(offset, selected(number));
    }
    true
}

fn declare_globals(bytes: &[u8], file: usize, body: Span, variables: &mut Variables) {
    let mut cursor = Cursor::new(bytes, body);
    cursor.name();
    loop {
        cursor.skip_blanks();
        let Some(declared) = name(&mut cursor) else { return };
        variables.declare_global(file, &declared.key);
        cursor.skip_blanks();
        if !cursor.eat(b',') {
            return;
        }
    }
}

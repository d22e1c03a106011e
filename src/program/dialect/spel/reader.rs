//! All files of a project: points become targets, motions their uses.

use std::collections::HashMap;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::flow::{Step, follow, left_over};
use crate::program::gather::{Gathered, plain};
use crate::program::scan::Cursor;
use crate::program::target::{Program, Reference, Target, Use, Way};

use super::expression::{Goal, bracket, goal, point_number};
use super::motion::{Motion, motion};
use super::points::{self, Point, Points};
use super::setting::{Definitions, Setting, setting};
use super::statement::{Part, functions, parts, words};

/// Reads the files of a folder.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    let mut points = Points::default();
    let mut routines = Vec::new();
    for (file, source) in sources.iter().enumerate() {
        if points::is_point_file(source) {
            points::read(source, file, &mut points, &mut program);
            continue;
        }
        points.macros.read(source);
        let found = functions(source);
        if let Some(span) = found.open {
            let end = Span::new(source.bytes().len(), source.bytes().len());
            let message = format!("`{}` has no Fend: the file may have been cut off", source.text(span));
            program.diagnostics.push(Diagnostic::error("truncated", message).at(file, end, "the text stops here"));
        }
        routines.extend(found.all.into_iter().map(|function| (file, function)));
    }
    let names: HashMap<&str, usize> =
        routines.iter().enumerate().map(|(index, (_, function))| (function.name.as_str(), index)).collect();
    let mut job = Job::new(sources, &points);
    let mut steps = Vec::with_capacity(routines.len());
    for (routine, (file, function)) in routines.iter().enumerate() {
        steps.push(job.routine(routine, *file, &function.statements, &names));
    }
    let states = follow(&steps);
    let changes = job.changes();
    let Job { motions, definitions, unknown, selections, .. } = job;
    definitions.finish(&mut program);
    let before = left_over(&selections, Reference::Unnamed, "tool");
    let mut reader = Reader { points: &points, changes, targets: Gathered::default(), indexed: None };
    for one in motions {
        let tool = match states[one.routine].get(one.step).map(|state| state.get(0)) {
            None | Some(Reference::Unnamed) => before.clone(),
            Some(selected) => selected.clone(),
        };
        reader.motion(&sources[one.file], one, &tool, unknown.as_ref());
    }
    reader.finish(&mut program);
    program
}

/// A motion with its place.
struct Placed {
    routine: usize,
    step: usize,
    file: usize,
    span: Span,
    motion: Motion,
}

/// What a statement does to a point.
struct Change {
    reason: String,
    /// The value, where it is written out.
    literal: Option<Point>,
    count: usize,
}

/// What is collected from the programs.
struct Job<'a> {
    sources: &'a [Source],
    points: &'a Points,
    motions: Vec<Placed>,
    definitions: Definitions,
    /// Why nothing is known of any frame.
    unknown: Option<String>,
    selections: Vec<Reference>,
    set: HashMap<u32, Change>,
    /// Points of which a local or pallet is made.
    pinned: HashMap<u32, String>,
    any_set: Option<String>,
}

/// Why points are not what the file says, or what they are instead.
struct Changes {
    set: HashMap<u32, Change>,
    pinned: HashMap<u32, String>,
    any_set: Option<String>,
}

impl<'a> Job<'a> {
    fn new(sources: &'a [Source], points: &'a Points) -> Self {
        Self {
            sources,
            points,
            motions: Vec::new(),
            definitions: Definitions::default(),
            unknown: None,
            selections: Vec::new(),
            set: HashMap::new(),
            pinned: HashMap::new(),
            any_set: None,
        }
    }

    fn changes(&mut self) -> Changes {
        Changes {
            set: std::mem::take(&mut self.set),
            pinned: std::mem::take(&mut self.pinned),
            any_set: self.any_set.take(),
        }
    }

    fn routine(
        &mut self,
        routine: usize,
        file: usize,
        statements: &[Span],
        names: &HashMap<&str, usize>,
    ) -> Vec<Step<1>> {
        let source = &self.sources[file];
        let mut steps = Vec::new();
        for part in statements.iter().flat_map(|statement| parts(source.bytes(), *statement)) {
            let span = match part {
                Part::Flow(step) => {
                    steps.push(step);
                    continue;
                }
                Part::Plain(span) => span,
            };
            if let Some(motion) = motion(source, file, span, self.points) {
                self.motions.push(Placed { routine, step: steps.len(), file, span, motion });
                steps.push(Step::Plain);
            } else if let Some(set) = setting(source, span, &self.points.macros) {
                self.definitions.add(file, span, &set);
                self.pin(source, span);
                match set {
                    Setting::Select(selected) => {
                        self.selections.push(selected.clone());
                        steps.push(Step::Sets(vec![(0, selected)]));
                    }
                    Setting::Unknown(reason) => self.unknown = Some(reason),
                    Setting::Tool(..) | Setting::Local(..) => {}
                }
            } else {
                self.assignment(source, file, span);
                let text = source.slice(span);
                for (_, word) in words(text) {
                    let name = String::from_utf8_lossy(word).to_lowercase();
                    if let Some(&callee) = names.get(name.as_str()) {
                        steps.push(Step::Calls(callee));
                    }
                }
            }
        }
        steps
    }

    /// Points that `Local`, `TLSet` or `Pallet` name.
    fn pin(&mut self, source: &Source, span: Span) {
        let line = source.line(span.start);
        for (_, word) in words(source.slice(span)).skip(1) {
            if let Some(number) = point_number(word, self.points) {
                let reason = format!("line {line} makes a frame of it: a correction would move that frame");
                self.pinned.entry(number).or_insert(reason);
            }
        }
    }

    /// `P3 = ..`, `pick = ..`, `P(i) = ..`, `Teach P3`.
    fn assignment(&mut self, source: &Source, file: usize, span: Span) {
        let mut cursor = Cursor::new(source.bytes(), span);
        let Some(name) = cursor.name() else { return };
        let line = source.line(span.start);
        cursor.skip_blanks();
        let word = source.slice(name);
        if word.eq_ignore_ascii_case(b"Pallet") {
            return self.pin(source, span);
        }
        let indexed = word.eq_ignore_ascii_case(b"P") && cursor.peek() == Some(b'(');
        let number = if indexed {
            let inside = bracket(&mut cursor);
            let index = inside.map(|inside| source.text(inside).trim().to_lowercase());
            index.and_then(|index| self.points.macros.meaning(&index).parse().ok())
        } else {
            point_number(word, self.points)
        };
        cursor.skip_blanks();
        if !cursor.eat(b'=') {
            return;
        }
        match number {
            None if indexed => self.any_set = Some(format!("line {line} sets a point by index")),
            None => {}
            Some(number) => {
                let literal = match goal(&mut cursor, source, file, self.points).0 {
                    Goal::Literal(point) => Some(*point),
                    _ => None,
                };
                let reason = format!("`{}` is set at run time in line {line}", source.text(name));
                self.set.entry(number).and_modify(|change| change.count += 1).or_insert(Change {
                    reason,
                    literal,
                    count: 1,
                });
            }
        }
    }
}

struct Reader<'a> {
    points: &'a Points,
    changes: Changes,
    targets: Gathered,
    /// The first motion to `P(i)`.
    indexed: Option<Use>,
}

impl Reader<'_> {
    fn motion(&mut self, source: &Source, placed: Placed, tool: &Reference, unknown: Option<&String>) {
        for (goal, span, path) in placed.motion.goals {
            let mut one = Use::new(
                placed.file,
                placed.span,
                Way {
                    motion: placed.motion.word.as_str().into(),
                    path,
                    tool: tool.clone(),
                    frame: Reference::Unnamed,
                    grip_load: Reference::Unnamed,
                    computed: placed.motion.computed.clone().or_else(|| unknown.cloned()),
                },
            );
            match goal {
                Goal::Point(number, changed) => {
                    one.computed = one.computed.take().or(changed);
                    self.use_point(number, source, span, one);
                }
                Goal::Literal(point) => {
                    let target = self.targets.inline(of_point(&point, None, None));
                    one.frame = frame(&point);
                    target.add_use(one);
                }
                Goal::Indexed => {
                    self.indexed.get_or_insert_with(|| one.clone());
                    let reason = "which point is meant is known only at run time".to_owned();
                    self.targets.unwritten(&source.text(span), span, reason, one);
                }
                Goal::Runtime(reason) => self.targets.unwritten(&source.text(span), span, reason, one),
            }
        }
    }

    fn use_point(&mut self, number: u32, source: &Source, span: Span, mut one: Use) {
        let change = self.changes.set.get(&number);
        let constant = change.filter(|change| change.count == 1).and_then(|change| change.literal.as_ref());
        let Some(point) = constant.or_else(|| self.points.all.get(&number)) else {
            let reason = change.map_or("no point file of the job holds it".to_owned(), |change| change.reason.clone());
            return self.targets.unwritten(&source.text(span), span, reason, one);
        };
        let changed = change.filter(|_| constant.is_none()).map(|change| &change.reason);
        let kept = changed.or_else(|| self.changes.pinned.get(&number)).or(self.changes.any_set.as_ref()).cloned();
        one.frame = frame(point);
        let name = match point.shown.is_empty() {
            true => format!("P{number}"),
            false => point.shown.clone(),
        };
        self.targets.add_use(number as usize, one, || of_point(point, kept, Some(name)));
    }

    fn finish(mut self, program: &mut Program) {
        if let Some(one) = self.indexed.take() {
            // Any taught point that no motion names may be the one that is meant.
            let mut open: Vec<u32> = self
                .points
                .all
                .iter()
                .filter(|(_, point)| point.computed.is_none())
                .map(|(number, _)| *number)
                .collect();
            open.sort_unstable();
            for number in open.into_iter().filter(|number| !self.targets.has(*number as usize)).collect::<Vec<_>>() {
                let point = &self.points.all[&number];
                let used = one.clone().in_frame(frame(point));
                let change = self.changes.set.get(&number).map(|change| change.reason.clone());
                let kept =
                    change.or_else(|| self.changes.pinned.get(&number).cloned()).or(self.changes.any_set.clone());
                self.targets.add_use(number as usize, used, || of_point(point, kept, Some(point.shown.clone())));
            }
        }
        self.targets.finish(program);
    }
}

fn frame(point: &Point) -> Reference {
    Reference::Named(point.local.to_string().into())
}

fn of_point(point: &Point, kept: Option<String>, name: Option<String>) -> Target {
    Target {
        name,
        computed: point.computed.clone().or(kept),
        configuration: point.configuration.clone().into_shared(),
        external_axes: point.external_axes.clone(),
        ..plain(point.file, point.span, point.value.clone())
    }
}

//! All files of a job: locations become targets, motions their uses.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::pose::Pose;
use crate::program::gather::Gathered;
use crate::program::target::{DisplacementKind, PathKind, Program, Reference, TargetValue, Use, Way};

use super::assignment::{Placed, apply};
use super::expression::{Expression, Name, Term, trans};
use super::motion::{Goal, Motion};
use super::section::{Body, sections};
use super::selection::{InForceAt, Setting, define_system, frame};
use super::statement::{Statement, statements as statements_of, system_data};
use super::target::{Displaced, of_value, three};
use super::value::{Found, Scope, Value, Values, literal, literal_numbers};

/// The work piece coordinates of block steps that are the base's own.
const NO_WORK: &str = "0";

/// Reads the files. Variables belong to all of them, as they do on a controller.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    let mut values = Values::default();
    let mut bodies: Vec<Vec<Body>> = Vec::new();
    let mut statements: Vec<Placed> = Vec::new();
    for (file, source) in sources.iter().enumerate() {
        let found = sections(source);
        if let Some(span) = found.open {
            let end = Span::new(source.bytes().len(), source.bytes().len());
            let message = format!("`{}` has no .END: the file may have been cut off", source.text(span));
            program.diagnostics.push(Diagnostic::error("truncated", message).at(file, end, "the text stops here"));
        }
        for line in &found.locations {
            values.read_line(source, file, *line, &mut program);
        }
        for line in &found.system {
            if let Some((word, numbers)) = system_data(source.bytes(), *line) {
                define_system(file, *line, &word, &numbers, &mut program);
            }
        }
        for (place, body) in found.programs.iter().enumerate() {
            for &span in &body.lines {
                let placed = |statement| Placed { scope: (file, place), span, statement };
                statements.extend(statements_of(source.bytes(), span).map(placed));
            }
        }
        bodies.push(found.programs);
    }
    frame(&mut program, 0, Span::default(), NO_WORK, Pose::identity());
    let kept = apply(sources, &bodies, &statements, &mut values);
    let mut reader =
        Reader { sources, values: &values, kept: &kept, reached: HashSet::new(), targets: Gathered::default() };
    reader.reached = reader.reached(&statements);
    let settings = InForceAt::of(sources, &bodies, &statements, &values, &mut program);
    reader.all(&statements, &settings, &mut program);
    reader.targets.finish(&mut program);
    program
}

struct Reader<'a> {
    sources: &'a [Source],
    values: &'a Values,
    /// Why a location must keep its numbers, by value.
    kept: &'a HashMap<usize, String>,
    /// Values that some motion goes to as they are.
    reached: HashSet<usize>,
    targets: Gathered,
}

impl Reader<'_> {
    fn reached(&self, statements: &[Placed]) -> HashSet<usize> {
        let mut all = HashSet::new();
        for placed in statements {
            let Statement::Motion(Motion { goal: Goal::Location(goal), computed: None, .. }) = &placed.statement else {
                continue;
            };
            if let Some(Found::Values(found)) = goal.single_name().map(|name| self.values.find(name, placed.scope)) {
                all.extend(found);
            }
        }
        all
    }

    fn all(&mut self, statements: &[Placed], settings: &InForceAt, program: &mut Program) {
        let mut elbow = None;
        for (number, placed) in statements.iter().enumerate() {
            match &placed.statement {
                Statement::ElbowDown(down) => elbow = Some(*down),
                Statement::Call(callee, handed) => {
                    self.handed(callee, handed, placed, &settings.at(number, placed, program));
                }
                Statement::Motion(motion) => {
                    let setting = settings.at(number, placed, program);
                    self.motion(motion, placed, setting, elbow.take(), program);
                }
                _ => {}
            }
        }
    }

    /// A location that is handed to a program, which may go there.
    fn handed(&mut self, callee: &str, handed: &[Option<Name>], placed: &Placed, setting: &Setting) {
        for name in handed.iter().flatten() {
            let Found::Values(found) = self.values.find(name, placed.scope) else { continue };
            for index in found {
                let reason = format!("handed to the program `{callee}`");
                self.use_value(index, a_use("CALL", PathKind::Other, placed, setting.clone(), Some(reason)), None);
            }
        }
    }

    fn motion(
        &mut self,
        motion: &Motion,
        placed: &Placed,
        setting: Setting,
        elbow: Option<bool>,
        program: &mut Program,
    ) {
        let source = &self.sources[placed.scope.0];
        let mut one = a_use(&motion.word, motion.path, placed, setting, motion.computed.clone());
        match &motion.goal {
            Goal::Relative(span) => {
                let reason = "onwards from where the arm stands".to_owned();
                self.targets.unwritten(&source.text(*span), *span, reason, one);
            }
            Goal::Block { span, joints, tool, work } => {
                let named = |number: &Option<String>| match number {
                    Some(number) => Reference::Named(number.as_str().into()),
                    None => Reference::Unnamed,
                };
                (one.tool, one.frame) = (named(tool), named(work));
                match literal_numbers(source, placed.scope.0, "", *span, joints, true) {
                    Some(value) => self.use_literal(&value, one, elbow),
                    None => {
                        let reason = "its joint values are not six numbers".to_owned();
                        self.targets.unwritten(&source.text(*span), *span, reason, one);
                    }
                }
            }
            Goal::Location(goal) => self.location(goal, placed.scope, one, elbow, program),
        }
    }

    fn location(&mut self, goal: &Expression, scope: Scope, mut one: Use, elbow: Option<bool>, program: &mut Program) {
        let source = &self.sources[scope.0];
        let text = source.text(goal.span);
        let unwritten = |this: &mut Self, reason: &str, one| {
            this.targets.unwritten(&text, goal.span, reason.to_owned(), one);
        };
        let Some(terms) = goal.terms.as_deref() else { return unwritten(self, "it is computed", one) };
        if let [Term::Name(name)] = terms {
            return match self.values.find(name, scope) {
                Found::Values(found) => found.into_iter().for_each(|index| self.use_value(index, one.clone(), elbow)),
                Found::Unknown(reason, _) => unwritten(self, &reason, one),
            };
        }
        if let Some(value) = literal(source, scope.0, "", goal) {
            return self.use_literal(&value, one, elbow);
        }
        if let Some(displaced) = self.displaced(terms, scope) {
            self.targets.inline(displaced.target(&text, one));
            return;
        }
        // `frame+p`: the last part seen from a constant frame that no motion goes to.
        let Some((last, before)) = terms.split_last().filter(|(_, before)| !before.is_empty()) else {
            return unwritten(self, "it is computed", one);
        };
        let goes_there = before.iter().any(|term| match term {
            Term::Name(name) => self.goes_to(name, scope),
            _ => false,
        });
        if goes_there {
            return unwritten(self, "displaced from another target: it moves with it", one);
        }
        match self.values.pose(before, scope) {
            Err((reason, _)) => unwritten(self, &reason, one),
            Ok(pose) => {
                let shown = source.text(Span::new(goal.span.start, span_start(last))).trim_end().to_owned();
                one.frame = compound_frame(&one, shown.trim_end_matches('+').trim_end(), pose, program);
                match last {
                    Term::Name(name) => match self.values.find(name, scope) {
                        Found::Values(all) => {
                            all.into_iter().for_each(|index| self.use_value(index, one.clone(), elbow))
                        }
                        Found::Unknown(reason, _) => unwritten(self, &reason, one),
                    },
                    Term::Trans(span, numbers) => match literal_numbers(source, scope.0, "", *span, numbers, false) {
                        Some(value) => self.use_literal(&value, one, elbow),
                        None => unwritten(self, "it has not six numbers", one),
                    },
                    _ => unwritten(self, "it is computed", one),
                }
            }
        }
    }

    /// `p+TRANS(x,y,z)` and `SHIFT(p BY x,y,z)` of a location that a motion goes to as it is.
    fn displaced(&self, terms: &[Term], scope: Scope) -> Option<Displaced> {
        let (name, span, kind, numbers, rotation) = match terms {
            [Term::Name(name), Term::Trans(span, numbers)] => {
                (name, *span, DisplacementKind::Tool, numbers, trans(numbers)?.rotation)
            }
            [Term::Shift(inner, span, numbers)] => {
                let identity = nalgebra::Matrix3::identity();
                (inner.single_name()?, *span, DisplacementKind::Frame, numbers, identity)
            }
            _ => return None,
        };
        let base = match self.values.find(name, scope) {
            Found::Values(all) if all.len() == 1 => all[0],
            _ => return None,
        };
        let value = &self.values.all[base];
        let movable = value.computed.is_none() && !self.kept.contains_key(&base) && self.reached.contains(&base);
        if !movable || !matches!(value.value, TargetValue::Cartesian(_)) {
            return None;
        }
        Some(Displaced { base, span, kind, position: three(numbers)?, rotation })
    }

    fn goes_to(&self, name: &Name, scope: Scope) -> bool {
        match self.values.find(name, scope) {
            Found::Values(all) => all.iter().any(|index| self.reached.contains(index)),
            Found::Unknown(..) => false,
        }
    }

    fn use_value(&mut self, index: usize, one: Use, elbow: Option<bool>) {
        let value = &self.values.all[index];
        let make = || of_value(value, self.kept.get(&index), Some(value.shown.clone()));
        let target = self.targets.add_use(index, one, make);
        // Only what is asked for at every use is asked for.
        let first = target.uses.len() == 1;
        if first || target.configuration.elbow_down != elbow {
            Arc::make_mut(&mut target.configuration).elbow_down = elbow.filter(|_| first);
        }
    }

    fn use_literal(&mut self, value: &Value, one: Use, elbow: Option<bool>) {
        let target = self.targets.inline(of_value(value, None, None));
        if elbow.is_some() {
            Arc::make_mut(&mut target.configuration).elbow_down = elbow;
        }
        target.add_use(one);
    }
}

fn a_use(word: &str, path: PathKind, placed: &Placed, setting: Setting, computed: Option<String>) -> Use {
    Use::new(
        placed.scope.0,
        placed.span,
        Way { motion: word.into(), path, tool: setting.tool, frame: setting.base, grip_load: setting.load, computed },
    )
}

/// Where a term begins.
fn span_start(term: &Term) -> usize {
    match term {
        Term::Name(name) => name.span.start,
        Term::Trans(span, _) | Term::Joints(span, _) | Term::Shift(_, span, _) => span.start,
        Term::Turn(..) | Term::Frame(_) | Term::Null => 0,
    }
}

/// The base in force times a constant pose, as a frame of the job. A base of the cell file is not known here: the cell
/// file has to give the compound frame.
fn compound_frame(one: &Use, shown: &str, pose: Pose, program: &mut Program) -> Reference {
    let (name, base) = match &one.frame {
        Reference::Runtime(reason) => return Reference::Runtime(reason.clone()),
        Reference::Unnamed => (shown.to_owned(), Some(Pose::identity())),
        Reference::Named(base) => {
            let known = program.frames.get(&Program::key(base)).and_then(|frame| frame.value.as_ref().ok());
            (format!("{base} + {shown}"), known.map(|frame| frame.pose))
        }
    };
    if let Some(base) = base {
        frame(program, one.file, one.span, &name, base * pose);
    }
    Reference::Named(name.into())
}

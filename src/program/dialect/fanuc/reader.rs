//! All programs of a job: points become targets, motions their uses.

use std::collections::{BTreeSet, HashMap};

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::pose::Pose;
use crate::program::number::starts_with_word;
use crate::program::scan::Cursor;
use crate::program::selection::{InForce, Selections};
use crate::program::shared::Shared;
use crate::program::target::{
    Configuration, Definition, FrameData, Program, Reference, Target, TargetValue, ToolData, Use, Way,
};

use super::block::blocks;
use super::motion::{Goal, Motion, motion};
use super::points::{Point, Stored, point};
use super::section::{Sections, programs};
use super::statement::{Statement, bracket, index, skip_gap, statements, without_comments};

/// Reads the files of one job. Points are known in their own program only.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    let origin = Definition { file: 0, span: Span::default(), value: Ok(()) };
    program
        .tools
        .insert("0".into(), define(&origin, ToolData { pose: Pose::identity(), held_by_robot: true, load: None }));
    program
        .frames
        .insert("0".into(), define(&origin, FrameData { pose: Pose::identity(), held_by_robot: false, on: None }));
    for (file, source) in sources.iter().enumerate() {
        for sections in programs(source) {
            One::read(file, source, &sections, &mut program).finish(&sections, &mut program);
        }
    }
    program.targets.sort_by_key(|target| (target.file, target.span));
    program
}

fn define<T>(origin: &Definition<()>, value: T) -> Definition<T> {
    Definition { file: origin.file, span: origin.span, value: Ok(value) }
}

/// One program.
struct One<'a> {
    file: usize,
    source: &'a Source,
    points: Vec<Point>,
    by_number: HashMap<u32, usize>,
    motions: Vec<(Statement, Motion)>,
    frames: Selections,
    tools: Selections,
    joins: Vec<usize>,
    /// Why the value of a point is not what the file says: set at run time.
    assigned: HashMap<u32, String>,
    all_assigned: Option<String>,
    /// Payload schedules that are selected.
    payloads: BTreeSet<String>,
    first_payload: Option<Span>,
    /// Why no position of the program is where it says: a conveyor.
    tracking: Option<String>,
}

impl<'a> One<'a> {
    fn read(file: usize, source: &'a Source, sections: &Sections, program: &mut Program) -> Self {
        let bytes = source.bytes();
        let mut one = Self {
            file,
            source,
            points: Vec::new(),
            by_number: HashMap::new(),
            motions: Vec::new(),
            frames: Selections::default(),
            tools: Selections::default(),
            joins: Vec::new(),
            assigned: HashMap::new(),
            all_assigned: None,
            payloads: BTreeSet::new(),
            first_payload: None,
            tracking: line_tracking(bytes, &sections.application),
        };
        for block in sections.points.map(|section| blocks(bytes, section)).unwrap_or_default() {
            let read = point(bytes, file, &block, &mut program.diagnostics);
            if one.by_number.insert(read.number, one.points.len()).is_some() {
                let message = format!("P[{}] is given twice: the later one holds", read.number);
                program.diagnostics.push(Diagnostic::warning("duplicate-point", message).at(file, read.span, ""));
            }
            one.points.push(read);
        }
        let mut touch_offset: Option<String> = None;
        for statement in statements(bytes, &sections.statements) {
            if let Some(mut motion) = motion(bytes, statement) {
                motion.computed = motion.computed.or_else(|| one.tracking.clone()).or_else(|| touch_offset.clone());
                one.motions.push((statement, motion));
            } else {
                one.statement(statement, &mut touch_offset, program);
            }
        }
        one
    }

    /// A statement that is no motion.
    fn statement(&mut self, statement: Statement, touch_offset: &mut Option<String>, program: &mut Program) {
        let bytes = self.source.bytes();
        let mut cursor = Cursor::new(bytes, statement.span);
        let start = statement.span.start;
        let line = self.source.line(start);
        let begins = |words: &[&str]| words.iter().any(|word| starts_with_word(cursor.rest(), word));
        if begins(&["LBL", "ENDIF", "ELSE", "ENDFOR", "FOR", "CALL"]) {
            self.joins.push(start);
        } else if begins(&["Touch", "Touch_Offset"]) {
            let ends = cursor.rest().to_ascii_uppercase().windows(3).any(|word| word == b"END");
            *touch_offset = (!ends).then(|| format!("displaced by touch sensing since line {line}"));
        }
        if begins(&["IF"]) {
            // `IF (DI[1]),UTOOL_NUM=2`: selected under a condition.
            let text = cursor.rest().to_ascii_uppercase();
            let reason = || Reference::Runtime(format!("set under a condition in line {line}"));
            for (word, selections) in [(&b"UFRAME_NUM"[..], &mut self.frames), (b"UTOOL_NUM", &mut self.tools)] {
                if text.windows(word.len() + 1).any(|found| found.starts_with(b",") && &found[1..] == word) {
                    selections.push(start, reason());
                }
            }
        }
        let Some(name) = cursor.name().map(|name| cursor.slice(name).to_ascii_uppercase()) else { return };
        let inside = bracket(&mut cursor);
        let number = inside.and_then(|inside| index(cursor.slice(inside)));
        if name == b"PAYLOAD"
            && let Some(inside) = inside
        {
            self.payloads.insert(without_comments(cursor.slice(inside)));
            self.first_payload.get_or_insert(statement.span);
            return;
        }
        skip_gap(&mut cursor);
        if !cursor.eat(b'=') {
            return;
        }
        let value = without_comments(cursor.rest());
        let selected = || match value.parse::<u32>() {
            Ok(number) => numbered(number),
            Err(_) => Reference::Runtime(format!("`{value}` in line {line} selects it")),
        };
        let place = Definition { file: self.file, span: statement.span, value: Ok(()) };
        let reason = format!("set to `{value}` in line {line}");
        match name.as_slice() {
            b"UFRAME_NUM" if is_robot(inside.map(|inside| cursor.slice(inside))) => self.frames.push(start, selected()),
            b"UTOOL_NUM" if is_robot(inside.map(|inside| cursor.slice(inside))) => self.tools.push(start, selected()),
            b"UFRAME" | b"UTOOL" if number.is_none() => {
                let message = "the number of the tool or frame that is set here is known only at run time";
                let finding = Diagnostic::warning("runtime-definition", message).at(self.file, statement.span, "");
                program.diagnostics.push(finding);
            }
            b"UFRAME" => {
                let changed = format!("user frame {} is {reason}", number.unwrap_or_default());
                program.frames.insert(number.unwrap_or_default().to_string(), unknown(&place, changed));
            }
            b"UTOOL" => {
                let changed = format!("user tool {} is {reason}", number.unwrap_or_default());
                program.tools.insert(number.unwrap_or_default().to_string(), unknown(&place, changed));
            }
            b"P" => match number {
                Some(number) => {
                    self.assigned.entry(number).or_insert(reason);
                }
                None => self.all_assigned = Some(format!("some point is {reason}")),
            },
            _ => {}
        }
    }

    /// Makes targets of the points that motions use.
    fn finish(self, sections: &Sections, program: &mut Program) {
        let mut uses: Vec<Vec<Use>> = vec![Vec::new(); self.points.len()];
        let mut others: Vec<Target> = Vec::new();
        let mut other_by_name: HashMap<String, usize> = HashMap::new();
        let mut indirect: Option<Use> = None;
        let mut mismatches = Vec::new();
        let mut ways = Shared::default();
        for (statement, motion) in &self.motions {
            for (goal, path) in &motion.goals {
                let mut one = Use::new(
                    self.file,
                    statement.span,
                    Way {
                        motion: motion.word.clone(),
                        path: *path,
                        tool: Reference::Unnamed,
                        frame: Reference::Unnamed,
                        grip_load: Reference::Unnamed,
                        computed: motion.computed.clone(),
                    },
                );
                let (name, span, reason) = match goal {
                    Goal::Point(number, span) => match self.by_number.get(number) {
                        Some(&index) => {
                            mismatches.extend(self.mismatch(&self.points[index], statement));
                            self.resolve(&self.points[index], &mut one);
                            uses[index].push(one.sharing(&mut ways));
                            continue;
                        }
                        None => (format!("P[{number}]"), *span, "the program holds no such point".to_owned()),
                    },
                    Goal::Indirect(text, span) => {
                        indirect.get_or_insert_with(|| one.clone());
                        (text.clone(), *span, "which point is meant is known only at run time".to_owned())
                    }
                    Goal::Register(text, span) => (text.clone(), *span, format!("{text} is filled at run time")),
                };
                let slot = *other_by_name.entry(name.clone()).or_insert_with(|| {
                    others.push(unwritten(self.file, name, span, reason));
                    others.len() - 1
                });
                others[slot].add_use(one);
            }
        }
        if let Some(one) = indirect {
            // Any point that no motion names may be the one that is meant.
            for (point, uses) in self.points.iter().zip(&mut uses).filter(|(_, uses)| uses.is_empty()) {
                let mut one = one.clone();
                self.resolve(point, &mut one);
                uses.push(one);
            }
        }
        self.report(sections, mismatches, program);
        let all_assigned = self.all_assigned;
        for (index, (point, uses)) in self.points.into_iter().zip(uses).enumerate() {
            if uses.is_empty() || self.by_number.get(&point.number) != Some(&index) {
                continue;
            }
            let assigned = self.assigned.get(&point.number).map(|reason| format!("it is {reason}"));
            program.targets.push(Target {
                file: self.file,
                name: Some(format!("P[{}]", point.number)),
                span: point.span,
                value: point.value,
                computed: point.computed.or(assigned).or_else(|| all_assigned.clone()),
                configuration: point.configuration.into_shared(),
                external_axes: point.external_axes,
                rides_along: false,
                uses,
            });
        }
        program.targets.extend(others);
    }

    /// Frame and tool of a motion to a point: what the point stores, unless a register selects.
    fn resolve(&self, point: &Point, one: &mut Use) {
        let offset = one.span.start;
        let reference = |stored: Stored, in_force: InForce<'_>, word: &str| match (stored, in_force) {
            (_, InForce::Known(Reference::Runtime(reason))) => Reference::Runtime(reason.clone()),
            (Stored::Number(number), _) => numbered(number),
            (Stored::Any, InForce::Known(selected)) => selected.clone(),
            (Stored::Any, InForce::Nothing | InForce::Open) => {
                Reference::Runtime(format!("P[{}] is stored without {word}, and none is selected here", point.number))
            }
        };
        one.frame = reference(point.frame, self.frames.at(offset, &self.joins), "a user frame");
        one.tool = reference(point.tool, self.tools.at(offset, &self.joins), "a tool");
    }

    /// A point that is stored for another frame or tool than the selected one: the controller stops there.
    fn mismatch(&self, point: &Point, statement: &Statement) -> Option<(Span, String)> {
        let offset = statement.span.start;
        let pairs = [
            ("UF", point.frame, self.frames.at(offset, &self.joins)),
            ("UT", point.tool, self.tools.at(offset, &self.joins)),
        ];
        pairs.into_iter().find_map(|(word, stored, in_force)| match (stored, in_force) {
            (Stored::Number(stored), InForce::Known(Reference::Named(selected)))
                if selected.as_ref() != stored.to_string() =>
            {
                let text = format!("P[{}] is stored for {word} {stored}, {selected} is selected", point.number);
                Some((statement.span, text))
            }
            _ => None,
        })
    }

    fn report(&self, sections: &Sections, mismatches: Vec<(Span, String)>, program: &mut Program) {
        let findings = &mut program.diagnostics;
        if let Some((span, text)) = mismatches.first() {
            let message =
                format!("{} move(s) go to points of another frame or tool than the selected one", mismatches.len());
            let finding = Diagnostic::warning("frame-mismatch", message).at(self.file, *span, text.clone());
            findings.push(finding.help("the controller stops there with an alarm; the stored numbers are used here"));
        }
        if let Some(span) = self.first_payload {
            let listed = self.payloads.iter().cloned().collect::<Vec<_>>().join(", ");
            let text = format!("payload schedule(s) {listed}: their values are on the controller");
            let help = "give the tool of the cell file the payload; without one the model's own holds";
            let finding = match self.payloads.len() {
                1 => Diagnostic::note("payload-schedule", text),
                _ => Diagnostic::warning("payload-schedule", text),
            };
            findings.push(finding.at(self.file, span, "").help(help));
        }
        let end = Span::new(sections.end, sections.end);
        if !self.motions.is_empty() && sections.points.is_none() {
            let message = "the program has motions and no /POS section: it may have been cut off";
            findings.push(Diagnostic::error("truncated", message).at(self.file, end, "the text stops here"));
        } else if !sections.ends {
            let message = "the program has no /END: it may have been cut off";
            findings.push(Diagnostic::warning("missing-end", message).at(self.file, end, "the text stops here"));
        }
    }
}

fn numbered(number: u32) -> Reference {
    Reference::Named(number.to_string().into())
}

fn unknown<T>(place: &Definition<()>, reason: String) -> Definition<T> {
    Definition { file: place.file, span: place.span, value: Err(reason) }
}

fn unwritten(file: usize, name: String, span: Span, reason: String) -> Target {
    Target {
        file,
        name: Some(name),
        span,
        value: TargetValue::Unwritten,
        computed: Some(reason),
        configuration: Configuration::unsaid(),
        external_axes: Vec::new(),
        rides_along: false,
        uses: Vec::new(),
    }
}

/// `UFRAME_NUM=1` and `UFRAME_NUM[GP1]=1` select for the robot, `UFRAME_NUM[GP2]=1` does not.
fn is_robot(groups: Option<&[u8]>) -> bool {
    groups.is_none_or(|groups| String::from_utf8_lossy(groups).split(',').any(|group| group.trim() == "GP1"))
}

/// Positions of a line tracking program are relative to the conveyor.
fn line_tracking(bytes: &[u8], application: &[Span]) -> Option<String> {
    const SCHEDULE: &str = "LINE_TRACK_SCHEDULE_NUMBER";
    application.iter().find_map(|line| {
        let mut cursor = Cursor::new(bytes, *line);
        cursor.skip_blanks();
        if !cursor.eat_word(SCHEDULE) {
            return None;
        }
        cursor.skip_while(|byte| matches!(byte, b' ' | b'\t' | b':' | b'='));
        let schedule = cursor.number()?.value;
        (schedule != 0.0).then(|| format!("line tracking (schedule {schedule}): relative to the conveyor"))
    })
}

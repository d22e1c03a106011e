//! All jobs that are read together: positions become targets, motions their uses.

use std::collections::HashMap;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::number::starts_with_word;
use crate::program::target::{Configuration, Definition, Program, Reference, Target, TargetValue, Use, Way};

use super::assignment::{Effect, effect};
use super::job::{Line, lines};
use super::motion::{Goal, Motion, motion};
use super::positions::{Kind, Position, PositionReader};

/// Reads the jobs. Steps are known in their own job only; position variables belong to all.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    let mut shared = Shared::default();
    let jobs: Vec<Job> =
        sources.iter().enumerate().map(|(file, source)| Job::read(file, source, &mut shared, &mut program)).collect();
    let mut targets = Targets::new(sources, &jobs);
    for (file, job) in jobs.iter().enumerate() {
        for (span, motion) in &job.motions {
            targets.add(file, *span, motion);
        }
    }
    targets.finish(&jobs, &shared, &mut program);
    program
}

/// What any of the jobs does to what all share.
#[derive(Default)]
struct Shared {
    assigned: HashMap<u32, String>,
    some_assigned: Option<String>,
    /// Variables that a frame is made of.
    frame_points: HashMap<u32, String>,
}

struct Job {
    positions: Vec<Position>,
    by_name: HashMap<(Kind, u32), usize>,
    motions: Vec<(Span, Motion)>,
}

impl Job {
    fn read(file: usize, source: &Source, shared: &mut Shared, program: &mut Program) -> Self {
        let bytes = source.bytes();
        let mut reader = PositionReader::new();
        let mut motions = Vec::new();
        let (mut shift, mut tool, mut relative) = (None, None, None);
        let mut ends = false;
        for line in lines(source) {
            match line {
                Line::Position(span) => reader.line(bytes, file, span, &mut program.diagnostics),
                Line::Head(span) => {
                    let text = String::from_utf8_lossy(source.slice(span));
                    let attributes = text.strip_prefix("///ATTR").unwrap_or_default();
                    if attributes.split(',').any(|attribute| attribute.trim() == "RJ") {
                        relative =
                            Some("a relative job: whoever calls it may move it to another user frame".to_owned());
                    }
                }
                Line::Instruction(span) => {
                    ends |= starts_with_word(source.slice(span), "END");
                    if let Some(mut motion) = motion(bytes, span) {
                        let reasons = [&shift, &tool, &relative].into_iter().flatten().next();
                        motion.computed = motion.computed.or_else(|| reasons.cloned());
                        motions.push((span, motion));
                        continue;
                    }
                    let line = source.line(span.start);
                    match effect(bytes, span) {
                        Some(Effect::ShiftOn) => shift = Some(format!("shifted by SFTON in line {line}")),
                        Some(Effect::ShiftOff) => shift = None,
                        Some(Effect::Tool) => tool = Some(format!("the tool is selected at run time in line {line}")),
                        Some(other) => shared.apply(other, file, span, line, program),
                        None => {}
                    }
                }
            }
        }
        let positions = reader.finish();
        let mut by_name = HashMap::new();
        for (index, position) in positions.iter().enumerate() {
            if by_name.insert((position.kind, position.number), index).is_some() {
                let message = "the position is given twice: the later one holds";
                program.diagnostics.push(Diagnostic::warning("duplicate-position", message).at(
                    file,
                    position.span,
                    "",
                ));
            }
        }
        let says_something = !positions.is_empty() || !motions.is_empty();
        if says_something && !ends {
            let end = Span::new(bytes.len(), bytes.len());
            let message = "the job has no END: it may have been cut off";
            program.diagnostics.push(Diagnostic::warning("missing-end", message).at(file, end, "the text stops here"));
        }
        Self { positions, by_name, motions }
    }
}

impl Shared {
    fn apply(&mut self, effect: Effect, file: usize, span: Span, line: usize, program: &mut Program) {
        match effect {
            Effect::Variable(number) => {
                self.assigned.entry(number).or_insert_with(|| format!("it is set at run time in line {line}"));
            }
            Effect::SomeVariable => self.some_assigned = Some(format!("line {line} sets a variable by index")),
            Effect::Frame(number, points) => {
                for point in points {
                    let reason = format!("line {line} makes a user frame of it: a correction would move that frame");
                    self.frame_points.entry(point).or_insert(reason);
                }
                match number {
                    Some(number) => {
                        let value = Err(format!("user frame {number} is set in line {line}"));
                        program.frames.insert(number.to_string(), Definition { file, span, value });
                    }
                    None => {
                        let message = "the number of the user frame that is set here is known only at run time";
                        let finding = Diagnostic::warning("runtime-definition", message).at(file, span, "");
                        program.diagnostics.push(finding);
                    }
                }
            }
            Effect::ShiftOn | Effect::ShiftOff | Effect::Tool => {}
        }
    }

    /// Why the value of a variable is not, or must stay, what the file says.
    fn reason(&self, number: u32) -> Option<String> {
        let of_this = self.assigned.get(&number).or_else(|| self.frame_points.get(&number));
        of_this.or(self.some_assigned.as_ref()).cloned()
    }
}

/// The targets so far: uses of positions, and goals without a position.
struct Targets<'a> {
    sources: &'a [Source],
    jobs: &'a [Job],
    /// Of variables: the only job that gives a value; `None` when several do.
    variables: HashMap<u32, Option<(usize, usize)>>,
    uses: HashMap<(usize, usize), Vec<Use>>,
    others: Vec<Target>,
    other_by_name: HashMap<(usize, String), usize>,
}

impl<'a> Targets<'a> {
    fn new(sources: &'a [Source], jobs: &'a [Job]) -> Self {
        let mut variables: HashMap<u32, Option<(usize, usize)>> = HashMap::new();
        for (file, job) in jobs.iter().enumerate() {
            for (&(kind, number), &index) in &job.by_name {
                if kind == Kind::Variable {
                    variables.entry(number).and_modify(|known| *known = None).or_insert(Some((file, index)));
                }
            }
        }
        Self { sources, jobs, variables, uses: HashMap::new(), others: Vec::new(), other_by_name: HashMap::new() }
    }

    fn add(&mut self, file: usize, span: Span, motion: &Motion) {
        let mut one = Use::new(
            file,
            span,
            Way {
                motion: motion.word.as_str().into(),
                path: motion.path,
                tool: Reference::Unnamed,
                frame: Reference::Unnamed,
                grip_load: Reference::Unnamed,
                computed: motion.computed.clone(),
            },
        );
        let (name, place, reason) = match &motion.goal {
            Goal::OtherAxes => return,
            Goal::Runtime(text, place) => (text.clone(), *place, format!("{text} is known only at run time")),
            Goal::Position(kind, number, place) => match self.find(file, *kind, *number) {
                Some(found) => {
                    let position = &self.jobs[found.0].positions[found.1];
                    one.tool = position.tool.clone();
                    one.frame = position.frame.clone();
                    self.uses.entry(found).or_default().push(one);
                    return;
                }
                None => {
                    (self.sources[file].text(*place).into_owned(), *place, "the job holds no value for it".to_owned())
                }
            },
        };
        let slot = *self.other_by_name.entry((file, name.clone())).or_insert_with(|| {
            self.others.push(Target {
                file,
                name: Some(name),
                span: place,
                value: TargetValue::Unwritten,
                computed: Some(reason),
                configuration: Configuration::unsaid(),
                external_axes: Vec::new(),
                rides_along: false,
                uses: Vec::new(),
            });
            self.others.len() - 1
        });
        self.others[slot].add_use(one);
    }

    fn find(&self, file: usize, kind: Kind, number: u32) -> Option<(usize, usize)> {
        let own = self.jobs[file].by_name.get(&(kind, number)).map(|&index| (file, index));
        own.or_else(|| (kind == Kind::Variable).then(|| self.variables.get(&number).copied().flatten()).flatten())
    }

    fn finish(mut self, jobs: &[Job], shared: &Shared, program: &mut Program) {
        for (file, job) in jobs.iter().enumerate() {
            for (index, position) in job.positions.iter().enumerate() {
                let Some(uses) = self.uses.remove(&(file, index)) else { continue };
                let changed = (position.kind == Kind::Variable).then(|| shared.reason(position.number)).flatten();
                program.targets.push(Target {
                    file,
                    name: Some(position.name.clone()),
                    span: position.span,
                    value: position.value.clone(),
                    computed: position.computed.clone().or(changed),
                    configuration: position.configuration.clone().into_shared(),
                    external_axes: position.external_axes.clone(),
                    rides_along: position.rides_along,
                    uses,
                });
            }
        }
        program.targets.append(&mut self.others);
        program.targets.sort_by_key(|target| (target.file, target.span));
    }
}

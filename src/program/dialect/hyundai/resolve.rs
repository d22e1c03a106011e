//! From motions to targets: each recorded pose is one target, each pose constant one for all its uses.

use std::collections::HashMap;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::program::shared::Shared;
use crate::program::target::{Configuration, Mention, Program, Reference, Target, TargetValue, Use, Way};

use super::checks;
use super::expression::{Goal, Name};
use super::motion::Motion;
use super::reader::JobFile;
use super::selection::in_force;
use super::statement::Statement;
use super::target::target;
use super::variable::Variables;
use super::written_pose::{Coordinates, PoseFault, WrittenPose};

/// Collects the targets of all files.
pub(super) struct Resolver<'a> {
    variables: &'a Variables,
    targets: Vec<Target>,
    ways: Shared<Way>,
    diagnostics: Vec<Diagnostic>,
    /// Index of the target of a name: scope and name.
    named: HashMap<(Option<usize>, String), usize>,
    /// File and place of a variable's pose, and where a motion names the variable.
    mentions: Vec<((usize, Span), Mention)>,
}

/// One motion and where it stands.
struct Step<'a> {
    index: usize,
    source: &'a Source,
    file: &'a JobFile,
    statement: &'a Statement,
    motion: &'a Motion,
}

impl<'a> Resolver<'a> {
    /// Starts with no targets.
    pub fn new(variables: &'a Variables) -> Self {
        Self {
            variables,
            targets: Vec::new(),
            ways: Shared::default(),
            diagnostics: Vec::new(),
            named: HashMap::new(),
            mentions: Vec::new(),
        }
    }

    /// Adds the targets of all motions of a file.
    pub fn add_file(&mut self, index: usize, source: &Source, file: &JobFile) {
        for (statement, motion) in &file.motions {
            self.add(&Step { index, source, file, statement, motion });
        }
    }

    /// Hands targets and findings over.
    pub fn finish(self, program: &mut Program) {
        program.targets.extend(self.targets);
        program.targets.sort_by_key(|target| (target.file, target.span));
        program.note_replaceable(&self.mentions);
        program.diagnostics.extend(self.diagnostics);
    }

    fn add(&mut self, step: &Step<'_>) {
        match &step.motion.goal {
            Some(Goal::Written(pose)) => {
                self.diagnostics.extend(checks::axis_count(step.index, &step.file.header, pose));
                let target = target(step.index, step.label(), pose);
                self.push(step, target, step.frame(&pose.coordinates));
            }
            Some(Goal::Named(name)) => self.add_named(step, name),
            Some(Goal::Expression(span)) => {
                let text = step.source.text(*span).trim().to_owned();
                self.push(step, step.unwritten(*span, format!("the goal is `{text}`")), Reference::Unnamed);
            }
            Some(Goal::Broken(fault)) => self.add_broken(step, fault),
            Some(Goal::Shift) | None => {
                let reason = "the recorded pose of this step is not in the text".to_owned();
                self.push(step, step.unwritten(step.statement.span, reason), Reference::Unnamed);
            }
        }
    }

    fn push(&mut self, step: &Step<'_>, target: Target, frame: Reference) {
        let one = step.usage(frame).sharing(&mut self.ways);
        self.targets.push(Target { uses: vec![one], ..target });
    }

    fn add_named(&mut self, step: &Step<'_>, name: &Name) {
        let known = self.variables.get(step.index, &name.key);
        let written = known.and_then(|(variable, _)| variable.poses.first());
        let frame = written.map_or(Reference::Unnamed, |(_, pose)| step.frame(&pose.coordinates));
        if let Some((file, pose)) = written {
            self.mentions.push(((*file, pose.span), (step.index, name.span)));
        }
        let key = (self.variables.scope(step.index, &name.key), name.key.clone());
        if let Some(&at) = self.named.get(&key) {
            self.targets[at].add_use(step.usage(frame).sharing(&mut self.ways));
            return;
        }
        let spelled = step.source.text(name.span).into_owned();
        let reason = match known {
            None => Some(format!("no value of {spelled} is in the text")),
            Some((variable, change)) => match (change, variable.poses.as_slice()) {
                (Some(change), _) => Some(format!("the value of {spelled} changes: {change}")),
                (None, []) => Some(format!("no value of {spelled} is in the text")),
                (None, [_]) => None,
                (None, [(_, first), .., (_, last)]) => Some(format!(
                    "{spelled} is assigned more than once: {} and {}",
                    step.place(*variable.poses.first().map_or(&step.index, |(file, _)| file), first),
                    step.place(*variable.poses.last().map_or(&step.index, |(file, _)| file), last),
                )),
            },
        };
        let mut target = match written {
            Some((file, pose)) => {
                self.diagnostics.extend(checks::axis_count(*file, &step.file.header, pose));
                target(*file, Some(spelled), pose)
            }
            None => Target { name: Some(spelled), ..step.unwritten(name.span, String::new()) },
        };
        if reason.is_some() {
            target.computed = reason;
        }
        self.named.insert(key, self.targets.len());
        self.push(step, target, frame);
    }

    fn add_broken(&mut self, step: &Step<'_>, fault: &PoseFault) {
        let (span, reason) = match *fault {
            PoseFault::Unclosed(span) => {
                let last = step.file.last_statement == step.statement.span && !step.file.ends;
                let finding = if last {
                    Diagnostic::error("truncated", "the job stops in the middle of a pose")
                } else {
                    Diagnostic::error("malformed-pose", "the bracket of a pose does not close")
                };
                self.diagnostics.push(finding.at(step.index, span, "this pose is not complete"));
                (span, "the pose is not complete")
            }
            PoseFault::NotConstant(span) => {
                let finding = Diagnostic::error("malformed-pose", "a recorded pose must hold numbers only");
                self.diagnostics.push(finding.at(step.index, span, "this is no recorded pose"));
                (span, "the pose holds something that is no number")
            }
        };
        self.push(step, step.unwritten(span, reason.to_owned()), Reference::Unnamed);
    }
}

impl Step<'_> {
    fn label(&self) -> Option<String> {
        self.statement.label.map(|span| self.source.text(span).into_owned())
    }

    /// A target whose numbers are not in the text.
    fn unwritten(&self, span: Span, reason: String) -> Target {
        Target {
            file: self.index,
            name: self.label(),
            span,
            value: TargetValue::Unwritten,
            computed: Some(reason),
            configuration: Configuration::unsaid(),
            external_axes: Vec::new(),
            rides_along: false,
            uses: Vec::new(),
        }
    }

    fn usage(&self, frame: Reference) -> Use {
        let selected = || in_force(&self.file.tools, self.statement.span.start, &self.file.joins);
        Use::new(
            self.index,
            self.statement.span,
            Way {
                motion: self.motion.word.clone(),
                path: self.motion.path,
                tool: self.motion.tool.clone().or_else(selected).unwrap_or_default(),
                frame,
                grip_load: Reference::Unnamed,
                computed: self.motion.computed.clone(),
            },
        )
    }

    /// Base and robot coordinates are the robot's own frame; a user frame without a number is the selected one.
    fn frame(&self, coordinates: &Coordinates) -> Reference {
        let named = |number: &str| match number {
            "0" => Reference::Unnamed,
            number => Reference::Named(number.into()),
        };
        match coordinates {
            Coordinates::User(Some(number)) => named(&number.to_string()),
            Coordinates::User(None) => {
                match in_force(&self.file.user_frames, self.statement.span.start, &self.file.joins) {
                    Some(Reference::Named(number)) => named(&number),
                    Some(other) => other,
                    None => Reference::Runtime("the user frame is selected outside of the job".to_owned()),
                }
            }
            _ => Reference::Unnamed,
        }
    }

    /// Where a pose is assigned, for people.
    fn place(&self, file: usize, pose: &WrittenPose) -> String {
        if file == self.index {
            format!("line {}", self.source.line(pose.span.start))
        } else {
            format!("another job (file {})", file + 1)
        }
    }
}

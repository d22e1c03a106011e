//! From motions to targets: every position that a motion goes to, with the settings in force.

use std::collections::HashMap;
use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Span;
use crate::program::flow::State;
use crate::program::target::{Configuration, Mention, PathKind, Program, Reference, Target, TargetValue, Use};

use super::aggregate::Unclosed;
use super::frames::Frames;
use super::job::{Job, Statement};
use super::motion::{Goal, Motion};
use super::position::{WrittenPosition, position};
use super::reference;
use super::setting::{SETTINGS, Sets};
use super::usage::{Settings, usage};
use super::variable::{Element, Known, Variables, Write};

/// Uses by variable index that are listed; a million are more than any program has.
const MOST_INDEXED_USES: usize = 1_000_000;

/// One motion and where it stands.
pub(super) struct Step<'s> {
    /// Its routine.
    pub routine: usize,
    /// The statement.
    pub statement: &'s Statement,
    /// What it says.
    pub motion: &'s Motion,
    /// The settings before it.
    pub state: &'s State<SETTINGS>,
    /// What the block around it and its own `WITH` set.
    pub with: &'s Sets,
}

/// Collects targets.
pub(super) struct Targets<'j, 'a> {
    job: &'j Job<'a>,
    variables: &'j Variables,
    /// The targets so far.
    pub targets: Vec<Target>,
    /// Findings so far.
    pub diagnostics: Vec<Diagnostic>,
    /// Where motions name a target.
    mentions: Vec<(usize, Mention)>,
    by_element: HashMap<Element, usize>,
    /// Targets whose status and turn count: see [`Targets::finish`].
    configured: Vec<bool>,
    indexed_uses: usize,
    /// In which routine the last motion went to a position that the text holds.
    stands_in: Option<usize>,
}

impl<'j, 'a> Targets<'j, 'a> {
    /// None yet.
    pub fn new(job: &'j Job<'a>, variables: &'j Variables) -> Self {
        Self {
            job,
            variables,
            targets: Vec::new(),
            diagnostics: Vec::new(),
            mentions: Vec::new(),
            by_element: HashMap::new(),
            configured: Vec::new(),
            indexed_uses: 0,
            stands_in: None,
        }
    }

    /// Adds the targets of a motion.
    pub fn add(&mut self, step: &Step<'_>, frames: &Frames<'_, '_>, settings: &mut Settings) {
        for (goal, path) in &step.motion.goals {
            let one = usage(step, *path, frames, settings);
            let counts = *path == PathKind::Joint || self.stands_in != Some(step.routine);
            let reached = match goal {
                _ if step.motion.is_relative => {
                    let reason = format!("{} goes on from where the arm stands", step.motion.word);
                    vec![self.push(step, None, step.statement.span, Unwritten(reason))]
                }
                Goal::Written(aggregate) => match position(self.job.bytes(step.statement.file), aggregate) {
                    Some(written) => vec![self.push_written(step.statement.file, None, written)],
                    None => vec![self.push(step, None, aggregate.span, Unwritten("it is no position".into()))],
                },
                Goal::Named(named) => self.named(step, named),
                Goal::Expression(span) => {
                    let text = self.job.sources[step.statement.file].text(*span).into_owned();
                    vec![self.push(step, None, *span, Unwritten(format!("its goal is `{text}`")))]
                }
                Goal::Broken(unclosed) => {
                    self.broken(step.statement.file, *unclosed);
                    vec![self.push(step, None, unclosed.0, Unwritten("it is not complete".into()))]
                }
            };
            let written = |&target: &usize| self.targets[target].computed.is_none();
            self.stands_in = reached.iter().all(written).then_some(step.routine).filter(|_| !reached.is_empty());
            for target in reached {
                self.targets[target].add_use(one.clone());
                self.configured[target] |= counts;
            }
        }
        if step.motion.has_angle {
            let message = "the arc ends where its angle says: the end point only gives the circle";
            self.diagnostics.push(Diagnostic::note("arc-angle", message).at(
                step.statement.file,
                step.statement.span,
                "",
            ));
        }
    }

    /// Gives the program its targets, in the order of the files, and what there was to say about them.
    ///
    /// Continuous motions keep the status of their start and ignore status and turn of their goal: those count only
    /// where some motion travels point to point, or where it is not known from where it starts. Axes that no target of
    /// the job moves are not there.
    pub fn finish(mut self, program: &mut Program) {
        let moving: Vec<String> = self
            .targets
            .iter()
            .flat_map(|target| target.external_axes.iter().filter(|axis| axis.value != 0.0))
            .map(|axis| axis.name.clone())
            .collect::<std::collections::BTreeSet<_>>()
            .into_iter()
            .collect();
        for (target, configured) in self.targets.iter_mut().zip(&self.configured) {
            target.external_axes.retain(|axis| moving.contains(&axis.name));
            if !configured {
                target.configuration = Configuration::unsaid();
            }
        }
        let place = |target: usize| (self.targets[target].file, self.targets[target].span);
        let mentions: Vec<_> = self.mentions.iter().map(|(target, mention)| (place(*target), *mention)).collect();
        self.targets.sort_by_key(|target| (target.file, target.span));
        program.targets = self.targets;
        program.diagnostics = self.diagnostics;
        program.note_replaceable(&mentions);
    }

    fn named(&mut self, step: &Step<'_>, named: &reference::Reference) -> Vec<usize> {
        let text = self.job.sources[step.statement.file].text(named.span).into_owned();
        if named.base.starts_with('$') || named.member.is_some() {
            let reason = format!("`{text}` is known only at run time");
            return vec![self.push(step, Some(text), named.span, Unwritten(reason))];
        }
        let scope = self.variables.scope(self.job, step.routine, &named.base);
        if let Some(element) = named.element() {
            let target = self.element(step, (scope, element), &text, named.span);
            self.mentions.push((target, (step.statement.file, named.span)));
            return vec![target];
        }
        let elements = self.variables.elements(scope, &named.base);
        if elements.is_empty() || self.indexed_uses + elements.len() > MOST_INDEXED_USES {
            let reason = format!("the index of `{text}` is known only at run time");
            return vec![self.push(step, Some(text), named.span, Unwritten(reason))];
        }
        self.indexed_uses += elements.len();
        let base = text.get(..named.base.len()).unwrap_or(&named.base);
        let spelled = |element: &String| format!("{base}{}", element.get(named.base.len()..).unwrap_or_default());
        let all = elements.iter().map(|one| self.element(step, (scope, one.clone()), &spelled(one), named.span));
        all.collect()
    }

    /// The target that an element of a variable is.
    fn element(&mut self, step: &Step<'_>, element: Element, spelled: &str, place: Span) -> usize {
        if let Some(&known) = self.by_element.get(&element) {
            return known;
        }
        let name = Some(spelled.to_string());
        let target = match self.variables.get(&element, spelled) {
            Known::Once(write) => self.assigned(step, name, place, write, None),
            Known::Changes(reason, Some(write)) => self.assigned(step, name, place, write, Some(reason)),
            Known::Changes(reason, None) | Known::Nowhere(reason) => self.push(step, name, place, Unwritten(reason)),
        };
        self.by_element.insert(element, target);
        target
    }

    /// The target that an assignment writes.
    fn assigned(
        &mut self,
        step: &Step<'_>,
        name: Option<String>,
        place: Span,
        write: Write,
        change: Option<String>,
    ) -> usize {
        let bytes = self.job.bytes(write.file);
        let mut cursor = crate::program::scan::Cursor::new(bytes, write.value);
        let text = || self.job.sources[write.file].text(write.value).into_owned();
        if cursor.peek() != Some(b'{') {
            let reason = change.unwrap_or_else(|| format!("its value is `{}`", text()));
            return self.push(step, name, place, Unwritten(reason));
        }
        let written = match super::aggregate::aggregate(bytes, &mut cursor) {
            Ok(aggregate) if cursor.at_end() => position(bytes, &aggregate),
            Ok(_) => None,
            Err(_) => return self.push(step, name, place, Unwritten("it is not complete".into())),
        };
        let Some(written) = written else {
            let reason = change.unwrap_or_else(|| format!("its value is `{}`", text()));
            return self.push(step, name, place, Unwritten(reason));
        };
        let target = self.push_written(write.file, name, written);
        if change.is_some() {
            self.targets[target].computed = change;
        }
        target
    }

    fn push_written(&mut self, file: usize, name: Option<String>, written: WrittenPosition) -> usize {
        self.configured.push(false);
        self.targets.push(Target {
            file,
            name,
            span: written.span,
            value: written.value,
            computed: written.incomplete,
            configuration: written.configuration.into_shared(),
            external_axes: written.external_axes,
            rides_along: false,
            uses: Vec::new(),
        });
        self.targets.len() - 1
    }

    fn push(&mut self, step: &Step<'_>, name: Option<String>, span: Span, why: Unwritten) -> usize {
        self.configured.push(false);
        self.targets.push(Target {
            file: step.statement.file,
            name,
            span,
            value: TargetValue::Unwritten,
            computed: Some(why.0),
            configuration: Configuration::unsaid(),
            external_axes: Vec::new(),
            rides_along: false,
            uses: Vec::<Use>::new(),
        });
        self.targets.len() - 1
    }

    /// Says that a brace does not close.
    pub fn broken(&mut self, file: usize, unclosed: Unclosed) {
        let source = &self.job.sources[file];
        let finding = match source.bytes()[unclosed.0.end.min(source.bytes().len())..].trim_ascii().is_empty() {
            true => Diagnostic::error("truncated", "the text stops in the middle of a position"),
            false => Diagnostic::error("malformed-position", "the brace of a position does not close"),
        };
        self.diagnostics.push(finding.at(file, unclosed.0, "this position is not complete"));
    }
}

/// Why a target has no numbers.
struct Unwritten(String);

/// The settings that a use names.
pub(super) fn named(name: &str) -> Reference {
    Reference::Named(Arc::from(name))
}

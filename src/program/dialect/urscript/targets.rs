//! From moves to targets: poses and joint lists, poses in a constant frame, displacements of other targets.

use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::sync::Arc;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Span;
use crate::program::target::{
    CartesianNumbers, Configuration, Definition, Displacement, DisplacementKind, FrameData, Mention, Program,
    Reference, Target, TargetValue, Use,
};

use super::expression::{Composed, File, Goal, shortened};
use super::value::{Literal, literal};

/// A move with its goal.
pub(super) struct Found {
    /// Where to.
    pub goal: Goal,
    /// From `qnear`.
    pub near_joints_deg: Option<[f64; 6]>,
    /// The argument.
    pub place: Span,
    /// The move.
    pub one: Use,
}

/// What all compositions of a file say together: by the second pose, what makes the first.
#[derive(Default)]
struct Shared {
    frames_of: HashMap<usize, HashSet<Vec<usize>>>,
}

/// The targets of a file while they are collected.
pub(super) struct Targets<'a> {
    file: File<'a>,
    first: usize,
    /// By the first token of their list.
    by_start: HashMap<usize, usize>,
}

/// Adds the targets of the moves of a file.
pub(super) fn collect(file: File<'_>, found: &[Found], program: &mut Program) {
    let mut targets = Targets { file, first: program.targets.len(), by_start: HashMap::new() };
    for one in found.iter().filter(|one| !matches!(one.goal, Goal::Composed(_))) {
        targets.plain(one, program);
    }
    let mut shared = Shared::default();
    for one in found {
        if let Goal::Composed(composed) = &one.goal {
            shared.frames_of.entry(composed.to.start).or_default().insert(composed.parts.clone());
        }
    }
    for one in found {
        if let Goal::Composed(composed) = &one.goal {
            targets.composed(one, composed, &shared, program);
        }
    }
    targets.in_order(program);
    program.note_replaceable(&named_in_moves(&file, found));
}

/// Where moves name a pose: the pose itself may stand there.
fn named_in_moves(file: &File<'_>, found: &[Found]) -> Vec<((usize, Span), Mention)> {
    let is_name = |place: Span| {
        file.text.source.slice(place).iter().all(|byte| byte.is_ascii_alphanumeric() || *byte == b'_' || *byte >= 0x80)
    };
    let mention = |found: &Found| match &found.goal {
        Goal::Written(list, _) if is_name(found.place) => {
            Some(((file.file, file.text.span(list)), (file.file, found.place)))
        }
        _ => None,
    };
    found.iter().filter_map(mention).collect()
}

impl Targets<'_> {
    /// A move to a list, or to something that is known only at run time.
    fn plain(&mut self, found: &Found, program: &mut Program) {
        match &found.goal {
            Goal::Written(list, name) => {
                let index = self.listed(list, name.as_ref(), program);
                let target = &mut program.targets[index];
                if target.configuration.near_joints_deg.is_none() {
                    Arc::make_mut(&mut target.configuration).near_joints_deg = found.near_joints_deg;
                }
                target.add_use(found.one.clone());
            }
            Goal::Runtime(reason) => self.runtime(found, reason.clone(), program),
            Goal::Composed(_) => {}
        }
    }

    fn runtime(&self, found: &Found, reason: String, program: &mut Program) {
        let mut target = self.target(found.place, None, TargetValue::Unwritten);
        target.computed = Some(reason);
        target.add_use(found.one.clone());
        program.targets.push(target);
    }

    fn target(&self, span: Span, name: Option<String>, value: TargetValue) -> Target {
        Target {
            file: self.file.file,
            name,
            span,
            value,
            computed: None,
            configuration: Configuration::unsaid(),
            external_axes: Vec::new(),
            rides_along: false,
            uses: Vec::new(),
        }
    }

    /// The target of a literal list.
    fn listed(&mut self, list: &Range<usize>, name: Option<&String>, program: &mut Program) -> usize {
        if let Some(&index) = self.by_start.get(&list.start) {
            return index;
        }
        let text = self.file.text;
        let span = text.span(list);
        let mut target = self.target(span, name.cloned(), TargetValue::Unwritten);
        match literal(text, list) {
            Some(Literal::Pose(numbers)) => target.value = TargetValue::Cartesian(numbers),
            Some(Literal::Joints(numbers)) => target.value = TargetValue::Joint(numbers),
            Some(Literal::Count(count)) => {
                let message = format!("a move goes to a list of {count} numbers; a pose and a joint list have six");
                program.diagnostics.push(Diagnostic::error("list-length", message).at(self.file.file, span, ""));
                target.computed = Some(format!("a list of {count} numbers"));
            }
            Some(Literal::Expression(at)) => {
                let element = text.tokens.get(at).map(|token| text.source.text(token.span)).unwrap_or_default();
                target.computed = Some(format!("an element of the list is computed (`{element}`)"));
            }
            None => target.computed = Some("it is computed".into()),
        }
        program.targets.push(target);
        self.by_start.insert(list.start, program.targets.len() - 1);
        program.targets.len() - 1
    }

    /// A move to `pose_trans(from, to)`.
    fn composed(&mut self, found: &Found, composed: &Composed, shared: &Shared, program: &mut Program) {
        let text = self.file.text;
        let Some(Literal::Pose(numbers)) = literal(text, &composed.to) else {
            return self.runtime(found, "the second pose of `pose_trans` is computed".into(), program);
        };
        // A part that is itself the second pose of a composition gets other numbers, and the frame would move.
        if composed.parts.iter().any(|part| shared.frames_of.contains_key(part)) {
            return self.runtime(found, "its frame is made of a pose that is itself a target".into(), program);
        }
        let bases: Vec<usize> = composed.parts.iter().filter_map(|part| self.moved_to(*part, program)).collect();
        let frames = shared.frames_of.get(&composed.to.start).map_or(0, HashSet::len);
        match (&bases[..], composed.parts.len()) {
            ([], _) => self.in_frame(found, composed, program),
            ([base], 1) if frames == 1 && matches!(program.targets[*base].value, TargetValue::Cartesian(_)) => {
                self.displaced(found, composed, *base, *numbers, program);
            }
            ([_], 1) => {
                let reason = "the second pose of `pose_trans` displaces several targets: no single value serves all";
                self.runtime(found, reason.into(), program);
            }
            _ => self.runtime(found, "its frame is made of a pose that is itself a target".into(), program),
        }
    }

    /// The target that a move goes to directly, by the first token of its list.
    fn moved_to(&self, start: usize, program: &Program) -> Option<usize> {
        let index = self.by_start.get(&start).copied()?;
        matches!(program.targets[index].value, TargetValue::Cartesian(_) | TargetValue::Joint(_)).then_some(index)
    }

    /// The first pose is a frame: no move goes there.
    fn in_frame(&mut self, found: &Found, composed: &Composed, program: &mut Program) {
        let text = self.file.text;
        let file = self.file.file;
        let line = text.source.line(text.span(&composed.from).start);
        let name = format!("{} in line {line}", shortened(&text.show(&composed.from)));
        let frame = FrameData { pose: composed.frame, held_by_robot: false, on: None };
        let definition = Definition { file, span: text.span(&composed.from), value: Ok(frame) };
        program.frames.insert(Program::key(&name), definition);
        let index = self.listed(&composed.to, composed.name.as_ref(), program);
        let one = found.one.clone().in_frame(Reference::Named(name.into()));
        let near = &mut Arc::make_mut(&mut program.targets[index].configuration).near_joints_deg;
        *near = near.or(found.near_joints_deg);
        program.targets[index].add_use(one);
    }

    /// The first pose is a target of its own: the second displaces it.
    fn displaced(
        &mut self,
        found: &Found,
        composed: &Composed,
        base: usize,
        numbers: CartesianNumbers,
        program: &mut Program,
    ) {
        if let Some(&index) = self.by_start.get(&composed.to.start) {
            match program.targets[index].value {
                TargetValue::Displaced(_) => program.targets[index].add_use(found.one.clone()),
                _ => self.runtime(found, "a move goes to the second pose of `pose_trans` as well".into(), program),
            }
            return;
        }
        let Some(pose) = numbers.pose() else {
            return self.runtime(found, "its numbers make no pose".into(), program);
        };
        let displacement = Displacement {
            base,
            kind: DisplacementKind::Tool,
            position: numbers.position,
            rotation: pose.rotation,
            units: numbers.units,
        };
        let value = TargetValue::Displaced(Box::new(displacement));
        let mut target = self.target(self.file.text.span(&composed.to), composed.name.clone(), value);
        Arc::make_mut(&mut target.configuration).near_joints_deg = found.near_joints_deg;
        target.add_use(found.one.clone());
        program.targets.push(target);
        self.by_start.insert(composed.to.start, program.targets.len() - 1);
    }

    /// Sorts the file's targets by their place; displacements keep pointing at their base.
    fn in_order(self, program: &mut Program) {
        let own = program.targets.split_off(self.first);
        let mut placed: Vec<(usize, Target)> = own.into_iter().enumerate().collect();
        placed.sort_by_key(|(index, target)| (target.span, *index));
        let mut new_place = vec![0; placed.len()];
        for (place, (index, _)) in placed.iter().enumerate() {
            new_place[*index] = self.first + place;
        }
        for (_, mut target) in placed {
            if let TargetValue::Displaced(displacement) = &mut target.value {
                displacement.base = new_place[displacement.base - self.first];
            }
            program.targets.push(target);
        }
    }
}

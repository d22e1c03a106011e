//! Values of variables, from the sections of locations and from `POINT` statements.

use std::collections::HashMap;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::geometry::pose::Pose;
use crate::program::number::NumberField;
use crate::program::scan::Cursor;
use crate::program::target::{ExternalAxis, JointNumbers, Program, TargetValue, Units};

use super::expression::{Expression, Index, Name, Number, Term, name, pose_numbers, six, trans, turn};

/// A program of the job: file and place in it.
pub(super) type Scope = (usize, usize);
/// The scope of a local variable, and its name with index in lower case.
pub(super) type Key = (Option<Scope>, String);

/// The robot's axes; values behind them belong to additional ones.
const ROBOT_AXES: usize = 6;

/// The value of a variable as the text has it.
#[derive(Clone, Debug)]
pub(super) struct Value {
    /// File of the job.
    pub file: usize,
    /// From the name or the literal's first letter to the last number.
    pub span: Span,
    /// The variable as written there.
    pub shown: String,
    /// Its numbers.
    pub value: TargetValue,
    /// Why they are not those at run time, if so.
    pub computed: Option<String>,
    /// Values of further axes.
    pub external_axes: Vec<ExternalAxis>,
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub(super) enum Found {
    /// A value; several where the index is known only at run time.
    Values(Vec<usize>),
    /// None in the job, with the reason and whether a cell file may know the name.
    Unknown(String, bool),
}

/// All values.
#[derive(Debug, Default)]
pub(super) struct Values {
    /// In the order in which they were read.
    pub all: Vec<Value>,
    by_key: HashMap<Key, usize>,
    elements: HashMap<Key, Vec<usize>>,
    changed: HashMap<Key, String>,
}

/// The key of a name in a program.
pub(super) fn key(name: &Name, scope: Scope) -> Key {
    (name.is_local().then_some(scope), name.key())
}

impl Values {
    /// A line of `.TRANS` or `.JOINTS`: `name[1,2] x y z o a t`, `#name 1 2 3 4 5 6`.
    pub fn read_line(&mut self, source: &Source, file: usize, line: Span, program: &mut Program) {
        let mut cursor = Cursor::new(source.bytes(), line);
        cursor.skip_blanks();
        let Some(name) = name(&mut cursor) else { return };
        let mut numbers = Vec::new();
        loop {
            cursor.skip_while(|byte| matches!(byte, b' ' | b'\t' | b','));
            let Some(field) = cursor.number() else { break };
            numbers.push(field);
        }
        let span = Span::new(name.span.start, numbers.last().map_or(name.span.end, |last| last.span().end));
        let (value, external_axes) = written(numbers, name.base.starts_with('#'));
        let computed =
            matches!(value, TargetValue::Unwritten).then(|| "its line holds fewer than six numbers".to_owned());
        if computed.is_some() {
            let message = format!("`{}` has fewer than six numbers", source.text(name.span));
            program.diagnostics.push(Diagnostic::error("broken-location", message).at(file, span, ""));
        }
        let shown = source.text(name.span).into_owned();
        let key = (None, name.key());
        if self.by_key.contains_key(&key) {
            let message = format!("`{shown}` is given twice: the later one holds");
            program.diagnostics.push(Diagnostic::warning("duplicate-location", message).at(file, span, ""));
        }
        self.set(key, Value { file, span, shown, value, computed, external_axes });
    }

    /// Gives a variable its value.
    pub fn set(&mut self, key: Key, value: Value) {
        self.by_key.insert(key, self.all.len());
        self.all.push(value);
    }

    /// Notes that a variable, or all elements of an array, are set at run time.
    pub fn mark_changed(&mut self, key: Key, reason: String) {
        if let Some(&index) = self.by_key.get(&key) {
            self.all[index].computed.get_or_insert_with(|| reason.clone());
        }
        self.changed.entry(key).or_insert(reason);
    }

    /// To be called when all values and changes are known.
    pub fn finish(&mut self) {
        for ((scope, name), &index) in &self.by_key {
            if let Some((base, _)) = name.split_once('[') {
                let array = (*scope, base.to_owned());
                if let Some(reason) = self.changed.get(&array) {
                    self.all[index].computed.get_or_insert_with(|| reason.clone());
                }
                self.elements.entry(array).or_default().push(index);
            }
        }
        self.elements.values_mut().for_each(|elements| elements.sort_unstable());
    }

    /// What a name stands for in a program.
    pub fn find(&self, name: &Name, scope: Scope) -> Found {
        let key = key(name, scope);
        if name.index == Index::Variable {
            if let Some(elements) = self.elements.get(&key) {
                return Found::Values(elements.clone());
            }
        } else if let Some(&index) = self.by_key.get(&key) {
            return Found::Values(vec![index]);
        }
        let array = (key.0, name.base.clone());
        if let Some(reason) = self.changed.get(&key).or_else(|| self.changed.get(&array)) {
            return Found::Unknown(reason.clone(), false);
        }
        match name.is_local() {
            true => Found::Unknown("it is a parameter or local variable, known only at run time".into(), false),
            false => Found::Unknown("the job holds no value for it".into(), name.index != Index::Variable),
        }
    }

    /// The only value of a name.
    pub fn single(&self, name: &Name, scope: Scope) -> Option<&Value> {
        match self.find(name, scope) {
            Found::Values(all) if all.len() == 1 && name.index != Index::Variable => Some(&self.all[all[0]]),
            _ => None,
        }
    }

    /// A location that is a constant.
    ///
    /// # Errors
    /// Why it is none, and whether a cell file may know it.
    pub fn pose(&self, terms: &[Term], scope: Scope) -> Result<Pose, (String, bool)> {
        let unknown = |reason: &str| (reason.to_owned(), false);
        let mut product = Pose::identity();
        for term in terms {
            let factor = match term {
                Term::Null => Pose::identity(),
                Term::Trans(_, numbers) => trans(numbers).ok_or_else(|| unknown("it is computed"))?,
                Term::Turn(axis, angle) => turn(*axis, angle.value().ok_or_else(|| unknown("it is computed"))?),
                Term::Name(name) => self.named_pose(name, scope, terms.len() == 1)?,
                Term::Joints(..) | Term::Shift(..) | Term::Frame(_) => return Err(unknown("it is computed")),
            };
            product = product * factor;
        }
        Ok(product)
    }

    fn named_pose(&self, name: &Name, scope: Scope, alone: bool) -> Result<Pose, (String, bool)> {
        match self.find(name, scope) {
            Found::Unknown(reason, cell) => Err((format!("`{}`: {reason}", name.key()), cell && alone)),
            Found::Values(_) => {
                let value = self.single(name, scope);
                let value =
                    value.ok_or_else(|| (format!("`{}` has an index known only at run time", name.key()), false))?;
                match (&value.value, &value.computed) {
                    (_, Some(reason)) => Err((format!("`{}`: {reason}", name.key()), false)),
                    (TargetValue::Cartesian(numbers), None) => {
                        numbers.pose().ok_or_else(|| ("its numbers make no pose".to_owned(), false))
                    }
                    _ => Err((format!("`{}` is no pose", name.key()), false)),
                }
            }
        }
    }
}

/// The value that an assignment or motion writes out, if it does.
pub(super) fn literal(source: &Source, file: usize, shown: &str, expression: &Expression) -> Option<Value> {
    let (span, numbers, joints) = match expression.terms.as_deref()? {
        [Term::Trans(span, numbers)] => (*span, numbers, false),
        [Term::Joints(span, numbers)] => (*span, numbers, true),
        _ => return None,
    };
    literal_numbers(source, file, shown, span, numbers, joints)
}

/// The same for the numbers of a bracket.
pub(super) fn literal_numbers(
    source: &Source,
    file: usize,
    shown: &str,
    span: Span,
    numbers: &[Number],
    joints: bool,
) -> Option<Value> {
    let written_fields: Option<Vec<NumberField>> = numbers
        .iter()
        .map(|number| match number {
            Number::Written(field) => Some(field.clone()),
            _ => None,
        })
        .collect();
    let (value, external_axes) = written(written_fields?, joints);
    debug_assert!(source.bytes().len() >= span.end);
    (!matches!(value, TargetValue::Unwritten)).then(|| Value {
        file,
        span,
        shown: shown.to_owned(),
        value,
        computed: None,
        external_axes,
    })
}

fn written(mut numbers: Vec<NumberField>, joints: bool) -> (TargetValue, Vec<ExternalAxis>) {
    let behind = numbers.split_off(numbers.len().min(ROBOT_AXES));
    let named = |(at, field): (usize, &NumberField)| ExternalAxis {
        name: format!("JT{}", at + ROBOT_AXES + 1),
        value: field.value,
    };
    let external_axes = behind.iter().enumerate().map(named).collect();
    let fields: Vec<Number> = numbers.into_iter().map(Number::Written).collect();
    let value = match six(&fields) {
        Some(joint_fields) if joints => {
            TargetValue::Joint(Box::new(JointNumbers { joints: joint_fields, units: Units::MM_DEG }))
        }
        Some(fields) => TargetValue::Cartesian(Box::new(pose_numbers(fields))),
        None => TargetValue::Unwritten,
    };
    (value, external_axes)
}

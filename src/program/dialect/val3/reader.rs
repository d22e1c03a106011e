//! All files of an application: data becomes targets, moves their uses.

use std::collections::HashMap;
use std::ops::Range;

use crate::base::text::Source;
use crate::geometry::orientation::OrientationConvention;
use crate::program::gather::{Gathered, plain};
use crate::program::number::{NumberField, number_at};
use crate::program::target::{
    Displacement, DisplacementKind, JointNumbers, Program, Reference, Target, TargetValue, Units, Use, Way,
};

use super::change::Changes;
use super::code::{Kind as Token, Text};
use super::data::{self, Data, Kind, Value};
use super::moves::{Move, moves};
use super::program_file::{self, Code};
use super::tree::{define, father, shown};

/// Reads the files of a folder.
pub(super) fn read(sources: &[Source]) -> Program {
    let mut program = Program::default();
    let mut data = Data::default();
    let mut programs = Vec::new();
    for (file, source) in sources.iter().enumerate() {
        data::read(source, file, &mut data, &mut program);
        programs.extend(program_file::read(source, file, &mut program));
    }
    let texts: Vec<Text<'_>> = programs.iter().map(|code| Text::of(&sources[code.file], code.text)).collect();
    let changes = Changes::of(&programs, &texts);
    define(&data, &changes, &mut program);
    let numbers = data.0.iter().flat_map(|(base, variable)| variable.values.keys().map(move |key| (base, key)));
    let numbers = numbers.enumerate().map(|(number, (base, key))| ((base.clone(), key.clone()), number)).collect();
    let mut reader = Reader { data: &data, changes: &changes, numbers, targets: Gathered::default() };
    for (code, text) in programs.iter().zip(&texts) {
        for one in moves(text) {
            reader.read_move(code, text, &one);
        }
    }
    reader.targets.finish(&mut program);
    program
}

struct Reader<'a> {
    data: &'a Data,
    changes: &'a Changes,
    /// Every element of the data has a number, by which its target is found again.
    numbers: HashMap<(String, String), usize>,
    targets: Gathered,
}

impl Reader<'_> {
    fn read_move(&mut self, code: &Code, text: &Text<'_>, one: &Move) {
        let tool = match &one.tool {
            None => Reference::Unnamed,
            Some(range) => match text.only_name(range) {
                Some(name) if code.own_names.contains(&name.base) => {
                    Reference::Runtime(format!("the tool `{}` is a parameter or local variable", name.base))
                }
                Some(name) => match name.key {
                    Some(key) => Reference::Named(shown(&name.base, &key).into()),
                    None => {
                        Reference::Runtime(format!("which element of `{}` is the tool is not in the text", name.base))
                    }
                },
                None => Reference::Runtime(format!("the tool is computed: `{}`", text.show(range))),
            },
        };
        for (range, path) in &one.goals {
            let used = Use::new(
                code.file,
                text.span(&one.tokens),
                Way {
                    motion: one.word.as_str().into(),
                    path: *path,
                    tool: tool.clone(),
                    frame: Reference::Unnamed,
                    grip_load: Reference::Unnamed,
                    computed: one.computed.clone(),
                },
            );
            if let Err(reason) = self.goal(code, text, range, &used) {
                self.targets.unwritten(&text.show(range), text.span(range), reason, used);
            }
        }
    }

    fn goal(&mut self, code: &Code, text: &Text<'_>, range: &Range<usize>, used: &Use) -> Result<(), String> {
        if let Some(target) = literal(text, code.file, range) {
            let target = self.targets.inline(target);
            let frame = if target.kind() == "joint" { Reference::Unnamed } else { father(None) };
            target.add_use(used.clone().in_frame(frame));
            return Ok(());
        }
        if text.word(range.start) == b"appro" && text.is(range.start + 1, b'(') {
            return self.appro(code, text, range, used);
        }
        let Some(name) = text.only_name(range) else { return Err("it is computed".into()) };
        let values = self.values(code, &name.base, name.key.as_deref())?;
        for (key, value) in values {
            self.use_value(&name.base, &key, &value, used.clone());
        }
        Ok(())
    }

    /// The elements that a name stands for.
    fn values(&self, code: &Code, base: &str, key: Option<&str>) -> Result<Vec<(String, Value)>, String> {
        if code.own_names.contains(base) {
            return Err("it is a parameter or local variable, known only at run time".into());
        }
        let Some(variable) = self.data.0.get(base) else { return Err("no data file of the job holds it".into()) };
        if !matches!(variable.kind, Kind::Point | Kind::Joint) {
            return Err(format!("`{base}` is no position"));
        }
        let Some(key) = key else {
            let all: Vec<_> = variable.values.iter().map(|(key, value)| (key.clone(), value.clone())).collect();
            return if all.is_empty() { Err("no element of it is written in the data file".into()) } else { Ok(all) };
        };
        match (variable.values.get(key), self.changes.reason(base, key)) {
            (Some(value), _) => Ok(vec![(key.to_owned(), value.clone())]),
            (None, Some(reason)) => Err(reason.clone()),
            (None, None) => Err("its value is not written in the data file: all its numbers are zero".into()),
        }
    }

    fn use_value(&mut self, base: &str, key: &str, value: &Value, mut used: Use) {
        let joint = matches!(value.numbers, TargetValue::Joint(_));
        if !joint {
            used.frame = father(value.father.as_deref());
        }
        let number = self.numbers.get(&(base.to_owned(), key.to_owned())).copied().unwrap_or_default();
        let changed = self.changes.reason(base, key);
        self.targets.add_use(number, used, || Target {
            name: Some(value.shown.clone()),
            computed: value.broken.as_ref().or(changed).cloned(),
            configuration: value.configuration.clone().into_shared(),
            ..plain(value.file, value.span, value.numbers.clone())
        });
    }

    /// `appro(p,{0,0,-100,0,0,0})` moves with p, and is corrected on top where its numbers are written.
    fn appro(&mut self, code: &Code, text: &Text<'_>, range: &Range<usize>, used: &Use) -> Result<(), String> {
        let Some((arguments, _)) = text.parts(range.start + 1).filter(|(_, close)| close + 1 == range.end) else {
            return Err("it is computed".into());
        };
        let [point, by] = &arguments[..] else {
            return Err("`appro` takes a point and a transformation".into());
        };
        let Some(name) = text.only_name(point) else { return Err("it is computed".into()) };
        let values = self.values(code, &name.base, name.key.as_deref())?;
        let written = numbers(text, by).and_then(|fields| <[NumberField; 6]>::try_from(fields).ok());
        if let ([(key, value)], Some(fields)) = (&values[..], written)
            && self.changes.reason(&name.base, key).is_none()
            && matches!(value.numbers, TargetValue::Cartesian(_))
        {
            let used = used.clone().in_frame(father(value.father.as_deref()));
            let base = self.numbers.get(&(name.base, key.clone())).copied().unwrap_or_default();
            let turn = data::pose(fields.clone()).pose().map(|pose| pose.rotation);
            let [x, y, z, ..] = fields;
            let displacement = Displacement {
                base,
                kind: DisplacementKind::Tool,
                position: [x, y, z],
                rotation: turn.unwrap_or_else(nalgebra::Matrix3::identity),
                units: Units::MM_DEG,
            };
            let value = TargetValue::Displaced(Box::new(displacement));
            let (name, span) = (Some(text.show(range)), text.span(by));
            self.targets.inline(Target { name, uses: vec![used], ..plain(code.file, span, value) });
            return Ok(());
        }
        let reason = format!("displaced by `{}`: it moves with the point", text.show(by));
        for (key, value) in values {
            let used = used.clone().computed_by(reason.clone());
            self.use_value(&name.base, &key, &value, used);
        }
        Ok(())
    }
}

/// `{j1,..,j6}`, `{{x,y,z,rx,ry,rz},{lefty,epositive,wpositive}}`.
fn literal(text: &Text<'_>, file: usize, range: &Range<usize>) -> Option<Target> {
    if !text.is(range.start, b'{') {
        return None;
    }
    let span = text.span(range);
    if let Some(fields) = numbers(text, range) {
        let joints = fields.try_into().ok()?;
        let value = TargetValue::Joint(Box::new(JointNumbers { joints, units: Units::MM_DEG }));
        return Some(plain(file, span, value));
    }
    let (parts, close) = text.parts(range.start)?;
    let [pose, config] = &parts[..] else { return None };
    if close + 1 != range.end {
        return None;
    }
    let numbers = data::pose(numbers(text, pose)?.try_into().ok()?);
    debug_assert_eq!(numbers.convention, OrientationConvention::EulerXyz);
    let words = text.parts(config.start).map(|(parts, _)| parts).unwrap_or_default();
    let word = |wanted: &str| {
        let place = ["shoulder", "elbow", "wrist"].iter().position(|name| *name == wanted)?;
        words.get(place).map(|range| text.show(range))
    };
    let configuration = data::configuration(word).into_shared();
    Some(Target { configuration, ..plain(file, span, TargetValue::Cartesian(Box::new(numbers))) })
}

/// Numbers in braces; `None` when one is none.
fn numbers(text: &Text<'_>, range: &Range<usize>) -> Option<Vec<NumberField>> {
    let (parts, close) = text.is(range.start, b'{').then(|| text.parts(range.start))??;
    if close + 1 != range.end {
        return None;
    }
    parts.iter().map(|part| number(text, part)).collect()
}

/// A number with a sign directly before it.
fn number(text: &Text<'_>, part: &Range<usize>) -> Option<NumberField> {
    let signed = part.len() == 2 && (text.is(part.start, b'-') || text.is(part.start, b'+'));
    let (kind, last) = text.tokens.get(part.end.checked_sub(1)?)?;
    if *kind != Token::Number || !(signed || part.len() == 1) {
        return None;
    }
    let field = number_at(text.source.bytes(), text.tokens[part.start].1.start)?;
    (field.span().end == last.end).then_some(field)
}

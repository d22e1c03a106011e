//! Tools, work objects and loads that a job declares, and what a name in a move refers to.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;
use std::sync::Arc;

use nalgebra::Vector3;

use crate::base::text::Span;
use crate::geometry::orientation::OrientationConvention;
use crate::geometry::pose::Pose;
use crate::program::target::{Definition, FrameData, LoadData, Program, Reference, ToolData};

use super::argument::{list, number, values};
use super::change::{Changes, element_at};
use super::statement::FileText;
use super::symbol::{Job, Lookup, Scope, Storage};
use super::token::TokenKind;

/// The key under which the declaration of each symbol is filed in the [`Program`].
pub struct DefinitionKeys(HashMap<usize, String>);

/// Reads every `tooldata`, `wobjdata` and `loaddata` of the job, and the predefined `tool0`, `wobj0`, `load0`.
pub fn read_definitions(job: &Job, changes: &Changes, program: &mut Program) -> DefinitionKeys {
    let mut keys = DefinitionKeys(HashMap::new());
    for (index, symbol) in job.symbols.iter().enumerate() {
        if matches!(symbol.storage, Storage::Parameter | Storage::Reference) {
            continue;
        }
        match symbol.data_type.as_str() {
            "tooldata" => define(job, changes, index, &mut program.tools, &mut keys, tool),
            "wobjdata" => define(job, changes, index, &mut program.frames, &mut keys, frame),
            "loaddata" => define(job, changes, index, &mut program.loads, &mut keys, load),
            _ => {}
        }
    }
    let identity = Pose::identity();
    predefine(&mut program.tools, "tool0", ToolData { pose: identity, held_by_robot: true, load: None });
    predefine(&mut program.frames, "wobj0", FrameData { pose: identity, held_by_robot: false, on: None });
    predefine(&mut program.loads, "load0", LoadData { mass_kg: 0.0, center_of_mass_m: [0.0; 3] });
    keys
}

fn predefine<T>(map: &mut BTreeMap<String, Definition<T>>, key: &str, value: T) {
    map.entry(key.into()).or_insert(Definition { file: 0, span: Span::default(), value: Ok(value) });
}

fn define<T>(
    job: &Job,
    changes: &Changes,
    index: usize,
    map: &mut BTreeMap<String, Definition<T>>,
    keys: &mut DefinitionKeys,
    read: impl Fn(&FileText, &Range<usize>) -> Result<T, String>,
) {
    let symbol = &job.symbols[index];
    let text = &job.files[symbol.scope.file];
    let name = Program::key(&symbol.display);
    // Modules may each have a local one of the same name: the later ones are filed under their module's number.
    let taken = map.contains_key(&name) || map.contains_key(&format!("{name}{{1}}"));
    let key = if taken { format!("{name}@{}.{index}", symbol.scope.module) } else { name };
    let span = text.span(&symbol.tokens);
    let mut add = |label: &str, value: Result<T, String>| {
        let changed = changes.reason(index, label).map(str::to_owned);
        let value = changed.map_or(value, Err);
        map.insert(format!("{key}{label}"), Definition { file: symbol.scope.file, span, value });
    };
    if symbol.value.is_none() {
        add("", Err(format!("`{}` is declared without a value", symbol.display)));
    }
    for (label, range) in job.elements(index) {
        add(&label, read(text, &range));
    }
    keys.0.insert(index, key);
}

impl DefinitionKeys {
    /// What an argument of type `tooldata`, `wobjdata` or `loaddata` refers to.
    pub fn reference(&self, job: &Job, text: &FileText, range: &Range<usize>, scope: Scope) -> Reference {
        let start = range.start;
        if range.is_empty() || text.kind(start) != Some(TokenKind::Name) {
            return Reference::Runtime(format!("written as an expression in line {}", text.line(start)));
        }
        let written = text.source.text(text.span(range)).into_owned();
        // Reports show the name as its declaration spells it; only names that several modules share need their key.
        let named = |key: String, spelled: &str| match Program::key(spelled) == key {
            true => Reference::Named(Arc::from(spelled)),
            false => Reference::Named(Arc::from(key)),
        };
        let symbol = match job.symbol(&text.key(start), scope) {
            Lookup::Found(index) => index,
            Lookup::Ambiguous => return Reference::Runtime(format!("several modules declare `{written}`")),
            // Names such as `Gripper(Closed)` are filed whole; what is declared nowhere is left to the cell file.
            Lookup::Unknown => match job.symbol(&Program::key(&written), scope) {
                Lookup::Found(index) => return named(self.key_of(index, &written), &job.symbols[index].display),
                _ if job.routine(&text.key(start), scope).is_some() => {
                    return Reference::Runtime(format!("`{written}` is a function"));
                }
                _ => return named(Program::key(&written), &written),
            },
        };
        let declared = &job.symbols[symbol];
        if matches!(declared.storage, Storage::Parameter | Storage::Reference) {
            return Reference::Runtime(format!("`{}` is a parameter of the routine", declared.display));
        }
        if range.len() == 1 {
            return named(self.key_of(symbol, &written), &declared.display);
        }
        match element_at(text, start + 1, range.end) {
            Some(label) if text.is_symbol(range.end - 1, b'}') => {
                let spelled = format!("{}{label}", declared.display);
                named(format!("{}{label}", self.key_of(symbol, &declared.display)), &spelled)
            }
            _ => Reference::Runtime(format!("`{written}` depends on a variable")),
        }
    }

    fn key_of(&self, symbol: usize, written: &str) -> String {
        self.0.get(&symbol).cloned().unwrap_or_else(|| Program::key(written))
    }
}

/// `[[x, y, z], [q1, q2, q3, q4]]`, millimetres.
fn pose(text: &FileText, range: &Range<usize>) -> Result<Pose, String> {
    let parts = list(text, range).unwrap_or_default();
    let [place, turn] = parts.as_slice() else { return Err("its pose is not written out".into()) };
    let (Some(position), Some(quaternion)) = (values::<3>(text, place), values::<4>(text, turn)) else {
        return Err("its pose is not written in numbers".into());
    };
    let rotation = OrientationConvention::QuaternionWxyz.rotation(&quaternion);
    let rotation = rotation.ok_or("its orientation is a quaternion without length")?;
    Ok(Pose { rotation, translation: Vector3::from(position) / 1000.0 })
}

fn truth(text: &FileText, range: &Range<usize>) -> Result<bool, String> {
    match (text.is_word(range.start, &["TRUE"]), text.is_word(range.start, &["FALSE"])) {
        (true, _) if range.len() == 1 => Ok(true),
        (_, true) if range.len() == 1 => Ok(false),
        _ => Err("it is not said whether the robot holds it".into()),
    }
}

/// `[robhold, pose, load]`
fn tool(text: &FileText, range: &Range<usize>) -> Result<ToolData, String> {
    let parts = list(text, range).unwrap_or_default();
    let [held, place, weight] = parts.as_slice() else { return Err("the tool is not written out".into()) };
    Ok(ToolData { held_by_robot: truth(text, held)?, pose: pose(text, place)?, load: load(text, weight).ok() })
}

/// `[robhold, ufprog, ufmec, uframe, oframe]`: the object frame stands in the user frame.
fn frame(text: &FileText, range: &Range<usize>) -> Result<FrameData, String> {
    let parts = list(text, range).unwrap_or_default();
    let [held, fixed, unit, user, object] = parts.as_slice() else {
        return Err("the work object is not written out".into());
    };
    let unit_text = text.source.text(text.span(unit));
    let unit_name = unit_text.trim_matches('"').trim();
    let held_by_robot = truth(text, held)?;
    // The controller computes the user frame of a mechanical unit; what the text has for it does not count.
    if !unit_name.is_empty() {
        return Ok(FrameData { held_by_robot, pose: pose(text, object)?, on: Some(Arc::from(unit_name)) });
    }
    if !truth(text, fixed)? {
        return Err("moved by a mechanical unit".into());
    }
    Ok(FrameData { held_by_robot, pose: pose(text, user)? * pose(text, object)?, on: None })
}

/// `[mass, cog, aom, ix, iy, iz]`, kilograms and millimetres.
fn load(text: &FileText, range: &Range<usize>) -> Result<LoadData, String> {
    let parts = list(text, range).unwrap_or_default();
    let (Some(mass), Some(center)) = (parts.first(), parts.get(1)) else {
        return Err("the load is not written out".into());
    };
    match (number(text, mass), values::<3>(text, center)) {
        (Some(mass), Some(center)) => {
            Ok(LoadData { mass_kg: mass.value, center_of_mass_m: center.map(|millimetres| millimetres / 1000.0) })
        }
        _ => Err("the load is not written in numbers".into()),
    }
}

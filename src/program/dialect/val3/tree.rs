//! The trees of frames and tools: each stands in its father, up to `world` and `flange`.

use crate::base::text::Span;
use crate::geometry::pose::Pose;
use crate::program::target::{Definition, FrameData, Program, Reference, TargetValue, ToolData};

use super::change::Changes;
use super::data::{Data, Kind, normal};

/// Longer chains of fathers are taken for circles.
const MAX_DEPTH: usize = 16;

const WORLD: &str = "world";
const FLANGE: &str = "flange";

/// Files the frames and tools of a job. One whose father is in no file of the job is left to the cell file.
pub(super) fn define(data: &Data, changes: &Changes, program: &mut Program) {
    let place = |value| Definition { file: 0, span: Span::default(), value };
    program
        .frames
        .insert(WORLD.into(), place(Ok(FrameData { pose: Pose::identity(), held_by_robot: false, on: None })));
    let flange = ToolData { pose: Pose::identity(), held_by_robot: true, load: None };
    program.tools.insert(FLANGE.into(), Definition { file: 0, span: Span::default(), value: Ok(flange) });
    for (base, variable) in &data.0 {
        for (key, value) in &variable.values {
            let name = Program::key(&shown(base, key));
            let (file, span) = (value.file, value.span);
            match variable.kind {
                Kind::Frame => {
                    if let Some(pose) = chain(data, changes, base, key, WORLD) {
                        let value = pose.map(|pose| FrameData { pose, held_by_robot: false, on: None });
                        program.frames.insert(name, Definition { file, span, value });
                    }
                }
                Kind::Tool => {
                    if let Some(pose) = chain(data, changes, base, key, FLANGE) {
                        let value = pose.map(|pose| ToolData { pose, held_by_robot: true, load: None });
                        program.tools.insert(name, Definition { file, span, value });
                    }
                }
                Kind::Point | Kind::Joint => {}
            }
        }
    }
}

/// The product of a chain of fathers, or why it is known only at run time; `None` when it leaves the job.
fn chain(data: &Data, changes: &Changes, base: &str, key: &str, root: &str) -> Option<Result<Pose, String>> {
    let (mut base, mut key, mut product) = (base.to_owned(), key.to_owned(), Pose::identity());
    for _ in 0..MAX_DEPTH {
        if base == root {
            return Some(Ok(product));
        }
        let value = data.0.get(&base)?.values.get(&key)?;
        if let Some(reason) = changes.reason(&base, &key) {
            return Some(Err(format!("`{}`: {reason}", value.shown)));
        }
        let TargetValue::Cartesian(numbers) = &value.numbers else {
            return Some(Err(format!("`{}` cannot be read", value.shown)));
        };
        product = numbers.pose()? * product;
        (base, key) = value.father.as_deref().map_or_else(|| (root.to_owned(), "0".to_owned()), split);
    }
    Some(Err(format!("`{base}` is its own father")))
}

/// `fPart[0]` as name and key.
fn split(father: &str) -> (String, String) {
    match father.trim().strip_suffix(']').and_then(|text| text.split_once('[')) {
        Some((base, key)) => (base.trim().to_owned(), normal(&key.replace('"', ""))),
        None => (father.trim().to_owned(), "0".to_owned()),
    }
}

/// The name of an element for people and cell files: `fPart`, `fPart[1]`.
pub(super) fn shown(base: &str, key: &str) -> String {
    if key == "0" { base.to_owned() } else { format!("{base}[{key}]") }
}

/// The frame of a point by its father.
pub(super) fn father(written: Option<&str>) -> Reference {
    let (base, key) = written.map_or_else(|| (WORLD.to_owned(), "0".to_owned()), split);
    Reference::Named(shown(&base, &key).into())
}

//! The tool, base and load of a motion, as the rest of the program names them.
//!
//! With `$IPO_MODE = #TCP` the two sides change places: `$BASE` is the stationary tool, `$TOOL` the work piece on the
//! flange, and positions are those of the one in the other.

use std::collections::BTreeMap;

use crate::geometry::pose::Pose;
use crate::program::shared::Shared;
use crate::program::target::{Definition, FrameData, PathKind, Program, Reference, ToolData, Use, Way};

use super::frames::{Frames, NULL_FRAME, WORLD};
use super::setting::{BASE, FOREIGN, LOAD, MODE, TOOL};
use super::targets::{Step, named};

/// The definitions that motions use.
#[derive(Default)]
pub(super) struct Settings {
    tools: BTreeMap<String, Definition<ToolData>>,
    frames: BTreeMap<String, Definition<FrameData>>,
    ways: Shared<Way>,
}

impl Settings {
    /// Hands the definitions over.
    pub fn finish(self, frames: Frames<'_, '_>, program: &mut Program) {
        program.tools.extend(self.tools);
        program.frames.extend(self.frames);
        program.flange_loads.extend(frames.loads);
    }
}

/// What a motion says about its tool, base and load.
pub(super) fn usage(step: &Step<'_>, path: PathKind, frames: &Frames<'_, '_>, settings: &mut Settings) -> Use {
    let setting = |index: usize| {
        let own = step.with.iter().rev().find(|(setting, _)| *setting == index).map(|(_, value)| value);
        own.unwrap_or_else(|| step.state.get(index)).clone()
    };
    // A routine that is not in the job may set what the job itself never does.
    let known = |index: usize, word: &str| match (setting(index), setting(FOREIGN)) {
        (Reference::Unnamed, Reference::Named(routine)) => {
            Reference::Runtime(format!("{word} may be set by `{routine}`, which is not in the files of this job"))
        }
        (own, _) => own,
    };
    let (tool, base) = (known(TOOL, "$TOOL"), known(BASE, "$BASE"));
    let (tool, frame) = match setting(MODE) {
        Reference::Runtime(reason) => {
            let reason = format!("$IPO_MODE: {reason}");
            (Reference::Runtime(reason.clone()), Reference::Runtime(reason))
        }
        Reference::Named(mode) if &*mode == "tcp" => stationary(tool, base, frames, settings),
        _ => (held_tool(tool, frames, settings), standing_base(base, frames, settings)),
    };
    let way = Way { motion: step.motion.word.clone(), path, tool, frame, grip_load: setting(LOAD), computed: None };
    Use::new(step.statement.file, step.statement.span, settings.ways.share(way))
}

fn held_tool(tool: Reference, frames: &Frames<'_, '_>, settings: &mut Settings) -> Reference {
    let Reference::Named(name) = &tool else { return tool };
    let short = number_of(name, "tool_data[");
    if let Some(pose) = frames.poses.get(&**name) {
        let tool = |pose: Pose| ToolData { pose, held_by_robot: true, load: None };
        settings.tools.entry(short.into()).or_insert_with(|| mapped(pose, tool));
    }
    named(short)
}

fn standing_base(base: Reference, frames: &Frames<'_, '_>, settings: &mut Settings) -> Reference {
    let Reference::Named(name) = &base else { return base };
    let root_t_world = frames.world_t_root.inverse();
    if matches!(&**name, WORLD | NULL_FRAME) && frames.world_t_root == Pose::identity() {
        return Reference::Unnamed;
    }
    let short = number_of(name, "base_data[");
    if let Some(pose) = frames.poses.get(&**name) {
        let frame = |pose: Pose| FrameData { pose: root_t_world * pose, held_by_robot: false, on: None };
        settings.frames.entry(short.into()).or_insert_with(|| mapped(pose, frame));
    }
    named(short)
}

/// Tool and frame of a move around a stationary tool.
fn stationary(
    work_piece: Reference,
    tool: Reference,
    frames: &Frames<'_, '_>,
    settings: &mut Settings,
) -> (Reference, Reference) {
    let root_t_world = frames.world_t_root.inverse();
    if let Reference::Named(name) = &tool
        && let Some(pose) = frames.poses.get(&**name)
    {
        let data = |pose: Pose| ToolData { pose: root_t_world * pose, held_by_robot: false, load: None };
        settings.tools.entry(name.to_string()).or_insert_with(|| mapped(pose, data));
    }
    if let Reference::Named(name) = &work_piece
        && let Some(pose) = frames.poses.get(&**name)
    {
        let data = |pose: Pose| FrameData { pose, held_by_robot: true, on: None };
        settings.frames.entry(name.to_string()).or_insert_with(|| mapped(pose, data));
    }
    let nothing = |side: &str| Reference::Runtime(format!("$IPO_MODE is #TCP, and {side} is set nowhere in this job"));
    let tool = if tool == Reference::Unnamed { nothing("$BASE") } else { tool };
    let work_piece = if work_piece == Reference::Unnamed { nothing("$TOOL") } else { work_piece };
    (tool, work_piece)
}

/// `3` for `tool_data[3]`: the name under which a cell file has it.
fn number_of<'n>(name: &'n str, data: &str) -> &'n str {
    name.strip_prefix(data).and_then(|rest| rest.strip_suffix(']')).unwrap_or(name)
}

fn mapped<T>(pose: &Definition<Pose>, to: impl FnOnce(Pose) -> T) -> Definition<T> {
    Definition { file: pose.file, span: pose.span, value: pose.value.clone().map(to) }
}

//! `$TOOL`, `$BASE`, `$UFRAME`: what holds where, and what it is.

use std::collections::HashMap;

use crate::base::text::Span;
use crate::geometry::pose::Pose;
use crate::program::selection::{InForce, Selections};
use crate::program::target::{Definition, FrameData, Program, Reference, ToolData};

/// A system variable with its values in the order of the text.
#[derive(Debug, Default)]
struct Variable {
    selections: Selections,
    values: HashMap<String, Pose>,
}

/// The system variables of a file.
#[derive(Debug, Default)]
pub(super) struct Frames {
    tool: Variable,
    base: Variable,
    user: Variable,
    /// Where other ways may come in.
    pub joins: Vec<usize>,
}

/// What one move sets for itself.
#[derive(Debug, Default)]
pub(super) struct Own {
    /// `WITH $TOOL = ..`.
    pub tool: Option<Result<Pose, String>>,
    /// `WITH $BASE = ..`.
    pub base: Option<Result<Pose, String>>,
    /// `WITH $UFRAME = ..`.
    pub user: Option<Result<Pose, String>>,
}

impl Own {
    /// The place for the value of a variable; `None` for others.
    pub fn place(&mut self, name: &str) -> Option<&mut Option<Result<Pose, String>>> {
        match name {
            "$TOOL" => Some(&mut self.tool),
            "$BASE" => Some(&mut self.base),
            "$UFRAME" => Some(&mut self.user),
            _ => None,
        }
    }
}

/// A value in force: nothing, or a name with its pose, or why it is not known.
type Held = Result<Option<(String, Pose)>, String>;

impl Variable {
    fn set(&mut self, offset: usize, name: String, value: Result<Pose, String>) {
        match value {
            Ok(pose) => {
                self.selections.push(offset, Reference::Named(name.as_str().into()));
                self.values.insert(name, pose);
            }
            Err(reason) => self.selections.push(offset, Reference::Runtime(reason)),
        }
    }

    fn at(&self, offset: usize, joins: &[usize], own: Option<&Result<Pose, String>>, what: &str) -> Held {
        if let Some(own) = own {
            return own.clone().map(|pose| Some((format!("{what} at byte {offset}"), pose)));
        }
        match self.selections.at(offset + 1, joins) {
            InForce::Nothing => Ok(None),
            InForce::Open => Err(format!("several {what} are set; which holds here depends on the way")),
            InForce::Known(Reference::Named(name)) => {
                let pose = self.values.get(&**name).copied();
                pose.map(|pose| Some((name.to_string(), pose))).ok_or_else(|| format!("{what} has no value"))
            }
            InForce::Known(Reference::Runtime(reason)) => Err(reason.clone()),
            InForce::Known(Reference::Unnamed) => Ok(None),
        }
    }
}

impl Frames {
    /// An assignment to a system variable, in a line; false for other names.
    pub fn set(&mut self, name: &str, offset: usize, line: usize, value: Result<Pose, String>) -> bool {
        let variable = match name {
            "$TOOL" => &mut self.tool,
            "$BASE" => &mut self.base,
            "$UFRAME" => &mut self.user,
            _ => return false,
        };
        let value = value.map_err(|reason| format!("{name} is set in line {line}: {reason}"));
        variable.set(offset, format!("{name} of line {line}"), value);
        true
    }

    /// Tool and frame of a move; defines them in `program`.
    pub fn at(&self, offset: usize, own: &Own, file: usize, program: &mut Program) -> (Reference, Reference) {
        let span = Span::new(offset, offset);
        let tool = match self.tool.at(offset, &self.joins, own.tool.as_ref(), "$TOOL") {
            Ok(None) => Reference::Unnamed,
            Err(reason) => Reference::Runtime(reason),
            Ok(Some((name, pose))) => {
                let value = Ok(ToolData { pose, held_by_robot: true, load: None });
                program.tools.insert(Program::key(&name), Definition { file, span, value });
                Reference::Named(name.into())
            }
        };
        let base = self.base.at(offset, &self.joins, own.base.as_ref(), "$BASE");
        let user = self.user.at(offset, &self.joins, own.user.as_ref(), "$UFRAME");
        let frame = match (base, user) {
            (Err(reason), _) | (_, Err(reason)) => Reference::Runtime(reason),
            (Ok(None), Ok(None)) => Reference::Unnamed,
            (Ok(base), Ok(user)) => {
                let names: Vec<&str> = [&base, &user].into_iter().flatten().map(|(name, _)| name.as_str()).collect();
                let name = names.join(", ");
                let pose = |held: &Option<(String, Pose)>| held.as_ref().map_or(Pose::identity(), |(_, pose)| *pose);
                let value = Ok(FrameData { pose: pose(&base).inverse() * pose(&user), held_by_robot: false, on: None });
                program.frames.insert(Program::key(&name), Definition { file, span, value });
                Reference::Named(name.into())
            }
        };
        (tool, frame)
    }
}

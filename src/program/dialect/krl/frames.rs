//! Tools, bases and loads: what `$TOOL`, `$BASE` and `$LOAD` are set to, and the poses that the job gives for them.
//!
//! `TOOL_DATA[n]` is tool `n` of a cell file, `BASE_DATA[n]` frame `n`; another variable goes by its own name. Bases are
//! given in `$WORLD`; they come out in the robot base, `$ROBROOT`, which is the same unless the job says otherwise.

use std::collections::BTreeMap;

use crate::base::text::Span;
use crate::base::units::m_from_mm;
use crate::geometry::pose::Pose;
use crate::program::scan::Cursor;
use crate::program::target::{Definition, LoadData, Reference};

use super::aggregate::{Aggregate, Value, aggregate};
use super::job::Job;
use super::position::pose;
use super::reference::{Index, reference};
use super::statement::{key, name, trimmed};
use super::variable::{Known, Scope, Variables, Write};

/// The flange as a tool, or the world as a base.
pub(super) const NULL_FRAME: &str = "$nullframe";
/// The world as a base.
pub(super) const WORLD: &str = "$world";

/// Which of the two an expression is assigned to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// `$TOOL`
    Tool,
    /// `$BASE`
    Base,
}

impl Role {
    fn word(self) -> &'static str {
        match self {
            Role::Tool => "$TOOL",
            Role::Base => "$BASE",
        }
    }

    fn data(self) -> &'static str {
        match self {
            Role::Tool => "tool_data",
            Role::Base => "base_data",
        }
    }
}

/// The poses and loads that references name.
pub(super) struct Frames<'j, 'a> {
    job: &'j Job<'a>,
    variables: &'j Variables,
    /// By the name in a reference.
    pub poses: BTreeMap<String, Definition<Pose>>,
    /// By the name in a reference.
    pub loads: BTreeMap<String, Definition<LoadData>>,
    /// `$ROBROOT` in `$WORLD`.
    pub world_t_root: Pose,
}

impl<'j, 'a> Frames<'j, 'a> {
    /// With the frames that every controller has.
    pub fn new(job: &'j Job<'a>, variables: &'j Variables) -> Self {
        let mut frames =
            Self { job, variables, poses: BTreeMap::new(), loads: BTreeMap::new(), world_t_root: Pose::identity() };
        if let Known::Once(write) = variables.get(&(Scope::Global, "$robroot".into()), "$ROBROOT")
            && let Ok(root) = frames.constant_pose(&write)
        {
            frames.world_t_root = root;
        }
        let root = frames.world_t_root;
        for (name, pose) in [(NULL_FRAME, Pose::identity()), (WORLD, Pose::identity()), ("$robroot", root)] {
            frames.poses.insert(name.into(), Definition { file: 0, span: Span::default(), value: Ok(pose) });
        }
        frames
    }

    /// What an expression on the right of `$TOOL =` or `$BASE =` means in a routine.
    pub fn frame(&mut self, routine: usize, file: usize, expression: Span, role: Role) -> Reference {
        let bytes = self.job.bytes(file);
        let expression = trimmed(bytes, expression);
        let mut cursor = Cursor::new(bytes, expression);
        if cursor.peek() == Some(b'{') {
            let line = self.job.sources[file].line(expression.start);
            let name = format!("{}@{line}", role.word().to_lowercase());
            let value = self.constant_pose(&Write { file, value: expression });
            self.poses.insert(name.clone(), Definition { file, span: expression, value });
            return Reference::Named(name.into());
        }
        let text = self.job.sources[file].text(expression).into_owned();
        let unknown = || Reference::Runtime(format!("{} is `{text}`, known only at run time", role.word()));
        let Some(found) = reference(bytes, &mut cursor).filter(|found| cursor.at_end() && found.member.is_none())
        else {
            return unknown();
        };
        match (found.base.as_str(), &found.index) {
            (name @ (NULL_FRAME | WORLD | "$robroot"), Index::None) => Reference::Named(name.into()),
            ("tool_data" | "base_data", index) => match self.index(routine, file, index) {
                Some(number) => self.numbered(routine, &found.base, number),
                None => unknown(),
            },
            (name, _) if name.starts_with('$') => unknown(),
            _ => match found.element() {
                Some(element) => self.variable(routine, &found.base, element),
                None => unknown(),
            },
        }
    }

    /// Tool or base `number`, as `BAS(#TOOL,number)` takes it: zero is the flange, or the world.
    pub fn by_number(&mut self, routine: usize, role: Role, number: i64) -> Reference {
        match (role, number > 0) {
            (Role::Tool, false) => Reference::Named(NULL_FRAME.into()),
            (Role::Base, false) => Reference::Named(WORLD.into()),
            (_, true) => self.numbered(routine, role.data(), number),
        }
    }

    /// The load of tool `number`. One that is not in the job, or negative, which means the machine's own, is none.
    pub fn load_by_number(&mut self, routine: usize, number: i64) -> Reference {
        let element = format!("load_data[{number}]");
        let scope = self.variables.scope(self.job, routine, "load_data");
        self.load_variable((scope, element.clone()), element)
    }

    /// What an expression on the right of `$LOAD =` means.
    pub fn load(&mut self, routine: usize, file: usize, expression: Span) -> Reference {
        let bytes = self.job.bytes(file);
        let expression = trimmed(bytes, expression);
        let mut cursor = Cursor::new(bytes, expression);
        if cursor.peek() == Some(b'{') {
            let name = format!("$load@{}", self.job.sources[file].line(expression.start));
            return self.declare_load(name, &Write { file, value: expression });
        }
        let unknown = Reference::Runtime("$LOAD is known only at run time".into());
        let Some(found) = reference(bytes, &mut cursor).filter(|found| cursor.at_end() && found.member.is_none())
        else {
            return unknown;
        };
        if found.base == "load_data" {
            return match self.index(routine, file, &found.index) {
                Some(number) => self.load_by_number(routine, number),
                None => unknown,
            };
        }
        match found.element() {
            Some(element) if !found.base.starts_with('$') => {
                let scope = self.variables.scope(self.job, routine, &found.base);
                self.load_variable((scope, element.clone()), element)
            }
            _ => unknown,
        }
    }

    /// The aggregate that a write assigns.
    pub fn constant(&self, write: &Write) -> Option<Aggregate> {
        let bytes = self.job.bytes(write.file);
        let mut cursor = Cursor::new(bytes, write.value);
        let is_aggregate = cursor.peek() == Some(b'{');
        aggregate(bytes, &mut cursor).ok().filter(|_| is_aggregate && cursor.at_end())
    }

    /// The number in brackets.
    fn index(&self, routine: usize, file: usize, index: &Index) -> Option<i64> {
        match index {
            Index::Constant(text) => text.trim_matches(['[', ']']).parse().ok(),
            Index::Variable(span) => self.variables.integer(self.job, routine, file, *span),
            Index::None => None,
        }
    }

    fn numbered(&mut self, routine: usize, data: &str, number: i64) -> Reference {
        let element = format!("{data}[{number}]");
        if data == "base_data"
            && let Some(reason) = self.moving_base(routine, number)
        {
            return Reference::Runtime(reason);
        }
        self.variable(routine, data, element)
    }

    /// A frame variable: where the job has no value, the cell file may know the name.
    fn variable(&mut self, routine: usize, base: &str, element: String) -> Reference {
        let scope = self.variables.scope(self.job, routine, base);
        match self.variables.get(&(scope, element.clone()), &element) {
            Known::Nowhere(_) => {}
            Known::Changes(reason, _) => return Reference::Runtime(reason),
            Known::Once(write) => {
                let value = self.constant_pose(&write);
                self.poses.insert(element.clone(), Definition { file: write.file, span: write.value, value });
            }
        }
        Reference::Named(element.into())
    }

    /// Why a base moves: it stands on a kinematic of its own.
    fn moving_base(&self, routine: usize, number: i64) -> Option<String> {
        let entry = |list: &str, number: i64| {
            let scope = self.variables.scope(self.job, routine, list);
            match self.variables.get(&(scope, format!("{list}[{number}]")), list) {
                Known::Once(write) => self.constant(&write),
                _ => None,
            }
        };
        let machine = entry("machine_frame_dat", number)?.integer("mach_def_index").filter(|index| *index > 0)?;
        let kind = entry("machine_def", machine)?;
        match kind.get("mech_type") {
            Some(Value::Constant(kind)) if !matches!(kind.as_str(), "robot" | "none") => {
                Some(format!("base {number} stands on a kinematic of its own"))
            }
            _ => None,
        }
    }

    fn load_variable(&mut self, element: (Scope, String), name: String) -> Reference {
        match self.variables.get(&element, &name) {
            Known::Once(write) => self.declare_load(name, &write),
            Known::Changes(reason, _) => Reference::Runtime(reason),
            Known::Nowhere(_) => Reference::Unnamed,
        }
    }

    fn declare_load(&mut self, name: String, write: &Write) -> Reference {
        let value = match self.constant(write).as_ref().map(|aggregate| self.load_data(write.file, aggregate)) {
            Some(Some(load)) if load.mass_kg < 0.0 => return Reference::Unnamed,
            Some(Some(load)) => Ok(load),
            _ => Err("the load is not written in numbers".to_string()),
        };
        self.loads.insert(name.clone(), Definition { file: write.file, span: write.value, value });
        Reference::Named(name.into())
    }

    fn load_data(&self, file: usize, load: &Aggregate) -> Option<LoadData> {
        let mass_kg = load.number("m")?;
        let center = match load.get("cm") {
            Some(Value::Nested(span)) => self.constant(&Write { file, value: *span })?,
            None => return Some(LoadData { mass_kg, center_of_mass_m: [0.0; 3] }),
            Some(_) => return None,
        };
        let [x, y, z] = ["x", "y", "z"].map(|name| center.number(name).map(m_from_mm));
        Some(LoadData { mass_kg, center_of_mass_m: [x?, y?, z?] })
    }

    fn constant_pose(&self, write: &Write) -> Result<Pose, String> {
        let text = || self.job.sources[write.file].text(write.value).into_owned();
        self.constant(write).as_ref().and_then(pose).ok_or_else(|| format!("the frame is `{}`", text()))
    }
}

/// The one argument of a call of `name`, in lower case, if an expression is that.
pub(super) fn call(bytes: &[u8], expression: Span) -> Option<(String, Span)> {
    let expression = trimmed(bytes, expression);
    let mut cursor = Cursor::new(bytes, expression);
    let callee = key(bytes, name(&mut cursor)?);
    cursor.skip_blanks();
    let closed = bytes[expression.start..expression.end].last() == Some(&b')');
    (cursor.eat(b'(') && closed).then(|| (callee, trimmed(bytes, Span::new(cursor.offset(), expression.end - 1))))
}

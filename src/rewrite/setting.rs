//! The tool, frame and load in force at a move, resolved to poses: what the program defines wins over the cell file.

use std::collections::HashMap;

use crate::files::cell::{Cell, CellTool};
use crate::geometry::pose::Pose;
use crate::invert::RealArm;
use crate::model::robot::Mass;
use crate::program::target::{LoadData, Program, Reference, Use};

use super::class::Class;

/// Why a target is left alone: its class and a sentence.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// [`Class::Computed`] or [`Class::Refused`].
    pub class: Class,
    /// For a person.
    pub reason: String,
    /// True when several values would do what a single one cannot: see [`super::split`].
    pub shared: bool,
}

impl Obstacle {
    /// There is no solution.
    pub fn refused(reason: impl Into<String>) -> Self {
        Self { class: Class::Refused, reason: reason.into(), shared: false }
    }

    /// The value is known only at run time.
    pub fn computed(reason: impl Into<String>) -> Self {
        Self { class: Class::Computed, reason: reason.into(), shared: false }
    }
}

/// Everything between a written target and the flange.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// With the tool on the flange: `base_T_frame`. With a stationary tool: `base_T_tool`.
    fixed: Pose,
    /// What the flange carries, as the controller has it: `flange_T_tool`, or `flange_T_frame` of a held work piece.
    carried: Pose,
    /// The same, as it really is.
    carried_really: Pose,
    /// True when the robot holds the work piece and the tool stands still.
    stationary_tool: bool,
    /// What the flange carries, if the program or cell says so.
    pub payload: Option<Mass>,
}

impl Setting {
    /// `base_T_flange` that the controller computes for a written target.
    pub fn nominal_flange(&self, target: &Pose) -> Pose {
        self.fixed * self.seen_from_fixed(target) * self.carried.inverse()
    }

    /// `base_T_flange` at which the real tool stands where the target says.
    pub fn meant_flange(&self, target: &Pose) -> Pose {
        self.fixed * self.seen_from_fixed(target) * self.carried_really.inverse()
    }

    /// The target that makes the controller compute this flange: the inverse of [`Setting::nominal_flange`].
    pub fn target(&self, nominal_flange: &Pose) -> Pose {
        self.seen_from_fixed(&(self.fixed.inverse() * *nominal_flange * self.carried))
    }

    /// Where the real tool stands in its frame when the real flange stands here: the inverse of
    /// [`Setting::meant_flange`].
    pub fn landed(&self, real_flange: &Pose) -> Pose {
        self.seen_from_fixed(&(self.fixed.inverse() * *real_flange * self.carried_really))
    }

    fn seen_from_fixed(&self, target: &Pose) -> Pose {
        if self.stationary_tool { target.inverse() } else { *target }
    }
}

/// Resolves the references of moves, each combination once.
pub struct Settings<'a> {
    program: &'a Program,
    cell: &'a Cell,
    own_tool: Tool,
    resolved: Vec<Result<Setting, Obstacle>>,
    known: HashMap<(Reference, Reference, Reference), usize>,
}

#[derive(Clone, Debug)]
struct Tool {
    nominal: Pose,
    real: Pose,
    held_by_robot: bool,
    load: Option<Mass>,
}

/// A load of this mass or less is ABB's `load0` and its like: a word for "not declared".
const UNDECLARED_KG: f64 = 0.001;

impl<'a> Settings<'a> {
    /// For one program.
    pub fn new(program: &'a Program, cell: &'a Cell, arm: &RealArm<'_>) -> Self {
        let real = arm.measured_tool();
        let nominal = arm.robot().tool.unwrap_or(real);
        let own_tool = Tool { nominal, real, held_by_robot: true, load: None };
        Self { program, cell, own_tool, resolved: Vec::new(), known: HashMap::new() }
    }

    /// The number of the setting at a move; equal references give equal numbers.
    pub fn of(&mut self, one: &Use) -> usize {
        let key = (one.tool.clone(), one.frame.clone(), one.grip_load.clone());
        if let Some(&index) = self.known.get(&key) {
            return index;
        }
        let setting = self.resolve(one);
        self.resolved.push(setting);
        self.known.insert(key, self.resolved.len() - 1);
        self.resolved.len() - 1
    }

    /// The setting with this number, or what is in its way.
    pub fn get(&self, index: usize) -> &Result<Setting, Obstacle> {
        &self.resolved[index]
    }

    fn resolve(&self, one: &Use) -> Result<Setting, Obstacle> {
        let tool = self.tool(&one.tool)?;
        let (frame, frame_held) = self.frame(&one.frame)?;
        let payload = match self.flange_load(&one.grip_load)? {
            Some(load) => Some(load),
            None => carried_mass(&tool, self.grip_load(&one.grip_load)?),
        };
        match (tool.held_by_robot, frame_held) {
            (true, false) => Ok(Setting {
                fixed: frame,
                carried: tool.nominal,
                carried_really: tool.real,
                stationary_tool: false,
                payload,
            }),
            (false, true) => Ok(Setting {
                fixed: tool.nominal,
                carried: frame,
                carried_really: frame,
                stationary_tool: true,
                payload,
            }),
            (true, true) => Err(Obstacle::refused("the robot holds both the tool and the work piece")),
            (false, false) => Err(Obstacle::refused("the robot holds neither the tool nor the work piece")),
        }
    }

    fn tool(&self, reference: &Reference) -> Result<Tool, Obstacle> {
        let name = match reference {
            Reference::Unnamed => return Ok(self.own_tool.clone()),
            Reference::Runtime(reason) => return Err(Obstacle::computed(reason.clone())),
            Reference::Named(name) => name,
        };
        if let Some(definition) = self.program.tools.get(&Program::key(name)) {
            let tool = definition.value.as_ref().map_err(|reason| Obstacle::computed(reason.clone()))?;
            return Ok(Tool {
                nominal: tool.pose,
                real: tool.pose,
                held_by_robot: tool.held_by_robot,
                load: tool.load.as_ref().map(mass_of),
            });
        }
        match self.cell.tools.get(&name.to_lowercase()) {
            Some(CellTool::Measured) => Ok(self.own_tool.clone()),
            Some(CellTool::Pose { flange_t_tool, payload }) => {
                let pose = *flange_t_tool;
                Ok(Tool { nominal: pose, real: pose, held_by_robot: true, load: *payload })
            }
            None => Err(Obstacle::refused(format!(
                "tool `{name}` is defined neither in the program nor in the cell file (--cell)"
            ))),
        }
    }

    fn frame(&self, reference: &Reference) -> Result<(Pose, bool), Obstacle> {
        let name = match reference {
            Reference::Unnamed => return Ok((Pose::identity(), false)),
            Reference::Runtime(reason) => return Err(Obstacle::computed(reason.clone())),
            Reference::Named(name) => name,
        };
        if let Some(definition) = self.program.frames.get(&Program::key(name)) {
            let frame = definition.value.as_ref().map_err(|reason| Obstacle::computed(reason.clone()))?;
            return Ok((frame.pose, frame.held_by_robot));
        }
        let pose = self.cell.frames.get(&name.to_lowercase()).copied();
        pose.map(|pose| (pose, false)).ok_or_else(|| {
            Obstacle::refused(format!("frame `{name}` is defined neither in the program nor in the cell file (--cell)"))
        })
    }

    /// A load that is all that the flange carries.
    fn flange_load(&self, reference: &Reference) -> Result<Option<Mass>, Obstacle> {
        let Reference::Named(name) = reference else { return Ok(None) };
        let load = self.program.flange_loads.get(&Program::key(name)).map(|definition| definition.value.as_ref());
        load.map(|load| load.map(mass_of).map_err(|reason| Obstacle::computed(reason.clone()))).transpose()
    }

    fn grip_load(&self, reference: &Reference) -> Result<Option<Mass>, Obstacle> {
        let name = match reference {
            Reference::Unnamed => return Ok(None),
            Reference::Runtime(reason) => return Err(Obstacle::computed(reason.clone())),
            Reference::Named(name) => name,
        };
        match self.program.loads.get(&Program::key(name)) {
            Some(definition) => match &definition.value {
                Ok(load) => Ok(Some(mass_of(load))),
                Err(reason) => Err(Obstacle::computed(reason.clone())),
            },
            None => Err(Obstacle::refused(format!("load `{name}` is not defined in the program"))),
        }
    }
}

fn mass_of(load: &LoadData) -> Mass {
    Mass { mass_kg: load.mass_kg, center_of_mass_m: load.center_of_mass_m.into() }
}

/// Tool and gripped part together, in the flange; `None` where nothing is declared.
fn carried_mass(tool: &Tool, grip: Option<Mass>) -> Option<Mass> {
    let declared = |mass: Mass| (mass.mass_kg > UNDECLARED_KG).then_some(mass);
    let own = tool.load.and_then(declared);
    let gripped = grip
        .and_then(declared)
        .map(|mass| Mass { center_of_mass_m: tool.nominal.transform_point(&mass.center_of_mass_m), ..mass });
    match (own, gripped) {
        (Some(a), Some(b)) => {
            let mass_kg = a.mass_kg + b.mass_kg;
            let moment = a.center_of_mass_m * a.mass_kg + b.center_of_mass_m * b.mass_kg;
            Some(Mass { mass_kg, center_of_mass_m: moment / mass_kg })
        }
        (one, other) => one.or(other),
    }
}

//! The tool, frame and load in force at a move, resolved to poses: what the program defines wins over the cell file.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::files::axes::Moves;
use crate::files::cell::{Cell, CellTool};
use crate::geometry::pose::Pose;
use crate::invert::RealArm;
use crate::model::robot::Mass;
use crate::program::target::{LoadData, Program, Reference, Target, TargetValue, Use};

use super::carriers::Carriers;
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
    /// Names of a frame that stands in the cell, lower case: an additional axis may move it.
    frames: Vec<String>,
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

    /// The same where additional axes have moved what does not travel with the flange: `B^-1 F` of
    /// [`super::carriers`].
    fn displaced(&self, displacement: &Pose) -> Self {
        Self { fixed: *displacement * self.fixed, ..self.clone() }
    }

    fn seen_from_fixed(&self, target: &Pose) -> Pose {
        if self.stationary_tool { target.inverse() } else { *target }
    }
}

/// Resolves the references of moves, each combination once.
pub struct Settings<'a> {
    program: &'a Program,
    cell: &'a Cell,
    carriers: Carriers<'a>,
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

/// A frame, resolved.
struct Frame {
    /// In the base; in the flange when the robot holds it.
    pose: Pose,
    held: bool,
    /// Its name and that of the mechanical unit that it stands on, lower case.
    names: Vec<String>,
}

/// A load of this mass or less is ABB's `load0` and its like: a word for "not declared".
const UNDECLARED_KG: f64 = 0.001;

impl<'a> Settings<'a> {
    /// For one program.
    pub fn new(program: &'a Program, cell: &'a Cell, arm: &RealArm<'_>) -> Self {
        let real = arm.measured_tool();
        let nominal = arm.robot().tool.unwrap_or(real);
        let own_tool = Tool { nominal, real, held_by_robot: true, load: None };
        let carriers = Carriers::new(&cell.axes, program);
        Self { program, cell, carriers, own_tool, resolved: Vec::new(), known: HashMap::new() }
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

    /// The setting with this number at a target, where the additional axes have moved the robot and the frame.
    ///
    /// # Errors
    /// What is in its way.
    pub fn at(&self, index: usize, target: &Target) -> Result<Cow<'_, Setting>, Obstacle> {
        let setting = self.resolved[index].as_ref().map_err(Obstacle::clone)?;
        // A joint target is a posture of the arm, wherever that stands.
        if self.carriers.is_empty() || matches!(target.value, TargetValue::Joint(_)) {
            return Ok(Cow::Borrowed(setting));
        }
        let displacement = self.carriers.displacement(target, &setting.frames)?;
        Ok(displacement.map_or(Cow::Borrowed(setting), |displacement| Cow::Owned(setting.displaced(&displacement))))
    }

    fn resolve(&self, one: &Use) -> Result<Setting, Obstacle> {
        let tool = self.tool(&one.tool)?;
        let Frame { pose: frame, held: frame_held, names: frames } = self.frame(&one.frame)?;
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
                frames,
            }),
            (false, true) => Ok(Setting {
                fixed: tool.nominal,
                carried: frame,
                carried_really: frame,
                stationary_tool: true,
                payload,
                frames: Vec::new(),
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

    fn frame(&self, reference: &Reference) -> Result<Frame, Obstacle> {
        let name = match reference {
            Reference::Unnamed => return Ok(Frame { pose: Pose::identity(), held: false, names: Vec::new() }),
            Reference::Runtime(reason) => return Err(Obstacle::computed(reason.clone())),
            Reference::Named(name) => name,
        };
        let mut names = vec![name.to_lowercase()];
        if let Some(definition) = self.program.frames.get(&Program::key(name)) {
            let frame = definition.value.as_ref().map_err(|reason| Obstacle::computed(reason.clone()))?;
            let unit = frame.on.as_ref().map(|unit| self.unit(unit)).transpose()?;
            names.extend(frame.on.as_ref().map(|unit| unit.to_lowercase()));
            let pose = unit.map_or(frame.pose, |unit| unit * frame.pose);
            return Ok(Frame { pose, held: frame.held_by_robot, names });
        }
        let pose = self.cell.frames.get(&name.to_lowercase()).copied();
        pose.map(|pose| Frame { pose, held: false, names }).ok_or_else(|| {
            Obstacle::refused(format!("frame `{name}` is defined neither in the program nor in the cell file (--cell)"))
        })
    }

    /// `base_T_unit` of a mechanical unit with its axes at zero.
    fn unit(&self, name: &str) -> Result<Pose, Obstacle> {
        let key = name.to_lowercase();
        let moves_it = |moves: &Moves| matches!(moves, Moves::Frames(all) if all.contains(&key));
        let known = self.cell.axes.iter().any(|axis| moves_it(&axis.moves));
        self.cell.frames.get(&key).copied().filter(|_| known).ok_or_else(|| {
            Obstacle::computed(format!(
                "moved by mechanical unit {name}: a cell file that has it among its frames and an axis that moves it \
                 says where it stands"
            ))
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

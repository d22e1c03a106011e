//! What a dialect finds in a program: targets with their numbers, the moves that use them, and the tools, frames and
//! loads that the program itself defines.
//!
//! Everything here is what the text says, in the file's own units and frames; nothing is decided yet.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::{Deref, DerefMut};
use std::sync::{Arc, LazyLock};

use nalgebra::Vector3;

use crate::base::diagnostic::Diagnostic;
use crate::base::text::Span;
use crate::base::units::{M_PER_INCH, M_PER_MM, m_from_mm};
use crate::geometry::orientation::{OrientationConvention, OrientationNumbers};
use crate::geometry::pose::Pose;

use super::number::NumberField;
use super::shared::Shared;

/// Everything that a dialect read from the files of one job.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// All targets, in the order of their place in the files.
    pub targets: Vec<Target>,
    /// Tools that the program defines itself, by name as [`Program::key`] spells it.
    pub tools: BTreeMap<String, Definition<ToolData>>,
    /// Frames (work objects, bases, user frames) that the program defines itself.
    pub frames: BTreeMap<String, Definition<FrameData>>,
    /// Loads that the program defines itself.
    pub loads: BTreeMap<String, Definition<LoadData>>,
    /// Loads that the program gives as all that the flange carries, centre of mass in the flange: they take the place
    /// of the tool's own load (KUKA `$LOAD`). A [`Use::grip_load`] names one like any other load.
    pub flange_loads: BTreeMap<String, Definition<LoadData>>,
    /// Files that are read with the job and never written, because other jobs share them: their targets stay as they
    /// are. Known to the one who reads files, not to the dialect.
    pub read_only: BTreeSet<usize>,
    /// The declarations of named targets that may be copied under another name, by index of the target.
    pub declarations: BTreeMap<usize, Declaration>,
    /// Where moves name a target in whose place its written value may stand, by index of the target: file of the job
    /// and the name there.
    pub replaceable: BTreeMap<usize, Vec<Mention>>,
    /// What the reader has to say: broken lines, suspicious units, a missing end.
    pub diagnostics: Vec<Diagnostic>,
}

/// Where a named target is declared, in a language in which a copy of the declaration under a new name declares another
/// target.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Declaration {
    /// The whole statement, with what ends it.
    pub statement: Span,
    /// The name in it.
    pub name: Span,
    /// Where moves name the target, directly or to displace it: file of the job and the name there.
    pub mentions: Vec<(usize, Span)>,
}

/// A place where a move names something: file of the job and the name there.
pub type Mention = (usize, Span);

/// A definition in the program: its value, or why the value is not in the text.
#[derive(Clone, Debug)]
pub struct Definition<T> {
    /// File of the job.
    pub file: usize,
    /// Where it stands.
    pub span: Span,
    /// The value, or the reason why it is known only at run time.
    pub value: Result<T, String>,
}

/// A tool as a program defines it.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolData {
    /// The TCP in the flange; for a stationary tool, the TCP in the world.
    pub pose: Pose,
    /// False for a stationary tool: the robot holds the work piece.
    pub held_by_robot: bool,
    /// The tool's own mass and centre of mass, if declared.
    pub load: Option<LoadData>,
}

/// A frame as a program defines it.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameData {
    /// The frame in the robot base; for a work piece in the gripper, in the flange.
    pub pose: Pose,
    /// True when the robot holds the work piece (with a stationary tool).
    pub held_by_robot: bool,
    /// The mechanical unit that moves the frame: `pose` then counts from where the cell file has that unit.
    pub on: Option<Arc<str>>,
}

/// A mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadData {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass, metres: in the flange for a tool's own load, in the tool for a gripped part.
    pub center_of_mass_m: [f64; 3],
}

/// A position in a program.
#[derive(Clone, Debug)]
pub struct Target {
    /// File of the job that holds it.
    pub file: usize,
    /// Its name, if it has one; inline targets have none.
    pub name: Option<String>,
    /// The whole target in the text.
    pub span: Span,
    /// Its numbers.
    pub value: TargetValue,
    /// Why its value is not in the text, if it is not: assigned at run time, arithmetic, untaught.
    pub computed: Option<String>,
    /// Configuration data, as far as the language has any; targets one after the other often share them.
    pub configuration: Arc<Configuration>,
    /// Values of additional axes, as written (mm or deg).
    pub external_axes: Vec<ExternalAxis>,
    /// True for a pose in coordinates that travel with the robot on a track; else the frame stands in the cell.
    pub rides_along: bool,
    /// The moves that go there, in the order in which they stand in the program.
    pub uses: Vec<Use>,
}

/// The numbers of a target.
#[derive(Clone, Debug)]
pub enum TargetValue {
    /// A pose in a frame.
    Cartesian(Box<CartesianNumbers>),
    /// Six joint values.
    Joint(Box<JointNumbers>),
    /// A constant displacement of another target (RAPID `Offs`, `RelTool`): the numbers are those of the displacement.
    Displaced(Box<Displacement>),
    /// Joint values as counts of encoders, which only the controller can turn into angles.
    Counts,
    /// Nothing that could be read: a step without a recorded pose, an expression.
    Unwritten,
}

/// Unit of length in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// 1e-3 m.
    Millimetre,
    /// 1 m.
    Metre,
    /// 25.4e-3 m.
    Inch,
}

/// Unit of length or angle in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Units {
    /// What one of a length number is.
    pub length: LengthUnit,
    /// Angle numbers are radians (else degrees).
    pub radians: bool,
}

impl Units {
    /// Millimetres and degrees: what almost every language writes.
    pub const MM_DEG: Units = Units { length: LengthUnit::Millimetre, radians: false };
    /// Metres and radians.
    pub const M_RAD: Units = Units { length: LengthUnit::Metre, radians: true };
}

/// The numbers of a pose.
#[derive(Clone, Debug)]
pub struct CartesianNumbers {
    /// x, y, z.
    pub position: [NumberField; 3],
    /// The orientation, in the order of `convention`.
    pub orientation: OrientationFields,
    /// What the orientation numbers mean.
    pub convention: OrientationConvention,
    /// Units of the numbers.
    pub units: Units,
}

/// The three or four numbers of an orientation, in place: used as a slice.
#[derive(Clone, Debug, Default)]
pub struct OrientationFields {
    fields: [NumberField; 4],
    count: u8,
}

impl From<[NumberField; 4]> for OrientationFields {
    fn from(fields: [NumberField; 4]) -> Self {
        Self { fields, count: 4 }
    }
}

impl From<[NumberField; 3]> for OrientationFields {
    fn from(fields: [NumberField; 3]) -> Self {
        fields.into_iter().collect()
    }
}

/// Of more than four numbers only the first four are taken.
impl FromIterator<NumberField> for OrientationFields {
    fn from_iter<I: IntoIterator<Item = NumberField>>(numbers: I) -> Self {
        let mut all = Self::default();
        for (place, number) in all.fields.iter_mut().zip(numbers) {
            *place = number;
            all.count += 1;
        }
        all
    }
}

impl<'a> IntoIterator for &'a OrientationFields {
    type Item = &'a NumberField;
    type IntoIter = std::slice::Iter<'a, NumberField>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl Deref for OrientationFields {
    type Target = [NumberField];

    fn deref(&self) -> &[NumberField] {
        &self.fields[..usize::from(self.count)]
    }
}

/// The numbers of a joint target: six robot axes in the controller's order and sense.
#[derive(Clone, Debug)]
pub struct JointNumbers {
    /// One a joint.
    pub joints: [NumberField; 6],
    /// Units of the numbers (rotary axes).
    pub units: Units,
}

/// A constant displacement of another target.
#[derive(Clone, Debug)]
pub struct Displacement {
    /// Index of the displaced target in [`Program::targets`].
    pub base: usize,
    /// In which frame the displacement is given.
    pub kind: DisplacementKind,
    /// x, y, z of the displacement.
    pub position: [NumberField; 3],
    /// The constant turn of the displaced target against the base target.
    pub rotation: nalgebra::Matrix3<f64>,
    /// Units of the numbers.
    pub units: Units,
}

/// In which frame a displacement acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DisplacementKind {
    /// In the frame in which the base target is given (RAPID `Offs`).
    Frame,
    /// In the tool at the base target (RAPID `RelTool`).
    Tool,
}

/// Which of the inverse kinematic solutions the program asks for. Empty: the language says nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Configuration {
    /// A joint must lie in an interval of its controller angle: `(joint from 0, min_deg, max_deg)`.
    pub joint_intervals_deg: Vec<(usize, f64, f64)>,
    /// The wrist centre lies behind axis 1.
    pub rear: Option<bool>,
    /// The elbow is bent the other way (wrist centre behind the lower arm; elbow below the line shoulder - wrist).
    pub elbow_down: Option<bool>,
    /// Axis 5 stands on its negative side.
    pub wrist_negative: Option<bool>,
    /// Joint values near which the solution lies, degrees, where the language gives them.
    pub near_joints_deg: Option<[f64; 6]>,
}

/// An additional axis of a target.
#[derive(Clone, Debug, PartialEq)]
pub struct ExternalAxis {
    /// The language's name for it: `eax_a`, `E1`, `J7`.
    pub name: String,
    /// Its value as written.
    pub value: f64,
}

/// A move to a target.
#[derive(Clone, Debug)]
pub struct Use {
    /// File of the job that holds the move.
    pub file: usize,
    /// The statement.
    pub span: Span,
    /// How it goes there; moves one after the other often share it.
    pub way: Arc<Way>,
}

/// How a move goes to a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// The word of the language: `MoveL`, `LIN`, `L`.
    pub motion: Arc<str>,
    /// How the arm travels there.
    pub path: PathKind,
    /// The tool in force.
    pub tool: Reference,
    /// The frame in force.
    pub frame: Reference,
    /// The load carried on top of the tool's own, if the program says so.
    pub grip_load: Reference,
    /// Why this move does not simply go to the target, if so: a displacement set at run time, a search, a
    /// positioner that moves along.
    pub computed: Option<String>,
}

/// How a move travels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathKind {
    /// Joint interpolation.
    Joint,
    /// A straight line of the TCP.
    Linear,
    /// The via point of an arc.
    ArcVia,
    /// The end point of an arc.
    ArcEnd,
    /// Something else, or unknown.
    Other,
}

/// What a move says about its tool, frame or load.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub enum Reference {
    /// The program names none: the robot's own.
    #[default]
    Unnamed,
    /// A name as the program spells it, to be looked up by [`Program::key`] in the program, then in the cell file.
    Named(Arc<str>),
    /// Known only at run time, with the reason.
    Runtime(String),
}

impl Reference {
    /// Two ways to a statement disagree; `None` for a way that leaves the setting as it was.
    pub fn disputed(one: Option<&Reference>, other: Option<&Reference>) -> Reference {
        let shown = |reference: Option<&Reference>| match reference {
            Some(Reference::Named(name)) => format!("`{name}`"),
            Some(Reference::Runtime(reason)) => reason.clone(),
            Some(Reference::Unnamed) | None => "what held before".to_owned(),
        };
        Reference::Runtime(format!("{} on one way to this statement, {} on another", shown(one), shown(other)))
    }
}

impl Configuration {
    /// That of a language or target that says nothing.
    pub fn unsaid() -> Arc<Self> {
        static UNSAID: LazyLock<Arc<Configuration>> = LazyLock::new(Arc::default);
        Arc::clone(&UNSAID)
    }

    /// The same, in one place with all others that say nothing.
    pub fn into_shared(self) -> Arc<Self> {
        if self == Self::default() { Self::unsaid() } else { Arc::new(self) }
    }
}

impl Program {
    /// Names are compared without regard to case: the spelling under which definitions are filed.
    pub fn key(name: &str) -> String {
        name.to_lowercase()
    }

    /// Files mentions of targets under [`Program::replaceable`]: file and place of the target, then the mention. The
    /// targets must stand in their last order.
    pub fn note_replaceable(&mut self, mentions: &[((usize, Span), Mention)]) {
        if mentions.is_empty() {
            return;
        }
        let place = |(index, target): (usize, &Target)| ((target.file, target.span), index);
        let by_place: HashMap<(usize, Span), usize> = self.targets.iter().enumerate().map(place).collect();
        for (target, mention) in mentions {
            if let Some(index) = by_place.get(target) {
                self.replaceable.entry(*index).or_default().push(*mention);
            }
        }
    }

    /// True for a target of the job's own files, or one in a file that it only reads to which its own moves go: what
    /// else stands there concerns other jobs.
    pub fn concerns(&self, target: &Target) -> bool {
        !self.read_only.contains(&target.file) || target.uses.iter().any(|one| !self.read_only.contains(&one.file))
    }
}

impl Use {
    /// A move that stands at `span` of a file.
    pub fn new(file: usize, span: Span, way: impl Into<Arc<Way>>) -> Self {
        Self { file, span, way: way.into() }
    }

    /// The same move, its way in one place with equal ones before it.
    #[must_use]
    pub fn sharing(self, ways: &mut Shared<Way>) -> Self {
        Self { way: ways.share(self.way), ..self }
    }

    /// The same move in another frame.
    #[must_use]
    pub fn in_frame(mut self, frame: Reference) -> Self {
        self.frame = frame;
        self
    }

    /// The same move, known only at run time for this reason.
    #[must_use]
    pub fn computed_by(mut self, reason: String) -> Self {
        self.computed = Some(reason);
        self
    }
}

impl Deref for Use {
    type Target = Way;

    fn deref(&self) -> &Way {
        &self.way
    }
}

/// Changes the way of this move alone.
impl DerefMut for Use {
    fn deref_mut(&mut self) -> &mut Way {
        Arc::make_mut(&mut self.way)
    }
}

impl Target {
    /// Adds a move that goes there. Most targets have one: no room is kept for more.
    pub fn add_use(&mut self, one: Use) {
        if self.uses.is_empty() {
            self.uses.reserve_exact(1);
        }
        self.uses.push(one);
    }

    /// `cartesian` or `joint`, as reports say it.
    pub fn kind(&self) -> &'static str {
        match self.value {
            TargetValue::Joint(_) | TargetValue::Counts => "joint",
            _ => "cartesian",
        }
    }
}

impl Units {
    /// Metres of one length unit.
    pub fn length_m(self) -> f64 {
        match self.length {
            LengthUnit::Millimetre => M_PER_MM,
            LengthUnit::Metre => 1.0,
            LengthUnit::Inch => M_PER_INCH,
        }
    }

    /// A length as a file with these units has it, from metres.
    pub fn from_m(self, length_m: f64) -> f64 {
        match self.length {
            LengthUnit::Millimetre => length_m * 1e3,
            LengthUnit::Metre => length_m,
            LengthUnit::Inch => length_m / M_PER_INCH,
        }
    }

    /// Radians of one angle unit.
    pub fn angle_rad(self) -> f64 {
        if self.radians { 1.0 } else { 1f64.to_radians() }
    }
}

impl CartesianNumbers {
    /// The pose in its frame; `None` when the numbers make no orientation.
    pub fn pose(&self) -> Option<Pose> {
        let rotation = self.convention.rotation(&self.orientation_in_radians())?;
        let translation = position_m(values(&self.position), self.units);
        Some(Pose { rotation, translation })
    }

    /// True when the numbers make an orientation, so that there is a [`CartesianNumbers::pose`].
    pub fn has_orientation(&self) -> bool {
        self.convention.is_rotation(&self.orientation_in_radians())
    }

    /// The orientation numbers with angles in radians.
    pub fn orientation_in_radians(&self) -> OrientationNumbers {
        let scale = if self.convention.has_angles() { self.units.angle_rad() } else { 1.0 };
        self.orientation.iter().map(|field| field.value * scale).collect()
    }
}

impl JointNumbers {
    /// The joint values, rad.
    pub fn numbers_rad(&self) -> [f64; 6] {
        std::array::from_fn(|joint| self.joints[joint].value * self.units.angle_rad())
    }
}

/// Three length numbers as a vector, m. Millimetres are divided, so that 0.1 mm stays the nearest double.
pub fn position_m(numbers: [f64; 3], units: Units) -> Vector3<f64> {
    Vector3::from(numbers).map(|number| match units.length {
        LengthUnit::Millimetre => m_from_mm(number),
        LengthUnit::Metre => number,
        LengthUnit::Inch => number * M_PER_INCH,
    })
}

/// The values of some number fields.
pub fn values<const N: usize>(fields: &[NumberField; N]) -> [f64; N] {
    fields.each_ref().map(|field| field.value)
}

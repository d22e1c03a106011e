//! What a nominal robot leaves out, one effect a file. Each is written once over the scalar: its value serves
//! prediction and correction, its derivatives identification, its presence or absence diagnosis.
//!
//! To add an effect: one file with a unit struct that implements [`Physics`], and one line in [`EFFECTS`].

use std::fmt;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::geometry::real::{Dual, Real};

use super::chain::Chain;
use super::conditions::Conditions;
use super::linkage::RowAngles;
use super::parameters::Displacement;
use super::robot::{DOF, Robot};
use super::statics::{Load, Statics};

mod backlash;
mod joint_compliance;

/// Every effect that the tool knows, in the order of its contract's table.
pub const EFFECTS: &[&dyn Effect] = &[&joint_compliance::JointCompliance, &backlash::Backlash];

/// The effect by which robot files state known compliances.
pub const JOINT_COMPLIANCE: &dyn Effect = &joint_compliance::JointCompliance;

/// Where an effect sits, and the constants that say which of its kind it is. Joints and links count from one here, as
/// they do in files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Location {
    /// The joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<usize>,
    /// The joint whose position causes it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub source_joint: Option<usize>,
    /// The link.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub link: Option<usize>,
    /// Repetitions per joint revolution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<f64>,
    /// The frame that moves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<MovingFrame>,
    /// When it happened, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_s: Option<f64>,
    /// True for the payload.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub payload: Option<bool>,
    /// True for the base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<bool>,
    /// True for the clocks.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clock: Option<bool>,
    /// The value of the effect's cause (a temperature, a time) at which it is zero by definition.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<f64>,
}

/// A frame that can move during a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MovingFrame {
    /// The robot base against the tracker.
    Base,
    /// The measured point against the flange.
    Tool,
}

impl Location {
    /// At a joint, from zero.
    pub fn at_joint(joint: usize) -> Self {
        Self { joint: Some(joint + 1), ..Self::default() }
    }

    /// The joint, from zero.
    pub fn joint_index(&self) -> Option<usize> {
        self.joint.and_then(|joint| joint.checked_sub(1)).filter(|&joint| joint < DOF)
    }

    /// The causing joint, from zero.
    pub fn source_index(&self) -> Option<usize> {
        self.source_joint.and_then(|joint| joint.checked_sub(1)).filter(|&joint| joint < DOF)
    }

    /// The link, from zero.
    pub fn link_index(&self) -> Option<usize> {
        self.link.and_then(|link| link.checked_sub(1)).filter(|&link| link < DOF)
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        let mut say = |part: Option<String>| parts.extend(part);
        say(self.joint.map(|joint| format!("joint {joint}")));
        say(self.source_joint.map(|joint| format!("from joint {joint}")));
        say(self.link.map(|link| format!("link {link}")));
        say(self.order.map(|order| format!("order {order}")));
        say(self.frame.map(|frame| match frame {
            MovingFrame::Base => "base frame".to_string(),
            MovingFrame::Tool => "tool frame".to_string(),
        }));
        say(self.at_s.map(|at_s| format!("at {at_s} s")));
        say(self.payload.map(|_| "payload".to_string()));
        say(self.base.map(|_| "base".to_string()));
        say(self.clock.map(|_| "clock".to_string()));
        f.write_str(&parts.join(", "))
    }
}

/// Which fields of [`Location`] an effect's place has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// `joint`.
    Joint,
    /// `joint` and `order`.
    JointOrder,
    /// `joint` and `source_joint`.
    JointPair,
    /// `link`.
    Link,
    /// `base`.
    Base,
    /// `payload`.
    Payload,
    /// `frame`.
    Frame,
    /// `frame` and `at_s`.
    FrameMoment,
    /// `clock`.
    Clock,
}

impl Place {
    /// The fields of [`Location`] that name this place.
    pub fn fields(self) -> &'static [&'static str] {
        match self {
            Place::Joint => &["joint"],
            Place::JointOrder => &["joint", "order"],
            Place::JointPair => &["joint", "source_joint"],
            Place::Link => &["link"],
            Place::Base => &["base"],
            Place::Payload => &["payload"],
            Place::Frame => &["frame"],
            Place::FrameMoment => &["frame", "at_s"],
            Place::Clock => &["clock"],
        }
    }

    /// True when a location has exactly these fields (a reference value may come with any).
    pub fn fits(self, location: &Location) -> bool {
        let present = [
            ("joint", location.joint_index().is_some()),
            ("source_joint", location.source_index().is_some()),
            ("link", location.link_index().is_some()),
            ("order", location.order.is_some_and(|order| order.is_finite() && order > 0.0)),
            ("frame", location.frame.is_some()),
            ("at_s", location.at_s.is_some_and(f64::is_finite)),
            ("payload", location.payload == Some(true)),
            ("base", location.base == Some(true)),
            ("clock", location.clock == Some(true)),
        ];
        present.iter().all(|(field, is_there)| self.fields().contains(field) == *is_there)
    }
}

/// One parameter of an effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterMeta {
    /// Its name in files.
    pub name: &'static str,
    /// Its unit in files and inside: SI throughout.
    pub unit: &'static str,
    /// A usual size: scales the unknown in a fit and is the width of its prior.
    pub typical: f64,
    /// Smallest and largest value that physics makes believable.
    pub plausible: (f64, f64),
}

/// What a record must tell for the effect to be computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Link masses.
    pub gravity_model: bool,
    /// The sense of the last approach.
    pub approach: bool,
    /// Joint speeds.
    pub speed: bool,
    /// Joint accelerations.
    pub acceleration: bool,
    /// Time.
    pub time: bool,
    /// Temperature.
    pub temperature: bool,
}

/// The name card of an effect.
#[derive(Clone, Copy, Debug)]
pub struct EffectMeta {
    /// The word in files: `backlash`.
    pub id: &'static str,
    /// For people: `play in the gear`.
    pub title: &'static str,
    /// Its parameters.
    pub parameters: &'static [ParameterMeta],
    /// Where it can sit.
    pub place: Place,
    /// What it needs to know.
    pub needs: Needs,
}

/// What an effect can look at.
pub struct Context<'a, T: Real> {
    /// The nominal robot.
    pub robot: &'a Robot,
    /// The record.
    pub conditions: &'a Conditions,
    /// Actuator angles as commanded, rad (see [`super::linkage`]).
    pub actuators_rad: &'a [T; DOF],
    /// Row angles with what is deflected so far.
    pub angles: &'a RowAngles<T>,
    /// The chain as deflected so far.
    pub chain: &'a Chain<T>,
    /// Loads in that pose.
    pub statics: &'a Statics<T>,
    /// What makes those loads.
    pub load: &'a Load<T>,
}

/// What effects do to the arm: the sum over all of them.
#[derive(Clone, Copy, Debug)]
pub struct Response<T: Real> {
    /// Extra turn of each actuator, rad, in the controller's sense.
    pub actuators_rad: [T; DOF],
    /// Extra tilt of each joint axis, rad: a rotation vector in the frame in which the joint turns about z.
    pub tilt: [Vector3<T>; DOF],
    /// Displacement of each link's far end, in the frame after its row.
    pub links: [Displacement<T>; DOF],
    /// Displacement of the base, in the robot base.
    pub base: Displacement<T>,
    /// Displacement of the measured point, in the tool frame.
    pub tool: Displacement<T>,
    /// True when any `tilt` was added.
    pub axes_tilt: bool,
    /// True when any `links` was added.
    pub links_move: bool,
    /// True when `base` was added.
    pub base_moves: bool,
}

impl<T: Real> Response<T> {
    /// Nothing moves.
    pub fn none() -> Self {
        let zero = T::zero();
        Self {
            actuators_rad: [zero; DOF],
            tilt: [Vector3::zeros(); DOF],
            links: [[zero; 6]; DOF],
            base: [zero; 6],
            tool: [zero; 6],
            axes_tilt: false,
            links_move: false,
            base_moves: false,
        }
    }

    /// Turns an actuator further.
    pub fn turn(&mut self, joint: usize, angle_rad: T) {
        self.actuators_rad[joint] += angle_rad;
    }

    /// Tilts a joint axis.
    pub fn tilt_axis(&mut self, joint: usize, vector_rad: Vector3<T>) {
        self.tilt[joint] += vector_rad;
        self.axes_tilt = true;
    }

    /// Displaces the far end of a link.
    pub fn move_link(&mut self, link: usize, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
        add(&mut self.links[link], shift_m, turn_rad);
        self.links_move = true;
    }

    /// Displaces the base.
    pub fn move_base(&mut self, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
        add(&mut self.base, shift_m, turn_rad);
        self.base_moves = true;
    }

    /// Displaces the measured point against the flange.
    pub fn move_tool(&mut self, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
        add(&mut self.tool, shift_m, turn_rad);
    }
}

fn add<T: Real>(to: &mut Displacement<T>, shift_m: Vector3<T>, turn_rad: Vector3<T>) {
    for (component, addend) in to.iter_mut().zip(shift_m.iter().chain(turn_rad.iter())) {
        *component += *addend;
    }
}

/// The physics of an effect. Implement this; [`Effect`] follows from it.
pub trait Physics: Sync {
    /// Its name card.
    fn meta(&self) -> &'static EffectMeta;

    /// Changes loads: gravity, payload, torque of a device. Called before the loads are computed.
    fn load<T: Real>(&self, _at: &Location, _parameters: &[T], _actuators_rad: &[T; DOF], _load: &mut Load<T>) {}

    /// Adds what the arm does because of the effect.
    ///
    /// With all parameters zero nothing may be added.
    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>);
}

/// [`Physics`] behind a pointer: one pair of entries for plain numbers, one for dual ones.
pub trait Effect: Sync {
    /// Its name card.
    fn meta(&self) -> &'static EffectMeta;
    /// [`Physics::load`] in plain numbers.
    fn load_plain(&self, at: &Location, parameters: &[f64], actuators_rad: &[f64; DOF], load: &mut Load<f64>);
    /// [`Physics::load`] with derivatives.
    fn load_dual(&self, at: &Location, parameters: &[Dual], actuators_rad: &[Dual; DOF], load: &mut Load<Dual>);
    /// [`Physics::respond`] in plain numbers.
    fn respond_plain(&self, at: &Location, parameters: &[f64], context: &Context<'_, f64>, out: &mut Response<f64>);
    /// [`Physics::respond`] with derivatives.
    fn respond_dual(&self, at: &Location, parameters: &[Dual], context: &Context<'_, Dual>, out: &mut Response<Dual>);
}

impl<P: Physics> Effect for P {
    fn meta(&self) -> &'static EffectMeta {
        Physics::meta(self)
    }
    fn load_plain(&self, at: &Location, parameters: &[f64], actuators_rad: &[f64; DOF], load: &mut Load<f64>) {
        self.load(at, parameters, actuators_rad, load);
    }
    fn load_dual(&self, at: &Location, parameters: &[Dual], actuators_rad: &[Dual; DOF], load: &mut Load<Dual>) {
        self.load(at, parameters, actuators_rad, load);
    }
    fn respond_plain(&self, at: &Location, parameters: &[f64], context: &Context<'_, f64>, out: &mut Response<f64>) {
        self.respond(at, parameters, context, out);
    }
    fn respond_dual(&self, at: &Location, parameters: &[Dual], context: &Context<'_, Dual>, out: &mut Response<Dual>) {
        self.respond(at, parameters, context, out);
    }
}

/// The scalars that the model runs on: picks the entry of an [`Effect`].
pub trait ModelScalar: Real {
    /// Further rounds towards equilibrium after the value has settled: derivatives follow a round behind, each round
    /// a thousand times nearer.
    const ROUNDS_FOR_DERIVATIVES: usize;

    /// [`Physics::load`].
    fn load(
        effect: &dyn Effect,
        at: &Location,
        parameters: &[Self],
        actuators_rad: &[Self; DOF],
        load: &mut Load<Self>,
    );
    /// [`Physics::respond`].
    fn respond(
        effect: &dyn Effect,
        at: &Location,
        parameters: &[Self],
        context: &Context<'_, Self>,
        out: &mut Response<Self>,
    );
}

impl ModelScalar for f64 {
    const ROUNDS_FOR_DERIVATIVES: usize = 0;

    fn load(effect: &dyn Effect, at: &Location, parameters: &[f64], actuators_rad: &[f64; DOF], load: &mut Load<f64>) {
        effect.load_plain(at, parameters, actuators_rad, load);
    }
    fn respond(
        effect: &dyn Effect,
        at: &Location,
        parameters: &[f64],
        context: &Context<'_, f64>,
        out: &mut Response<f64>,
    ) {
        effect.respond_plain(at, parameters, context, out);
    }
}

impl ModelScalar for Dual {
    const ROUNDS_FOR_DERIVATIVES: usize = 3;

    fn load(
        effect: &dyn Effect,
        at: &Location,
        parameters: &[Dual],
        actuators_rad: &[Dual; DOF],
        load: &mut Load<Dual>,
    ) {
        effect.load_dual(at, parameters, actuators_rad, load);
    }
    fn respond(
        effect: &dyn Effect,
        at: &Location,
        parameters: &[Dual],
        context: &Context<'_, Dual>,
        out: &mut Response<Dual>,
    ) {
        effect.respond_dual(at, parameters, context, out);
    }
}

/// The effect with this id.
pub fn by_id(id: &str) -> Option<&'static dyn Effect> {
    EFFECTS.iter().copied().find(|effect| effect.meta().id == id)
}

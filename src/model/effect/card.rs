//! The name card of an effect: what it is called, which numbers it has, what it needs to know, what it looks like.

use crate::model::conditions::Conditions;
use crate::model::robot::Robot;

use super::location::Place;

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
    /// Temperature, or the time from which a warm-up is guessed.
    pub warmth: bool,
}

impl Needs {
    /// Joint numbers suffice.
    pub const NOTHING: Needs =
        Needs { gravity_model: false, approach: false, speed: false, acceleration: false, time: false, warmth: false };

    /// True when a record of this robot tells what the effect must know.
    pub fn met_by(&self, robot: &Robot, conditions: &Conditions) -> bool {
        (!self.gravity_model || robot.links.is_some())
            && (!self.approach || conditions.approach.iter().any(|&sense| sense != 0.0))
            && (!self.speed || conditions.speed_rad_s.is_some())
            && (!self.acceleration || conditions.acceleration_rad_s2.is_some())
            && (!self.time || conditions.time_s.is_some())
            && (!self.warmth || conditions.temperature_c.is_some() || conditions.time_s.is_some())
    }
}

/// The variable that an effect's error is a function of: what a plot shows it against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Follows {
    /// Its joint's position.
    OwnPosition,
    /// The position of the joint that it comes from.
    SourcePosition,
    /// Its joint's load torque.
    OwnTorque,
    /// Its joint's speed.
    OwnSpeed,
    /// Its joint's acceleration.
    OwnAcceleration,
    /// Time.
    Time,
    /// Temperature, or time where no temperature is known.
    Warmth,
    /// More than one, or none that can be named.
    Several,
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
    /// What its error follows and what it is blind to: one sentence for a report.
    pub signature: &'static str,
    /// Ids of the effects that a recording can confuse it with, the likeliest first.
    pub mistaken_for: &'static [&'static str],
    /// The variable that its error is a function of.
    pub follows: Follows,
    /// The measurement that tells it from those: what to do.
    pub told_apart_by: &'static str,
}

/// What tells apart whatever moves in time: [`EffectMeta::told_apart_by`] of several.
pub const CONTROL_POSES: &str =
    "three control poses every 25 records, one of them with the arm folded, and a reflector on the base";

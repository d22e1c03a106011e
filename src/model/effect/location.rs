//! Where an effect sits.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::model::robot::DOF;

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
    /// The value of the effect's cause at which it is zero by definition (a temperature), or at which it changes sides
    /// (the torque that friction holds), or the time in which it levels off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<f64>,
    /// How a spring that is not straight bends; without it, by a rounded knee.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<SpringLaw>,
}

/// How a spring that is not straight bends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SpringLaw {
    /// Straight up to a torque and straight, with another slope, beyond it.
    Knee,
    /// A spring whose torque has a cubic part.
    Cubic,
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

    /// The same place without the constants of a law.
    pub fn bare(&self) -> Self {
        Self { reference: None, law: None, ..*self }
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
        say(self.at_s.map(|at_s| format!("at {at_s:.1} s")));
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
    /// `joint`, and `law` where the usual one does not hold.
    JointLaw,
    /// `joint` and `order`.
    JointOrder,
    /// `joint`, and `order` where the effect's usual one does not hold.
    JointOwnOrder,
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
            Place::Joint | Place::JointLaw | Place::JointOwnOrder => &["joint"],
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

    /// True where an effect is an error of its joint's angle.
    pub fn turns_its_joint(self) -> bool {
        matches!(self, Place::Joint | Place::JointLaw | Place::JointOrder | Place::JointPair)
    }

    /// A field that a location may have beside these.
    fn may_have(self, field: &str) -> bool {
        matches!((self, field), (Place::JointOwnOrder, "order") | (Place::JointLaw, "law"))
    }

    /// True when a location has exactly these fields (a reference value may come with any).
    pub fn fits(self, location: &Location) -> bool {
        let is_order = |order: f64| order.is_finite() && order > 0.0;
        let present = [
            ("joint", location.joint_index().is_some()),
            ("source_joint", location.source_index().is_some()),
            ("link", location.link_index().is_some()),
            ("order", location.order.is_some()),
            ("frame", location.frame.is_some()),
            ("at_s", location.at_s.is_some_and(f64::is_finite)),
            ("payload", location.payload == Some(true)),
            ("base", location.base == Some(true)),
            ("clock", location.clock == Some(true)),
            ("law", location.law.is_some()),
        ];
        location.order.is_none_or(is_order)
            && present
                .iter()
                .all(|(field, is_there)| self.may_have(field) || self.fields().contains(field) == *is_there)
    }
}

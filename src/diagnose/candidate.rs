//! What may be missing: every effect of the registry at every place where it could sit.

use crate::identify::problem::Problem;
use crate::model::arm::{ArmModel, EffectInstance};
use crate::model::effect::{EFFECTS, Effect, JOINT_COMPLIANCE, Location, MovingFrame, Place};
use crate::model::robot::DOF;

/// A named cause that the model does not have.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The effect at its place first; then effects that belong to it (the straight part of a bent spring).
    pub instances: Vec<EffectInstance>,
    /// Places at which the search looks for this kind: the more, the more must be shown.
    pub places: f64,
    /// Constants of the location that the search chose to fit (an order between whole numbers).
    pub chosen_constants: usize,
}

impl Candidate {
    /// The effect that gives the name.
    pub fn effect(&self) -> &'static dyn Effect {
        self.instances[0].effect
    }

    /// Its id.
    pub fn id(&self) -> &'static str {
        self.effect().meta().id
    }

    /// Where.
    pub fn location(&self) -> &Location {
        &self.instances[0].location
    }

    /// True when both say the same: the same effect in the same place, orders as good as equal.
    pub fn same_as(&self, other: &Candidate) -> bool {
        let bare = |location: &Location| Location { order: None, at_s: None, ..location.bare() };
        let near = |a: Option<f64>, b: Option<f64>, within: f64| match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() < within,
            (a, b) => a.is_none() == b.is_none(),
        };
        let (a, b) = (self.location(), other.location());
        self.id() == other.id() && bare(a) == bare(b) && near(a.order, b.order, ORDER_APART)
    }
}

/// Orders of one joint that are nearer than this are one line: joints turn less than two revolutions.
const ORDER_APART: f64 = 0.5;
/// Whole orders up to here are believed without a search: eccentricity, ovality, few poles.
const LOW_ORDERS: usize = 12;
/// Orders at which an axis may tilt (once is geometry).
const WOBBLE_ORDERS: [Option<f64>; 3] = [None, Some(3.0), Some(4.0)];
/// Part of the records that must tell what an effect needs.
const NEEDED_PART: f64 = 0.5;

/// Every candidate but the fine search over orders and moments (see [`super::scan`]).
pub fn candidates(model: &ArmModel, problem: &Problem<'_>) -> Vec<Candidate> {
    let mut all = Vec::new();
    for &effect in EFFECTS {
        if !is_told(effect, model, problem) {
            continue;
        }
        let places: Vec<Location> = places_of(effect.meta().place, model);
        let count = places.len() as f64;
        let known = |location: &Location| {
            let here = |known: &EffectInstance| known.location.bare() == location.bare();
            model.effects.iter().any(|known| known.effect.meta().id == effect.meta().id && here(known))
        };
        for location in places.into_iter().filter(|location| !known(location)) {
            let instances = with_companion(effect, location, model);
            all.push(Candidate { instances, places: count, chosen_constants: 0 });
        }
    }
    all
}

/// True when most records tell what the effect must know.
pub fn is_told(effect: &dyn Effect, model: &ArmModel, problem: &Problem<'_>) -> bool {
    let needs = effect.meta().needs;
    let telling =
        problem.records.iter().filter(|record| needs.met_by(&model.robot, &record.observation.conditions)).count();
    telling as f64 >= NEEDED_PART * problem.records.len() as f64
}

/// An effect with what belongs to it: a spring that is not straight has a straight part as well, which the model may lack
/// too.
pub fn with_companion(effect: &'static dyn Effect, location: Location, model: &ArmModel) -> Vec<EffectInstance> {
    let bent = effect.meta().id == "joint_stiffening";
    let known = model
        .effects
        .iter()
        .any(|known| known.effect.meta().id == JOINT_COMPLIANCE.meta().id && known.location.joint == location.joint);
    let straight = (bent && !known).then_some(EffectInstance { effect: JOINT_COMPLIANCE, location: location.bare() });
    std::iter::once(EffectInstance { effect, location }).chain(straight).collect()
}

fn places_of(place: Place, model: &ArmModel) -> Vec<Location> {
    let joints = || (0..DOF).map(Location::at_joint);
    let links = (0..DOF).map(|link| Location { link: Some(link + 1), ..Location::default() });
    let here = Location::default();
    match place {
        Place::Joint | Place::JointLaw => joints().collect(),
        Place::JointOrder => joints()
            .flat_map(|at| (1..=LOW_ORDERS).map(move |order| Location { order: Some(order as f64), ..at }))
            .collect(),
        Place::JointOwnOrder => joints().flat_map(|at| WOBBLE_ORDERS.map(|order| Location { order, ..at })).collect(),
        Place::JointPair => joints()
            .flat_map(|at| (1..=DOF).map(move |source| Location { source_joint: Some(source), ..at }))
            .filter(|at| at.joint != at.source_joint)
            .collect(),
        Place::Link => links.collect(),
        Place::Base => vec![Location { base: Some(true), ..here }],
        Place::Payload if model.robot.links.is_some() => vec![Location { payload: Some(true), ..here }],
        Place::Payload => Vec::new(),
        Place::Frame => FRAMES.map(|frame| Location { frame: Some(frame), ..here }).into(),
        Place::FrameMoment => Vec::new(),
        Place::Clock => vec![Location { clock: Some(true), ..here }],
    }
}

/// The frames that can move.
pub const FRAMES: [MovingFrame; 2] = [MovingFrame::Base, MovingFrame::Tool];

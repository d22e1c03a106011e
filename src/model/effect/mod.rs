//! What a nominal robot leaves out, one effect a file. Each is written once over the scalar: its value serves
//! prediction and correction, its derivatives identification, its presence or absence diagnosis.
//!
//! To add an effect: one file with a unit struct that implements [`Physics`], and one line in [`EFFECTS`].

use nalgebra::Vector3;

use crate::geometry::real::{DUAL_WIDTH, Dual, Real, derivatives};

use super::chain::Chain;
use super::conditions::Conditions;
use super::linkage::RowAngles;
use super::robot::{DOF, Robot};
use super::statics::{Load, Statics};

mod axis_wobble;
mod backlash;
mod base_compliance;
mod card;
mod drift;
mod friction_windup;
mod gear_ratio;
mod gravity_compensator;
mod gravity_tilt;
mod inertial_deflection;
mod joint_compliance;
mod joint_coupling;
mod joint_periodic;
mod joint_stiffening;
mod link_flexibility;
mod location;
mod payload_error;
mod response;
mod servo_lag;
mod step_shift;
mod thermal_growth;
mod time_offset;

pub use card::{CONTROL_POSES, EffectMeta, Follows, Needs, ParameterMeta};
pub use location::{Location, MovingFrame, Place, SpringLaw};
pub use response::Response;

/// Every effect that the tool knows, in the order of its contract's table.
pub const EFFECTS: &[&dyn Effect] = &[
    &joint_compliance::JointCompliance,
    &joint_stiffening::JointStiffening,
    &link_flexibility::LinkFlexibility,
    &backlash::Backlash,
    &friction_windup::FrictionWindup,
    &joint_periodic::JointPeriodic,
    &gear_ratio::GearRatio,
    &joint_coupling::JointCoupling,
    &axis_wobble::AxisWobble,
    &gravity_compensator::GravityCompensator,
    &payload_error::PayloadError,
    &gravity_tilt::GravityTilt,
    &base_compliance::BaseCompliance,
    &thermal_growth::ThermalGrowth,
    &drift::Drift,
    &step_shift::StepShift,
    &time_offset::TimeOffset,
    &servo_lag::ServoLag,
    &inertial_deflection::InertialDeflection,
];

/// The effect by which robot files state known compliances.
pub const JOINT_COMPLIANCE: &dyn Effect = &joint_compliance::JointCompliance;

/// What an effect on the loads can look at: nothing that the loads themselves decide.
pub struct Setting<'a, T: Real> {
    /// The nominal robot.
    pub robot: &'a Robot,
    /// The record.
    pub conditions: &'a Conditions,
    /// Actuator angles as commanded, rad (see [`super::linkage`]).
    pub actuators_rad: &'a [T; DOF],
}

/// What an effect on the arm can look at.
pub struct Context<'a, T: Real> {
    /// The nominal robot.
    pub robot: &'a Robot,
    /// What weight could at most make at each joint, Nm (see [`super::statics::largest_torque_nm`]).
    pub largest_torque_nm: &'a [f64; DOF],
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

impl<T: Real> Context<'_, T> {
    /// The two ends of a link in the robot base, m: where its own joint's axis frame stands, and where the next
    /// one's does (for the last link the flange). With either convention this is the body between two drives.
    pub fn link_ends_m(&self, link: usize) -> (Vector3<T>, Vector3<T>) {
        let far = match self.chain.axes.get(link + 1) {
            Some(next) => next.origin,
            None => self.chain.flange().translation,
        };
        (self.chain.axes[link].origin, far)
    }

    /// Moves the far end of a link by a shift in m and a turn in rad, both in the robot base.
    ///
    /// [`Response::links`] counts in the frame after the row, whose origin is not the far end where a modified row
    /// still has its `a` to go: the turn carries the one to the other, to first order.
    pub fn move_far_end(&self, link: usize, shift_m: &Vector3<T>, turn_rad: &Vector3<T>, response: &mut Response<T>) {
        let frame = &self.chain.frames[link];
        let (_, far) = self.link_ends_m(link);
        let to_frame = frame.rotation.transpose();
        let at_frame = shift_m - turn_rad.cross(&(far - frame.translation));
        response.move_link(link, to_frame * at_frame, to_frame * turn_rad);
    }
}

/// The physics of an effect. Implement this; [`Effect`] follows from it.
pub trait Physics: Sync {
    /// Its name card.
    fn meta(&self) -> &'static EffectMeta;

    /// Changes loads: gravity, payload, torque of a device. Called before the loads are computed.
    fn load<T: Real>(&self, _at: &Location, _parameters: &[T], _setting: &Setting<'_, T>, _load: &mut Load<T>) {}

    /// Adds what the arm does because of the effect.
    ///
    /// With all parameters zero nothing may be added.
    fn respond<T: Real>(
        &self,
        _at: &Location,
        _parameters: &[T],
        _context: &Context<'_, T>,
        _response: &mut Response<T>,
    ) {
    }

    /// False for fitted numbers that no such device has together, each known to its sigma; the range of each by itself stands on
    /// the name card.
    fn is_believable(&self, _parameters: &[f64], _sigmas: &[f64]) -> bool {
        true
    }
}

/// [`Physics`] behind a pointer: one pair of entries for plain numbers, one for dual ones.
pub trait Effect: Sync {
    /// Its name card.
    fn meta(&self) -> &'static EffectMeta;
    /// [`Physics::load`] in plain numbers.
    fn load_plain(&self, at: &Location, parameters: &[f64], setting: &Setting<'_, f64>, load: &mut Load<f64>);
    /// [`Physics::load`] with derivatives.
    fn load_dual(&self, at: &Location, parameters: &[Dual], setting: &Setting<'_, Dual>, load: &mut Load<Dual>);
    /// [`Physics::respond`] in plain numbers.
    fn respond_plain(&self, at: &Location, parameters: &[f64], context: &Context<'_, f64>, out: &mut Response<f64>);
    /// [`Physics::respond`] with derivatives.
    fn respond_dual(&self, at: &Location, parameters: &[Dual], context: &Context<'_, Dual>, out: &mut Response<Dual>);
    /// [`Physics::is_believable`].
    fn is_believable(&self, parameters: &[f64], sigmas: &[f64]) -> bool;
}

impl<P: Physics> Effect for P {
    fn meta(&self) -> &'static EffectMeta {
        Physics::meta(self)
    }
    fn load_plain(&self, at: &Location, parameters: &[f64], setting: &Setting<'_, f64>, load: &mut Load<f64>) {
        self.load(at, parameters, setting, load);
    }
    fn load_dual(&self, at: &Location, parameters: &[Dual], setting: &Setting<'_, Dual>, load: &mut Load<Dual>) {
        self.load(at, parameters, setting, load);
    }
    fn respond_plain(&self, at: &Location, parameters: &[f64], context: &Context<'_, f64>, out: &mut Response<f64>) {
        self.respond(at, parameters, context, out);
    }
    fn respond_dual(&self, at: &Location, parameters: &[Dual], context: &Context<'_, Dual>, out: &mut Response<Dual>) {
        self.respond(at, parameters, context, out);
    }
    fn is_believable(&self, parameters: &[f64], sigmas: &[f64]) -> bool {
        Physics::is_believable(self, parameters, sigmas)
    }
}

/// The scalars that the model runs on: picks the entry of an [`Effect`].
pub trait ModelScalar: Real {
    /// By how much the derivatives of two responses differ, in parts of the largest that they or the flange's place have; zero for
    /// plain numbers. They settle later than the values do.
    fn change_of_slopes(now: &Response<Self>, last: &Response<Self>, flange_m: &Vector3<Self>) -> f64;

    /// [`Physics::load`].
    fn load(
        effect: &dyn Effect,
        at: &Location,
        parameters: &[Self],
        setting: &Setting<'_, Self>,
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
    fn change_of_slopes(_: &Response<f64>, _: &Response<f64>, _: &Vector3<f64>) -> f64 {
        0.0
    }

    fn load(effect: &dyn Effect, at: &Location, parameters: &[f64], setting: &Setting<'_, f64>, load: &mut Load<f64>) {
        effect.load_plain(at, parameters, setting, load);
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
    fn change_of_slopes(now: &Response<Dual>, last: &Response<Dual>, flange_m: &Vector3<Dual>) -> f64 {
        let (mut change, mut size) = ([0.0f64; DUAL_WIDTH], [0.0f64; DUAL_WIDTH]);
        for (now, last) in now.numbers().zip(last.numbers()) {
            let (now, last) = (derivatives(now), derivatives(last));
            for slot in 0..DUAL_WIDTH {
                change[slot] = change[slot].max((now[slot] - last[slot]).abs());
                size[slot] = size[slot].max(now[slot].abs());
            }
        }
        for slopes in flange_m.iter().map(derivatives) {
            size.iter_mut().zip(slopes).for_each(|(size, slope)| *size = size.max(slope.abs()));
        }
        let parts = change.iter().zip(&size).filter(|(_, size)| **size > 0.0).map(|(change, size)| change / size);
        parts.fold(0.0, f64::max)
    }

    fn load(
        effect: &dyn Effect,
        at: &Location,
        parameters: &[Dual],
        setting: &Setting<'_, Dual>,
        load: &mut Load<Dual>,
    ) {
        effect.load_dual(at, parameters, setting, load);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::real::seeded;

    #[test]
    fn derivatives_that_are_rounding_beside_those_of_the_flange_have_settled() {
        let turned = |slope: f64| {
            let mut response = Response::none();
            response.turn(2, seeded(0.0, 0) * Dual::constant(slope));
            response
        };
        let flange_m = Vector3::new(seeded(1.2, 0), Dual::constant(0.0), Dual::constant(0.4));
        assert!(Dual::change_of_slopes(&turned(1e-19), &turned(-1e-19), &flange_m) < 1e-15);
        let still = Vector3::from_element(Dual::constant(1.0));
        assert!((Dual::change_of_slopes(&turned(3e-7), &turned(2e-7), &still) - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!(Dual::change_of_slopes(&turned(0.0), &turned(0.0), &still), 0.0);
    }
}

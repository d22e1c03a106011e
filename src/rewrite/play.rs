//! A program on a real arm: where each target lands.

use crate::files::cell::Cell;
use crate::geometry::pose::Pose;
use crate::invert::RealArm;
use crate::kinematics::controller::Controller;
use crate::model::arm::ArmModel;
use crate::model::conditions::Conditions;
use crate::program::target::{Program, TargetValue};

use super::setting::Settings;
use super::visits::{follow, senses};

/// Where one arrival lands.
#[derive(Clone, Debug)]
pub struct Arrival {
    /// The target.
    pub target: usize,
    /// Which of its uses.
    pub one_use: usize,
    /// The target as written, in its frame.
    pub written: Pose,
    /// Where the real tool stands, in the same frame.
    pub landed: Pose,
}

/// Plays every static move of a program: the controller's nominal inverse, then the real arm. Arrivals that the nominal
/// robot cannot make are left out; joint targets count with the pose that the nominal robot takes.
pub fn play(program: &Program, cell: &Cell, real: &ArmModel, controller: &Controller) -> Vec<Arrival> {
    let arm = RealArm::new(real);
    let mut settings = Settings::new(program, cell, &arm);
    let visits = follow(program, &mut settings, controller);
    let approaches = senses(program, controller, &visits, |index| visits[index].nominal_rad.as_ref().ok().copied());
    visits
        .iter()
        .zip(&approaches)
        .filter_map(|(visit, &approach)| {
            let setting = settings.at(visit.setting, &program.targets[visit.target]).ok()?;
            let numbers = visit.nominal_rad.as_ref().ok()?;
            let conditions = Conditions { approach, payload: setting.payload, ..Conditions::default() };
            let landed = setting.landed(&arm.flange(numbers, &conditions).ok()?);
            let is_joint = matches!(program.targets[visit.target].value, TargetValue::Joint(_));
            let written = if is_joint { setting.target(&controller.forward(numbers).ok()?) } else { visit.written };
            Some(Arrival { target: visit.target, one_use: visit.one_use, written, landed })
        })
        .collect()
}

//! A program on a real arm: where each target lands.

use crate::files::cell::Cell;
use crate::geometry::pose::Pose;
use crate::invert::RealArm;
use crate::kinematics::controller::Controller;
use crate::model::arm::ArmModel;
use crate::model::conditions::Conditions;
use crate::model::robot::DOF;
use crate::program::target::{Program, TargetValue};

use super::setting::Settings;
use super::visits::{Visit, follow, senses, written_pose};

/// Where one arrival lands.
#[derive(Clone, Debug)]
pub struct Arrival {
    /// The target.
    pub target: usize,
    /// Which of its uses.
    pub one_use: usize,
    /// Joint numbers that the controller commands for the target as written, rad.
    pub numbers_rad: [f64; DOF],
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
    let approaches = senses(program, controller, &visits, Visit::numbers_rad);
    visits
        .iter()
        .zip(&approaches)
        .filter_map(|(visit, approach)| {
            let target = &program.targets[visit.target()];
            let setting = settings.at(visit.setting(), target).ok()?;
            let numbers_rad = visit.numbers_rad()?;
            let approach = approach.map(f64::from);
            let conditions = Conditions { approach, payload: setting.payload, ..Conditions::default() };
            let landed = setting.landed(&arm.flange(&numbers_rad, &conditions).ok()?);
            let written = match &target.value {
                TargetValue::Joint(_) => setting.target(&controller.forward(&numbers_rad).ok()?),
                value => written_pose(program, value)?,
            };
            Some(Arrival { target: visit.target(), one_use: visit.one_use(), numbers_rad, written, landed })
        })
        .collect()
}

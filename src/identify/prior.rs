//! What is known of a robot before it is measured.
//!
//! The widths are those of the error sizes found in the literature on uncalibrated arms (Judd and Knasinski 1990;
//! Renders et al. 1991; Nubiola and Bonev 2013; catalogue of this project's physics notes), taken generously: an
//! ordinary recording overrules them, a recording of 40 poses leans on them. They are stated in docs/identification.md.

use crate::model::arm::ArmModel;
use crate::model::effect::JOINT_COMPLIANCE;
use crate::model::parameters::{ParameterId, RowQuantity};
use crate::model::robot::Robot;

use super::unknown::{Prior, Unknown, UnknownId};

/// Error of a length: this part of the reach ...
const LENGTH_PER_REACH: f64 = 4e-4;
/// ... and this much in any case, m.
const LENGTH_M: f64 = 3e-4;
/// Zero of a joint, rad.
const OFFSET_RAD: f64 = 5e-3;
/// Twist of a link, rad.
const TWIST_RAD: f64 = 1e-3;
/// Rods of a parallelogram, m: what matters is their difference, which is machined.
const ROD_M: f64 = 5e-4;
/// A base or tool that the robot file states, m and rad: set up by hand.
const STATED_FRAME: [f64; 2] = [1e-2, 1e-2];
/// A base, tool or station that was found from the recording itself, m and rad: free but for numerical safety.
const FOUND_FRAME: [f64; 2] = [0.2, 0.2];
/// Twist of a drive train under its largest torque, rad ...
const DEFLECTION_RAD: f64 = 3e-3;
/// ... unless that makes it softer than the softest drives, rad/Nm: where hardly any torque acts, the recording says
/// nothing of the stiffness and must not be asked.
const SOFTEST_RAD_PER_NM: f64 = 5e-5;
/// Other effects: this many times their usual size.
const TYPICAL: f64 = 5.0;

/// Sum of all lengths of the arm, m: its size.
pub fn reach_m(robot: &Robot) -> f64 {
    robot.joints.iter().map(|joint| joint.a_m.abs() + joint.d_m.abs()).sum()
}

/// The prior of a number of the model.
///
/// `largest_torque_nm` holds the largest static torque of each actuator over the recording: the width of a compliance
/// is the one that would make [`DEFLECTION_RAD`] of it.
pub fn prior_of(id: ParameterId, nominal: &ArmModel, largest_torque_nm: &[f64]) -> Prior {
    let frame = |stated: bool, component: usize| {
        let widths = if stated { STATED_FRAME } else { FOUND_FRAME };
        Prior { mean: 0.0, sigma: widths[component / 3] }
    };
    let robot = &nominal.robot;
    let centred = |sigma| Prior { mean: 0.0, sigma };
    match id {
        ParameterId::Row(_, RowQuantity::Offset) => centred(OFFSET_RAD),
        ParameterId::Row(_, RowQuantity::D | RowQuantity::A) => centred(LENGTH_M + LENGTH_PER_REACH * reach_m(robot)),
        ParameterId::Row(_, RowQuantity::Alpha | RowQuantity::Beta) => centred(TWIST_RAD),
        ParameterId::Base(component) => frame(robot.base.is_some(), component),
        ParameterId::Tool(component) => frame(robot.tool.is_some(), component),
        ParameterId::Loop(_) => centred(ROD_M),
        ParameterId::Effect(effect, parameter) => effect_prior(effect, parameter, nominal, largest_torque_nm),
    }
}

fn effect_prior(effect: usize, parameter: usize, nominal: &ArmModel, largest_torque_nm: &[f64]) -> Prior {
    let Some(instance) = nominal.effects.get(effect) else {
        return Prior { mean: 0.0, sigma: 1.0 };
    };
    let meta = instance.effect.meta();
    let typical = meta.parameters.get(parameter).map_or(1.0, |parameter| parameter.typical);
    if meta.id != JOINT_COMPLIANCE.meta().id {
        return Prior { mean: 0.0, sigma: TYPICAL * typical };
    }
    let joint = instance.location.joint_index().unwrap_or(0);
    let torque = largest_torque_nm.get(joint).copied().unwrap_or(0.0);
    let mean = nominal.robot.compliance_rad_per_nm[joint];
    let sigma = (DEFLECTION_RAD / torque.max(f64::MIN_POSITIVE)).min(SOFTEST_RAD_PER_NM);
    // A drive that the file knows to be softer than that is known to a half.
    Prior { mean, sigma: sigma.max(0.5 * mean) }
}

/// An unknown of the model with its prior.
pub fn unknown_of(id: ParameterId, nominal: &ArmModel, largest_torque_nm: &[f64]) -> Unknown {
    Unknown { id: UnknownId::Model(id), prior: prior_of(id, nominal, largest_torque_nm) }
}

/// The six unknowns of a station's frame.
pub fn unknowns_of_station(station: usize) -> impl Iterator<Item = Unknown> {
    (0..6).map(move |component| Unknown {
        id: UnknownId::Station { station, component },
        prior: Prior { mean: 0.0, sigma: FOUND_FRAME[component / 3] },
    })
}

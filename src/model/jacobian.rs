//! How the flange moves with the controller's numbers.

use nalgebra::{Matrix6, Vector3};

use crate::geometry::real::Real;

use super::chain::Chain;
use super::linkage::RowAngles;
use super::robot::{DOF, LOOP_AROUND, LOOP_DRIVEN, Robot};

/// Geometric Jacobian of the flange with respect to the controller's numbers, in the robot base.
///
/// Column j is the twist of the flange for one rad of joint number j: rows 0 to 2 the translation of the flange's
/// origin, m, rows 3 to 5 the rotation, rad. It holds for the nominal chain and for the real one alike, loop and
/// coupled displays included; what deflections change with the pose is not in it.
///
/// # Arguments
/// * `chain` - the chain at the row angles `angles`
/// * `angles` - with them how the driven row of a parallelogram follows its actuators
///
/// # Source
/// Siciliano, Sciavicco, Villani and Oriolo 2009, equation 3.30, for the rows; the loop by the chain rule.
pub fn jacobian_from_chain<T: Real>(robot: &Robot, chain: &Chain<T>, angles: &RowAngles<T>) -> Matrix6<T> {
    let flange = chain.flange().translation;
    let row_twists: [(Vector3<T>, Vector3<T>); DOF] = chain.axes.map(|axis| {
        let lever = flange - axis.origin;
        (axis.direction.cross(&lever), axis.direction)
    });
    let mut by_actuator = Matrix6::zeros();
    let mut add = |joint: usize, row: usize, rate: T| {
        let (shift, turn) = &row_twists[row];
        for axis in 0..3 {
            by_actuator[(axis, joint)] += shift[axis] * rate;
            by_actuator[(axis + 3, joint)] += turn[axis] * rate;
        }
    };
    for joint in 0..DOF {
        let own = if joint == LOOP_DRIVEN { angles.driven_by_own } else { T::constant(robot.joints[joint].sign) };
        add(joint, joint, own);
    }
    add(LOOP_AROUND, LOOP_DRIVEN, angles.driven_by_around);

    let mut by_number = by_actuator;
    for coupling in &robot.couplings {
        let share = T::constant(coupling.factor * robot.joints[coupling.joint].sign);
        for row in 0..6 {
            by_number[(row, coupling.by)] += by_actuator[(row, coupling.joint)] * share;
        }
    }
    by_number
}

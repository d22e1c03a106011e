//! Causes without a name: any smooth function of one or two variables, at a joint or a frame.

use nalgebra::DMatrix;

use crate::geometry::pose::Pose;
use crate::identify::problem::Record;
use crate::model::arm::{ArmState, PreparedArm};
use crate::model::conditions::Conditions;
use crate::model::effect::{Location, MovingFrame};
use crate::model::linkage::actuators_from_numbers;
use crate::model::robot::DOF;

use super::regressors::Regressors;

/// A variable that an error may depend on. Joints count from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Variable {
    /// A joint's position: the angle of its drive, which on coupled joints is not the number that the controller shows.
    Position(usize),
    /// The sense in which a joint arrived.
    Approach(usize),
    /// A joint's load torque.
    Torque(usize),
    /// Its speed.
    Speed(usize),
    /// Its acceleration.
    Acceleration(usize),
    /// Time.
    Time,
    /// Temperature.
    Temperature,
    /// The direction, seen from above, in which a tracker that stands there looks at the point.
    Beam(Stand),
}

/// Where a tracker may stand: x and y in the robot base, mm.
pub type Stand = [i32; 2];

impl Variable {
    /// The word in reports.
    pub fn word(self) -> String {
        match self {
            Variable::Position(joint) => format!("q{}", joint + 1),
            Variable::Approach(joint) => format!("dir{}", joint + 1),
            Variable::Torque(joint) => format!("torque{}", joint + 1),
            Variable::Speed(joint) => format!("qd{}", joint + 1),
            Variable::Acceleration(joint) => format!("qdd{}", joint + 1),
            Variable::Time => "t_s".into(),
            Variable::Temperature => "temp_c".into(),
            Variable::Beam(_) => "beam_azimuth".into(),
        }
    }

    /// True for what is measured in radians or parts of them.
    pub fn is_angular(self) -> bool {
        matches!(self, Variable::Position(_) | Variable::Speed(_) | Variable::Acceleration(_) | Variable::Beam(_))
    }

    /// Its value in a record, SI; `None` where the record does not say.
    pub fn value(self, arm: &PreparedArm<'_, f64>, stand: &ArmState<f64>, conditions: &Conditions) -> Option<f64> {
        let of_drive = |rates: &[f64; DOF], joint: usize| actuators_from_numbers(&arm.model().robot, rates)[joint];
        match self {
            Variable::Position(joint) => Some(stand.actuators_rad[joint]),
            Variable::Approach(joint) => Some(conditions.approach[joint]),
            Variable::Torque(joint) => Some(stand.statics.actuator_torque_nm[joint]),
            Variable::Speed(joint) => conditions.speed_rad_s.map(|speed| of_drive(&speed, joint)),
            Variable::Acceleration(joint) => conditions.acceleration_rad_s2.map(|rates| of_drive(&rates, joint)),
            Variable::Time => conditions.time_s,
            Variable::Temperature => conditions.temperature_c,
            Variable::Beam(at_mm) => Some(beam_azimuth_rad(at_mm, stand, &arm.flange_t_tool())),
        }
    }
}

/// Where an unnamed cause acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seat {
    /// It turns a joint.
    Joint(usize),
    /// It displaces the base.
    Base,
    /// It displaces the measured point.
    Tool,
    /// It turns the beam of a tracker that stands there.
    Tracker(Stand),
}

/// An unnamed cause.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FreeFunction {
    /// Where it acts.
    pub seat: Seat,
    /// What it depends on: one or two variables.
    pub variables: Vec<Variable>,
}

/// Highest degree of a polynomial in one of two variables ...
const DEGREE_OF_PAIR: usize = 4;
/// ... and in a joint's position alone: a damaged tooth is narrow.
const DEGREE_ALONE: usize = 20;
/// Highest degree in the direction of a beam.
const DEGREE_OF_BEAM: usize = 12;
/// Highest degree in a variable that is no angle.
const DEGREE_OTHER: usize = 4;

/// Every unnamed cause that is looked at.
pub fn free_functions(regressors: &Regressors<'_, '_>) -> Vec<FreeFunction> {
    let mut all = Vec::new();
    let varies = |variable: Variable| spread(&values(regressors, variable)).is_some();
    for joint in 0..DOF {
        let seat = Seat::Joint(joint);
        for first in 0..DOF {
            all.push(FreeFunction { seat, variables: vec![Variable::Position(first)] });
            all.extend((first + 1..DOF).map(|second| FreeFunction {
                seat,
                variables: vec![Variable::Position(first), Variable::Position(second)],
            }));
            all.push(FreeFunction { seat, variables: vec![Variable::Approach(joint), Variable::Position(first)] });
        }
        let own = [Variable::Torque(joint), Variable::Speed(joint), Variable::Acceleration(joint)];
        all.extend(own.map(|variable| FreeFunction { seat, variables: vec![variable] }));
        all.extend([Variable::Time, Variable::Temperature].map(|v| FreeFunction { seat, variables: vec![v] }));
    }
    for seat in [Seat::Base, Seat::Tool] {
        all.extend([Variable::Time, Variable::Temperature].map(|v| FreeFunction { seat, variables: vec![v] }));
    }
    all.retain(|function| function.variables.iter().all(|&variable| varies(variable)));
    all
}

impl FreeFunction {
    /// True for an error of a joint by its own position alone: enough lines of a spectrum are any such function, so that names in
    /// number say nothing against it.
    pub fn is_of_own_position(&self) -> bool {
        matches!((self.seat, &self.variables[..]), (Seat::Joint(joint), &[Variable::Position(own)]) if own == joint)
    }

    /// True for what turns a tracker's beam: an error of the measurement.
    pub fn is_of_tracker(&self) -> bool {
        matches!(self.seat, Seat::Tracker(_))
    }

    /// The joint that it turns, from zero.
    pub fn joint(&self) -> Option<usize> {
        match self.seat {
            Seat::Joint(joint) => Some(joint),
            Seat::Base | Seat::Tool | Seat::Tracker(_) => None,
        }
    }

    /// True when a named effect at this place is by its definition a function of this kind: only the law is another, and laws
    /// are never exact.
    pub fn is_what_means(&self, id: &str, at: &Location) -> bool {
        match (self.seat, &self.variables[..]) {
            (Seat::Joint(joint), &[Variable::Torque(own)]) if own == joint => {
                id == "joint_stiffening" && at.joint_index() == Some(joint)
            }
            (Seat::Joint(joint), &[Variable::Speed(own)]) if own == joint => {
                id == "servo_lag" && at.joint_index() == Some(joint)
            }
            (Seat::Base, [Variable::Time]) => id == "drift" && at.frame == Some(MovingFrame::Base),
            (Seat::Tool, [Variable::Time]) => id == "drift" && at.frame == Some(MovingFrame::Tool),
            _ => false,
        }
    }

    /// Whitened columns: the levers of the seat times Legendre polynomials of the variables over their range, each the
    /// smaller the higher its degree, as smooth functions have it.
    pub fn columns(&self, regressors: &Regressors<'_, '_>) -> DMatrix<f64> {
        let shapes = self.shapes(regressors);
        let levers = match self.seat {
            Seat::Joint(joint) => regressors.joints.columns(joint, 1).into_owned(),
            Seat::Base => regressors.base.clone(),
            Seat::Tool => regressors.tool.clone(),
            Seat::Tracker(at_mm) => about_vertical(&regressors.base, at_mm),
        };
        let rows = regressors.record_of.len();
        let mut columns = DMatrix::zeros(rows, shapes.len() * levers.ncols());
        for (index, shape) in shapes.iter().enumerate() {
            for lever in 0..levers.ncols() {
                for row in 0..rows {
                    columns[(row, index * levers.ncols() + lever)] =
                        levers[(row, lever)] * shape[regressors.record_of[row]];
                }
            }
        }
        columns
    }

    /// The functions themselves, one value a record; the constant is left out.
    fn shapes(&self, regressors: &Regressors<'_, '_>) -> Vec<Vec<f64>> {
        let of = |variable: Variable, degree: usize| smaller(polynomials(&values(regressors, variable), degree));
        match self.variables[..] {
            [Variable::Approach(joint), other] => {
                let sense = values(regressors, Variable::Approach(joint));
                of(other, DEGREE_OF_PAIR).into_iter().map(|shape| product(&sense, &shape)).collect()
            }
            [first, second] => {
                let (first, second) = (of(first, DEGREE_OF_PAIR), of(second, DEGREE_OF_PAIR));
                let pairs = first.iter().flat_map(|a| second.iter().map(move |b| product(a, b)));
                pairs.skip(1).collect()
            }
            [alone @ Variable::Position(_)] => of(alone, DEGREE_ALONE).into_iter().skip(1).collect(),
            [alone @ Variable::Beam(_)] => of(alone, DEGREE_OF_BEAM).into_iter().skip(1).collect(),
            [alone] => of(alone, DEGREE_OTHER).into_iter().skip(1).collect(),
            _ => Vec::new(),
        }
    }
}

/// The lever of a turn about the vertical through a place: about that of the base, and the shift that brings the axis there.
fn about_vertical(base: &DMatrix<f64>, at_mm: Stand) -> DMatrix<f64> {
    let [x_m, y_m] = at_mm.map(|mm| 1e-3 * f64::from(mm));
    let lever = base.column(5) + base.column(0) * y_m - base.column(1) * x_m;
    DMatrix::from_column_slice(base.nrows(), 1, lever.as_slice())
}

/// The direction of a beam to the measured point, seen from above, rad: 0 towards the robot base.
fn beam_azimuth_rad(at_mm: Stand, stand: &ArmState<f64>, flange_t_tool: &Pose) -> f64 {
    let point = (stand.base_t_flange * *flange_t_tool).translation;
    let [x_m, y_m] = at_mm.map(|mm| 1e-3 * f64::from(mm));
    let (along, across) =
        (-(point.x - x_m) * x_m - (point.y - y_m) * y_m, (point.x - x_m) * y_m - (point.y - y_m) * x_m);
    across.atan2(along)
}

fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).collect()
}

/// The variable at every record; where a record does not say, zero.
pub fn values(regressors: &Regressors<'_, '_>, variable: Variable) -> Vec<f64> {
    let records = regressors.problem.records.iter().zip(&regressors.stands);
    let arm = regressors.model().prepared();
    let value = |(record, stand): (&Record<'_>, &ArmState<f64>)| {
        variable.value(&arm, stand, &record.observation.conditions).unwrap_or(0.0)
    };
    records.map(value).collect()
}

/// Each function divided by its number: what a smooth function has of them at most, up to a common factor.
fn smaller(shapes: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let divided = |(degree, shape): (usize, Vec<f64>)| {
        let by = (1 + degree) as f64;
        shape.into_iter().map(|value| value / by).collect()
    };
    shapes.into_iter().enumerate().map(divided).collect()
}

/// Smallest and largest; `None` when they are as good as equal.
fn spread(values: &[f64]) -> Option<(f64, f64)> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (high - low > 1e-6 * (1e-3 + high.abs().max(low.abs()))).then_some((low, high))
}

/// Legendre polynomials of degree 0 to `degree` over the range of the values.
fn polynomials(values: &[f64], degree: usize) -> Vec<Vec<f64>> {
    let (low, high) = spread(values).unwrap_or((0.0, 1.0));
    let scaled: Vec<f64> = values.iter().map(|value| 2.0 * (value - low) / (high - low) - 1.0).collect();
    let mut all = vec![vec![1.0; values.len()], scaled.clone()];
    for n in 1..degree {
        let next = scaled
            .iter()
            .zip(all[n].iter().zip(&all[n - 1]))
            .map(|(x, (now, before))| ((2 * n + 1) as f64 * x * now - n as f64 * before) / (n + 1) as f64)
            .collect();
        all.push(next);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legendre_polynomials_are_those_of_the_tables() {
        let all = polynomials(&[-1.0, 0.5, 1.0], 3);
        assert_eq!(all.len(), 4);
        // P2(x) = (3 x^2 - 1) / 2, P3(x) = (5 x^3 - 3 x) / 2.
        assert!((all[2][1] + 0.125).abs() < 1e-15);
        assert!((all[3][1] + 0.4375).abs() < 1e-15);
        assert_eq!((all[3][0], all[3][2]), (-1.0, 1.0));
    }
}

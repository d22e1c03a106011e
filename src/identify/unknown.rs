//! The numbers that a fit may change.

use serde::{Deserialize, Serialize};

use crate::model::arm::ArmModel;
use crate::model::parameters::{ParameterId, Rod, RowQuantity};
use crate::model::robot::{Convention, DOF};

/// The name of one unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum UnknownId {
    /// A number of the model.
    Model(ParameterId),
    /// A component of the displacement of a station's frame (see [`super::state::Stations`]): three lengths in metres,
    /// then a rotation vector in radians.
    Station {
        /// Which station; never the reference station 0.
        station: usize,
        /// Which component.
        component: usize,
    },
}

/// What is known of a number before the recording: a normal distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Its mean, in the unknown's unit.
    pub mean: f64,
    /// Its standard deviation.
    pub sigma: f64,
}

/// An unknown with what is known of it before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unknown {
    /// Which number.
    pub id: UnknownId,
    /// What is known before.
    pub prior: Prior,
}

/// How much of the model a fit frees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// Base and tool only.
    Frames,
    /// Frames, rows and loop.
    Geometry,
    /// Geometry and the parameters of every effect that the model has.
    Everything,
}

/// Every number that `scope` frees, before redundancy is looked at, those to be kept first in front.
///
/// Frames come before rows, so that where the two say the same (zero of joint 1 and yaw of the base) the frame keeps
/// the number. Where an axis is nominally parallel to the next, Hayati's beta stands in the place of d (Hayati and
/// Mirmirani 1985). The tool's orientation is free only when `with_rotation` says that it was measured.
pub fn model_ids(model: &ArmModel, scope: Scope, with_rotation: bool) -> Vec<ParameterId> {
    let tool_components = if with_rotation { 6 } else { 3 };
    let mut ids: Vec<ParameterId> = (0..6).map(ParameterId::Base).collect();
    ids.extend((0..tool_components).map(ParameterId::Tool));
    if scope == Scope::Frames {
        return ids;
    }
    for quantity in [RowQuantity::Offset, RowQuantity::A, RowQuantity::D, RowQuantity::Alpha, RowQuantity::Beta] {
        for row in 0..DOF {
            let parallel = has_beta(model, row);
            let free = match quantity {
                RowQuantity::D => !parallel,
                RowQuantity::Beta => parallel,
                _ => true,
            };
            if free {
                ids.push(ParameterId::Row(row, quantity));
            }
        }
    }
    if model.robot.parallelogram.is_some() {
        ids.extend([Rod::Crank, Rod::Coupler].map(ParameterId::Loop));
    }
    if scope == Scope::Everything {
        for (effect, values) in model.parameters.effects.iter().enumerate() {
            ids.extend((0..values.len()).map(|parameter| ParameterId::Effect(effect, parameter)));
        }
    }
    ids
}

/// True when `row` carries the twist between two nominally parallel axes.
fn has_beta(model: &ArmModel, row: usize) -> bool {
    match model.robot.convention {
        Convention::Standard => model.robot.parallel_to_next(row),
        Convention::Modified => row > 0 && model.robot.parallel_to_next(row - 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::fixture;

    #[test]
    fn parallel_axes_trade_d_for_beta_in_both_conventions() {
        let standard = ArmModel::nominal(fixture::bare(Convention::Standard, &fixture::LOOPED));
        let ids = model_ids(&standard, Scope::Geometry, false);
        assert!(ids.contains(&ParameterId::Row(1, RowQuantity::Beta)));
        assert!(!ids.contains(&ParameterId::Row(1, RowQuantity::D)));
        assert_eq!(ids.len(), 6 + 3 + 24);
        let rows = [
            [0.0, 600.0, 0.0, 0.0],
            [0.0, 0.0, 300.0, -90.0],
            [0.0, 0.0, 1100.0, 0.0],
            [0.0, 1200.0, 200.0, -90.0],
            [0.0, 0.0, 0.0, 90.0],
            [0.0, 200.0, 0.0, -90.0],
        ];
        let modified = ArmModel::nominal(fixture::bare(Convention::Modified, &rows));
        let ids = model_ids(&modified, Scope::Geometry, true);
        assert!(ids.contains(&ParameterId::Row(2, RowQuantity::Beta)));
        assert!(!ids.contains(&ParameterId::Row(2, RowQuantity::D)));
        assert!(ids.contains(&ParameterId::Row(1, RowQuantity::D)));
        assert!(ids.contains(&ParameterId::Tool(5)));
    }
}

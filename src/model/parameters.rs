//! The numbers in which the real arm differs from the nominal one, each with a name, a unit and a place.

use serde::{Deserialize, Serialize};

use crate::geometry::real::Real;

use super::robot::DOF;

/// Errors of one row. For a standard row `Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta)`, for a modified one
/// `Rx(alpha) Tx(a) Ry(beta) Rz(theta) Tz(d)` (Hayati and Mirmirani 1985 for beta).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowErrors<T> {
    /// Zero offset of the actuator, rad, in the controller's sense.
    pub offset_rad: T,
    /// Error of d, m.
    pub d_m: T,
    /// Error of a, m.
    pub a_m: T,
    /// Error of alpha, rad.
    pub alpha_rad: T,
    /// Hayati's second twist, rad.
    pub beta_rad: T,
}

/// A small displacement: three lengths in metres, then a rotation vector in radians.
pub type Displacement<T> = [T; 6];

/// Every number of the model that identification may change, over the scalar `T`.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters<T> {
    /// Geometry errors of the rows.
    pub rows: [RowErrors<T>; DOF],
    /// Base error: `measuring_T_base = nominal * displacement`.
    pub base: Displacement<T>,
    /// Tool error: `flange_T_tool = nominal * displacement`.
    pub tool: Displacement<T>,
    /// Errors of the parallelogram's crank and coupler, m.
    pub crank_m: T,
    /// See `crank_m`.
    pub coupler_m: T,
    /// Parameters of each effect, in the order of the model's effects.
    pub effects: Vec<Vec<T>>,
}

/// Which number of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RowQuantity {
    /// Zero offset of the actuator.
    Offset,
    /// d.
    D,
    /// a.
    A,
    /// alpha.
    Alpha,
    /// beta.
    Beta,
}

/// Which rod of the parallelogram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rod {
    /// P-Q.
    Crank,
    /// Q-R.
    Coupler,
}

/// The name of one number of [`Parameters`]. Joints and components count from zero here, from one in text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ParameterId {
    /// A number of a row.
    Row(usize, RowQuantity),
    /// A component of the base error.
    Base(usize),
    /// A component of the tool error.
    Tool(usize),
    /// A rod of the parallelogram.
    Loop(Rod),
    /// A parameter of an effect: which effect of the model, which parameter.
    Effect(usize, usize),
}

impl<T: Real> RowErrors<T> {
    /// No error.
    pub fn zero() -> Self {
        let zero = T::zero();
        Self { offset_rad: zero, d_m: zero, a_m: zero, alpha_rad: zero, beta_rad: zero }
    }
}

impl<T: Real> Parameters<T> {
    /// A robot without error and without effects.
    pub fn zero() -> Self {
        let zero = T::zero();
        Self {
            rows: [RowErrors::zero(); DOF],
            base: [zero; 6],
            tool: [zero; 6],
            crank_m: zero,
            coupler_m: zero,
            effects: Vec::new(),
        }
    }

    /// The same numbers over another scalar, each made by `convert`.
    pub fn map<U: Real>(&self, convert: impl Fn(T) -> U) -> Parameters<U> {
        Parameters {
            rows: self.rows.map(|row| RowErrors {
                offset_rad: convert(row.offset_rad),
                d_m: convert(row.d_m),
                a_m: convert(row.a_m),
                alpha_rad: convert(row.alpha_rad),
                beta_rad: convert(row.beta_rad),
            }),
            base: self.base.map(&convert),
            tool: self.tool.map(&convert),
            crank_m: convert(self.crank_m),
            coupler_m: convert(self.coupler_m),
            effects: self.effects.iter().map(|one| one.iter().map(|&number| convert(number)).collect()).collect(),
        }
    }

    /// The number of that name; `None` for an effect or component that the model does not have.
    pub fn get_mut(&mut self, id: ParameterId) -> Option<&mut T> {
        match id {
            ParameterId::Row(joint, quantity) => {
                let row = self.rows.get_mut(joint)?;
                Some(match quantity {
                    RowQuantity::Offset => &mut row.offset_rad,
                    RowQuantity::D => &mut row.d_m,
                    RowQuantity::A => &mut row.a_m,
                    RowQuantity::Alpha => &mut row.alpha_rad,
                    RowQuantity::Beta => &mut row.beta_rad,
                })
            }
            ParameterId::Base(component) => self.base.get_mut(component),
            ParameterId::Tool(component) => self.tool.get_mut(component),
            ParameterId::Loop(Rod::Crank) => Some(&mut self.crank_m),
            ParameterId::Loop(Rod::Coupler) => Some(&mut self.coupler_m),
            ParameterId::Effect(effect, parameter) => self.effects.get_mut(effect)?.get_mut(parameter),
        }
    }
}

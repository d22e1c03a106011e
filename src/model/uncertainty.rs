//! How well the numbers of a model are known, and what they leave unexplained.

use nalgebra::DMatrix;

use super::parameters::ParameterId;

/// Uncertainty of a model, as identification leaves it.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    /// The identified numbers.
    pub ids: Vec<ParameterId>,
    /// Their covariance, in products of their SI units.
    pub covariance: DMatrix<f64>,
    /// Degrees of freedom behind it: coordinates less parameters.
    pub freedom: f64,
    /// Standard deviation per axis of what the measurement itself scatters, m.
    pub noise_sigma_m: f64,
    /// Standard deviation per axis of what the arm does and the model does not, m.
    pub unexplained_sigma_m: f64,
}

impl Uncertainty {
    /// Standard uncertainty of a number; `None` for one that was not identified.
    pub fn sigma(&self, id: ParameterId) -> Option<f64> {
        let index = self.ids.iter().position(|known| *known == id)?;
        Some(self.covariance[(index, index)].max(0.0).sqrt())
    }
}

//! The uncertainty block of a model file.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use crate::base::text::Source;
use crate::base::units::{m_from_mm, mm_from_m};
use crate::files::error::FileError;
use crate::files::yaml::{complain, tidy};
use crate::model::arm::ArmModel;
use crate::model::parameters::ParameterId;
use crate::model::uncertainty::Uncertainty;

use super::names::{geometry_ids, geometry_name};

/// An [`Uncertainty`] as files write it: the lower triangle of the covariance, a row for each parameter.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UncertaintyEntry {
    noise_sigma_mm: f64,
    unexplained_sigma_mm: f64,
    freedom: f64,
    /// `joint 2 a`, `tool x`, or `effect 3 compliance`: the third entry of the file's own `effects`.
    parameters: Vec<String>,
    covariance: Vec<Vec<f64>>,
}

impl UncertaintyEntry {
    /// What a file says of this uncertainty; `places` holds the model's index of each effect in the file.
    pub fn new(known: &Uncertainty, arm: &ArmModel, places: &[usize]) -> Self {
        Self {
            noise_sigma_mm: tidy(mm_from_m(known.noise_sigma_m)),
            unexplained_sigma_mm: tidy(mm_from_m(known.unexplained_sigma_m)),
            freedom: known.freedom,
            parameters: known.ids.iter().map(|&id| name_of(id, arm, places).unwrap_or_default()).collect(),
            covariance: (0..known.ids.len())
                .map(|row| (0..=row).map(|column| known.covariance[(row, column)]).collect())
                .collect(),
        }
    }

    /// The uncertainty, checked.
    ///
    /// # Errors
    /// [`FileError`] for unknown parameters, a triangle of another shape, or numbers that are no variances.
    pub fn uncertainty(&self, source: &Source, arm: &ArmModel, places: &[usize]) -> Result<Uncertainty, FileError> {
        let wrong = |message: String| Err(complain(source, "uncertainty", None, "uncertainty", message));
        let known: Vec<(ParameterId, String)> = geometry_ids()
            .chain(places.iter().flat_map(|&place| {
                (0..arm.parameters.effects[place].len()).map(move |slot| ParameterId::Effect(place, slot))
            }))
            .filter_map(|id| Some((id, name_of(id, arm, places)?)))
            .collect();
        let mut ids = Vec::with_capacity(self.parameters.len());
        for name in &self.parameters {
            match known.iter().find(|(_, known)| known == name) {
                Some((id, _)) => ids.push(*id),
                None => return wrong(format!("the uncertainty names `{name}`, which the model does not have")),
            }
        }
        let count = ids.len();
        if self.covariance.len() != count || self.covariance.iter().enumerate().any(|(row, all)| all.len() != row + 1) {
            return wrong(format!("the covariance is no lower triangle of {count} rows"));
        }
        let sound = |number: f64| number.is_finite() && number >= 0.0;
        let diagonal = (0..count).all(|row| sound(self.covariance[row][row]));
        let finite = self.covariance.iter().flatten().all(|number| number.is_finite());
        if !diagonal
            || !finite
            || ![self.noise_sigma_mm, self.unexplained_sigma_mm, self.freedom].into_iter().all(sound)
        {
            return wrong("the uncertainty holds a negative variance or a number that is not finite".into());
        }
        let covariance =
            DMatrix::from_fn(count, count, |row, column| self.covariance[row.max(column)][row.min(column)]);
        Ok(Uncertainty {
            ids,
            covariance,
            freedom: self.freedom,
            noise_sigma_m: m_from_mm(self.noise_sigma_mm),
            unexplained_sigma_m: m_from_mm(self.unexplained_sigma_mm),
        })
    }
}

fn name_of(id: ParameterId, arm: &ArmModel, places: &[usize]) -> Option<String> {
    if let ParameterId::Effect(effect, slot) = id {
        let entry = places.iter().position(|&place| place == effect)?;
        let name = arm.effects[effect].effect.meta().parameters.get(slot)?.name;
        return Some(format!("effect {} {name}", entry + 1));
    }
    let (at, quantity) = geometry_name(id)?;
    Some(format!("{at} {quantity}"))
}

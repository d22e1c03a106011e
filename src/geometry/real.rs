//! The scalar that physics is written over: plain numbers, or dual numbers that carry derivatives.

use nalgebra::RealField;
use num_dual::{DualNum, DualSVec64};

/// A real number or a dual number. Every formula of the robot model is written once over this trait; its value and
/// all its derivatives come from the same lines.
pub trait Real: DualNum<f64> + RealField + Copy {
    /// The number without its derivatives.
    fn value(self) -> f64;

    /// A constant: no derivative.
    fn constant(value: f64) -> Self {
        <Self as From<f64>>::from(value)
    }
}

impl Real for f64 {
    fn value(self) -> f64 {
        self
    }
}

impl<const N: usize> Real for DualSVec64<N> {
    fn value(self) -> f64 {
        self.re
    }
}

/// How many derivatives one pass through the model carries.
pub const DUAL_WIDTH: usize = 8;

/// The dual number that Jacobians are made with: [`DUAL_WIDTH`] columns at a time.
pub type Dual = DualSVec64<DUAL_WIDTH>;

/// A dual number with derivative one in direction `slot`.
pub fn seeded(value: f64, slot: usize) -> Dual {
    let mut direction = nalgebra::SVector::<f64, DUAL_WIDTH>::zeros();
    direction[slot] = 1.0;
    Dual::new(value, num_dual::Derivative::some(direction))
}

/// The derivatives that a dual number carries.
pub fn derivatives(number: &Dual) -> [f64; DUAL_WIDTH] {
    let column = number.eps.unwrap_generic(nalgebra::Const::<DUAL_WIDTH>, nalgebra::Const::<1>);
    column.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dual_number_carries_the_derivative() {
        let x = seeded(0.5, 3);
        let y = x.sin() * x + Dual::constant(2.0);
        assert_eq!(y.value(), 0.5f64.sin() * 0.5 + 2.0);
        let expected = 0.5f64.cos() * 0.5 + 0.5f64.sin();
        assert!((derivatives(&y)[3] - expected).abs() < 1e-15);
        assert_eq!(derivatives(&y)[0], 0.0);
    }
}

//! Floor 4: from recordings to the real arm. Whitened least squares on the nonlinear model, with priors, robustness,
//! identifiability, covariance and prediction.
//!
//! The parts, in the order in which [`calibrate::calibrate`] uses them: [`sanity`] (is this recording of this robot?),
//! [`place`] (base and tool in closed form), [`unknown`] and [`prior`] (what is free, and what is known before),
//! [`problem`] (residuals and Jacobian), [`solve`] (the iteration), [`robust`] (gross errors), [`identifiability`],
//! [`structure`] (what is left: noise or something unmodelled), [`predict`], [`report`].

pub mod ball;
pub mod calibrate;
pub mod candidates;
pub mod estimate;
pub mod gather;
pub mod identifiability;
#[expect(clippy::module_inception, reason = "the module does what its floor is named for")]
pub mod identify;
pub mod linear;
pub mod naming;
pub mod outlier;
pub mod place;
pub mod plan;
pub mod predict;
pub mod prior;
pub mod problem;
pub mod report;
pub mod rest;
pub mod robust;
pub mod sanity;
pub mod settle;
pub mod solve;
pub mod split;
pub mod state;
pub mod stated;
pub mod station_report;
pub mod stations;
pub mod structure;
pub mod summary;
pub mod unknown;
pub mod validate;
pub mod workspace;
pub mod written;

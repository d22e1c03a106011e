//! Floor 2: the robot, nominal and real. Every formula is written once, over [`crate::geometry::real::Real`], so that
//! values and derivatives come from the same lines. Knows no files and no programs.

pub mod arm;
pub mod chain;
pub mod conditions;
pub mod curves;
pub mod effect;
mod equilibrium;
#[cfg(test)]
pub(crate) mod fixture;
pub mod inertia;
pub mod jacobian;
pub mod learner;
pub mod linkage;
pub mod network;
pub mod parameters;
pub mod ready_network;
pub mod robot;
pub mod statics;
pub mod uncertainty;

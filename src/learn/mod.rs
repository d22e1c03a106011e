//! Floor 6: what the physics leaves. Learned from the residuals of an identification, used only where records that were
//! held out say that it helps.
//!
//! The parts: [`samples`] (residuals and levers of the records), [`subject`] (what a
//! learner may look at), [`term`] (the functions of which a learner may be
//! made), [`evidence`] (how strong each may be: Bayesian regression with a variance for each group), [`additive`] (the
//! learner of joint errors), [`network`] (the network of joint errors), [`folds`] (blocked cross-validation), [`choose`] (which learner, if any), [`learned`] (what was learned), [`calibration`] (the
//! learner as a stage of a calibration), [`paper`] (the plain network of the paper).

pub mod additive;
pub mod calibration;
pub mod cholesky;
pub mod choose;
pub mod drawing;
pub mod evidence;
pub mod folds;
pub mod learned;
pub mod network;
pub mod paper;
pub mod samples;
pub mod subject;
pub mod term;

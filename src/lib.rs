//! Corrects robot programs for the robot that is really there.
//!
//! A robot's controller believes a nominal arm; programs from OLP and CAM are written for that arm, so the real one misses.
//! This crate holds a model of the real arm and replaces each target of a program by a *false target*: the command that
//! makes the real arm arrive where the programmer meant.
//!
//! ```
//! use falsetarget::base::text::Source;
//! use falsetarget::files::{builtin, cell::Cell};
//! use falsetarget::kinematics::controller::Controller;
//! use falsetarget::model::arm::ArmModel;
//! use falsetarget::program::dialect;
//! use falsetarget::rewrite::correct::{Job, Options, correct};
//!
//! // An arm whose elbow stands 1 mrad off.
//! let robot = builtin::by_name("abb-irb4600").ok_or("not built in")??;
//! let controller = Controller::new(&robot);
//! let mut real = ArmModel::nominal(robot);
//! real.parameters.rows[2].offset_rad = 1e-3;
//!
//! // A program as its bytes; its language is told by its content.
//! let sources = [Source::new("job.mod", "MoveL [[1500,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;")];
//! let rapid = dialect::detect(&sources[0]).ok_or("no language")?;
//! let program = rapid.read(&sources);
//!
//! // The correction is a set of edits; applying it gives the new file.
//! let cell = Cell::default();
//! let job = Job { sources: &sources, program: &program, rules: rapid.meta().numbers, cell: &cell };
//! let outcome = correct(&job, &real, &controller, &Options::default());
//! let corrected = outcome.edits[0].apply(sources[0].bytes())?;
//! assert_ne!(corrected, sources[0].bytes());
//! assert!(outcome.targets[0].figures.as_ref().is_some_and(|figures| figures.correction_m > 1e-4));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The floors of the house, from the ground up: [`base`], [`geometry`], [`model`] and [`program`], [`kinematics`] and
//! [`measure`], [`files`], [`invert`], [`rewrite`], [`report`], [`cli`]. A module uses lower floors only.
//!
//! # Limitations
//! Arms with six axes. Corrections act at targets; between them the arm follows the controller's interpolation.

#![deny(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout, clippy::print_stderr)]

pub mod base;
pub mod cli;
pub mod diagnose;
pub mod files;
pub mod geometry;
pub mod identify;
pub mod invert;
pub mod kinematics;
pub mod learn;
pub mod measure;
pub mod model;
pub mod program;
pub mod report;
pub mod rewrite;

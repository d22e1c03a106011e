//! The robots that come with the tool. To add one: a folder under `calibration/` and one line here.

use crate::base::text::Source;
use crate::model::robot::Robot;

use super::error::FileError;

macro_rules! built_in {
    ($($id:literal),* $(,)?) => {
        /// The built-in robots: name and text of the robot file.
        pub const BUILT_IN: &[(&str, &str)] = &[
            $(($id, include_str!(concat!("../../calibration/", $id, "/robot.yaml")))),*
        ];
    };
}

built_in!["hh800-class"];

/// The built-in robot of this name.
///
/// # Errors
/// [`FileError`] when its own file is broken, which a test excludes.
pub fn by_name(name: &str) -> Option<Result<Robot, FileError>> {
    let (id, text) = BUILT_IN.iter().find(|(id, _)| id.eq_ignore_ascii_case(name))?;
    Some(super::robot::read(&Source::new(format!("built-in:{id}"), *text)))
}

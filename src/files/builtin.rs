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

built_in![
    "abb-irb120",
    "abb-irb1600",
    "abb-irb2400",
    "abb-irb4600",
    "abb-irb6640",
    "abb-irb8700-800",
    "fanuc-m20ia",
    "fanuc-r2000ic-210f",
    "hh800-class",
    "hyundai-ha006b",
    "hyundai-hs220",
    "kawasaki-rs080",
    "kuka-kr210-r2700",
    "kuka-kr500",
    "kuka-kr6-r900",
    "staubli-tx90l",
    "ur10",
    "ur10e",
    "ur5e",
    "yaskawa-gp180",
    "yaskawa-gp25",
];

/// The built-in robot of this name.
///
/// # Errors
/// [`FileError`] when its own file is broken, which a test excludes.
pub fn by_name(name: &str) -> Option<Result<Robot, FileError>> {
    let (id, text) = BUILT_IN.iter().find(|(id, _)| id.eq_ignore_ascii_case(name))?;
    Some(super::robot::read(&Source::new(format!("built-in:{id}"), *text)))
}

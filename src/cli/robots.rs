//! `falsetarget robots`: the robots that come with the tool.

use std::path::Path;

use crate::files::builtin::{BUILT_IN, by_name};
use crate::kinematics::controller::Controller;

use super::exit::{Exit, Failure};
use super::output;

/// List the built-in robots, or print the robot file of one.
#[derive(clap::Args)]
pub struct Args {
    /// Print this robot's file: a start for your own
    name: Option<String>,
    /// Where to write it
    #[arg(short, long, default_value = "-")]
    output: std::path::PathBuf,
}

pub fn run(args: &Args) -> Result<Exit, Failure> {
    if let Some(name) = &args.name {
        let found = BUILT_IN.iter().find(|(id, _)| id.eq_ignore_ascii_case(name));
        let (_, text) = found.ok_or_else(|| Failure::Usage(format!("no built-in robot `{name}`")))?;
        output::write(&args.output, text.as_bytes())?;
        return Ok(Exit::Done);
    }
    let mut text = format!("{:<22} {:>9}  inverse kinematics\n", "name", "length mm");
    for (id, _) in BUILT_IN {
        if let Some(robot) = by_name(id) {
            let controller = Controller::new(&robot?);
            text += &format!("{id:<22} {:>9.0}  {}\n", controller.size_m() * 1e3, controller.family());
        }
    }
    output::write(Path::new("-"), text.as_bytes())?;
    Ok(Exit::Done)
}

//! `falsetarget plan`: which poses to measure.

use std::path::PathBuf;

use crate::base::units::{m_from_mm, mm_from_m};
use crate::files::recording::write_observations;
use crate::identify::plan::plan;
use crate::identify::workspace::random_poses;
use crate::measure::observation::Observation;
use crate::model::arm::ArmModel;

use super::console::Console;
use super::exit::{Exit, Failure};
use super::load;
use super::output;

/// Choose the poses that a tracker should measure
///
/// Poses are drawn all over the joint ranges, or taken from --among, and those chosen that together tell most of base,
/// tool, geometry and compliance. From 30 points on, a tenth are repeats of one control pose, spread over the recording
/// (repeatability, drift), and a tenth are poses approached once more from the other side (lost motion). The columns dir1 to
/// dir6 say from which side each joint should come: 1 counting up.
///
/// Collisions, cables and lines of sight are not known here: look through the poses, or give those that are free with
/// --among.
#[derive(clap::Args)]
pub struct Args {
    /// Robot file, model file or a built-in robot's name
    #[arg(long, value_name = "ROBOT")]
    robot: String,
    /// How many points to measure
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(6..=2000))]
    points: u16,
    /// Choose among these poses (CSV with q1_deg to q6_deg) instead of poses drawn all over the joint ranges
    #[arg(long, value_name = "POSES.csv")]
    among: Option<PathBuf>,
    /// Leave out poses that put the tool point lower than this above the robot's base
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    above_mm: Option<f64>,
    /// Standard uncertainty of the tracker per axis
    #[arg(long, value_name = "MM", default_value_t = 0.05, value_parser = super::calibrate::positive)]
    sigma_mm: f64,
    /// Seed of everything that is drawn
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Where to write the poses
    #[arg(short, long, value_name = "POSES.csv")]
    output: PathBuf,
}

/// Poses drawn to choose from: this many, and this many for each point.
const CANDIDATES: usize = 600;
const CANDIDATES_PER_POINT: usize = 4;

pub fn run(args: &Args, console: &Console) -> Result<Exit, Failure> {
    let model = load::model(&args.robot)?.arm;
    let points = usize::from(args.points);
    let mut candidates = match &args.among {
        Some(path) => load::recording(path, &model.robot)?.observations,
        None => drawn(&model, CANDIDATES + CANDIDATES_PER_POINT * points, args.seed),
    };
    candidates.retain(|pose| stands(&model, pose, args.above_mm.map(m_from_mm)));
    if candidates.len() < points {
        return Err(Failure::Usage(format!(
            "only {} poses to choose {points} from: the arm takes no others within the limits given",
            candidates.len()
        )));
    }
    let plan = plan(&model, &candidates, points, m_from_mm(args.sigma_mm), args.seed)
        .map_err(|error| Failure::Usage(error.to_string()))?;
    output::write(&args.output, write_observations(&plan.poses).as_bytes())?;
    console.say(&format!(
        "{} points for {} unknowns: a model from them will know points to {:.4} mm per axis (root mean square over {} poses), \
         {:.4} mm with poses taken as they come",
        plan.poses.len(),
        plan.unknowns,
        mm_from_m(plan.expected_sigma_m),
        candidates.len(),
        mm_from_m(plan.unplanned_sigma_m)
    ));
    Ok(Exit::Done)
}

fn drawn(model: &ArmModel, count: usize, seed: u64) -> Vec<Observation> {
    random_poses(&model.robot, count, seed).into_iter().map(Observation::unmeasured).collect()
}

/// True when the arm takes the pose, high enough.
fn stands(model: &ArmModel, pose: &Observation, above_m: Option<f64>) -> bool {
    let arm = model.prepared();
    let Ok(state) = arm.at(&pose.numbers_rad, &pose.conditions, None) else { return false };
    let in_base = arm.measuring_t_base().inverse() * arm.measured(&state);
    above_m.is_none_or(|least| in_base.translation.z >= least)
}

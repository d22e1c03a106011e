//! Several tracker stations: which of them stood elsewhere.
//!
//! A station's name alone says nothing: many recordings name work areas that one tracker saw from one place. A station
//! gets a frame of its own only where the data ask for it.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::geometry::pose::{Pose, skew};
use crate::measure::recording::Recording;
use crate::model::arm::ArmModel;

use super::gather::Entry;
use super::place::{Handedness, Placement, place};
use super::problem::{NoPose, Problem};
use super::robust::{lengths_of, median};
use super::state::{State, Station};

/// Records that a station needs to have a frame of its own.
pub const FEWEST: usize = 8;
/// A station whose own placement lies this many misfits from the reference's stood elsewhere from the start ...
const CLEARLY_ELSEWHERE: f64 = 8.0;
/// ... and one whose residuals a rigid motion makes smaller by this factor has moved.
const RIGID_GAIN: f64 = 3.0;

/// Stations by name, and which record belongs to which. The largest comes first: it is the reference.
#[derive(Clone, Debug)]
pub struct Grouping {
    /// Names; `None` for records that name none in a single recording.
    pub names: Vec<Option<String>>,
    /// Station of each entry.
    pub station_of: Vec<usize>,
}

/// Groups records by station; records without one by recording, when there are several.
pub fn group(entries: &[Entry<'_>], recordings: &[Recording]) -> Grouping {
    let name_of = |entry: &Entry<'_>| {
        let unnamed = (recordings.len() > 1).then(|| recordings[entry.recording].name.clone());
        entry.observation.station.clone().or(unnamed)
    };
    let mut counted: Vec<(Option<String>, usize)> = Vec::new();
    for entry in entries {
        let name = name_of(entry);
        match counted.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => counted.push((name, 1)),
        }
    }
    // Stable: of equally large stations the first in the file is the reference.
    counted.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let names: Vec<Option<String>> = counted.into_iter().map(|(name, _)| name).collect();
    let station_of = entries
        .iter()
        .map(|entry| {
            let name = name_of(entry);
            names.iter().position(|known| *known == name).unwrap_or(0)
        })
        .collect();
    Grouping { names, station_of }
}

/// Base and tool for the nominal arm, and the stations that clearly stood elsewhere.
#[derive(Clone, Debug)]
pub struct Start {
    /// Model with base and tool placed, and the stations.
    pub state: State,
    /// True for stations with a frame of their own; never for the reference.
    pub own_frame: Vec<bool>,
}

/// Places base, tool and stations by registration of the nominal arm.
///
/// `reference` is the placement of the reference station's records.
pub fn start(nominal: &ArmModel, entries: &[Entry<'_>], grouping: &Grouping, reference: &Placement) -> Start {
    let prepared = nominal.prepared();
    let flange_of = |entry: &Entry<'_>| {
        let stand = prepared.at(&entry.observation.numbers_rad, &entry.observation.conditions, None);
        stand.map_or_else(|_| Pose::identity(), |stand| stand.base_t_flange)
    };
    let scene = |members: &[usize]| -> (Vec<Pose>, Vec<Vector3<f64>>) {
        members.iter().map(|&index| (flange_of(&entries[index]), entries[index].measured.position_m)).unzip()
    };
    let mut own_frame = vec![false; grouping.names.len()];
    let mut stations: Vec<Station> = grouping.names.iter().cloned().map(Station::reference).collect();
    for station in 1..grouping.names.len() {
        let members = members_of(grouping, station);
        if members.len() < FEWEST {
            continue;
        }
        let (flanges, points) = scene(&members);
        let Some(placed) = place(&flanges, &points, Some(reference.tool_m), Handedness::Right) else { continue };
        let apart: Vec<f64> = flanges
            .iter()
            .map(|flange| {
                let point = flange.transform_point(&reference.tool_m);
                (placed.measuring_t_base.transform_point(&point) - reference.measuring_t_base.transform_point(&point))
                    .norm()
            })
            .collect();
        let typical = placed.typical_misfit_m.max(reference.typical_misfit_m);
        if median(&apart) > CLEARLY_ELSEWHERE * typical {
            own_frame[station] = true;
            stations[station].station_t_measuring = placed.measuring_t_base * reference.measuring_t_base.inverse();
        }
    }
    let mut model = nominal.clone();
    let shared: Vec<usize> = (0..entries.len()).filter(|&index| !own_frame[grouping.station_of[index]]).collect();
    let (flanges, points) = scene(&shared);
    let tool = model.robot.tool.map(|tool| tool.translation);
    let placed = place(&flanges, &points, tool, Handedness::Right).unwrap_or_else(|| reference.clone());
    if model.robot.base.is_none() {
        model.measuring_t_base = placed.measuring_t_base;
    }
    if model.robot.tool.is_none() {
        model.flange_t_tool = Pose { translation: placed.tool_m, rotation: tool_rotation(&model, entries, &flange_of) };
    }
    Start { state: State { model, stations }, own_frame }
}

/// Indices of the entries of a station.
pub fn members_of(grouping: &Grouping, station: usize) -> Vec<usize> {
    (0..grouping.station_of.len()).filter(|&index| grouping.station_of[index] == station).collect()
}

/// `flange_R_tool` where orientations were measured: their mean, projected onto rotations; else no turn.
fn tool_rotation(model: &ArmModel, entries: &[Entry<'_>], flange_of: &dyn Fn(&Entry<'_>) -> Pose) -> Matrix3<f64> {
    let mut sum = Matrix3::zeros();
    for entry in entries {
        if let Some(measured) = entry.measured.rotation {
            sum += (model.measuring_t_base * flange_of(entry)).rotation.transpose() * measured;
        }
    }
    let svd = sum.svd(true, true);
    match (svd.u, svd.v_t) {
        (Some(u), Some(v_t)) if sum.norm() > 0.0 => {
            let sign = (u * v_t).determinant();
            u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v_t
        }
        _ => Matrix3::identity(),
    }
}

/// Stations that could have a frame of their own and have none: not the reference, and seen often enough.
pub fn candidates(problem: &Problem<'_>, own_frame: &[bool]) -> Vec<usize> {
    let records = |station: usize| problem.records.iter().filter(|record| record.station == station).count();
    (1..own_frame.len()).filter(|&station| !own_frame[station] && records(station) >= FEWEST).collect()
}

/// The station that has moved most evidently against the others, if any: a rigid motion explains most of its
/// residuals, and they are large against those of the rest.
///
/// # Errors
/// [`NoPose`] when the model cannot place a record.
pub fn moved(problem: &Problem<'_>, state: &State, own_frame: &[bool]) -> Result<Option<usize>, NoPose> {
    let residuals = problem.residuals(state)?;
    let lengths = lengths_of(problem, &residuals);
    let firsts = problem.first_rows();
    let mut worst: Option<(usize, f64)> = None;
    for station in candidates(problem, own_frame) {
        let members: Vec<usize> =
            (0..problem.records.len()).filter(|&index| problem.records[index].station == station).collect();
        let points: Vec<Vector3<f64>> =
            members.iter().map(|&index| problem.records[index].measured.position_m).collect();
        let misses: Vec<Vector3<f64>> =
            members.iter().map(|&index| residuals.fixed_rows::<3>(firsts[index]).into_owned()).collect();
        let before = median(&misses.iter().map(|miss| miss.norm()).collect::<Vec<_>>());
        let after = median(&without_rigid_motion(&points, &misses));
        let rest: Vec<f64> = (0..lengths.len())
            .filter(|&index| problem.records[index].station != station)
            .map(|index| lengths[index])
            .collect();
        let gain = before / after.max(f64::MIN_POSITIVE);
        if gain > RIGID_GAIN && before > RIGID_GAIN * median(&rest) && worst.is_none_or(|(_, known)| gain > known) {
            worst = Some((station, gain));
        }
    }
    Ok(worst.map(|(station, _)| station))
}

/// Lengths of what a small rigid motion, fitted with Huber's weights, leaves of vectors at points.
fn without_rigid_motion(points: &[Vector3<f64>], misses: &[Vector3<f64>]) -> Vec<f64> {
    let centre = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let mut weights = vec![1.0; points.len()];
    let mut left: Vec<f64> = misses.iter().map(|miss| miss.norm()).collect();
    for _ in 0..10 {
        let mut design = DMatrix::zeros(3 * points.len(), 6);
        let mut right = DVector::zeros(3 * points.len());
        for (index, (point, miss)) in points.iter().zip(misses).enumerate() {
            let root = f64::sqrt(weights[index]);
            design.fixed_view_mut::<3, 3>(3 * index, 0).copy_from(&(Matrix3::identity() * root));
            design.fixed_view_mut::<3, 3>(3 * index, 3).copy_from(&(skew(&(point - centre)) * -root));
            right.fixed_rows_mut::<3>(3 * index).copy_from(&(miss * root));
        }
        let Ok(motion) = design.svd(true, true).solve(&right, 1e-12) else { break };
        let (shift, turn) = (motion.fixed_rows::<3>(0).into_owned(), motion.fixed_rows::<3>(3).into_owned());
        left = points
            .iter()
            .zip(misses)
            .map(|(point, miss)| (miss - shift - turn.cross(&(point - centre))).norm())
            .collect();
        let typical = median(&left).max(f64::MIN_POSITIVE);
        weights = left.iter().map(|length| (2.0 * typical / length.max(f64::MIN_POSITIVE)).min(1.0)).collect();
    }
    left
}

//! Model files: `falsetarget/model/1`, what is known of the real arm. A robot file serves as one without errors.
//! Effects files: `falsetarget/effects/1`, the same errors and effects without a robot, for simulation.

use serde::{Deserialize, Serialize};

use crate::base::diagnostic::Diagnostic;
use crate::base::text::{Source, Span};
use crate::base::units::{deg_from_rad, rad_from_deg};
use crate::geometry::pose::Pose;
use crate::model::arm::{ArmModel, EffectInstance};
use crate::model::curves::JointCurves;
use crate::model::effect::{self, Location};
use crate::model::learner::Learner;
use crate::model::network::ResidualNetwork;
use crate::model::parameters::ParameterId;
use crate::model::robot::DOF;
use crate::model::uncertainty::Uncertainty;

use super::error::FileError;
use super::robot::{self, RobotEntry};
use super::yaml::{PoseEntry, complain, parse};

mod names;
mod uncertainty;

use names::{geometry_id, geometry_ids};
pub use names::{geometry_name, geometry_unit};
use uncertainty::UncertaintyEntry;

/// The word in the first line of a model file.
pub const MODEL_SCHEMA: &str = "falsetarget/model/1";
/// The word in the first line of an effects file.
pub const EFFECTS_SCHEMA: &str = "falsetarget/effects/1";

/// Largest believable geometric error, m or rad: anything beyond is a wrong unit or a wrong robot.
const LARGEST_ERROR: f64 = 0.2;

/// A model of a real arm with what is known about that knowledge.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The model.
    pub arm: ArmModel,
    /// Standard uncertainty of parameters, in their SI unit, where a file states no more than that; absent for those
    /// that were not identified.
    pub sigma: Vec<(ParameterId, f64)>,
    /// The whole covariance and what stays unexplained, where the tool identified the model itself.
    pub uncertainty: Option<Uncertainty>,
    /// Trackers that stood elsewhere than the measuring frame.
    pub stations: Vec<StationFrame>,
    /// The joint numbers that the recordings covered.
    pub region: Option<Region>,
    /// Where it comes from.
    pub provenance: Option<Provenance>,
}

/// Where a tracker stood that does not measure in the measuring frame.
#[derive(Clone, Debug, PartialEq)]
pub struct StationFrame {
    /// Its name in recordings.
    pub name: String,
    /// `station_T_measuring`.
    pub station_t_measuring: Pose,
}

/// A box of joint numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// Smallest number of each joint, rad.
    pub min_rad: [f64; DOF],
    /// Largest number of each joint, rad.
    pub max_rad: [f64; DOF],
}

impl Region {
    /// The smallest box around these joint numbers; `None` around none.
    pub fn covering<'a>(numbers_rad: impl IntoIterator<Item = &'a [f64; DOF]>) -> Option<Self> {
        let mut all = numbers_rad.into_iter();
        let first = *all.next()?;
        let grow = |region: Self, numbers: &[f64; DOF]| Self {
            min_rad: std::array::from_fn(|joint| region.min_rad[joint].min(numbers[joint])),
            max_rad: std::array::from_fn(|joint| region.max_rad[joint].max(numbers[joint])),
        };
        Some(all.fold(Self { min_rad: first, max_rad: first }, grow))
    }
}

/// Where a model comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// The program and its version.
    pub written_by: String,
    /// Each recording's name, SHA-256 and number of records.
    #[serde(default)]
    pub recordings: Vec<RecordingProvenance>,
    /// Anything a person should know: `made by hand`, `class stand-in`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// A recording that went into a model.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordingProvenance {
    /// File name.
    pub name: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// Records in it.
    pub records: usize,
    /// Records used.
    pub used: usize,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ModelEntry {
    schema: String,
    robot: RobotEntry,
    #[serde(skip_serializing_if = "Option::is_none")]
    measuring_t_base: Option<PoseEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    flange_t_tool: Option<PoseEntry>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    parameters: Vec<GeometryEntry>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    effects: Vec<EffectEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    network: Option<ResidualNetwork>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    stations: Vec<StationEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    curves: Option<JointCurves>,
    #[serde(skip_serializing_if = "Option::is_none")]
    region: Option<RegionEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    provenance: Option<Provenance>,
    #[serde(skip_serializing_if = "Option::is_none")]
    uncertainty: Option<UncertaintyEntry>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StationEntry {
    name: String,
    station_t_measuring: PoseEntry,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EffectsFileEntry {
    schema: String,
    #[serde(default)]
    parameters: Vec<GeometryEntry>,
    #[serde(default)]
    effects: Vec<EffectEntry>,
    network: Option<ResidualNetwork>,
    curves: Option<JointCurves>,
    noise_sigma_mm: Option<f64>,
    seed: Option<u64>,
}

/// An effects file: what to conceal in a simulated robot.
#[derive(Clone, Debug)]
pub struct EffectsFile {
    /// The real arm that the simulation plays.
    pub arm: ArmModel,
    /// Noise of the simulated tracker, standard deviation per axis, m.
    pub noise_sigma_m: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// `{at: joint 2, quantity: a, value: 0.31e-3, unit: m}`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GeometryEntry {
    at: String,
    quantity: String,
    value: f64,
    unit: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma: Option<f64>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct EffectEntry {
    effect: String,
    location: Location,
    parameters: Vec<ValueEntry>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ValueEntry {
    name: String,
    value: f64,
    unit: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma: Option<f64>,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RegionEntry {
    min_deg: [f64; DOF],
    max_deg: [f64; DOF],
}

#[derive(Deserialize)]
struct SchemaOnly {
    schema: String,
}

impl Calibration {
    /// What a robot file alone says.
    pub fn nominal(robot: crate::model::robot::Robot) -> Self {
        Self {
            arm: ArmModel::nominal(robot),
            sigma: Vec::new(),
            uncertainty: None,
            stations: Vec::new(),
            region: None,
            provenance: None,
        }
    }

    /// Standard uncertainty of a number; `None` where it was not identified.
    pub fn sigma_of(&self, id: ParameterId) -> Option<f64> {
        let whole = self.uncertainty.as_ref().and_then(|uncertainty| uncertainty.sigma(id));
        whole.or_else(|| self.sigma.iter().find(|(known, _)| *known == id).map(|(_, sigma)| *sigma))
    }
}

/// Reads a model file, or a robot file in its place.
///
/// # Errors
/// [`FileError`] with the place.
pub fn read(source: &Source) -> Result<Calibration, FileError> {
    let what = "a model file (schema: falsetarget/model/1) or a robot file";
    let schema = schema_of(source, what)?;
    if schema == robot::SCHEMA {
        return Ok(Calibration::nominal(robot::read(source)?));
    }
    if schema != MODEL_SCHEMA {
        let message = format!("the schema is `{schema}`; expected `{MODEL_SCHEMA}` or `{}`", robot::SCHEMA);
        return Err(complain(source, "schema", None, "schema", message));
    }
    let entry: ModelEntry = parse(source, what)?;
    let mut arm = ArmModel::nominal(entry.robot.robot(source)?);
    let finite = |key: &str, pose: Option<PoseEntry>| match pose.map(|pose| pose.pose()) {
        Some(None) => Err(complain(source, key, None, "pose", format!("`{key}` has a number that is not finite"))),
        Some(pose) => Ok(pose),
        None => Ok(None),
    };
    if let Some(pose) = finite("measuring_t_base", entry.measuring_t_base)? {
        arm.measuring_t_base = pose;
    }
    if let Some(pose) = finite("flange_t_tool", entry.flange_t_tool)? {
        arm.flange_t_tool = pose;
    }
    let mut sigma = fill_geometry(source, &mut arm, &entry.parameters)?;
    let (places, effect_sigma) = fill_effects(source, &mut arm, &entry.effects)?;
    sigma.extend(effect_sigma);
    arm.learner = learner(source, entry.network, entry.curves)?;
    let stations = entry
        .stations
        .iter()
        .map(|station| {
            let name = station.name.clone();
            let pose = finite("stations", Some(station.station_t_measuring))?.unwrap_or_else(Pose::identity);
            Ok(StationFrame { name, station_t_measuring: pose })
        })
        .collect::<Result<_, FileError>>()?;
    let uncertainty = match &entry.uncertainty {
        Some(entry) => Some(entry.uncertainty(source, &arm, &places)?),
        None => None,
    };
    if uncertainty.is_some() {
        // One truth: the covariance says more than the sigmas beside the values.
        sigma.clear();
    }
    let region = entry
        .region
        .map(|region| Region { min_rad: region.min_deg.map(rad_from_deg), max_rad: region.max_deg.map(rad_from_deg) });
    Ok(Calibration { arm, sigma, uncertainty, stations, region, provenance: entry.provenance })
}

/// Reads an effects file for this robot.
///
/// # Errors
/// [`FileError`] with the place.
pub fn read_effects(source: &Source, robot: crate::model::robot::Robot) -> Result<EffectsFile, FileError> {
    let what = "an effects file (schema: falsetarget/effects/1) or a model file";
    let schema = schema_of(source, what)?;
    if schema == MODEL_SCHEMA {
        return Ok(EffectsFile { arm: read(source)?.arm, noise_sigma_m: 0.0, seed: 1 });
    }
    if schema != EFFECTS_SCHEMA {
        let message = format!("the schema is `{schema}`; expected `{EFFECTS_SCHEMA}`");
        return Err(complain(source, "schema", None, "schema", message));
    }
    let entry: EffectsFileEntry = parse(source, what)?;
    let mut arm = ArmModel::nominal(robot);
    fill_geometry(source, &mut arm, &entry.parameters)?;
    fill_effects(source, &mut arm, &entry.effects)?;
    arm.learner = learner(source, entry.network, entry.curves)?;
    let noise_sigma_mm = entry.noise_sigma_mm.unwrap_or(0.0);
    if !(0.0..100.0).contains(&noise_sigma_mm) {
        let message = format!("noise of {noise_sigma_mm} mm; expected 0 to 100 mm");
        return Err(complain(source, "noise_sigma_mm", None, "unit-scale", message));
    }
    debug_assert_eq!(entry.schema, EFFECTS_SCHEMA);
    Ok(EffectsFile { arm, noise_sigma_m: noise_sigma_mm * 1e-3, seed: entry.seed.unwrap_or(1) })
}

fn schema_of(source: &Source, what: &str) -> Result<String, FileError> {
    // The other keys belong to the schema that is named, so they are read afterwards, with that schema's own type.
    match parse::<SchemaOnly>(source, what) {
        Ok(only) => Ok(only.schema),
        Err(error) if error.diagnostic.message.contains("missing field") => {
            let missing = Diagnostic::error("schema", format!("no `schema:` key; expected {what}"));
            Err(FileError::new(source, missing.at(0, Span::new(0, 0), "")))
        }
        Err(error) => Err(error),
    }
}

fn fill_geometry(
    source: &Source,
    arm: &mut ArmModel,
    entries: &[GeometryEntry],
) -> Result<Vec<(ParameterId, f64)>, FileError> {
    let mut sigma = Vec::new();
    for (index, entry) in entries.iter().enumerate() {
        let wrong = |code, message| Err(complain(source, "parameters", Some(index), code, message));
        let Some(id) = geometry_id(&entry.at, &entry.quantity) else {
            let message = format!(
                "no parameter `{}` at `{}`; joints have offset, d, a, alpha, beta; base and tool x, y, z, rx, ry, rz; \
                 the loop crank, coupler",
                entry.quantity, entry.at
            );
            return wrong("parameter", message);
        };
        if entry.unit != geometry_unit(id) {
            let message = format!("unit `{}`; `{}` is given in {}", entry.unit, entry.quantity, geometry_unit(id));
            return wrong("unit", message);
        }
        if !entry.value.is_finite() || entry.value.abs() > LARGEST_ERROR {
            let message =
                format!("an error of {} {} is no calibration error; below 0.2 is expected", entry.value, entry.unit);
            return wrong("unit-scale", message);
        }
        if let Some(number) = arm.parameters.get_mut(id) {
            *number = entry.value;
        }
        sigma.extend(entry.sigma.map(|sigma| (id, sigma)));
    }
    Ok(sigma)
}

/// Parameters with their standard uncertainty.
type Sigmas = Vec<(ParameterId, f64)>;

/// Puts the effects of a file into the model. Returns the model's index of each, and the sigmas that stand beside the
/// values.
fn fill_effects(
    source: &Source,
    arm: &mut ArmModel,
    entries: &[EffectEntry],
) -> Result<(Vec<usize>, Sigmas), FileError> {
    let mut sigma = Vec::new();
    let mut places = Vec::with_capacity(entries.len());
    for (index, entry) in entries.iter().enumerate() {
        let wrong = |message| complain(source, "effects", Some(index), "effect", message);
        let effect = effect::by_id(&entry.effect).ok_or_else(|| {
            let known: Vec<&str> = effect::EFFECTS.iter().map(|effect| effect.meta().id).collect();
            wrong(format!("no effect `{}`; known are {}", entry.effect, known.join(", ")))
        })?;
        let meta = effect.meta();
        if !meta.place.fits(&entry.location) {
            return Err(wrong(format!("`{}` needs its place: {}", meta.id, meta.place.fields().join(", "))));
        }
        let mut values = vec![0.0; meta.parameters.len()];
        let instance = arm.effects.len();
        // A compliance that the robot file states is replaced, not doubled.
        let same_place = |known: &EffectInstance| known.effect.meta().id == meta.id && known.location == entry.location;
        let at = arm.effects.iter().position(same_place).unwrap_or(instance);
        for value in &entry.parameters {
            let Some(slot) = meta.parameters.iter().position(|parameter| parameter.name == value.name) else {
                return Err(wrong(format!("`{}` has no parameter `{}`", meta.id, value.name)));
            };
            if value.unit != meta.parameters[slot].unit || !value.value.is_finite() {
                let unit = meta.parameters[slot].unit;
                return Err(wrong(format!("parameter `{}` is a finite number in {unit}", value.name)));
            }
            values[slot] = value.value;
            sigma.extend(value.sigma.map(|sigma| (ParameterId::Effect(at, slot), sigma)));
        }
        if at == instance {
            arm.effects.push(EffectInstance { effect, location: entry.location });
            arm.parameters.effects.push(values);
        } else {
            arm.parameters.effects[at] = values;
        }
        places.push(at);
    }
    Ok((places, sigma))
}

fn learner(
    source: &Source,
    network: Option<ResidualNetwork>,
    curves: Option<JointCurves>,
) -> Result<Option<Learner>, FileError> {
    if let Some(network) = &network {
        network.check().map_err(|error| complain(source, "network", None, "network", error.to_string()))?;
    }
    if let Some(curves) = &curves {
        curves.check().map_err(|error| complain(source, "curves", None, "curves", error.to_string()))?;
    }
    match (network, curves) {
        (Some(_), Some(_)) => {
            let message = "a model has either a `network` or `curves` on top of its effects, not both".into();
            Err(complain(source, "curves", None, "curves", message))
        }
        (Some(network), None) => Ok(Some(Learner::Network(network))),
        (None, curves) => Ok(curves.map(Learner::Curves)),
    }
}

/// The text of a model file.
///
/// # Errors
/// [`serde_yaml::Error`] when the library cannot write it, which no model is known to cause.
pub fn write(calibration: &Calibration) -> Result<String, serde_yaml::Error> {
    let arm = &calibration.arm;
    let sigma_of = |id: ParameterId| calibration.sigma_of(id);
    let parameters = geometry_ids()
        .filter_map(|id| {
            let value = arm.parameters.clone().get_mut(id).copied()?;
            let sigma = sigma_of(id);
            if value == 0.0 && sigma.is_none() {
                return None;
            }
            let (at, quantity) = geometry_name(id)?;
            Some(GeometryEntry { at, quantity, value, unit: geometry_unit(id).into(), sigma })
        })
        .collect();
    // An effect that is zero and that nobody has asked about is no news.
    let told = |index: usize, values: &[f64]| {
        let identified = (0..values.len()).any(|slot| sigma_of(ParameterId::Effect(index, slot)).is_some());
        identified || values.iter().any(|&value| value != 0.0)
    };
    let places: Vec<usize> =
        (0..arm.effects.len()).filter(|&index| told(index, &arm.parameters.effects[index])).collect();
    let effects = places
        .iter()
        .map(|&index| (index, (&arm.effects[index], &arm.parameters.effects[index])))
        .map(|(index, (instance, values))| EffectEntry {
            effect: instance.effect.meta().id.into(),
            location: instance.location,
            parameters: instance
                .effect
                .meta()
                .parameters
                .iter()
                .zip(values)
                .enumerate()
                .map(|(slot, (meta, &value))| ValueEntry {
                    name: meta.name.into(),
                    value,
                    unit: meta.unit.into(),
                    sigma: sigma_of(ParameterId::Effect(index, slot)),
                })
                .collect(),
        })
        .collect();
    let entry = ModelEntry {
        schema: MODEL_SCHEMA.into(),
        robot: RobotEntry::from_robot(&arm.robot, false),
        measuring_t_base: Some(PoseEntry::from_pose(&arm.measuring_t_base)),
        flange_t_tool: Some(PoseEntry::from_pose(&arm.flange_t_tool)),
        parameters,
        effects,
        network: match &arm.learner {
            Some(Learner::Network(network)) => Some(network.clone()),
            _ => None,
        },
        curves: match &arm.learner {
            Some(Learner::Curves(curves)) => Some(curves.clone()),
            _ => None,
        },
        region: calibration.region.map(|region| RegionEntry {
            min_deg: region.min_rad.map(deg_from_rad),
            max_deg: region.max_rad.map(deg_from_rad),
        }),
        stations: calibration
            .stations
            .iter()
            .map(|station| StationEntry {
                name: station.name.clone(),
                station_t_measuring: PoseEntry::from_pose(&station.station_t_measuring),
            })
            .collect(),
        provenance: calibration.provenance.clone(),
        uncertainty: calibration.uncertainty.as_ref().map(|known| UncertaintyEntry::new(known, arm, &places)),
    };
    serde_yaml::to_string(&entry)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::builtin;
    use crate::model::parameters::RowQuantity;

    #[test]
    fn covariance_and_stations_go_round_and_bad_ones_are_refused() {
        let source = Source::new("m.yaml", model_text());
        let mut calibration = read(&source).expect("readable");
        let ids = vec![ParameterId::Row(1, RowQuantity::A), ParameterId::Effect(1, 0), ParameterId::Effect(4, 0)];
        let covariance = nalgebra::DMatrix::from_row_slice(3, 3, &[4e-10, 1e-15, 0., 1e-15, 1e-18, 0., 0., 0., 2e-18]);
        let (noise_sigma_m, unexplained_sigma_m) = (4e-5, 1e-4);
        let uncertainty = Uncertainty { ids, covariance, freedom: 686.5, noise_sigma_m, unexplained_sigma_m };
        calibration.uncertainty = Some(uncertainty.clone());
        let station_t_measuring = Pose::from_translation(nalgebra::Vector3::new(1.5, 0.0, -0.25));
        calibration.stations = vec![StationFrame { name: "S2".into(), station_t_measuring }];
        let text = write(&calibration).expect("writable");
        let again = read(&Source::new("m.yaml", text.clone())).expect(&text);
        // An identified compliance of zero is written too: the model knows that it is nearly zero.
        assert_eq!(again.uncertainty, Some(uncertainty));
        assert_eq!(again.stations, calibration.stations);
        assert_eq!(again.sigma_of(ParameterId::Row(1, RowQuantity::A)), Some(2e-5));
        assert_eq!(write(&again).expect("writable"), text);
        for (from, to) in [("joint 2 a", "joint 7 a"), ("freedom: 686.5", "freedom: -1.0"), ("- - 4e-10", "- - -1.0")] {
            assert!(text.contains(from), "{from} in {text}");
            let error = read(&Source::new("m.yaml", text.replacen(from, to, 1))).expect_err(to);
            assert_eq!(error.diagnostic.code, "uncertainty", "{to}");
        }
    }

    fn model_text() -> String {
        let robot = builtin::by_name("hh800-class").expect("built in").expect("sound");
        let mut calibration = Calibration::nominal(robot);
        calibration.arm.parameters.rows[1].a_m = 3.1e-4;
        calibration.arm.parameters.effects[1][0] = 4.3e-8;
        calibration.sigma.push((ParameterId::Row(1, RowQuantity::A), 1.5e-5));
        calibration.region = Some(Region { min_rad: [-1.0; DOF], max_rad: [1.0; DOF] });
        write(&calibration).expect("writable")
    }

    #[test]
    fn a_model_file_goes_round_bit_for_bit() {
        let text = model_text();
        let again = read(&Source::new("m.yaml", text.clone())).expect("readable");
        assert_eq!(again.arm.parameters.rows[1].a_m, 3.1e-4);
        assert_eq!(again.arm.parameters.effects[1][0], 4.3e-8);
        assert_eq!(again.sigma, [(ParameterId::Row(1, RowQuantity::A), 1.5e-5)]);
        assert_eq!(write(&again).expect("writable"), text);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        for (from, to, code) in [
            ("quantity: a", "quantity: b", "parameter"),
            ("value: 0.00031", "value: 310.0", "unit-scale"),
            ("unit: m", "unit: mm", "unit"),
            ("effect: joint_compliance", "effect: magic", "effect"),
            ("falsetarget/model/1", "falsetarget/model/9", "schema"),
            ("parameters:\n- at", "parametres:\n- at", "yaml"),
        ] {
            let text = model_text();
            assert!(text.contains(from), "{from} in {text}");
            let source = Source::new("m.yaml", text.replacen(from, to, 1));
            let error = read(&source).expect_err(to);
            assert_eq!(error.diagnostic.code, code, "{to}: {}", error.diagnostic.message);
            let place = error.diagnostic.place.as_ref().expect("a place");
            assert!(code == "schema" || source.line(place.span.start) > 1, "{to}");
        }
    }
}

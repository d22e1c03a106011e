//! Robot files: `falsetarget/robot/1`.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::base::text::Source;
use crate::base::units::{deg_from_rad, m_from_mm, mm_from_m, rad_from_deg};
use crate::model::robot::{Convention, Coupling, DOF, Joint, LOOP_AROUND, LOOP_DRIVEN, Mass, Parallelogram, Robot};

use super::error::FileError;
use super::yaml::{PoseEntry, complain, parse, tidy};

/// The word in the first line.
pub const SCHEMA: &str = "falsetarget/robot/1";

/// A robot file as it is written. The units are in the keys.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotEntry {
    #[serde(skip_serializing_if = "Option::is_none")]
    schema: Option<String>,
    name: String,
    convention: ConventionEntry,
    joints: Vec<JointEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parallelogram: Option<ParallelogramEntry>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    coupling: Vec<CouplingEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    links: Option<Vec<MassEntry>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<PoseEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tool: Option<PoseEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    payload: Option<MassEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gravity_m_s2: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint_compliance_rad_per_nm: Option<[f64; DOF]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum ConventionEntry {
    #[serde(rename = "standard-dh")]
    Standard,
    #[serde(rename = "modified-dh")]
    Modified,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct JointEntry {
    name: String,
    theta_deg: f64,
    d_mm: f64,
    a_mm: f64,
    alpha_deg: f64,
    #[serde(default = "one", skip_serializing_if = "is_one")]
    sign: f64,
    min_deg: f64,
    max_deg: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_speed_deg_s: Option<f64>,
}

fn one() -> f64 {
    1.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn is_one(sign: &f64) -> bool {
    *sign == 1.0
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ParallelogramEntry {
    driven_joint: usize,
    around_joint: usize,
    crank_mm: f64,
    coupler_mm: f64,
    rocker_mm: f64,
    arm_mm: f64,
    crank_offset_deg: f64,
    passive_min_deg: f64,
    passive_max_deg: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CouplingEntry {
    joint: usize,
    by: usize,
    factor: f64,
}

/// A mass as files write it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MassEntry {
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass, mm.
    #[serde(default)]
    pub com_mm: [f64; 3],
}

impl MassEntry {
    /// In kilograms and metres.
    pub fn mass(&self) -> Mass {
        Mass { mass_kg: self.mass_kg, center_of_mass_m: Vector3::from(self.com_mm.map(m_from_mm)) }
    }

    fn from_mass(mass: &Mass) -> Self {
        let com_mm = std::array::from_fn(|axis| tidy(mm_from_m(mass.center_of_mass_m[axis])));
        Self { mass_kg: mass.mass_kg, com_mm }
    }

    /// True for a finite mass that is not negative.
    pub fn is_sound(&self) -> bool {
        self.mass_kg.is_finite() && self.mass_kg >= 0.0 && self.com_mm.iter().all(|x| x.is_finite())
    }
}

/// Reads a robot file.
///
/// # Errors
/// [`FileError`] with the place: broken YAML, unknown key, number of joints other than six, limits out of order,
/// a robot 1000 times too large or too small, a parallelogram that cannot close, ...
pub fn read(source: &Source) -> Result<Robot, FileError> {
    let entry: RobotEntry = parse(source, "a robot file (schema: falsetarget/robot/1)")?;
    if entry.schema.as_deref() != Some(SCHEMA) {
        let message = format!("the file does not begin with `schema: {SCHEMA}`");
        return Err(complain(source, "schema", None, "schema", message));
    }
    entry.robot(source)
}

impl RobotEntry {
    /// The robot, checked; `source` is for complaints.
    ///
    /// # Errors
    /// [`FileError`] as for [`read`].
    pub fn robot(&self, source: &Source) -> Result<Robot, FileError> {
        let joints = self.joints(source)?;
        let convention = match self.convention {
            ConventionEntry::Standard => Convention::Standard,
            ConventionEntry::Modified => Convention::Modified,
        };
        let links = self.links(source)?;
        let payload = self.payload.unwrap_or(MassEntry { mass_kg: 0.0, com_mm: [0.0; 3] });
        if !payload.is_sound() {
            let message = "the payload's mass must be finite and not negative".to_string();
            return Err(complain(source, "payload", None, "mass", message));
        }
        let gravity = Vector3::from(self.gravity_m_s2.unwrap_or([0.0, 0.0, -9.80665]));
        if !gravity.norm().is_finite() || gravity.norm() > 30.0 {
            let message = format!("gravity of {:.1} m/s2 is not of this world; give it in m/s2", gravity.norm());
            return Err(complain(source, "gravity_m_s2", None, "unit-scale", message));
        }
        let compliance_rad_per_nm = self.joint_compliance_rad_per_nm.unwrap_or([0.0; DOF]);
        if compliance_rad_per_nm.iter().any(|s| !(0.0..1e-2).contains(s)) {
            let message = "compliances are rad/Nm: from 0 to below 0.01, usually 1e-8 to 1e-5".to_string();
            return Err(complain(source, "joint_compliance_rad_per_nm", None, "unit-scale", message));
        }
        let robot = Robot {
            name: self.name.clone(),
            convention,
            joints,
            parallelogram: self.parallelogram(source)?,
            couplings: self.couplings(source)?,
            links,
            base: self.pose(source, "base", self.base)?,
            tool: self.pose(source, "tool", self.tool)?,
            payload: payload.mass(),
            gravity_m_s2: gravity,
            compliance_rad_per_nm,
        };
        check_loop_axes(source, &robot)?;
        Ok(robot)
    }

    /// What a file says of this robot. `with_schema` for a file of its own, not for the robot inside a model file.
    pub fn from_robot(robot: &Robot, with_schema: bool) -> Self {
        let compliant = robot.compliance_rad_per_nm.iter().any(|&s| s != 0.0);
        Self {
            schema: with_schema.then(|| SCHEMA.to_string()),
            name: robot.name.clone(),
            convention: match robot.convention {
                Convention::Standard => ConventionEntry::Standard,
                Convention::Modified => ConventionEntry::Modified,
            },
            joints: robot.joints.iter().map(JointEntry::from_joint).collect(),
            parallelogram: robot.parallelogram.as_ref().map(ParallelogramEntry::from_parallelogram),
            coupling: robot
                .couplings
                .iter()
                .map(|coupling| CouplingEntry {
                    joint: coupling.joint + 1,
                    by: coupling.by + 1,
                    factor: coupling.factor,
                })
                .collect(),
            links: robot.links.as_ref().map(|links| links.iter().map(MassEntry::from_mass).collect()),
            base: robot.base.as_ref().map(PoseEntry::from_pose),
            tool: robot.tool.as_ref().map(PoseEntry::from_pose),
            payload: Some(MassEntry::from_mass(&robot.payload)),
            gravity_m_s2: Some(robot.gravity_m_s2.into()),
            joint_compliance_rad_per_nm: compliant.then_some(robot.compliance_rad_per_nm),
        }
    }

    fn joints(&self, source: &Source) -> Result<[Joint; DOF], FileError> {
        let mut joints = Vec::with_capacity(DOF);
        for (index, entry) in self.joints.iter().enumerate() {
            let wrong = |message: String| complain(source, "joints", Some(index), "joint", message);
            let joint = entry.joint();
            let numbers = [joint.theta_rad, joint.d_m, joint.a_m, joint.alpha_rad, joint.min_rad, joint.max_rad];
            if numbers.iter().any(|number| !number.is_finite()) {
                return Err(wrong(format!("joint {} has a number that is not finite", index + 1)));
            }
            if joint.sign.abs() != 1.0 {
                return Err(wrong(format!("sign of joint {} is {}; it must be 1 or -1", index + 1, joint.sign)));
            }
            if joint.min_rad >= joint.max_rad {
                let (min, max) = (entry.min_deg, entry.max_deg);
                return Err(wrong(format!("limits of joint {} are out of order: {min} to {max} deg", index + 1)));
            }
            joints.push(joint);
        }
        let length_m: f64 = joints.iter().map(|joint| joint.a_m.abs() + joint.d_m.abs()).sum();
        let joints: [Joint; DOF] = joints.try_into().map_err(|joints: Vec<Joint>| {
            let message = format!("{} joints; this tool knows arms with {DOF}", joints.len());
            complain(source, "joints", None, "joint-count", message)
        })?;
        // From the smallest desktop arm to the largest made, with a factor of two to spare.
        if !(0.2..20.0).contains(&length_m) {
            let message = format!(
                "all lengths of the arm together make {:.4} m; a real arm has 0.2 to 20 m. Lengths are millimetres here",
                length_m
            );
            return Err(complain(source, "joints", None, "unit-scale", message));
        }
        let turn: f64 = joints.iter().map(|joint| joint.max_rad - joint.min_rad).sum();
        if turn < rad_from_deg(40.0) {
            let message = "all joints together turn less than 40 deg. Angles are degrees here, not radians".to_string();
            return Err(complain(source, "joints", None, "unit-scale", message));
        }
        Ok(joints)
    }

    fn links(&self, source: &Source) -> Result<Option<[Mass; DOF]>, FileError> {
        let Some(entries) = &self.links else {
            return Ok(None);
        };
        if let Some(index) = entries.iter().position(|entry| !entry.is_sound()) {
            let message = format!("link {}: the mass must be finite and not negative", index + 1);
            return Err(complain(source, "links", Some(index), "mass", message));
        }
        let masses: Vec<Mass> = entries.iter().map(MassEntry::mass).collect();
        let count = masses.len();
        let links = masses.try_into().map_err(|_| {
            complain(source, "links", None, "link-count", format!("{count} links; expected {DOF}, one a joint"))
        })?;
        Ok(Some(links))
    }

    fn pose(
        &self,
        source: &Source,
        key: &str,
        entry: Option<PoseEntry>,
    ) -> Result<Option<crate::geometry::pose::Pose>, FileError> {
        entry
            .map(|entry| {
                let message = format!("`{key}` has a number that is not finite");
                entry.pose().ok_or_else(|| complain(source, key, None, "pose", message))
            })
            .transpose()
    }

    fn couplings(&self, source: &Source) -> Result<Vec<Coupling>, FileError> {
        self.coupling
            .iter()
            .map(|entry| {
                let inside = |joint: usize| (1..=DOF).contains(&joint);
                if !inside(entry.joint) || !inside(entry.by) || entry.joint == entry.by || !entry.factor.is_finite() {
                    let message = format!("a coupling names two different joints from 1 to {DOF} and a factor");
                    return Err(complain(source, "coupling", None, "coupling", message));
                }
                Ok(Coupling { joint: entry.joint - 1, by: entry.by - 1, factor: entry.factor })
            })
            .collect()
    }

    fn parallelogram(&self, source: &Source) -> Result<Option<Parallelogram>, FileError> {
        let Some(entry) = &self.parallelogram else {
            return Ok(None);
        };
        let wrong = |message: String| complain(source, "parallelogram", None, "parallelogram", message);
        if (entry.driven_joint, entry.around_joint) != (LOOP_DRIVEN + 1, LOOP_AROUND + 1) {
            return Err(wrong("this tool knows parallelograms that drive joint 3 around joint 2".into()));
        }
        let rods = [entry.crank_mm, entry.coupler_mm, entry.rocker_mm, entry.arm_mm];
        let longest = rods.iter().copied().fold(0.0, f64::max);
        if rods.iter().any(|rod| !rod.is_finite() || *rod <= 0.0) || 2.0 * longest >= rods.iter().sum() {
            return Err(wrong("four positive rods that close are needed: none longer than the other three".into()));
        }
        let range_deg = entry.passive_max_deg - entry.passive_min_deg;
        if range_deg <= 0.0 || !range_deg.is_finite() || !entry.crank_offset_deg.is_finite() {
            return Err(wrong("passive_min_deg must lie below passive_max_deg".into()));
        }
        Ok(Some(Parallelogram {
            crank_m: m_from_mm(entry.crank_mm),
            coupler_m: m_from_mm(entry.coupler_mm),
            rocker_m: m_from_mm(entry.rocker_mm),
            arm_m: m_from_mm(entry.arm_mm),
            crank_offset_rad: rad_from_deg(entry.crank_offset_deg),
            passive_min_rad: rad_from_deg(entry.passive_min_deg),
            passive_max_rad: rad_from_deg(entry.passive_max_deg),
        }))
    }
}

/// The loop lies in one plane: axes 2 and 3 point the same way and the arm is the distance between them.
fn check_loop_axes(source: &Source, robot: &Robot) -> Result<(), FileError> {
    let Some(parallelogram) = &robot.parallelogram else {
        return Ok(());
    };
    let (twist, length_m) = match robot.convention {
        Convention::Standard => (robot.joints[LOOP_AROUND].alpha_rad, robot.joints[LOOP_AROUND].a_m),
        Convention::Modified => (robot.joints[LOOP_DRIVEN].alpha_rad, robot.joints[LOOP_DRIVEN].a_m),
    };
    let wrong = |message: String| Err(complain(source, "parallelogram", None, "parallelogram", message));
    if !robot.parallel_to_next(LOOP_AROUND) || twist.cos() < 0.0 {
        return wrong("axes 2 and 3 of an arm with a parallelogram must be parallel and point the same way".into());
    }
    if (length_m - parallelogram.arm_m).abs() > 1e-6 {
        let (rod, row) = (mm_from_m(parallelogram.arm_m), mm_from_m(length_m));
        return wrong(format!("arm_mm is {rod} but the rows put {row} mm between axes 2 and 3"));
    }
    Ok(())
}

impl JointEntry {
    fn joint(&self) -> Joint {
        Joint {
            name: self.name.clone(),
            theta_rad: rad_from_deg(self.theta_deg),
            d_m: m_from_mm(self.d_mm),
            a_m: m_from_mm(self.a_mm),
            alpha_rad: rad_from_deg(self.alpha_deg),
            sign: self.sign,
            min_rad: rad_from_deg(self.min_deg),
            max_rad: rad_from_deg(self.max_deg),
            max_speed_rad_s: self.max_speed_deg_s.map(rad_from_deg),
        }
    }

    fn from_joint(joint: &Joint) -> Self {
        Self {
            name: joint.name.clone(),
            theta_deg: tidy(deg_from_rad(joint.theta_rad)),
            d_mm: tidy(mm_from_m(joint.d_m)),
            a_mm: tidy(mm_from_m(joint.a_m)),
            alpha_deg: tidy(deg_from_rad(joint.alpha_rad)),
            sign: joint.sign,
            min_deg: tidy(deg_from_rad(joint.min_rad)),
            max_deg: tidy(deg_from_rad(joint.max_rad)),
            max_speed_deg_s: joint.max_speed_rad_s.map(|speed| tidy(deg_from_rad(speed))),
        }
    }
}

impl ParallelogramEntry {
    fn from_parallelogram(parallelogram: &Parallelogram) -> Self {
        Self {
            driven_joint: LOOP_DRIVEN + 1,
            around_joint: LOOP_AROUND + 1,
            crank_mm: tidy(mm_from_m(parallelogram.crank_m)),
            coupler_mm: tidy(mm_from_m(parallelogram.coupler_m)),
            rocker_mm: tidy(mm_from_m(parallelogram.rocker_m)),
            arm_mm: tidy(mm_from_m(parallelogram.arm_m)),
            crank_offset_deg: tidy(deg_from_rad(parallelogram.crank_offset_rad)),
            passive_min_deg: tidy(deg_from_rad(parallelogram.passive_min_rad)),
            passive_max_deg: tidy(deg_from_rad(parallelogram.passive_max_rad)),
        }
    }
}

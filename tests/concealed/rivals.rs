//! Which names a recording cannot tell apart, by the simulator's own physics: the trace of the concealed cause beside
//! what another name could do instead.

use falsetarget::model::robot::DOF;
use nalgebra::{DVector, Vector3};
use serde_json::Value;

use crate::arm::Arm;
use crate::cause::{Cause, Frame, Setting, Spring};
use crate::motion::Moment;
use crate::real::Real;
use crate::size::Nuisance;
use crate::trial::Concealed;

/// Everything that a comparison needs, owned.
pub struct Bench {
    arm: Arm,
    moments: Vec<Moment>,
    nuisance: Nuisance,
    bare: Vec<Vector3<f64>>,
    traces: Vec<DVector<f64>>,
    sigma_m: f64,
    largest_nm: [f64; DOF],
    payload_m: Vector3<f64>,
}

impl Bench {
    pub fn new(
        arm: &Arm,
        moments: &[Moment],
        nuisance: Nuisance,
        concealed: &[Concealed],
        setting: &Setting<'_>,
        sigma_m: f64,
    ) -> Option<Self> {
        let bare = moments.iter().map(|moment| Real::new(arm, &[]).point(moment)).collect::<Option<_>>()?;
        let mut bench = Self {
            arm: arm.clone(),
            moments: moments.to_vec(),
            nuisance,
            bare,
            traces: Vec::new(),
            sigma_m,
            largest_nm: *setting.largest_nm,
            payload_m: *setting.payload_m,
        };
        for one in concealed {
            bench.traces.push(bench.trace(&one.cause, one.size)?);
        }
        Some(bench)
    }

    fn trace(&self, cause: &Cause, size: f64) -> Option<DVector<f64>> {
        let real = Real::new(&self.arm, &[(cause.clone(), size)]);
        let moved: Vec<Vector3<f64>> = self
            .moments
            .iter()
            .zip(&self.bare)
            .map(|(moment, bare)| Some(real.point(moment)? - bare))
            .collect::<Option<_>>()?;
        Some(self.nuisance.clear(&moved))
    }

    /// How far, in standard deviations of the noise, the records stand from the best that another name can do: the
    /// root of the non-centrality of any test between the two. `None` where the name cannot be tried.
    pub fn apart(&self, concealed: usize, effect: &str, location: &Value) -> Option<f64> {
        let mut left = self.traces[concealed].clone();
        let mut directions: Vec<DVector<f64>> = Vec::new();
        for (cause, size) in self.family(effect, location)? {
            let mut column = self.trace(&cause, size)?;
            let whole = column.norm();
            for direction in &directions {
                let along = direction.dot(&column);
                column.axpy(-along, direction, 1.0);
            }
            let length = column.norm();
            if whole <= 0.0 || length < 1e-4 * whole {
                continue;
            }
            column /= length;
            let along = column.dot(&left);
            left.axpy(-along, &column, 1.0);
            directions.push(column);
        }
        Some(left.norm() / self.sigma_m)
    }

    /// Causes whose sum is what a name with free parameters can do, at small sizes.
    fn family(&self, effect: &str, location: &Value) -> Option<Vec<(Cause, f64)>> {
        let index = |key: &str| location.get(key)?.as_u64().and_then(|n| (n as usize).checked_sub(1));
        let joint = index("joint");
        let frame = || match location.get("frame")?.as_str()? {
            "base" => Some(Frame::Base),
            "tool" => Some(Frame::Tool),
            _ => None,
        };
        let six = |make: &dyn Fn(Vector3<f64>, Vector3<f64>) -> Cause| -> Vec<(Cause, f64)> {
            (0..3)
                .flat_map(|axis| {
                    let unit = Vector3::ith(axis, 1.0);
                    [(make(unit, Vector3::zeros()), 1e-4), (make(Vector3::zeros(), unit), 1e-4)]
                })
                .collect()
        };
        let tau = |joint: usize| self.largest_nm[joint].max(1.0);
        let quarter = std::f64::consts::FRAC_PI_2;
        Some(match effect {
            "joint_compliance" => vec![(Cause::Compliance { joint: joint? }, 1e-4 / tau(joint?))],
            "joint_stiffening" => {
                let (joint, largest_nm) = (joint?, self.largest_nm[joint?]);
                let knee = |share| (Cause::Stiffening { joint, spring: Spring::Knee(share), largest_nm }, 1e-4);
                vec![knee(0.3), knee(0.6), knee(0.9)]
            }
            "link_flexibility" => {
                let link = index("link")?;
                [0.0, 2.0].map(|twist_ratio| (Cause::Beam { link, twist_ratio }, 1e-10)).to_vec()
            }
            "backlash" => {
                // The torque that the friction is said to hold belongs to the name.
                let told_nm = location.get("reference").and_then(Value::as_f64);
                let held_nm = told_nm.unwrap_or((0.03 * tau(joint?)).max(1.0));
                vec![(Cause::Backlash { joint: joint?, held_nm }, 1e-4)]
            }
            "friction_windup" => vec![(Cause::Windup { joint: joint? }, 1e-4)],
            "joint_periodic" => {
                let (joint, order) = (joint?, location.get("order")?.as_f64()?);
                [0.0, quarter].map(|phase| (Cause::Periodic { joint, order, phase }, 1e-4)).to_vec()
            }
            "gear_ratio" => vec![(Cause::GearRatio { joint: joint? }, 1e-4)],
            "joint_coupling" => vec![(Cause::Coupling { joint: joint?, source: index("source_joint")? }, 1e-4)],
            "axis_wobble" => {
                let (joint, order) = (joint?, location.get("order").and_then(Value::as_f64).unwrap_or(2.0));
                let tilt = |phases, ratio| (Cause::Wobble { joint, order, phases, ratio }, 1e-4);
                let sides = [[0.0, 0.0], [quarter, 0.0], [0.0, quarter], [quarter, quarter]];
                sides.iter().flat_map(|&phases| [tilt(phases, 0.0), tilt(phases, 1.0)]).collect()
            }
            "gravity_compensator" => {
                let joint = joint?;
                let soft = self.arm.compliance[joint];
                if soft == 0.0 {
                    return None;
                }
                let line = |order, phase| (Cause::Periodic { joint, order, phase }, 1e-4);
                vec![line(1.0, 0.0), line(1.0, quarter), line(2.0, 0.0), line(2.0, quarter)]
            }
            "payload_error" => {
                let places = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
                places.iter().map(|place| (Cause::Payload { at_m: self.payload_m + 0.3 * place }, 1.0)).collect()
            }
            "gravity_tilt" => [Vector3::x(), Vector3::y()].map(|about| (Cause::Tilt { about }, 1e-3)).to_vec(),
            "base_compliance" => [0.0, 2.0].map(|ratio| (Cause::Foundation { ratio }, 1e-5 / tau(1))).to_vec(),
            "thermal_growth" => vec![(Cause::Growth { link: index("link")? }, 1e-5)],
            "drift" => {
                let frame = frame()?;
                six(&|shift, turn| Cause::Drift { frame, shift, turn, levelling: 0.0 })
            }
            "step_shift" => {
                let (frame, at_s) = (frame()?, location.get("at_s")?.as_f64()?);
                let at = at_s / self.moments.last()?.time_s;
                six(&|shift, turn| Cause::Step { frame, at, shift, turn })
            }
            "time_offset" => vec![(Cause::Clock, 1e-3)],
            "servo_lag" => vec![(Cause::Lag { joint: joint? }, 1e-3)],
            "inertial_deflection" => vec![(Cause::Inertial { joint: joint? }, 1e-4 / tau(joint?))],
            _ => return None,
        })
    }
}

//! The arm as it is: everything that is wrong with it at once, at static equilibrium by fixed point.

use falsetarget::model::robot::DOF;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use crate::arm::{Arm, BODIES, Shape, Stand};
use crate::cause::{Cause, Frame, Spring};
use crate::motion::{Moment, Motion};

/// Rounds towards equilibrium: each is some thousand times nearer.
const ROUNDS: usize = 5;

/// An arm with what is wrong with it.
pub struct Real {
    arm: Arm,
    causes: Vec<(Cause, f64)>,
    gravity: Vector3<f64>,
}

impl Real {
    pub fn new(arm: &Arm, causes: &[(Cause, f64)]) -> Self {
        let mut real = Self { arm: arm.clone(), causes: causes.to_vec(), gravity: arm.gravity };
        for (cause, size) in causes {
            match cause {
                Cause::Tilt { about } => {
                    real.gravity =
                        UnitQuaternion::from_scaled_axis(arm.bodies[0].rotation * about * *size) * arm.gravity;
                }
                Cause::Payload { at_m } => {
                    let load = &mut real.arm.payload;
                    let whole = load.mass_kg + size;
                    load.at_m = (load.at_m * load.mass_kg + at_m * *size) / whole;
                    load.mass_kg = whole;
                }
                _ => {}
            }
        }
        real
    }

    /// Where the measured point stands, m; `None` in a pose that the arm cannot take.
    pub fn point(&self, moment: &Moment) -> Option<Vector3<f64>> {
        let stand = self.settle(moment)?;
        let seen = self.causes.iter().fold(stand.point, |point, (cause, size)| seen(cause, *size, point));
        Some(seen)
    }

    /// Static torque of each drive, Nm, and where everything stands.
    pub fn loaded(&self, moment: &Moment) -> Option<([f64; DOF], Stand)> {
        let drives = self.arm.drives(&moment.numbers);
        let shape = Shape::default();
        Some((self.arm.torques(&drives, &shape, &[self.gravity; BODIES])?, self.arm.stand(&drives, &shape)?))
    }

    fn settle(&self, moment: &Moment) -> Option<Stand> {
        let drives = self.drives(moment);
        let own = self.unloaded(moment, &drives);
        let inertia = self.inertial_torques(moment);
        let fields = [self.gravity; BODIES];
        let mut shape = own.clone();
        for _ in 0..ROUNDS {
            let mut torques = self.arm.torques(&drives, &shape, &fields)?;
            self.add_devices(&drives, &mut torques);
            let stand = self.arm.stand(&drives, &shape)?;
            shape = own.clone();
            for (turn, (soft, torque)) in shape.turns.iter_mut().zip(self.arm.compliance.iter().zip(&torques)) {
                *turn += soft * torque;
            }
            for (cause, size) in &self.causes {
                self.give_way(cause, *size, moment, &torques, &inertia, &stand, &mut shape);
            }
        }
        self.arm.stand(&drives, &shape)
    }

    /// Where the drives stand when the record is taken. A servo runs behind in its own drive's angle, whatever the controller
    /// shows for it.
    fn drives(&self, moment: &Moment) -> [f64; DOF] {
        let Some(motion) = &moment.motion else { return self.arm.drives(&moment.numbers) };
        let mut clocks = self.causes.iter().filter(|(cause, _)| matches!(cause, Cause::Clock));
        let mut drives = match clocks.next_back() {
            Some((_, size)) => self.arm.drives(&motion.numbers(moment.time_s + size)),
            None => self.arm.drives(&moment.numbers),
        };
        for (cause, size) in &self.causes {
            if let Cause::Lag { joint } = cause {
                drives[*joint] = self.arm.drives(&motion.numbers(moment.time_s - size))[*joint];
            }
        }
        drives
    }

    /// What no load changes.
    fn unloaded(&self, moment: &Moment, drives: &[f64; DOF]) -> Shape {
        let mut shape = Shape { turns: moment.unsettled, ..Shape::default() };
        for (cause, size) in &self.causes {
            match *cause {
                Cause::Windup { joint } => shape.turns[joint] -= size * moment.wound[joint],
                Cause::Periodic { joint, order, phase } => {
                    shape.turns[joint] += size * (order * drives[joint] + phase).sin();
                }
                Cause::GearRatio { joint } => shape.turns[joint] += size * drives[joint],
                Cause::Coupling { joint, source } => shape.turns[joint] += size * drives[source],
                Cause::Wobble { joint, order, phases, ratio } => {
                    let at = |phase: f64| (order * drives[joint] + phase).cos();
                    shape.axis_tilts[joint] += Vector3::new(at(phases[0]), ratio * at(phases[1]), 0.0) * *size;
                }
                Cause::Growth { link } => shape.growth[link + 1] += size * moment.warmer_k,
                Cause::Drift { frame, shift, turn, levelling } => {
                    let grown = if levelling > 0.0 {
                        (-2.0 * levelling * moment.fraction).exp_m1() / (-2.0 * levelling).exp_m1()
                    } else {
                        moment.fraction
                    };
                    displace(&mut shape, frame, &(shift * *size * grown), &(turn * *size * grown));
                }
                Cause::Step { frame, at, shift, turn } if moment.fraction >= at => {
                    displace(&mut shape, frame, &(shift * *size), &(turn * *size));
                }
                Cause::Product { joint, of: [a, b], phases } => {
                    shape.turns[joint] += size * (2.0 * drives[a] + phases[0]).sin() * (drives[b] + phases[1]).sin();
                }
                Cause::FrictionByAngle { joint, phase } => {
                    shape.turns[joint] -= size * moment.approach[joint] * (drives[joint] + phase).sin();
                }
                Cause::Bump { joint, at, width } => {
                    shape.turns[joint] += size * (-0.5 * ((drives[joint] - at) / width).powi(2)).exp();
                }
                _ => {}
            }
        }
        shape
    }

    /// Torques of springs between arm and pedestal: minus the slope of their energy.
    fn add_devices(&self, drives: &[f64; DOF], torques: &mut [f64; DOF]) {
        for (cause, size) in &self.causes {
            if let Cause::Balancer { joint, radius_m, height_m, rest_m, start } = *cause {
                let energy = |angle: f64| {
                    let square =
                        radius_m.powi(2) + height_m.powi(2) + 2.0 * radius_m * height_m * (start + angle).cos();
                    0.5 * size * (square.sqrt() - rest_m).powi(2)
                };
                let step = 1e-4;
                torques[joint] -= (energy(drives[joint] + step) - energy(drives[joint] - step)) / (2.0 * step);
            }
        }
    }

    #[allow(clippy::too_many_arguments, reason = "what a cause can look at")]
    fn give_way(
        &self,
        cause: &Cause,
        size: f64,
        moment: &Moment,
        torques: &[f64; DOF],
        inertia: &[f64; DOF],
        stand: &Stand,
        shape: &mut Shape,
    ) {
        match *cause {
            Cause::Compliance { joint } => shape.turns[joint] += size * torques[joint],
            Cause::Stiffening { joint, spring, largest_nm } => {
                shape.turns[joint] += bend_of(spring, self.arm.compliance[joint], size, torques[joint], largest_nm);
            }
            Cause::Backlash { joint, held_nm } => {
                let flank =
                    if torques[joint].abs() > held_nm { torques[joint].signum() } else { -moment.approach[joint] };
                shape.turns[joint] += 0.5 * size * flank;
            }
            Cause::Inertial { joint } => shape.turns[joint] += size * inertia[joint],
            Cause::Foundation { ratio } => {
                let foot = &stand.foot;
                let moment = self.beyond(stand, 0, &foot.translation.vector).1;
                let own = foot.rotation.inverse() * moment;
                let turn = Vector3::new(size * own.x, size * ratio * own.y, 0.0);
                shape.ends[0] *= UnitQuaternion::from_scaled_axis(turn);
            }
            Cause::Beam { link, twist_ratio } => shape.ends[link + 1] *= self.bent(stand, link, size, twist_ratio),
            _ => {}
        }
    }

    /// Force and moment about a point of the masses from body `first` on.
    fn beyond(&self, stand: &Stand, first: usize, about: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        self.arm.masses(stand)[first..].iter().fold(
            (Vector3::zeros(), Vector3::zeros()),
            |(force, moment), (mass, at)| {
                let weight = self.gravity * *mass;
                (force + weight, moment + (at - about).cross(&weight))
            },
        )
    }

    /// How the far end of a slender beam moves under force and moment there (Euler and Bernoulli), in its own frame.
    fn bent(&self, stand: &Stand, link: usize, softness: f64, twist_ratio: f64) -> Isometry3<f64> {
        let (near, end) = (stand.turning[link].translation.vector, &stand.ends[link]);
        let far = end.translation.vector;
        let length = (far - near).norm();
        let along = (far - near) / length;
        let (force, mut moment) = self.beyond(stand, link + 1, &far);
        // A pin passes on no moment about itself, and the rod beside the arm keeps the forearm from turning.
        let pin = (link == 1 && self.arm.rods.is_some()).then(|| stand.turning[2].rotation * Vector3::z());
        let free_of_pin = |v: Vector3<f64>| pin.map_or(v, |pin| v - pin * pin.dot(&v));
        moment = free_of_pin(moment);
        let across = |v: &Vector3<f64>| v - along * along.dot(v);
        let (side, couple) = (across(&force), across(&moment));
        let sag = side * (length.powi(3) / 3.0) + couple.cross(&along) * (length.powi(2) / 2.0);
        let lean = along.cross(&side) * (length.powi(2) / 2.0) + couple * length;
        let turn = free_of_pin((lean + along * along.dot(&moment) * length * twist_ratio) * softness);
        let to_own = end.rotation.inverse();
        Isometry3::new(to_own * (sag * softness), to_own * turn)
    }

    /// Torques that accelerate the masses (d'Alembert), as loads; accelerations by differences along the motion.
    fn inertial_torques(&self, moment: &Moment) -> [f64; DOF] {
        let wanted = self.causes.iter().any(|(cause, _)| matches!(cause, Cause::Inertial { .. }));
        let (Some(motion), true) = (&moment.motion, wanted) else { return [0.0; DOF] };
        const STEP_S: f64 = 2e-3;
        let masses = |motion: &Motion, time_s: f64| {
            let stand = self.arm.stand(&self.arm.drives(&motion.numbers(time_s)), &Shape::default());
            stand.map(|stand| self.arm.masses(&stand))
        };
        let at = [-1.0, 0.0, 1.0].map(|side| masses(motion, moment.time_s + side * STEP_S));
        let [Some(before), Some(now), Some(after)] = at else { return [0.0; DOF] };
        let fields =
            std::array::from_fn(|index| -(before[index].1 - 2.0 * now[index].1 + after[index].1) / STEP_S.powi(2));
        self.arm.torques(&self.arm.drives(&moment.numbers), &Shape::default(), &fields).unwrap_or([0.0; DOF])
    }
}

/// What a spring twists beyond its straight line, rad; `size` of it at the largest torque.
fn bend_of(spring: Spring, compliance: f64, size: f64, torque: f64, largest_nm: f64) -> f64 {
    match spring {
        Spring::Cubic => {
            // tau = (x + b x^3) / c with b so that x(largest) lies `size` below the straight line.
            let straight = compliance * largest_nm;
            let there = (straight - size).max(0.3 * straight);
            let b = (straight - there) / there.powi(3);
            let target = compliance * torque;
            let mut x = target;
            for _ in 0..40 {
                x -= (x + b * x.powi(3) - target) / (1.0 + 3.0 * b * x * x);
            }
            x - target
        }
        Spring::Knee(share) => {
            // Soft up to the knee: an additional twist that grows to `size` and stays.
            let knee = share * largest_nm;
            size * (torque / knee).clamp(-1.0, 1.0)
        }
    }
}

fn displace(shape: &mut Shape, frame: Frame, shift: &Vector3<f64>, turn: &Vector3<f64>) {
    let by = Isometry3::from_parts(Translation3::from(*shift), UnitQuaternion::from_scaled_axis(*turn));
    match frame {
        Frame::Base => shape.ends[0] *= by,
        Frame::Tool => shape.tool *= by,
    }
}

/// What the tracker makes of a point.
fn seen(cause: &Cause, size: f64, point: Vector3<f64>) -> Vector3<f64> {
    let Cause::TrackerAngle { phase, order, stands_m } = cause else { return point };
    let ray = point - stands_m;
    let azimuth = ray.y.atan2(ray.x);
    let turn = size * (order * azimuth + phase).sin();
    stands_m + UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn) * ray
}

//! The link bends and twists as a beam clamped at its own drive.
//!
//! Euler and Bernoulli: at the far end of a straight uniform beam of length `L` along `u`, under the force `F` and the
//! moment `M` that hang there (subscript t: the part across `u`), `shift = b (F_t L^3/3 + M_t x u L^2/2)`,
//! `turn  = b (u x F_t L^2/2 + M_t L) + t L (u.M) u`, with `b = 1/EI` the same across all directions and `t = 1/GJ`. The
//! link's own weight is left out: most of a casting's mass sits at its two ends, and what it bends the drive's spring
//! takes. `u` and `L` go from the link's own axis frame to the next one's (see [`Context::link_ends_m`]); everything in
//! the robot base. A link that these frames give no length has no beam.
//!
//! In a parallelogram no moment passes about the pin at the arm's end itself: the coupler takes it, as a couple of forces
//! along the arm and along the coupler, which stretch one and shorten the other. The two together turn the forearm with
//! that moment as a frame of its own would, so arm and coupler count as one beam that carries force and moment.
//!
//! Signature: what remains beside joint springs: side bending where gravity leaves the arm's plane, a shift without the
//! turn that a joint would give, torsion of the forearm. Size: a cast box of 0.3 m, EI = 4e7 Nm^2, 10 kN at 1.5 m: 0.3
//! mm; small arms 0.01 to 0.05 mm. Nine tenths of the in-plane part pass for joint compliance (Mamedov and Klimchik
//! 2018).

use nalgebra::Vector3;

use crate::geometry::real::Real;

use super::{Context, EffectMeta, Follows, Location, Needs, ParameterMeta, Physics, Place, Response};

/// See the module.
pub struct LinkFlexibility;

static META: EffectMeta = EffectMeta {
    id: "link_flexibility",
    title: "link bends under load",
    parameters: &[
        // 1/EI from a heavy casting (4e7 Nm^2) to a thin tube, ten times softer than a UR10's (2.4e5 Nm^2).
        ParameterMeta { name: "bending", unit: "1/(Nm^2)", typical: 1e-7, plausible: (0.0, 4e-5) },
        ParameterMeta { name: "torsion", unit: "1/(Nm^2)", typical: 1e-7, plausible: (0.0, 8e-5) },
    ],
    place: Place::Link,
    needs: Needs { gravity_model: true, ..Needs::NOTHING },
    signature: "shift and turn of a link's far end with the force and moment there, sideways too",
    mistaken_for: &["joint_compliance", "base_compliance", "payload_error", "joint_stiffening"],
    follows: Follows::Several,
    told_apart_by: "15 poses twice, with the full payload and with none",
};

/// Length, m, below which a link is no beam.
const SHORTEST_M: f64 = 1e-3;

/// What loads a beam at its end, in one frame: N and Nm.
struct BeamLoad<T: Real> {
    end_force: Vector3<T>,
    end_moment: Vector3<T>,
}

impl Physics for LinkFlexibility {
    fn meta(&self) -> &'static EffectMeta {
        &META
    }

    fn respond<T: Real>(&self, at: &Location, parameters: &[T], context: &Context<'_, T>, response: &mut Response<T>) {
        let (Some(link), [bending, torsion]) = (at.link_index(), parameters) else {
            return;
        };
        let (near, far) = context.link_ends_m(link);
        let beam = far - near;
        if beam.norm().value() < SHORTEST_M {
            return;
        }
        let (shift, turn) = far_end(&beam, &beam_load(context, link, &far), *bending, *torsion);
        context.move_far_end(link, &shift, &turn, response);
    }
}

fn beam_load<T: Real>(context: &Context<'_, T>, link: usize, far: &Vector3<T>) -> BeamLoad<T> {
    let statics = context.statics;
    let gravity = &statics.gravity_m_s2;
    let beyond = statics.beyond_link(link);
    BeamLoad { end_force: beyond.weight(gravity), end_moment: beyond.moment_about(far, gravity) }
}

/// Shift, m, and turn, rad, of the free end of the beam. See the module for the equations.
fn far_end<T: Real>(beam: &Vector3<T>, load: &BeamLoad<T>, bending: T, torsion: T) -> (Vector3<T>, Vector3<T>) {
    let length = beam.norm();
    let along = beam / length;
    let across = |v: &Vector3<T>| v - along * along.dot(v);
    let (force, moment) = (across(&load.end_force), across(&load.end_moment));
    let part = |divisor: f64| T::constant(1.0 / divisor);
    let square = length * length;
    let shift = force * (square * length * part(3.0)) + moment.cross(&along) * (square * part(2.0));
    let bent = along.cross(&force) * (square * part(2.0)) + moment * length;
    let twisted = along * (along.dot(&load.end_moment) * length);
    (shift * bending, bent * bending + twisted * torsion)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The deflection curve of the beam by plain integration of curvature `M(s)/EI`, with no closed formula.
    fn integrated(length: f64, load: &BeamLoad<f64>, bending: f64, torsion: f64) -> (Vector3<f64>, Vector3<f64>) {
        const SLICES: usize = 20_000;
        let step = length / SLICES as f64;
        let (mut shift, mut turn) = (Vector3::zeros(), Vector3::zeros());
        for slice in 0..SLICES {
            let s = (slice as f64 + 0.5) * step;
            let to_end = Vector3::x() * (length - s);
            let moment = load.end_moment + to_end.cross(&load.end_force);
            let curved = Vector3::new(moment.x * torsion, moment.y * bending, moment.z * bending) * step;
            // Each slice's turn carries the rest of the beam with it.
            shift += curved.cross(&to_end);
            turn += curved;
        }
        (shift, turn)
    }

    #[test]
    fn the_beam_formulas_are_the_integrated_curvature() {
        let load = BeamLoad {
            end_force: Vector3::new(300.0, -2000.0, 700.0),
            end_moment: Vector3::new(400.0, 900.0, -1500.0),
        };
        let (length, bending, torsion) = (1.7, 3e-8, 5e-8);
        let (shift, turn) = far_end(&Vector3::new(length, 0.0, 0.0), &load, bending, torsion);
        let (expected_shift, expected_turn) = integrated(length, &load, bending, torsion);
        assert!((shift - expected_shift).norm() < 1e-7 * expected_shift.norm(), "{shift} against {expected_shift}");
        assert!((turn - expected_turn).norm() < 1e-7 * expected_turn.norm(), "{turn} against {expected_turn}");
    }

    #[test]
    fn a_cantilever_with_an_end_load_sinks_by_the_handbook_value() {
        // 10 kN at 1.5 m on EI = 4e7 Nm^2: F L^3 / 3EI = 0.28125 mm, slope F L^2 / 2EI = 0.28125 mrad, nose down.
        let load = BeamLoad { end_force: Vector3::new(0.0, 0.0, -1e4), end_moment: Vector3::zeros() };
        let (shift, turn) = far_end(&Vector3::new(1.5, 0.0, 0.0), &load, 1.0 / 4e7, 0.0);
        assert!((shift - Vector3::new(0.0, 0.0, -2.8125e-4)).norm() < 1e-12);
        assert!((turn - Vector3::new(0.0, 2.8125e-4, 0.0)).norm() < 1e-12);
    }
}

//! Robots for the tests of this floor, made by hand: no file is read here.

use nalgebra::Vector3;

use super::robot::{Convention, DOF, Joint, Mass, Parallelogram, Robot};

/// Rows `[theta_deg, d_mm, a_mm, alpha_deg]`.
pub type RowsMmDeg = [[f64; 4]; DOF];

/// An arm of the 800 kg class whose third drive sits at the shoulder.
pub const LOOPED: RowsMmDeg = [
    [0.0, 1337.7, 576.5, 90.0],
    [90.0, 0.0, 1791.0, 0.0],
    [0.0, 0.0, 391.8, 90.0],
    [0.0, 2126.9, 0.0, -90.0],
    [0.0, 0.0, 0.0, 90.0],
    [0.0, 498.1, 0.0, 0.0],
];

/// An effect-free robot with these rows, generous limits and no masses.
pub fn bare(convention: Convention, rows: &RowsMmDeg) -> Robot {
    let joints = std::array::from_fn(|index| {
        let [theta_deg, d_mm, a_mm, alpha_deg] = rows[index];
        Joint {
            name: format!("J{}", index + 1),
            theta_rad: theta_deg.to_radians(),
            d_m: d_mm * 1e-3,
            a_m: a_mm * 1e-3,
            alpha_rad: alpha_deg.to_radians(),
            sign: 1.0,
            min_rad: -std::f64::consts::PI,
            max_rad: std::f64::consts::PI,
            max_speed_rad_s: None,
        }
    });
    Robot {
        name: "fixture".into(),
        convention,
        joints,
        parallelogram: None,
        couplings: Vec::new(),
        links: None,
        base: None,
        tool: None,
        payload: Mass::NONE,
        gravity_m_s2: Vector3::new(0.0, 0.0, -9.80665),
        compliance_rad_per_nm: [0.0; DOF],
    }
}

/// [`LOOPED`] with rods, masses and a tilted gravity.
pub fn looped_with_masses() -> Robot {
    let mass = |mass_kg: f64, com_mm: [f64; 3]| Mass { mass_kg, center_of_mass_m: Vector3::from(com_mm) * 1e-3 };
    Robot {
        parallelogram: Some(Parallelogram {
            crank_m: 0.5,
            coupler_m: 1.791,
            rocker_m: 0.5,
            arm_m: 1.791,
            crank_offset_rad: -std::f64::consts::FRAC_PI_2,
            passive_min_rad: -1.05,
            passive_max_rad: 1.05,
        }),
        links: Some([
            mass(539.8, [-223.9, -167.9, 0.0]),
            mass(276.6, [-895.5, 0.0, 44.8]),
            mass(303.6, [-134.3, -22.4, 89.6]),
            mass(141.7, [0.0, 783.6, 0.0]),
            mass(54.0, [0.0, 0.0, 33.6]),
            mass(30.4, [0.0, 0.0, -67.2]),
        ]),
        payload: mass(80.0, [40.0, 20.0, 280.0]),
        gravity_m_s2: Vector3::new(0.8, -0.5, -9.75),
        ..bare(Convention::Standard, &LOOPED)
    }
}

/// [`looped_with_masses`] with the third drive at the elbow, in modified rows.
pub fn serial_with_masses() -> Robot {
    let rows = [
        [0.0, 780.0, 0.0, 0.0],
        [-90.0, 0.0, 320.0, -90.0],
        [0.0, 0.0, 1075.0, 0.0],
        [0.0, 1392.5, 200.0, -90.0],
        [0.0, 0.0, 0.0, 90.0],
        [180.0, 200.0, 0.0, -90.0],
    ];
    let looped = looped_with_masses();
    Robot {
        links: looped.links,
        payload: looped.payload,
        gravity_m_s2: looped.gravity_m_s2,
        ..bare(Convention::Modified, &rows)
    }
}

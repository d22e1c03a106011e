//! Conversions between the units of files (mm, deg) and the units inside (m, rad).
//!
//! Every function names both sides, so that a reader of the calling line sees which unit comes out.

/// Metres in a millimetre.
pub const M_PER_MM: f64 = 1e-3;
/// Metres in an inch.
pub const M_PER_INCH: f64 = 25.4e-3;
/// Millimetres in a metre.
pub const MM_PER_M: f64 = 1e3;

/// A length in metres from millimetres.
pub fn m_from_mm(length_mm: f64) -> f64 {
    // Division, not multiplication by 1e-3: it is correctly rounded, so 0.1 mm stays the nearest double.
    length_mm / MM_PER_M
}

/// A length in millimetres from metres.
pub fn mm_from_m(length_m: f64) -> f64 {
    length_m * MM_PER_M
}

/// An angle in radians from degrees.
pub fn rad_from_deg(angle_deg: f64) -> f64 {
    angle_deg.to_radians()
}

/// An angle in degrees from radians.
pub fn deg_from_rad(angle_rad: f64) -> f64 {
    angle_rad.to_degrees()
}

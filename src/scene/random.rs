//! A Gaussian field of mean 0 and variance 1 that is the same at the same place whatever the mesh.
//!
//! ```text
//! f(x) = √(2/M) Σ cos(k_m · x + φ_m)        k_m Gaussian with the deviation √2/L:   correlation exp(−(d/L)²)
//! ```
//!
//! Wave vectors fill their space evenly (an additive recurrence, shifted by the seed), so that every field has the correlation
//! itself, not only the mean of many fields; phases are random.

use std::sync::Arc;

/// Waves of a field.
const WAVES: usize = 512;
/// Root of x⁵ = x + 1: its powers make the recurrence in four dimensions.
const RATIO: f64 = 1.167_303_978_261_418_7;

/// A field.
#[derive(Debug, Clone)]
pub(super) struct RandomField {
    /// k and φ.
    waves: Arc<[[f64; 4]]>,
}

impl RandomField {
    /// The field of a seed whose correlation falls to 1/e over a length.
    pub(super) fn new(seed: u64, correlation_length: f64) -> RandomField {
        let mut state = seed;
        let mut next = || {
            // splitmix64
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        };
        let shift: [f64; 4] = std::array::from_fn(|_| next());
        let step: [f64; 4] = std::array::from_fn(|i| RATIO.powi(-(i as i32) - 1));
        let deviation = std::f64::consts::SQRT_2 / correlation_length;
        let waves = (0..WAVES).map(|m| {
            let u: [f64; 4] = std::array::from_fn(|i| (shift[i] + (m + 1) as f64 * step[i]).fract());
            // Box and Muller
            let size = |u: f64| deviation * (-2.0 * (1.0 - u).ln()).sqrt();
            let angle = |u: f64| std::f64::consts::TAU * u;
            let plane = [size(u[0]) * angle(u[1]).cos(), size(u[0]) * angle(u[1]).sin()];
            [plane[0], plane[1], size(u[2]) * angle(u[3]).cos(), angle(next())]
        });
        RandomField { waves: waves.collect() }
    }

    /// Its value at a place.
    pub(super) fn at(&self, x: f64, y: f64, z: f64) -> f64 {
        let sum: f64 =
            self.waves.iter().map(|[kx, ky, kz, phase]| (kx * x + ky * y + kz * z + phase).cos()).sum();
        sum * (2.0 / WAVES as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claim: along a line of any direction every field has mean 0, variance 1 and the correlation exp(−(d/L)²), within 5 %.
    #[test]
    fn every_field_has_its_moments_and_its_correlation() {
        let length = 0.3;
        for seed in [1, 7, 1 << 40] {
            let field = RandomField::new(seed, length);
            for direction in [[1.0, 0.0, 0.0], [0.6, 0.8, 0.0], [0.0, 0.6, -0.8]] {
                let [a, b, c] = direction;
                let step = 0.1 * length;
                let values: Vec<f64> = (0..200_000)
                    .map(|k| k as f64 * step)
                    .map(|s| field.at(a * s + 5.0, b * s - 3.0, c * s))
                    .collect();
                let n = values.len() as f64;
                let mean = values.iter().sum::<f64>() / n;
                let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
                assert!(
                    mean.abs() < 0.05 && (square - 1.0).abs() < 0.05,
                    "{seed} {direction:?}: {mean} {square}"
                );
                for lag in [5, 10, 15, 20] {
                    let pairs = values.iter().zip(&values[lag..]);
                    let correlation = pairs.map(|(p, q)| (p - mean) * (q - mean)).sum::<f64>() / (n * square);
                    let exact = (-(lag as f64 * 0.1).powi(2)).exp();
                    assert!(
                        (correlation - exact).abs() < 0.05,
                        "{seed} {direction:?} {lag}: {correlation} {exact}"
                    );
                }
            }
        }
    }

    /// Claim: values at one place over many seeds are Gaussian: mean, variance and fourth moment.
    #[test]
    fn seeds_differ_and_their_values_are_gaussian() {
        let values: Vec<f64> =
            (0..20_000).map(|seed| RandomField::new(seed, 1.0).at(0.2, -0.7, 0.1)).collect();
        let moment = |k: i32| values.iter().map(|v| v.powi(k)).sum::<f64>() / values.len() as f64;
        assert!(moment(1).abs() < 0.03 && (moment(2) - 1.0).abs() < 0.05 && (moment(4) - 3.0).abs() < 0.25);
    }
}

//! ∫ ds/w³ over parts of an interval whose normal jump is a polynomial, with its derivatives.

use super::interval::Polynomial;

/// Gauss points and weights on −1 to 1, eight of them.
const GAUSS_8: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_27],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];
/// An aperture changes at most by this factor over the points.
const RATIO: f64 = 1.5;
/// Most halvings of a part.
const HALVINGS: usize = 60;

/// An integral, and its derivatives by the normal jumps of the interval's law points.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Resistance {
    pub value: f64,
    pub by_jump: [f64; 3],
}

impl Resistance {
    pub fn add(&mut self, other: &Resistance) {
        self.value += other.value;
        self.by_jump.iter_mut().zip(other.by_jump).for_each(|(sum, slope)| *sum += slope);
    }
}

/// ∫ dξ/w³ from one place of an interval to another, ξ from 0 to 1.
pub(super) fn between(jump: &Polynomial, touching: f64, from: f64, to: f64) -> Resistance {
    let mut sum = Resistance::default();
    let mut start = from;
    let mut parts = |end: f64| {
        if end > start {
            sum.add(&part(jump, touching, start, end));
            start = end;
        }
    };
    jump.breaks().into_iter().flatten().filter(|at| *at > from && *at < to).for_each(&mut parts);
    parts(to);
    sum
}

/// The same where the jump keeps its sign and does not turn.
fn part(jump: &Polynomial, touching: f64, from: f64, to: f64) -> Resistance {
    let length = to - from;
    if jump.at(0.5 * (from + to)) <= 0.0 {
        return Resistance { value: length / touching.powi(3), by_jump: [0.0; 3] };
    }
    let w = |at: f64| touching + jump.at(at).max(0.0);
    if jump.is_of_two() {
        let (a, b) = (w(from), w(to));
        let slope = |a: f64, b: f64| -length * (a + 2.0 * b) / (2.0 * a.powi(3) * b * b);
        let (by_a, by_b) = (slope(a, b), slope(b, a));
        let (at_a, at_b) = (jump.functions(from), jump.functions(to));
        return Resistance {
            value: length * (a + b) / (2.0 * a * a * b * b),
            by_jump: [0, 1, 2].map(|j| by_a * at_a[j] + by_b * at_b[j]),
        };
    }
    let mut sum = Resistance::default();
    let mut todo = vec![(from, to, 0)];
    while let Some((from, to, depth)) = todo.pop() {
        let (a, b) = (w(from), w(to));
        if a.max(b) > RATIO * a.min(b) && depth < HALVINGS {
            let middle = 0.5 * (from + to);
            todo.extend([(from, middle, depth + 1), (middle, to, depth + 1)]);
            continue;
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        for [xi, weight] in GAUSS_8.iter().flat_map(|&[xi, weight]| [[-xi, weight], [xi, weight]]) {
            let at = middle + half * xi;
            let (w, functions) = (w(at), jump.functions(at));
            let per_cube = half * weight / w.powi(3);
            sum.value += per_cube;
            (0..3).for_each(|j| sum.by_jump[j] -= 3.0 * per_cube / w * functions[j]);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::interval::Polynomial;
    use super::*;

    /// ∫ dξ/w³ by a million trapezoids.
    fn by_brute_force(jump: &Polynomial, touching: f64, [from, to]: [f64; 2]) -> f64 {
        let n = 1_000_000;
        let w = |k: usize| touching + jump.at(from + (to - from) * (k as f64 + 0.5) / n as f64).max(0.0);
        (0..n).map(|k| w(k).powi(-3)).sum::<f64>() * (to - from) / n as f64
    }

    #[test]
    fn integrals_are_those_of_a_million_trapezoids_and_slopes_those_of_differences() {
        let gauss_2 = [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()];
        let gauss_3 = [0.5 - 0.5 * 0.6f64.sqrt(), 0.5, 0.5 + 0.5 * 0.6f64.sqrt()];
        for (places, jumps, touching) in [
            (&gauss_2[..], &[0.2, 0.7][..], 0.1),
            (&gauss_2[..], &[-0.2, 0.7][..], 0.1),
            (&gauss_2[..], &[0.9, -0.7][..], 0.3),
            (&gauss_2[..], &[-0.9, -0.7][..], 0.3),
            (&gauss_2[..], &[0.4, 0.4][..], 0.3),
            (&gauss_3[..], &[0.4, 0.9, 0.3][..], 0.3),
            (&gauss_3[..], &[-0.1, 0.9, -0.3][..], 0.3),
            (&gauss_3[..], &[0.3, -0.1, 0.5][..], 0.2),
            (&gauss_3[..], &[-0.3, -0.1, -0.5][..], 0.2),
            (&gauss_3[..], &[0.1, 0.2, 0.3][..], 0.02),
        ] {
            for ends in [[0.0, 1.0], [0.15, 0.6]] {
                let at = |jumps: &[f64]| between(&Polynomial::new(places, jumps), touching, ends[0], ends[1]);
                let found = at(jumps);
                let exact = by_brute_force(&Polynomial::new(places, jumps), touching, ends);
                assert!((found.value - exact).abs() < 1e-9 * exact, "{jumps:?} {ends:?}: {found:?}, {exact}");
                for j in 0..jumps.len() {
                    let moved = |by: f64| {
                        let mut jumps = jumps.to_vec();
                        jumps[j] += by;
                        at(&jumps).value
                    };
                    let differences = (moved(1e-6) - moved(-1e-6)) / 2e-6;
                    let error = (found.by_jump[j] - differences).abs();
                    assert!(error < 1e-7 * exact / touching, "{jumps:?} {j}: {found:?}, {differences}");
                }
            }
        }
    }

    #[test]
    fn an_aperture_of_a_millionth_beside_an_open_crack_is_no_trouble() {
        // a wedge from 1e-6 to 1: ∫ = (1/a² − 1/b²)/(2 (b − a)); on three points it is the same polynomial
        let (a, b) = (1e-6, 1.0);
        let exact = (1.0 / (a * a) - 1.0 / (b * b)) / (2.0 * (b - a));
        for places in [&[0.2, 0.8][..], &[0.1, 0.5, 0.9][..]] {
            let jumps: Vec<f64> = places.iter().map(|xi| (b - a) * xi).collect();
            let found = between(&Polynomial::new(places, &jumps), a, 0.0, 1.0).value;
            assert!((found / exact - 1.0).abs() < 1e-11, "{places:?}: {found}, {exact}");
        }
    }
}

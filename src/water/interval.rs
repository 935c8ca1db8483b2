//! An interval of C: the normal jumps at its law points are a polynomial along it.

/// Coefficients above this part of the largest jump make a parabola.
const STRAIGHT: f64 = 1e-13;

/// An interval of C with its law points in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Interval {
    /// Its length along C [length].
    pub length: f64,
    /// Number of its first law point in the interface.
    pub first: usize,
    /// Places of its law points, from 0 at its start to 1 at its end; at most three.
    pub places: Vec<f64>,
}

/// The normal jump along an interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct Polynomial {
    /// c₀ + c₁ ξ + c₂ ξ².
    coefficients: [f64; 3],
    /// Lagrange functions of the law points, alike.
    functions: [[f64; 3]; 3],
    linear: bool,
    /// Its functions are linear too.
    of_two: bool,
}

impl Polynomial {
    /// Through the jumps at one to three places.
    pub fn new(places: &[f64], jumps: &[f64]) -> Polynomial {
        let mut functions = [[0.0; 3]; 3];
        for (j, own) in functions.iter_mut().enumerate().take(places.len()) {
            own[0] = 1.0;
            for (_, place) in places.iter().enumerate().filter(|(k, _)| *k != j) {
                let scale = 1.0 / (places[j] - place);
                *own = [
                    -own[0] * place * scale,
                    (own[0] - own[1] * place) * scale,
                    (own[1] - own[2] * place) * scale,
                ];
            }
        }
        let mut coefficients = [0.0; 3];
        for (own, jump) in functions.iter().zip(jumps) {
            (0..3).for_each(|d| coefficients[d] += own[d] * jump);
        }
        let largest = jumps.iter().map(|jump| jump.abs()).fold(0.0, f64::max);
        let linear = coefficients[2].abs() <= STRAIGHT * largest;
        if linear {
            coefficients[2] = 0.0;
        }
        Polynomial { coefficients, functions, linear, of_two: places.len() <= 2 }
    }

    pub fn at(&self, xi: f64) -> f64 {
        let [a, b, c] = self.coefficients;
        a + xi * (b + xi * c)
    }

    /// Values of the functions of the law points.
    pub fn functions(&self, xi: f64) -> [f64; 3] {
        self.functions.map(|[a, b, c]| a + xi * (b + xi * c))
    }

    /// True if it is linear whatever the jumps.
    pub fn is_of_two(&self) -> bool {
        self.of_two
    }

    /// Places where the jump changes its sign or turns, ascending.
    pub fn breaks(&self) -> [Option<f64>; 3] {
        let [a, b, c] = self.coefficients;
        if self.linear {
            return [(b != 0.0).then(|| -a / b), None, None];
        }
        let turn = -0.5 * b / c;
        let square = b * b - 4.0 * a * c;
        if square <= 0.0 {
            return [Some(turn), None, None];
        }
        let q = -0.5 * (b + square.sqrt().copysign(b));
        let roots = [q / c, if q == 0.0 { turn } else { a / q }];
        [Some(roots[0].min(roots[1])), Some(turn), Some(roots[0].max(roots[1]))]
    }
}

//! A symmetric sparse matrix: the values on a pattern.

use super::Pattern;

/// Values of the lower triangle, one per entry of a pattern.
#[derive(Debug, Clone)]
pub struct Symmetric {
    /// Values in the order of the pattern's rows.
    pub values: Vec<f64>,
}

impl Symmetric {
    /// All zero.
    pub fn zero(pattern: &Pattern) -> Symmetric {
        Symmetric { values: vec![0.0; pattern.rows.len()] }
    }

    /// y += A x for a matrix that no translation strains: every row of blocks sums to zero, Σ_j A_ij = 0. Taken from
    /// differences, Σ_j A_ij (x_j − x_i), so that a body that moves as a whole makes no force by rounding.
    pub fn add_product_by_differences(&self, pattern: &Pattern, x: &[f64], y: &mut [f64]) {
        self.visit_differences(pattern, x, |i, force| y[i] += force);
    }

    /// y_i += Σ_j |A_ij (x_j − x_i)|
    pub fn add_absolute_product_by_differences(&self, pattern: &Pattern, x: &[f64], y: &mut [f64]) {
        self.visit_differences(pattern, x, |i, force| y[i] += force.abs());
    }

    #[inline]
    fn visit_differences(&self, pattern: &Pattern, x: &[f64], mut entry: impl FnMut(usize, f64)) {
        let c = pattern.components();
        for j in 0..pattern.nodes() {
            for (k, &i) in pattern.neighbours(j).iter().enumerate().skip(1) {
                let i = i as usize;
                for b in 0..c {
                    let at = pattern.offsets[c * j + b] as usize + c * k - b;
                    for (a, value) in self.values[at..at + c].iter().enumerate() {
                        entry(c * i + a, value * (x[c * j + b] - x[c * i + b]));
                        entry(c * j + b, value * (x[c * i + a] - x[c * j + a]));
                    }
                }
            }
        }
    }

    /// y += |A| |x|
    pub fn add_absolute_product(&self, pattern: &Pattern, x: &[f64], y: &mut [f64]) {
        self.visit(pattern, |i, j, value| {
            y[i] += (value * x[j]).abs();
            if i != j {
                y[j] += (value * x[i]).abs();
            }
        });
    }

    /// Rows and columns of `held` dofs replaced by their diagonal, so that the rest is positive definite alone. Returns
    /// what `release` puts back.
    pub fn hold(&mut self, pattern: &Pattern, constrained: &[bool]) -> Vec<(usize, f64)> {
        let mut taken = Vec::new();
        for j in 0..pattern.size() {
            for at in pattern.column(j) {
                let i = pattern.rows[at] as usize;
                if i != j && (constrained[i] || constrained[j]) {
                    taken.push((at, std::mem::take(&mut self.values[at])));
                }
            }
        }
        taken
    }

    /// Undoes `hold`.
    pub fn release(&mut self, taken: &[(usize, f64)]) {
        for &(at, value) in taken {
            self.values[at] = value;
        }
    }

    #[inline]
    fn visit(&self, pattern: &Pattern, mut entry: impl FnMut(usize, usize, f64)) {
        for j in 0..pattern.size() {
            let range = pattern.column(j);
            for (&i, &value) in pattern.rows[range.clone()].iter().zip(&self.values[range]) {
                entry(i as usize, j, value);
            }
        }
    }
}

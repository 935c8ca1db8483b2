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

    /// y += A x
    pub fn add_product(&self, pattern: &Pattern, x: &[f64], y: &mut [f64]) {
        self.visit(pattern, |i, j, value| {
            y[i] += value * x[j];
            if i != j {
                y[j] += value * x[i];
            }
        });
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

    /// Rows and columns of `held` dofs replaced by their diagonal, so that the rest is positive definite alone.
    pub fn hold(&mut self, pattern: &Pattern, held: &[bool]) {
        for j in 0..pattern.size() {
            let range = pattern.offsets[j]..pattern.offsets[j + 1];
            for (&i, value) in pattern.rows[range.clone()].iter().zip(&mut self.values[range]) {
                if i != j && (held[i] || held[j]) {
                    *value = 0.0;
                }
            }
        }
    }

    #[inline]
    fn visit(&self, pattern: &Pattern, mut entry: impl FnMut(usize, usize, f64)) {
        for j in 0..pattern.size() {
            let range = pattern.offsets[j]..pattern.offsets[j + 1];
            for (&i, &value) in pattern.rows[range.clone()].iter().zip(&self.values[range]) {
                entry(i, j, value);
            }
        }
    }
}

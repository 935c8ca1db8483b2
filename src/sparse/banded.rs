//! Cholesky of a small banded mass matrix, solved column by column where the right-hand side is sparse.
//!
//! M⁻¹ of a 1D mass matrix decays by 0.27 (linear) or 0.41 (quadratic) per grid node, so a column of M⁻¹ B is followed
//! only as far as it differs from zero.

/// Entries below this, relative to the largest of their column, are zero.
const DECAYED: f64 = 1e-18;

/// L of M = L Lᵀ with `width` sub-diagonals: row i holds L[i, i − width ..= i].
#[derive(Debug)]
pub struct Banded {
    width: usize,
    rows: Vec<f64>,
}

impl Banded {
    /// Factors M, given by rows like L: entry (i, j) at `i · (width + 1) + width + j − i`.
    pub fn factor(width: usize, mut rows: Vec<f64>) -> Banded {
        let stride = width + 1;
        let n = rows.len() / stride;
        for i in 0..n {
            for j in i.saturating_sub(width)..=i {
                let first = i.saturating_sub(width).max(j.saturating_sub(width));
                let mut sum = rows[i * stride + width + j - i];
                for k in first..j {
                    sum -= rows[i * stride + width + k - i] * rows[j * stride + width + k - j];
                }
                rows[i * stride + width + j - i] =
                    if i == j { sum.sqrt() } else { sum / rows[j * stride + width] };
            }
        }
        Banded { width, rows }
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        self.rows[i * (self.width + 1) + self.width + j - i]
    }

    /// Solves M x = b in place. `b` is zero outside `first..last` on entry; returns the range outside which x has
    /// decayed to zero. What lies outside is left at zero.
    pub fn solve(&self, b: &mut [f64], first: usize, last: usize) -> std::ops::Range<usize> {
        let n = b.len();
        let mut largest = 0.0_f64;
        let mut end = n;
        for i in first..n {
            for k in i.saturating_sub(self.width).max(first)..i {
                b[i] -= self.entry(i, k) * b[k];
            }
            b[i] /= self.entry(i, i);
            largest = largest.max(b[i].abs());
            let decayed = |k: usize| b[k].abs() <= DECAYED * largest;
            if i >= last + self.width && (i - self.width..=i).all(decayed) {
                end = i + 1;
                break;
            }
        }
        largest = 0.0;
        let mut start = 0;
        for i in (0..end).rev() {
            for k in i + 1..(i + self.width + 1).min(end) {
                b[i] -= self.entry(k, i) * b[k];
            }
            b[i] /= self.entry(i, i);
            largest = largest.max(b[i].abs());
            let decayed = |k: usize| b[k].abs() <= DECAYED * largest;
            if i < first && i + self.width < end && (i..=i + self.width).all(decayed) {
                start = i;
                break;
            }
        }
        start..end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sparse_column_is_solved_to_round_off() {
        // M = tridiagonal (1, 4, 1), n = 200: the residual of every column must vanish
        let n = 200;
        let rows: Vec<f64> = (0..n).flat_map(|i| [if i > 0 { 1.0 } else { 0.0 }, 4.0]).collect();
        let factor = Banded::factor(1, rows);
        for column in [0, 1, 100, 199] {
            let mut x = vec![0.0; n];
            x[column] = 3.0;
            let range = factor.solve(&mut x, column, column + 1);
            assert!(range.len() <= 80);
            for i in 0..n {
                let mut r = 4.0 * x[i] - if i == column { 3.0 } else { 0.0 };
                r += if i > 0 { x[i - 1] } else { 0.0 } + if i + 1 < n { x[i + 1] } else { 0.0 };
                assert!(r.abs() < 1e-15, "column {column}, row {i}: {r:e}");
            }
        }
    }
}

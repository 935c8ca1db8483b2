//! A sparse matrix in compressed rows.

/// Rows of (column, value), columns ascending within a row.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Csr {
    /// Start of every row, one more entry than rows.
    pub offsets: Vec<usize>,
    /// Column of every entry.
    pub columns: Vec<usize>,
    /// Value of every entry.
    pub values: Vec<f64>,
    /// Number of columns.
    pub width: usize,
}

impl Csr {
    /// Sums entries (row, column, value) given in any order.
    pub fn from_triplets(rows: usize, width: usize, triplets: &[(usize, usize, f64)]) -> Csr {
        let mut sorted: Vec<(usize, usize, f64)> = triplets.to_vec();
        sorted.sort_by_key(|&(i, j, _)| (i, j)); // stable: equal places are summed in the order given
        let mut csr = Csr { offsets: vec![0; rows + 1], width, ..Csr::default() };
        let mut last = None;
        for (i, j, value) in sorted {
            if last == Some((i, j)) {
                let end = csr.values.len() - 1;
                csr.values[end] += value;
            } else {
                csr.columns.push(j);
                csr.values.push(value);
                csr.offsets[i + 1] += 1;
                last = Some((i, j));
            }
        }
        for i in 0..rows {
            csr.offsets[i + 1] += csr.offsets[i];
        }
        csr
    }

    /// Matrices of one width, one below the other.
    pub fn stacked(matrices: &[Csr]) -> Csr {
        let width = matrices.first().map_or(0, |first| first.width);
        let mut all = Csr { offsets: vec![0], width, ..Csr::default() };
        for matrix in matrices {
            let end = all.columns.len();
            all.offsets.extend(matrix.offsets[1..].iter().map(|offset| end + offset));
            all.columns.extend_from_slice(&matrix.columns);
            all.values.extend_from_slice(&matrix.values);
        }
        all
    }

    /// The matrix without the entries that `keep`, asked with row and value, does not want.
    pub fn retain(mut self, keep: impl Fn(usize, f64) -> bool) -> Csr {
        let mut kept = 0;
        for i in 0..self.rows() {
            let range = self.offsets[i]..self.offsets[i + 1];
            self.offsets[i] = kept;
            for k in range {
                if keep(i, self.values[k]) {
                    (self.columns[kept], self.values[kept]) = (self.columns[k], self.values[k]);
                    kept += 1;
                }
            }
        }
        let rows = self.rows();
        self.offsets[rows] = kept;
        self.columns.truncate(kept);
        self.values.truncate(kept);
        self
    }

    /// Entries a − b on this pattern without those that are zero.
    pub fn less(&self, a: &[f64], b: &[f64]) -> Csr {
        let mut change = Csr { offsets: vec![0], width: self.width, ..Csr::default() };
        for i in 0..self.rows() {
            for k in (self.offsets[i]..self.offsets[i + 1]).filter(|&k| a[k] != b[k]) {
                change.columns.push(self.columns[k]);
                change.values.push(a[k] - b[k]);
            }
            change.offsets.push(change.columns.len());
        }
        change
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Columns and values of row `i`.
    pub fn row(&self, i: usize) -> (&[usize], &[f64]) {
        let range = self.offsets[i]..self.offsets[i + 1];
        (&self.columns[range.clone()], &self.values[range])
    }

    /// y = A x
    pub fn multiply(&self, x: &[f64]) -> Vec<f64> {
        (0..self.rows())
            .map(|i| {
                let (columns, values) = self.row(i);
                columns.iter().zip(values).map(|(&j, v)| v * x[j]).sum()
            })
            .collect()
    }

    /// y += Aᵀ x
    pub fn add_transposed(&self, x: &[f64], y: &mut [f64]) {
        for i in 0..self.rows() {
            let (columns, values) = self.row(i);
            for (&j, v) in columns.iter().zip(values) {
                y[j] += v * x[i];
            }
        }
    }

    /// A B, row by row.
    pub fn product(&self, b: &Csr) -> Csr {
        let mut result = Csr { offsets: vec![0], width: b.width, ..Csr::default() };
        let mut row: Vec<(usize, f64)> = Vec::new();
        for i in 0..self.rows() {
            row.clear();
            let (columns, values) = self.row(i);
            for (&k, &value) in columns.iter().zip(values) {
                let (b_columns, b_values) = b.row(k);
                row.extend(b_columns.iter().zip(b_values).map(|(&j, b)| (j, value * b)));
            }
            row.sort_by_key(|&(j, _)| j);
            for &(j, value) in &row {
                if result.columns.len() > result.offsets[i] && result.columns[result.columns.len() - 1] == j {
                    let end = result.values.len() - 1;
                    result.values[end] += value;
                } else {
                    result.columns.push(j);
                    result.values.push(value);
                }
            }
            result.offsets.push(result.columns.len());
        }
        result
    }

    /// The transposed matrix.
    pub fn transposed(&self) -> Csr {
        let mut offsets = vec![0; self.width + 1];
        for &j in &self.columns {
            offsets[j + 1] += 1;
        }
        for j in 0..self.width {
            offsets[j + 1] += offsets[j];
        }
        let (mut columns, mut values) = (vec![0; self.columns.len()], vec![0.0; self.values.len()]);
        let mut next = offsets.clone();
        for i in 0..self.rows() {
            let (row, entries) = self.row(i);
            for (&j, &value) in row.iter().zip(entries) {
                (columns[next[j]], values[next[j]]) = (i, value);
                next[j] += 1;
            }
        }
        Csr { offsets, columns, values, width: self.rows() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triplets_are_summed_and_products_agree_with_the_transposed() {
        let a = Csr::from_triplets(2, 3, &[(1, 2, 4.0), (0, 1, 1.0), (1, 0, 3.0), (0, 1, 1.0)]);
        assert_eq!(a.multiply(&[1.0, 10.0, 100.0]), [20.0, 403.0]);
        let mut y = [0.0; 3];
        a.add_transposed(&[1.0, 10.0], &mut y);
        assert_eq!(y, [30.0, 2.0, 40.0]);
        assert_eq!(a.transposed().multiply(&[1.0, 10.0]), y);
        let twice = Csr::stacked(&[a.clone(), a]);
        assert_eq!(twice.multiply(&[1.0, 10.0, 100.0]), [20.0, 403.0, 20.0, 403.0]);
        assert_eq!(twice.transposed().multiply(&[1.0, 0.0, 0.0, 10.0]), y);
    }
}

//! One part of a matrix with the separator it touches: its factor, what it adds to the separator, and both substitutions.
//!
//! ```text
//!   [A Bᵀ; B C] = [L 0; M N] [L 0; M N]ᵀ      A = L Lᵀ      M = B L⁻ᵀ      N Nᵀ − C = −B A⁻¹ Bᵀ
//! ```

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Accum, Mat, MatMut, MatRef, Par};

use super::graph::Graph;
use super::{NotPositiveDefinite, Symbolic};
use crate::assembly::{Pattern, Symmetric};

/// A part with its separator.
#[derive(Debug)]
pub(super) struct Part {
    /// [Aₚ Bₚᵀ; Bₚ C], the separator last.
    pub(super) block: Submatrix,
    /// Number of dofs before those of the separator.
    pub(super) inner: usize,
    /// Place of its separator dofs in the whole separator.
    pub(super) separator: Vec<u32>,
    pub(super) plan: Symbolic,
}

/// The lower triangle of a principal submatrix.
#[derive(Debug)]
pub(super) struct Submatrix {
    /// Its dofs in the whole matrix.
    pub(super) dofs: Vec<u32>,
    pub(super) offsets: Vec<u32>,
    pub(super) rows: Vec<u32>,
    /// Place of every entry in the values of the whole matrix.
    pub(super) source: Vec<u32>,
}

impl Submatrix {
    /// The submatrix of the dofs of some nodes; `local` is the place of a node among them.
    pub(super) fn new(
        pattern: &Pattern,
        graph: &Graph,
        nodes: &[u32],
        local: impl Fn(u32) -> Option<u32>,
    ) -> Submatrix {
        let c = pattern.components() as u32;
        let dofs = nodes.iter().flat_map(|&node| c * node..c * (node + 1)).collect();
        let (mut offsets, mut rows, mut source) = (vec![0], Vec::new(), Vec::new());
        let mut below = Vec::new();
        for (k, &node) in (0..).zip(nodes) {
            below.clear();
            below.push((k, node));
            below.extend(
                graph
                    .of(node)
                    .iter()
                    .filter_map(|&other| Some((local(other)?, other)))
                    .filter(|(i, _)| *i > k),
            );
            below.sort_unstable();
            for b in 0..c as usize {
                for &(i, other) in &below {
                    let at = pattern.block(other.max(node) as usize, other.min(node) as usize);
                    for a in if i == k { b } else { 0 }..c as usize {
                        rows.push(c * i + a as u32);
                        source.push((if other >= node { at[b] + a } else { at[a] + b }) as u32);
                    }
                }
                offsets.push(rows.len() as u32);
            }
        }
        Submatrix { dofs, offsets, rows, source }
    }

    /// Visits the entries of the columns from one on, as (row, column, value).
    pub(super) fn visit(&self, matrix: &Symmetric, from: usize, mut entry: impl FnMut(usize, usize, f64)) {
        for j in from..self.dofs.len() {
            for at in self.offsets[j] as usize..self.offsets[j + 1] as usize {
                entry(self.rows[at] as usize, j, matrix.values[self.source[at] as usize]);
            }
        }
    }
}

impl Part {
    /// L and −B A⁻¹ Bᵀ. With `lifted` the diagonal of C is doubled on the way, which changes neither: the part need not
    /// be positive definite as a whole then, only without its separator.
    pub(super) fn factor(
        &self,
        matrix: &Symmetric,
        lifted: bool,
    ) -> Result<(Vec<f64>, Mat<f64>), NotPositiveDefinite> {
        let mut entries: Vec<f64> = self.block.source.iter().map(|&at| matrix.values[at as usize]).collect();
        let lift: Vec<f64> = (self.inner..self.block.dofs.len())
            .map(|j| {
                let diagonal = &mut entries[self.block.offsets[j] as usize];
                let lift = if lifted { *diagonal } else { 0.0 };
                *diagonal += lift;
                lift
            })
            .collect();
        let values = self.plan.factor_values(&self.block.offsets, &self.block.rows, &entries)?;
        drop(entries);
        let m = self.separator.len();
        let mut l = Mat::zeros(m, m);
        for (start, columns, below) in self.plan.supernodes(&values) {
            let width = columns.ncols();
            for j in self.inner.saturating_sub(start)..width {
                for i in j..columns.nrows() {
                    let row = if i < width { start + i } else { below[i - width] as usize };
                    l[(row - self.inner, start + j - self.inner)] = columns[(i, j)];
                }
            }
        }
        let mut s = Mat::zeros(m, m);
        triangular::matmul(
            &mut s,
            BlockStructure::TriangularLower,
            Accum::Replace,
            &l,
            BlockStructure::TriangularLower,
            l.transpose(),
            BlockStructure::TriangularUpper,
            1.0,
            Par::Seq,
        );
        self.block.visit(matrix, self.inner, |i, j, value| s[(i - self.inner, j - self.inner)] -= value);
        lift.iter().enumerate().for_each(|(j, lift)| s[(j, j)] -= lift);
        Ok((values, s))
    }

    /// The part's own columns of L by supernodes: the first, the triangle, what is below it and the rows of that.
    fn own<'a>(&'a self, values: &'a [f64]) -> impl DoubleEndedIterator<Item = Own<'a>> {
        self.plan.supernodes(values).filter(|(start, ..)| *start < self.inner).map(|(start, l, below)| {
            let width = l.ncols().min(self.inner - start);
            let rows = (start + width..start + l.ncols()).chain(below.iter().map(|&row| row as usize));
            let (triangle, rest) = l.subcols(0, width).split_at_row(width);
            Own { start, triangle, rest, rows: rows.collect() }
        })
    }

    /// L y = b through the part's own columns, for one right-hand side a column.
    pub(super) fn forward(&self, values: &[f64], mut y: MatMut<f64>) {
        let count = y.ncols();
        let mut sums = vec![0.0; y.nrows() * count];
        for Own { start, triangle, rest, rows } in self.own(values) {
            let mut x = y.as_mut().subrows_mut(start, triangle.ncols());
            solve_lower_triangular_in_place(triangle, x.as_mut(), Par::Seq);
            let mut sums =
                MatMut::from_column_major_slice_mut(&mut sums[..rows.len() * count], rows.len(), count);
            matmul(sums.as_mut(), Accum::Replace, rest, x.as_ref(), 1.0, Par::Seq);
            for k in 0..count {
                rows.iter().enumerate().for_each(|(i, &row)| y[(row, k)] -= sums[(i, k)]);
            }
        }
    }

    /// Lᵀ x = y through the part's own columns, for one right-hand side a column.
    pub(super) fn backward(&self, values: &[f64], mut y: MatMut<f64>) {
        let count = y.ncols();
        let mut below = vec![0.0; y.nrows() * count];
        for Own { start, triangle, rest, rows } in self.own(values).rev() {
            let mut below =
                MatMut::from_column_major_slice_mut(&mut below[..rows.len() * count], rows.len(), count);
            for k in 0..count {
                rows.iter().enumerate().for_each(|(i, &row)| below[(i, k)] = y[(row, k)]);
            }
            let mut x = y.as_mut().subrows_mut(start, triangle.ncols());
            matmul(x.as_mut(), Accum::Add, rest.transpose(), below, -1.0, Par::Seq);
            solve_upper_triangular_in_place(triangle.transpose(), x, Par::Seq);
        }
    }
}

/// Columns of L in one supernode.
struct Own<'a> {
    start: usize,
    triangle: MatRef<'a, f64>,
    rest: MatRef<'a, f64>,
    rows: Vec<usize>,
}

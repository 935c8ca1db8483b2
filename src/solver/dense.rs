//! Dense factors with faer: Cholesky and LU with row exchanges.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt;
use faer::linalg::lu::partial_pivoting as lu;
use faer::perm::PermRef;
use faer::{Mat, MatMut, Par};

use super::NotPositiveDefinite;

/// Larger matrices are worked on by all threads.
const PARALLEL: usize = 256;

/// Threads for a matrix of this size; depends on nothing else, so that a run repeats bit by bit.
pub(super) fn parallelism(size: usize) -> Par {
    if size > PARALLEL { Par::rayon(0) } else { Par::Seq }
}

/// A vector as a matrix of one column.
pub(super) fn column_mut(x: &mut [f64]) -> MatMut<'_, f64> {
    let n = x.len();
    MatMut::from_column_major_slice_mut(x, n, 1)
}

/// Clears row and column k of a lower triangle but for the diagonal, so that equation k stands alone.
pub(super) fn detach(s: &mut Mat<f64>, k: usize) {
    (0..k).for_each(|j| s[(k, j)] = 0.0);
    (k + 1..s.nrows()).for_each(|i| s[(i, k)] = 0.0);
}

/// L of a positive definite matrix, in place of its lower triangle.
pub(super) fn cholesky(s: &mut Mat<f64>, par: Par) -> Result<(), NotPositiveDefinite> {
    let scratch = llt::factor::cholesky_in_place_scratch::<f64>(s.nrows(), par, Default::default());
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    llt::factor::cholesky_in_place(s.as_mut(), Default::default(), par, stack, Default::default())
        .map(|_| ())
        .map_err(|_| NotPositiveDefinite)
}

/// Solves L Lᵀ X = B in place, one right-hand side a column.
pub(super) fn cholesky_solve(l: &Mat<f64>, b: MatMut<f64>) {
    let scratch = llt::solve::solve_in_place_scratch::<f64>(b.nrows(), b.ncols(), Par::Seq);
    llt::solve::solve_in_place(l.as_ref(), b, Par::Seq, MemStack::new(&mut MemBuffer::new(scratch)));
}

/// P A = L U.
#[derive(Debug)]
pub(super) struct Lu {
    factors: Mat<f64>,
    rows: Vec<usize>,
    rows_back: Vec<usize>,
}

impl Lu {
    /// Factors a square matrix.
    pub(super) fn new(mut matrix: Mat<f64>) -> Lu {
        let n = matrix.nrows();
        let par = parallelism(n);
        let (mut rows, mut rows_back) = (vec![0; n], vec![0; n]);
        let scratch = lu::factor::lu_in_place_scratch::<usize, f64>(n, n, par, Default::default());
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        let (a, spec) = (matrix.as_mut(), Default::default());
        lu::factor::lu_in_place(a, &mut rows, &mut rows_back, par, stack, spec);
        Lu { factors: matrix, rows, rows_back }
    }

    /// Solves A x = b in place.
    pub(super) fn solve(&self, b: &mut [f64]) {
        self.solve_with(column_mut(b), Par::Seq);
    }

    /// Solves A X = B in place, one right-hand side a column.
    pub(super) fn solve_many(&self, b: MatMut<f64>) {
        let par = parallelism(b.ncols());
        self.solve_with(b, par);
    }

    fn solve_with(&self, b: MatMut<f64>, par: Par) {
        let (n, count) = (b.nrows(), b.ncols());
        let mut memory = MemBuffer::new(lu::solve::solve_in_place_scratch::<usize, f64>(n, count, par));
        let order = PermRef::new_checked(&self.rows, &self.rows_back, n);
        let (factors, stack) = (self.factors.as_ref(), MemStack::new(&mut memory));
        lu::solve::solve_in_place(factors, factors, order, b, par, stack);
    }
}

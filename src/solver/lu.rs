//! LU of sparse matrices that need not be symmetric: places analysed once, values often.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};

use super::dense::column_mut;

/// The factors of a matrix whose entries keep their places.
#[derive(Debug, Default)]
pub(super) struct SparseLu {
    plan: Option<(SymbolicSparseColMat<usize>, Argsort<usize>, SymbolicLu<usize>)>,
    factor: Option<Lu<usize, f64>>,
}

impl SparseLu {
    /// True if the places of the entries are known.
    pub(super) fn is_planned(&self) -> bool {
        self.plan.is_some()
    }

    /// Analyses the places (row, column) of the entries of a square matrix; entries at one place are summed.
    pub(super) fn plan(&mut self, size: usize, places: impl Iterator<Item = (usize, usize)>) {
        let places: Vec<Pair<usize, usize>> = places.map(|(row, col)| Pair { row, col }).collect();
        let made = SymbolicSparseColMat::try_new_from_indices(size, size, &places);
        self.plan = made.ok().and_then(|(pattern, order)| {
            let symbolic = SymbolicLu::try_new(pattern.as_ref()).ok()?;
            Some((pattern, order, symbolic))
        });
    }

    /// Factors the matrix with these values, in the order of the places; false if that cannot be done.
    pub(super) fn factor(&mut self, values: &[f64]) -> bool {
        let Some((pattern, order, symbolic)) = &self.plan else { return false };
        let matrix = SparseColMat::new_from_argsort(pattern.clone(), order, values);
        self.factor =
            matrix.ok().and_then(|matrix| Lu::try_new_with_symbolic(symbolic.clone(), matrix.as_ref()).ok());
        self.factor.is_some()
    }

    /// A⁻¹ b in place; b as it is without a factor.
    pub(super) fn solve(&self, b: &mut [f64]) {
        if let Some(factor) = &self.factor {
            factor.solve_in_place(column_mut(b));
        }
    }
}

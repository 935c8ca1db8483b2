//! Sparse Cholesky with faer: analysed once per pattern, factored once per set of supports.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

use crate::assembly::{Pattern, Symmetric};

/// Below this many unknowns faer may choose its simplicial factorisation.
const SMALL: usize = 1000;

/// The factorisation's plan for one pattern.
#[derive(Debug)]
pub struct Symbolic {
    plan: SymbolicCholesky<usize>,
}

/// L of A = L Lᵀ.
#[derive(Debug)]
pub struct Cholesky<'a> {
    symbolic: &'a Symbolic,
    values: Vec<f64>,
}

/// The matrix is not positive definite in floating point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotPositiveDefinite;

impl Symbolic {
    /// Orders and analyses a pattern.
    pub fn analyse(pattern: &Pattern) -> Result<Symbolic, NotPositiveDefinite> {
        let mut params = CholeskySymbolicParams::default();
        if pattern.size() > SMALL {
            params.supernodal_flop_ratio_threshold = SupernodalThreshold::FORCE_SUPERNODAL;
        }
        let plan =
            factorize_symbolic_cholesky(structure(pattern), Side::Lower, SymmetricOrdering::Amd, params)
                .map_err(|_| NotPositiveDefinite)?;
        Ok(Symbolic { plan })
    }

    /// Number of entries of L, padding of supernodes included.
    pub fn entries(&self) -> usize {
        self.plan.len_val()
    }

    /// Factors a matrix on the pattern that was analysed.
    pub fn factor(&self, pattern: &Pattern, matrix: &Symmetric) -> Result<Cholesky<'_>, NotPositiveDefinite> {
        let a = SparseColMatRef::new(structure(pattern), matrix.values.as_slice());
        let mut values = vec![0.0; self.plan.len_val()];
        let scratch = self.plan.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        self.plan
            .factorize_numeric_llt(
                &mut values,
                a,
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| NotPositiveDefinite)?;
        Ok(Cholesky { symbolic: self, values })
    }
}

impl Cholesky<'_> {
    /// Solves A x = b in place.
    pub fn solve(&self, b: &mut [f64]) {
        let n = b.len();
        let mut memory = MemBuffer::new(self.symbolic.plan.solve_in_place_scratch::<f64>(1, Par::Seq));
        LltRef::new(&self.symbolic.plan, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(b, n, 1),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }
}

fn structure(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let n = pattern.size();
    SymbolicSparseColMatRef::new_checked(n, n, &pattern.offsets, None, &pattern.rows)
}

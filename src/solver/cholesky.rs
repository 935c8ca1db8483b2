//! Sparse Cholesky with faer: analysed once per pattern, factored once per set of supports.
//!
//! This is the factorisation of a small model and of every part of a large one (`parts`): faer walks the subtrees of the
//! elimination tree one after the other, and the fronts of a plane model are too small for threads inside its dense
//! kernels to gain anything.
//!
//! Indices are 32 bits wide, half the memory of the usual ones: a factor has at most 2³¹ entries, which is 17 GB.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, MatRef, Par, Side};

use super::{Order, nested_dissection};
use crate::assembly::{Pattern, Symmetric};

/// Up to this many unknowns the order is AMD and faer chooses between its factorisations.
const SMALL: usize = 1000;
/// Up to this many both orders are made, which costs little, and the better is taken: separators across an interface, whose
/// coupling reaches some thirty nodes along it, weigh more the smaller the model is.
pub(super) const MEDIUM: usize = 50_000;

/// The factorisation's plan for one pattern.
#[derive(Debug)]
pub struct Symbolic {
    plan: SymbolicCholesky<u32>,
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

/// The factor would have more entries than can be numbered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLarge;

impl Symbolic {
    /// Orders and analyses a pattern. `coordinates` are those of its nodes, one node after the other.
    pub fn analyse(pattern: &Pattern, coordinates: &[f64]) -> Result<Symbolic, TooLarge> {
        if pattern.size() <= SMALL {
            return Symbolic::plan(
                structure(pattern),
                SymmetricOrdering::Amd,
                CholeskySymbolicParams::default(),
            );
        }
        let dissected = Symbolic::with_order(pattern, &nested_dissection(pattern, coordinates))?;
        if pattern.size() > MEDIUM {
            return Ok(dissected);
        }
        let other = Symbolic::minimum_degree(pattern)?;
        Ok(if other.operations() < dissected.operations() { other } else { dissected })
    }

    /// Analyses a pattern in a given order.
    pub fn with_order(pattern: &Pattern, order: &Order) -> Result<Symbolic, TooLarge> {
        let order = PermRef::new_checked(&order.forward, &order.inverse, pattern.size());
        Symbolic::plan(structure(pattern), SymmetricOrdering::Custom(order), supernodal())
    }

    /// Analyses a pattern in the order of approximate minimum degree: the yardstick for other orders.
    pub fn minimum_degree(pattern: &Pattern) -> Result<Symbolic, TooLarge> {
        Symbolic::plan(structure(pattern), SymmetricOrdering::Amd, supernodal())
    }

    /// Analyses the lower triangle of a matrix whose order is good as it is.
    pub(super) fn as_is(offsets: &[u32], rows: &[u32]) -> Result<Symbolic, TooLarge> {
        let lower = lower(offsets, rows);
        // faer's own `Identity` would read an upper triangle
        let same: Vec<u32> = (0..lower.ncols() as u32).collect();
        let order = PermRef::new_checked(&same, &same, same.len());
        Symbolic::plan(lower, SymmetricOrdering::Custom(order), supernodal())
    }

    fn plan(
        lower: SymbolicSparseColMatRef<'_, u32>,
        order: SymmetricOrdering<u32>,
        params: CholeskySymbolicParams,
    ) -> Result<Symbolic, TooLarge> {
        let plan = factorize_symbolic_cholesky(lower, Side::Lower, order, params);
        plan.map(|plan| Symbolic { plan }).map_err(|_| TooLarge)
    }

    /// Number of entries of L, padding of supernodes included.
    pub fn entries(&self) -> usize {
        self.plan.len_val()
    }

    /// Memory of a factor and of the work on it [bytes].
    pub fn bytes(&self) -> usize {
        let scratch = self.plan.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        size_of::<f64>() * self.plan.len_val() + scratch.unaligned_bytes_required()
    }

    /// Multiplications and additions of the factorisation.
    pub fn operations(&self) -> f64 {
        let column = |rows: usize| (rows as f64).powi(2);
        match self.plan.raw() {
            SymbolicCholeskyRaw::Simplicial(plan) => {
                plan.col_ptr().windows(2).map(|p| column((p[1] - p[0]) as usize)).sum()
            }
            SymbolicCholeskyRaw::Supernodal(plan) => (0..plan.n_supernodes())
                .map(|s| {
                    let below = plan.supernode(s).pattern().len();
                    let width = (plan.supernode_end()[s] - plan.supernode_begin()[s]) as usize;
                    (1..=width).map(|k| column(below + k)).sum::<f64>()
                })
                .sum(),
        }
    }

    /// Factors a matrix on the pattern that was analysed.
    pub fn factor(&self, pattern: &Pattern, matrix: &Symmetric) -> Result<Cholesky<'_>, NotPositiveDefinite> {
        let values = self.factor_values(&pattern.offsets, &pattern.rows, &matrix.values)?;
        Ok(Cholesky { symbolic: self, values })
    }

    /// Values of L for the lower triangle of a matrix, by columns.
    pub(super) fn factor_values(
        &self,
        offsets: &[u32],
        rows: &[u32],
        entries: &[f64],
    ) -> Result<Vec<f64>, NotPositiveDefinite> {
        let lower = SparseColMatRef::new(lower(offsets, rows), entries);
        let mut values = vec![0.0; self.plan.len_val()];
        let scratch = self.plan.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::new(scratch);
        self.plan
            .factorize_numeric_llt(
                &mut values,
                lower,
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| NotPositiveDefinite)?;
        Ok(values)
    }

    /// Supernodes of L in the order of elimination, each with its first column, its columns and the rows below its
    /// triangle; none in a plan that is not supernodal.
    pub(super) fn supernodes<'a>(
        &'a self,
        values: &'a [f64],
    ) -> impl DoubleEndedIterator<Item = (usize, MatRef<'a, f64>, &'a [u32])> {
        let plan = match self.plan.raw() {
            SymbolicCholeskyRaw::Supernodal(plan) => Some(plan),
            SymbolicCholeskyRaw::Simplicial(_) => None,
        };
        plan.into_iter().flat_map(move |plan| {
            (0..plan.n_supernodes()).map(move |k| {
                let supernode = SupernodalLltRef::new(plan, values).supernode(k);
                (supernode.start(), supernode.val(), supernode.pattern())
            })
        })
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

fn structure(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, u32> {
    lower(&pattern.offsets, &pattern.rows)
}

/// Lower triangle of a matrix by columns.
fn lower<'a>(offsets: &'a [u32], rows: &'a [u32]) -> SymbolicSparseColMatRef<'a, u32> {
    let n = offsets.len() - 1;
    SymbolicSparseColMatRef::new_checked(n, n, offsets, None, rows)
}

fn supernodal() -> CholeskySymbolicParams<'static> {
    let threshold = SupernodalThreshold::FORCE_SUPERNODAL;
    CholeskySymbolicParams { supernodal_flop_ratio_threshold: threshold, ..Default::default() }
}

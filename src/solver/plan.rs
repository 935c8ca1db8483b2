//! Which factorisation a matrix gets: of the whole, or in parts side by side.

use super::cholesky::MEDIUM;
use super::{
    Cholesky, Cut, Method, NotPositiveDefinite, Parts, PartsFactor, Symbolic, TooLarge, nested_dissection,
};
use crate::assembly::{Pattern, Symmetric};

/// The factorisation's plan for one pattern.
#[derive(Debug)]
pub enum FactorPlan {
    /// One factor of the whole matrix.
    Joined(Symbolic),
    /// Parts side by side, then what they share.
    InParts(Parts),
}

/// The factor of a matrix.
#[derive(Debug)]
pub enum Factor<'a> {
    /// Factor of the whole matrix.
    Joined(Cholesky<'a>),
    /// Factors of its parts.
    InParts(PartsFactor<'a>),
}

impl FactorPlan {
    /// Orders and analyses a pattern: a large one in parts where its separator is small. `coordinates` are those of its
    /// nodes, one node after the other.
    pub fn analyse(pattern: &Pattern, coordinates: &[f64]) -> Result<FactorPlan, TooLarge> {
        if pattern.size() <= MEDIUM {
            return Symbolic::analyse(pattern, coordinates).map(FactorPlan::Joined);
        }
        let order = nested_dissection(pattern, coordinates);
        let cut = Cut::new(pattern, &order);
        if cut.pays() {
            return Parts::new(pattern, cut).map(FactorPlan::InParts);
        }
        drop(cut);
        Symbolic::with_order(pattern, &order).map(FactorPlan::Joined)
    }

    /// Way in which it solves.
    pub fn method(&self) -> Method {
        match self {
            FactorPlan::Joined(_) => Method::Joined,
            FactorPlan::InParts(_) => Method::InParts,
        }
    }

    /// Number of entries of the factors.
    pub fn entries(&self) -> usize {
        match self {
            FactorPlan::Joined(plan) => plan.entries(),
            FactorPlan::InParts(plan) => plan.entries(),
        }
    }

    /// Memory of the factors and of the work on them [bytes].
    pub fn bytes(&self) -> usize {
        match self {
            FactorPlan::Joined(plan) => plan.bytes(),
            FactorPlan::InParts(plan) => plan.bytes(),
        }
    }

    /// Factors a matrix on the pattern that was analysed.
    pub fn factor(&self, pattern: &Pattern, matrix: &Symmetric) -> Result<Factor<'_>, NotPositiveDefinite> {
        match self {
            FactorPlan::Joined(plan) => plan.factor(pattern, matrix).map(Factor::Joined),
            FactorPlan::InParts(plan) => plan.factor(matrix).map(Factor::InParts),
        }
    }
}

impl Factor<'_> {
    /// Solves A X = B in place, for several right-hand sides.
    pub fn solve(&self, b: &mut [Vec<f64>]) {
        match self {
            Factor::Joined(factor) => b.iter_mut().for_each(|b| factor.solve(b)),
            Factor::InParts(factor) => factor.solve(b),
        }
    }
}

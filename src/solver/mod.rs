//! Solving K u + Gᵀ q(G u) = f. Knows no mesh and no law by name: it sees matrices, joints and their stiffness.

mod cholesky;
mod linear;

pub use cholesky::{Cholesky, NotPositiveDefinite, Symbolic};
pub use linear::{Linear, Solution, System};

//! Solving K u + Gᵀ q(G u) = f. Knows no mesh and no law by name: it sees matrices, joints and their stiffness.

mod cholesky;
mod graph;
mod linear;
mod ordering;

pub use cholesky::{Cholesky, NotPositiveDefinite, Symbolic, TooLarge};
pub use linear::{Linear, Solution, System};
pub use ordering::{Order, nested_dissection};

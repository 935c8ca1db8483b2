//! Solving K u + Gᵀ q(G u) = f. Knows no mesh and no law by name: it sees matrices, joints and their stiffness.

mod cholesky;
mod cut;
mod graph;
mod linear;
mod ordering;
mod part;
mod parts;
mod plan;

pub use cholesky::{Cholesky, NotPositiveDefinite, Symbolic, TooLarge};
pub use cut::Cut;
pub use linear::{Linear, Solution, System};
pub use ordering::{Order, nested_dissection};
pub use parts::{Parts, PartsFactor};
pub use plan::{Factor, Plan};

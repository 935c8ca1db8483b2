//! Solving K u + Gᵀ q(G u) = f. Knows no mesh and no law by name: it sees matrices, joints and their stiffness.

mod base;
mod cholesky;
mod condensation;
mod cut;
mod dense;
mod dual;
mod form;
mod graph;
mod jacobian;
mod linear;
mod measure;
mod newton;
mod ordering;
mod part;
mod parts;
mod path;
mod plain;
mod plan;
mod refine;

pub use base::Base;
pub use cholesky::{Cholesky, NotPositiveDefinite, Symbolic, TooLarge};
pub use condensation::{Condensation, Continuum};
pub use cut::Cut;
pub use dual::Dual;
pub use form::{Form, Respond};
pub use linear::{Linear, System};
pub use measure::{Measure, Ramp};
pub use newton::{Iterate, Newton, Settings, Unconverged};
pub use ordering::{Order, nested_dissection};
pub use parts::{Parts, PartsFactor};
pub use path::{Affine, Point};
pub use plain::Plain;
pub use plan::{Factor, Plan};
pub use refine::Solution;

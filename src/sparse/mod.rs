//! Sparse matrices: compressed rows with their products, and the factor of a banded mass matrix.

mod banded;
mod csr;

pub use banded::Banded;
pub use csr::Csr;

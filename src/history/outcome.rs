//! Outcome of a search that may be tried again in another way.

use crate::solver::Unconverged;

/// An equilibrium, or why the search is tried again with other numbers.
pub(super) enum Outcome<T, W = Unconverged> {
    /// It was found.
    Converged(T),
    /// It was not.
    Retry(W),
}

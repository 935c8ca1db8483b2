//! Variables that a law keeps at a point beyond jump and traction: results, probes and tables follow from their names.

use serde::Serialize;

/// Most variables that a law has of its own.
pub const OWN: usize = 4;

/// A variable of a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct LawVariable {
    /// Name of its array, probe and column.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// A noun phrase that says what it is.
    pub meaning: &'static str,
    #[serde(skip)]
    /// Its place in `State::own`, which other laws have for theirs.
    pub place: usize,
}

//! Variables that a law keeps at a point beyond jump and traction: results, probes and tables follow from their names.

use super::{State, cracking};

/// Variables that a law can have of its own.
pub const OWN: usize = 4;

/// A variable of a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variable {
    /// Name of its array, probe and column.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// A noun phrase that says what it is.
    pub meaning: &'static str,
    /// Its place in `State::own`.
    pub place: usize,
}

impl Variable {
    /// Its value at a point.
    pub fn of(&self, state: &State) -> f64 {
        state.own[self.place]
    }
}

/// The variables of all laws: results have an array for each.
pub fn variables() -> impl Iterator<Item = &'static Variable> {
    cracking::VARIABLES.iter()
}

//! Variables that a law keeps at a point beyond jump and traction: results, probes and tables follow from their names.

/// Most variables that a law has of its own.
pub const OWN: usize = 4;

/// A variable of a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LawVariable {
    /// Name of its array, probe and column.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// A noun phrase that says what it is.
    pub meaning: &'static str,
    /// Its place in `State::own`, which other laws have for theirs.
    pub place: usize,
}

/// True if the places of all variables exist.
pub(super) const fn fit(laws: &[&[LawVariable]]) -> bool {
    let mut law = 0;
    while law < laws.len() {
        let mut k = 0;
        while k < laws[law].len() {
            if laws[law][k].place >= OWN {
                return false;
            }
            k += 1;
        }
        law += 1;
    }
    true
}

//! Interface laws: each is a value that maps (jump, old state) to (traction, stiffness, new state, dissipation).
//!
//! A law stores nothing: to reject an increment drop the new states, to accept it copy them over the old ones. The
//! way from the old jump to the new one is straight; a law whose answer depends on the way divides it (`Stepping`).
//!
//! A law is a file with its parameters and its answers (`PointLaw`), a line of the list below, and its tests.

mod admissible;
mod balance;
mod bounds;
mod closure;
mod cohesive;
mod condition;
mod coulomb;
mod cracking;
#[cfg(test)]
mod damage;
mod elastic;
mod lagged;
mod list;
mod local;
pub mod path;
mod point;
mod start;
mod state;
mod variable;

pub use admissible::Inadmissible;
pub use closure::Closure;
pub use cohesive::{Cohesive, MixedMode, NamedSoftening, Softening};
pub use condition::{Condition, is_open};
pub use coulomb::{Coulomb, LossOfCohesion};
pub use cracking::{Cracking, Unloading, WORK};
pub use elastic::Elastic;
pub use local::{Local, LocalMatrix, N, S, T, diagonal_rows, local, write_diagonal, write_rows};
pub use point::PointLaw;
pub use state::{Integration, Response, State, Strength, Unresolved};
pub use variable::{LawVariable, OWN};

use std::ops::Deref;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

#[cfg(test)]
use damage::Damage;

/// Relative tolerance of the laws' integration when the scene names none.
pub const LAW_TOLERANCE: f64 = 1e-4;

list::laws! {
    /// Linear springs (paper eq. 10).
    Elastic,
    /// Contact with Coulomb friction.
    Coulomb,
    /// Normal/shear cracking: a hyperbola that shrinks with the work spent on fracture (paper §3.2).
    Cracking,
    /// Cohesive zone with damage in two modes, contact and friction.
    Cohesive,
    /// A law of a test alone.
    #[cfg(test)]
    Damage,
}

/// The variables of all laws, each name once.
pub fn variables() -> impl Iterator<Item = &'static LawVariable> {
    let named_before = |k: usize, name: &str| lists().flatten().take(k).any(|before| before.name == name);
    lists().flatten().enumerate().filter(move |(k, own)| !named_before(*k, own.name)).map(|(_, own)| own)
}

impl Law {
    /// True if the law has a variable of this name.
    pub fn has(&self, variable: &LawVariable) -> bool {
        self.variables().iter().any(|own| own.name == variable.name)
    }

    /// Value of a variable at a point of the law; zero for one of another law.
    pub fn value(&self, variable: &LawVariable, state: &State) -> f64 {
        let own = self.variables().iter().find(|own| own.name == variable.name);
        own.map_or(0.0, |own| state.own[own.place])
    }

    /// Fraction of a straight way to a jump at which a point of a softening law that is inside its surface reaches it; none if
    /// it does not, or is on it already.
    pub fn onset(&self, jump: Local, old: &State) -> Option<f64> {
        self.onset_or_on(jump, old).filter(|fraction| *fraction > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_of_a_law_have_places_and_names_of_their_own() {
        for list in lists() {
            assert!(list.iter().all(|variable| variable.place < OWN), "a law with more variables raises OWN");
            for (k, variable) in list.iter().enumerate() {
                let clash =
                    |other: &LawVariable| other.place == variable.place || other.name == variable.name;
                assert!(!list[..k].iter().any(clash), "{}", variable.name);
            }
        }
    }
}

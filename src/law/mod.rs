//! Interface laws: each is a value that maps (jump, old state) to (traction, stiffness, new state, dissipation).
//!
//! A law stores nothing: to reject an increment drop the new states, to accept it copy them over the old ones. The
//! way from the old jump to the new one is straight; a law whose answer depends on the way divides it (`Stepping`).

mod admissible;
mod balance;
mod coulomb;
mod cracking;
mod elastic;
mod lagged;
mod local;
pub mod path;
mod state;
mod variable;

pub use admissible::Inadmissible;
pub use coulomb::Coulomb;
pub use cracking::{Cracking, Strength, Unloading, WORK};
pub use elastic::Elastic;
pub use local::{Local, LocalMatrix, N, S, T, diagonal_rows, local, write_diagonal, write_rows};
pub use state::{Integration, Response, State, Unresolved};
pub use variable::{LawVariable, OWN};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use admissible::{error_at, not_negative};
use state::listed;

use crate::error::Warning;

/// Relative tolerance of the laws' integration when the scene names none.
pub const LAW_TOLERANCE: f64 = 1e-4;

/// Initial tractions may lie outside the surface by rounding, relative to the traction and the cohesion.
const ON_SURFACE: f64 = 1e-12;

/// The law of an interface, as written in the scene under `law`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum Law {
    /// Linear springs (paper eq. 10).
    Elastic(Elastic),
    /// Contact with Coulomb friction.
    Coulomb(Coulomb),
    /// Normal/shear cracking: a hyperbola that shrinks with the work spent on fracture (paper §3.2).
    Cracking(Cracking),
}

/// Variables of every law that has any.
const VARIABLES: [&[LawVariable]; 1] = [&cracking::VARIABLES];
const _: () = assert!(variable::fit(&VARIABLES)); // a law with more of them raises OWN

/// The variables of all laws: results have an array for each.
pub fn variables() -> impl Iterator<Item = &'static LawVariable> {
    VARIABLES.into_iter().flatten()
}

impl Law {
    /// Checks the parameters; the scene's door asks once, nobody after it.
    pub fn check(&self) -> Result<(), Inadmissible> {
        match self {
            Law::Elastic(law) => law.check(),
            Law::Coulomb(law) => law.check(),
            Law::Cracking(law) => law.check(),
        }
    }

    /// Warnings of admissible parameters.
    pub fn warnings(&self) -> Vec<Warning> {
        match self {
            Law::Elastic(_) | Law::Coulomb(_) => Vec::new(),
            Law::Cracking(law) => law.warnings(),
        }
    }

    /// Elastic stiffnesses of the components, K_N, K_T, K_T [stress / length].
    pub fn elastic_stiffness(&self) -> [f64; 3] {
        let [kn, kt] = match self {
            Law::Elastic(law) => [law.normal_stiffness, law.tangential_stiffness],
            Law::Coulomb(law) => [law.normal_stiffness, law.tangential_stiffness],
            Law::Cracking(law) => [law.normal_stiffness, law.tangential_stiffness],
        };
        [kn, kt, kt]
    }

    /// Variables of the law at a point, beyond jump and traction.
    pub fn variables(&self) -> &'static [LawVariable] {
        match self {
            Law::Elastic(_) | Law::Coulomb(_) => &[],
            Law::Cracking(law) => law.variables(),
        }
    }

    /// Value of a variable at a point of the law; zero for one of another law.
    pub fn value(&self, variable: &LawVariable, state: &State) -> f64 {
        if self.variables().contains(variable) { state.own[variable.place] } else { 0.0 }
    }

    /// Stored energy of a point whose stiffnesses are above zero [stress × length]: ½ tᵀ D⁻¹ t where the law does not say more.
    pub fn stored(&self, state: &State) -> f64 {
        if let Law::Cracking(law) = self {
            return law.stored(state);
        }
        let t = state.traction;
        0.5 * t.component_mul(&t).component_div(&Local::from(self.elastic_stiffness())).sum()
    }

    /// Traction at a jump with the point held elastic, and its slopes by the same components [stress / length].
    pub fn held(&self, jump: Local, old: &State) -> (Local, [f64; 3]) {
        match self {
            Law::Cracking(law) => law.held(jump, old),
            _ => {
                let k = self.elastic_stiffness();
                (old.traction + Local::from(k).component_mul(&(jump - old.jump)), k)
            }
        }
    }

    /// True for a softening law whose sides move apart as they slide under compression.
    pub fn dilates(&self) -> bool {
        matches!(self, Law::Cracking(law) if law.dilatancy_stress > 0.0)
    }

    /// True for a law whose cracks close.
    pub fn closes(&self) -> bool {
        matches!(self, Law::Cracking(law) if law.unloading == Unloading::Closing)
    }

    /// Steepest loss of traction per jump that the law has [stress / length]; zero if it has no softening.
    pub fn steepest_softening(&self) -> f64 {
        match self {
            Law::Elastic(_) | Law::Coulomb(_) => 0.0,
            Law::Cracking(law) => law.steepest_softening(),
        }
    }

    /// Fraction of a straight way to a jump at which a point of a softening law that is inside its surface reaches it; none if
    /// it does not, or is on it already.
    pub fn onset(&self, jump: Local, old: &State) -> Option<f64> {
        self.onset_or_on(jump, old).filter(|fraction| *fraction > 0.0)
    }

    /// The same, 0 for a point that is on its surface.
    pub fn onset_or_on(&self, jump: Local, old: &State) -> Option<f64> {
        match self {
            Law::Elastic(_) | Law::Coulomb(_) => None,
            Law::Cracking(law) => law.onset(jump, old),
        }
    }

    /// The state before the first increment: jump 0 under the traction t₀ (paper eq. 10), or, for `coulomb`,
    /// faces that are `initial_gap` apart, or pressed by an overlap where that is negative.
    pub fn initial_state(&self, initial_traction: Local, initial_gap: f64) -> Result<State, Inadmissible> {
        if !initial_traction.iter().all(|component| component.is_finite()) {
            return error_at("initial_traction", "initial_traction is not finite", "give two numbers [n, t]");
        }
        if !initial_gap.is_finite() {
            return error_at("initial_gap", "initial_gap is not finite", "give a distance");
        }
        let outside = match self {
            Law::Elastic(_) => f64::NEG_INFINITY,
            Law::Coulomb(law) => law.excess(initial_traction) - ON_SURFACE * law.cohesion,
            Law::Cracking(law) => law.excess(initial_traction) - ON_SURFACE * law.cohesion,
        };
        if outside > ON_SURFACE * initial_traction.amax() {
            return error_at(
                "initial_traction",
                format!(
                    "initial_traction [{}] lies outside the strength by {outside:.3e}",
                    listed(&initial_traction)
                ),
                "give a traction that the intact interface can carry",
            );
        }
        if initial_gap != 0.0 && !matches!(self, Law::Coulomb(_)) {
            return error_at("initial_gap", "initial_gap is for coulomb only", "remove it or use that law");
        }
        if initial_gap != 0.0 && initial_traction != Local::zeros() {
            let what = "an open gap carries no initial_traction, and an overlap has its own";
            return error_at("initial_gap", what, "give one of the two");
        }
        let stiffness = self.elastic_stiffness();
        let pressed = Local::new((stiffness[N] * initial_gap).min(0.0), 0.0, 0.0);
        let mut jump_plastic = Local::new(-initial_gap, 0.0, 0.0);
        for (i, stiffness) in stiffness.into_iter().enumerate() {
            if stiffness > 0.0 {
                jump_plastic[i] -= initial_traction[i] / stiffness; // no stiffness: the elastic law carries t₀ alone
            }
        }
        let own = match self {
            Law::Cracking(law) => law.intact(),
            _ => [0.0; OWN],
        };
        Ok(State { traction: initial_traction + pressed, jump_plastic, own, ..State::default() })
    }

    /// The state at a given jump, irreversible jump and variables of its own; `Err` if the law cannot carry it.
    pub fn state_at(&self, jump: Local, jump_plastic: Local, own: [f64; OWN]) -> Result<State, Inadmissible> {
        let k = Local::from(self.elastic_stiffness());
        let elastic = jump - jump_plastic;
        let mut traction = k.component_mul(&elastic);
        for variable in self.variables() {
            not_negative("initial", own[variable.place])?;
        }
        let rounding = ON_SURFACE * (traction.amax() + k.component_mul(&jump).abs().sum());
        let excess = match self {
            Law::Elastic(_) => f64::NEG_INFINITY,
            Law::Coulomb(law) => {
                if elastic[N] > 0.0 {
                    traction = Local::zeros();
                }
                law.excess(traction)
            }
            Law::Cracking(law) => {
                traction = law.elastic_at(jump, jump_plastic, own);
                law.excess_at(traction, own[WORK]) - ON_SURFACE * law.cohesion
            }
        };
        if !jump.iter().chain(&jump_plastic).all(|component| component.is_finite()) || excess > rounding {
            return error_at(
                "initial",
                format!("the traction [{}] of the initial state is outside", listed(&traction)),
                "give a state that the law can carry",
            );
        }
        Ok(State { jump, traction, jump_plastic, own, status: 0 })
    }

    /// Current strength (χ, c, tanφ) at a state; `None` for the elastic law, which has none.
    pub fn strength(&self, state: &State) -> Option<Strength> {
        match self {
            Law::Elastic(_) => None,
            Law::Coulomb(law) => Some(Strength {
                tensile_strength: 0.0,
                cohesion: law.cohesion,
                tan_friction: law.friction_coefficient,
            }),
            Law::Cracking(law) => Some(law.strength(state.own[WORK])),
        }
    }

    /// The answer at a jump, reached in a straight line from the old state. Allocates nothing.
    #[inline]
    pub fn respond(
        &self,
        jump: Local,
        old: &State,
        integration: Integration,
    ) -> Result<Response, Unresolved> {
        if !jump.iter().all(|component| component.is_finite()) {
            return Err(Unresolved::NotFinite { jump });
        }
        match self {
            Law::Elastic(law) => Ok(law.respond(jump, old)),
            Law::Coulomb(law) => Ok(law.respond(jump, old)),
            Law::Cracking(law) => law.respond(jump, old, integration),
        }
    }
}

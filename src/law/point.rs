//! A law at a point: the questions that it answers about itself. Answers that most laws share are given here.

use super::local::Local;
use super::{Inadmissible, Integration, LawVariable, OWN, Response, State, Strength, Unresolved};
use crate::error::Warning;

/// A law at a point. What results, probes, tables and the solution know of a law they ask here.
pub trait PointLaw {
    /// Variables that laws of this type have at a point, beyond jump and traction: results have an array for each.
    fn all_variables() -> &'static [LawVariable]
    where
        Self: Sized,
    {
        &[]
    }

    /// Those of them that this law has.
    fn variables(&self) -> &'static [LawVariable] {
        &[]
    }

    /// Checks the parameters; the scene's door asks once, nobody after it.
    fn check(&self) -> Result<(), Inadmissible>;

    /// Warnings of admissible parameters.
    fn warnings(&self) -> Vec<Warning> {
        Vec::new()
    }

    /// Elastic stiffnesses of the components, K_N, K_T, K_T [stress / length].
    fn elastic_stiffness(&self) -> [f64; 3];

    /// The answer at a jump that is a number, reached in a straight line from the old state. Allocates nothing.
    fn respond(&self, jump: Local, old: &State, integration: Integration) -> Result<Response, Unresolved>;

    /// The same for a law whose answer depends on how fast the load factor of its step grows: by `advance` in this step.
    fn respond_over(
        &self,
        jump: Local,
        old: &State,
        integration: Integration,
        _advance: f64,
    ) -> Result<Response, Unresolved> {
        self.respond(jump, old, integration)
    }

    /// True for a law whose answer depends on that.
    fn is_viscous(&self) -> bool {
        false
    }

    /// Work of a point's viscosity so far, part of what it has dissipated [stress × length].
    fn viscous_work(&self, _state: &State) -> f64 {
        0.0
    }

    /// The answer with friction, and dilatancy alike, of the step before where its slope has no bound, or with `all` where it is
    /// steep; the law's own elsewhere.
    fn respond_lagged(
        &self,
        jump: Local,
        old: &State,
        integration: Integration,
        _all: bool,
    ) -> Result<Response, Unresolved> {
        self.respond(jump, old, integration)
    }

    /// Traction at a jump with the point held elastic, and its slopes by the same components [stress / length].
    fn held(&self, jump: Local, old: &State) -> (Local, [f64; 3]) {
        let k = self.elastic_stiffness();
        (old.traction + Local::from(k).component_mul(&(jump - old.jump)), k)
    }

    /// Stored energy of a point whose stiffnesses are above zero [stress × length].
    fn stored(&self, state: &State) -> f64 {
        let t = state.traction;
        0.5 * t.component_mul(&t).component_div(&Local::from(self.elastic_stiffness())).sum()
    }

    /// Share of a point's strength in tension that is spent, 0 to 1; none for a law without.
    fn damage(&self, _state: &State) -> Option<f64> {
        None
    }

    /// Variables of an intact point.
    fn intact(&self) -> [f64; OWN] {
        [0.0; OWN]
    }

    /// Variables of a closed point that has lost a share of its fracture energy in mode I; none for a law that has none to lose.
    fn lost(&self, _share: f64) -> Option<[f64; OWN]> {
        None
    }

    /// True for a law that has a fracture energy to lose (`initial_damage`).
    fn takes_damage(&self) -> bool {
        false
    }

    /// Normal jump, less the irreversible one, that the faces cannot reach however they are pressed [length].
    fn narrowest(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// Jump of an intact point under a traction; none in a direction without stiffness [length].
    fn jump_under(&self, traction: &Local) -> Local {
        let k = self.elastic_stiffness();
        Local::from_fn(|i, _| if k[i] > 0.0 { traction[i] / k[i] } else { 0.0 })
    }

    /// Traction of a state at rest: its jump, its irreversible jump and its own variables.
    fn at_rest(&self, jump: Local, jump_plastic: Local, _own: &[f64; OWN]) -> Local {
        Local::from(self.elastic_stiffness()).component_mul(&(jump - jump_plastic))
    }

    /// Excess of a traction over what the point can carry, by its own variables [stress]; −∞ for a law without a strength.
    fn excess(&self, _traction: &Local, _own: &[f64; OWN]) -> f64 {
        f64::NEG_INFINITY
    }

    /// Current strength (χ, c, tanφ) at a state; `None` for a law that has none.
    fn strength(&self, _state: &State) -> Option<Strength> {
        None
    }

    /// Steepest loss of traction per jump that the law has [stress / length]; zero if it has no softening.
    fn steepest_softening(&self) -> f64 {
        0.0
    }

    /// Fraction of a straight way to a jump at which a point of a softening law reaches its strength, 0 if it is there already;
    /// none if it does not.
    fn onset_or_on(&self, _jump: Local, _old: &State) -> Option<f64> {
        None
    }

    /// True for a law that is D r + t₀ whatever happens: it has no states.
    fn is_linear(&self) -> bool {
        false
    }

    /// True for a law that is integrated along the way under error control (`law_tolerance`).
    fn is_integrated(&self) -> bool {
        false
    }

    /// True for a law whose faces may be apart, or overlap, at the start (`initial_gap`).
    fn takes_gap(&self) -> bool {
        false
    }

    /// True for a softening law whose sides move apart as they slide under compression.
    fn dilates(&self) -> bool {
        false
    }

    /// True for a law whose cracks close.
    fn closes(&self) -> bool {
        false
    }

    /// Distance of two states, as an error of the traction [stress].
    fn misfit(&self, a: &State, b: &State) -> f64 {
        (a.traction - b.traction).amax()
    }

    /// Bound of the local error of a step under a tolerance [stress]; none for a law that is exact along a straight way.
    fn local_bound(&self, _tolerance: f64) -> Option<f64> {
        None
    }
}

/// Largest of a law's strengths when it is intact [stress]; zero for a law that has none.
pub(super) fn intact_strength(law: &dyn PointLaw) -> f64 {
    let intact = State { own: law.intact(), ..State::default() };
    law.strength(&intact).map_or(0.0, |strength| strength.cohesion.max(strength.tensile_strength))
}

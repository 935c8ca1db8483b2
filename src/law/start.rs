//! States from which a law point starts.

use super::admissible::{Inadmissible, error_at, not_negative};
use super::local::{Local, N};
use super::point::intact_strength;
use super::state::listed;
use super::{Law, OWN, State};

/// Initial tractions may lie outside the surface by rounding, relative to the traction and the strength.
const ON_SURFACE: f64 = 1e-12;

impl Law {
    /// The state before the first increment: jump 0 under the traction t₀ (paper eq. 10), or faces that are `initial_gap` apart,
    /// pressed by an overlap where that is negative.
    pub fn initial_state(&self, initial_traction: Local, initial_gap: f64) -> Result<State, Inadmissible> {
        if !initial_traction.iter().all(|component| component.is_finite()) {
            return error_at("initial_traction", "initial_traction is not finite", "give two numbers [n, t]");
        }
        if !initial_gap.is_finite() {
            return error_at("initial_gap", "initial_gap is not finite", "give a distance");
        }
        let own = self.intact();
        let outside = self.excess(&initial_traction, &own) - ON_SURFACE * intact_strength(&**self);
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
        if initial_gap != 0.0 && !self.takes_gap() {
            return error_at("initial_gap", "this law knows no initial_gap", "remove it or take \"coulomb\"");
        }
        if initial_gap != 0.0 && initial_traction != Local::zeros() {
            let what = "an open gap carries no initial_traction, and an overlap has its own";
            return error_at("initial_gap", what, "give one of the two");
        }
        if initial_gap <= self.narrowest() {
            let what = format!(
                "initial_gap = {initial_gap:e} is more of an overlap than the closure of {:e}",
                -self.narrowest()
            );
            return error_at("initial_gap", what, "give a smaller overlap");
        }
        // without a stiffness the elastic law carries t₀ alone
        let jump_plastic = Local::new(-initial_gap, 0.0, 0.0) - self.jump_under(&initial_traction);
        let pressed =
            if initial_gap < 0.0 { self.at_rest(Local::zeros(), jump_plastic, &own) } else { Local::zeros() };
        let traction = initial_traction + pressed;
        Ok(State { traction, jump_plastic, own, ..State::default() })
    }

    /// The same for a point that has lost a share of its fracture energy, faces closed.
    pub fn damaged(&self, intact: State, share: f64) -> Result<State, Inadmissible> {
        if share == 0.0 {
            return Ok(intact);
        }
        if !(0.0..=1.0).contains(&share) {
            let what = format!("initial_damage = {share} is no share");
            return error_at("initial_damage", what, "it lies between 0 and 1");
        }
        if intact.traction[N] > 0.0 {
            let what = "initial_traction pulls on a crack that is there at the start";
            return error_at("initial_damage", what, "its faces are closed and untied: take the tension off");
        }
        let Some(own) = self.lost(share) else {
            return error_at("initial_damage", "this law knows no initial damage", "remove it");
        };
        let outside = self.excess(&intact.traction, &own) - ON_SURFACE * intact_strength(&**self);
        if outside > ON_SURFACE * intact.traction.amax() {
            let what = format!(
                "initial_traction [{}] is more than a point carries that has lost the share {share}",
                listed(&intact.traction)
            );
            return error_at("initial_damage", what, "lower one of the two");
        }
        Ok(State { own, ..intact })
    }

    /// The state at a given jump, irreversible jump and variables of its own; `Err` if the law cannot carry it.
    pub fn state_at(&self, jump: Local, jump_plastic: Local, own: [f64; OWN]) -> Result<State, Inadmissible> {
        for variable in self.variables() {
            not_negative("initial", own[variable.place])?;
        }
        if jump[N] - jump_plastic[N] <= self.narrowest() {
            let what = format!("the initial state closes the joint by {:e} or more", -self.narrowest());
            return error_at("initial", what, "give a state that the law can carry");
        }
        let traction = self.at_rest(jump, jump_plastic, &own);
        let trial = self.elastic_stiffness();
        let size = traction.amax() + Local::from(trial).component_mul(&jump).abs().sum();
        let rounding = ON_SURFACE * (size + intact_strength(&**self));
        let finite = jump.iter().chain(&jump_plastic).all(|component| component.is_finite());
        if !finite || self.excess(&traction, &own) > rounding {
            return error_at(
                "initial",
                format!("the traction [{}] of the initial state is outside", listed(&traction)),
                "give a state that the law can carry",
            );
        }
        Ok(State { jump, traction, jump_plastic, own, status: 0 })
    }
}

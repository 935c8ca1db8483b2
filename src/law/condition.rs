//! Condition of a law point: what has become of it, whatever it did in the last increment.

use super::local::{Local, N, S, T};
use super::{Law, State};

/// Condition of a law point; the number is its value in results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Condition {
    /// Nothing has cracked, slid or come apart.
    Intact = 0,
    /// Faces that touch and have slid.
    Slid = 1,
    /// Cracked: a part of the strength is spent; the faces touch, or are still to come apart.
    Cracked = 2,
    /// Cracked and apart, tied by what bridges the crack.
    Tied = 3,
    /// Cracked through: no strength in tension is left; the faces touch.
    Through = 4,
    /// Apart and free of stress.
    Open = 5,
}

impl Law {
    /// The condition of a point of this law.
    pub fn condition(&self, state: &State) -> Condition {
        let apart = (state.jump - state.jump_plastic)[N] > 0.0;
        match self.damage(state) {
            _ if state.jump[N] > 0.0 && state.traction == Local::zeros() => Condition::Open,
            Some(damage) if damage >= 1.0 => Condition::Through,
            Some(damage) if damage > 0.0 && apart => Condition::Tied,
            Some(damage) if damage > 0.0 => Condition::Cracked,
            _ if state.jump_plastic[T] != 0.0 || state.jump_plastic[S] != 0.0 => Condition::Slid,
            _ => Condition::Intact,
        }
    }
}

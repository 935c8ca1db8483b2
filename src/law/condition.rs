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

/// True where the faces are apart and carry nothing; across a gap at the start they are until they meet, at r_n = r_n^p = −g.
#[inline]
pub fn is_open(jump: &Local, jump_plastic: &Local, traction: &Local) -> bool {
    jump[N] > jump_plastic[N].min(0.0) && *traction == Local::zeros()
}

impl Law {
    /// The condition of a point of this law.
    pub fn condition(&self, state: &State) -> Condition {
        let apart = (state.jump - state.jump_plastic)[N] > 0.0;
        match self.damage(state) {
            _ if is_open(&state.jump, &state.jump_plastic, &state.traction) => Condition::Open,
            Some(damage) if damage >= 1.0 => Condition::Through,
            Some(damage) if damage > 0.0 && apart => Condition::Tied,
            Some(damage) if damage > 0.0 => Condition::Cracked,
            _ if state.jump_plastic[T] != 0.0 || state.jump_plastic[S] != 0.0 => Condition::Slid,
            _ => Condition::Intact,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Integration;

    const CRACKING: &str = r#"{ "type": "cracking", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "tensile_strength": 3,
        "cohesion": 4, "tan_friction": 0.8785, "fracture_energy_i": 2e-4, "fracture_energy_iia": 2e-3, "dilatancy_stress": 0 }"#;
    const COHESIVE: &str = r#"{ "type": "cohesive", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "tensile_strength": 3,
        "shear_strength": 4, "fracture_energy_i": 2e-4, "fracture_energy_ii": 4e-4, "softening": "linear" }"#;
    const COULOMB: &str = r#"{ "type": "coulomb", "normal_stiffness": 1e6, "tangential_stiffness": 1e6, "friction_coefficient": 0.5 }"#;

    /// Conditions after each of some jumps (n, t), one after the other.
    fn along(law: &str, jumps: &[[f64; 2]]) -> Vec<Condition> {
        let law: Law = serde_json::from_str(law).unwrap();
        let mut state = law.initial_state(Local::zeros(), 0.0).unwrap();
        let mut go = |&[n, t]: &[f64; 2]| {
            state = law.respond(Local::new(n, t, 0.0), &state, Integration::Tolerance(1e-6)).unwrap().state;
            law.condition(&state)
        };
        jumps.iter().map(&mut go).collect()
    }

    #[test]
    fn conditions_tell_what_has_become_of_a_point() {
        use Condition::{Cracked, Intact, Open, Slid, Through, Tied};
        // below the strength; beyond it; nearly closed again, and pressed; pulled until nothing is left; pressed again
        let pulled = [[2e-6, 0.0], [3e-5, 0.0], [1e-6, 0.0], [-1e-6, 0.0], [1e-2, 0.0], [-1e-6, 0.0]];
        assert_eq!(along(CRACKING, &pulled), [Intact, Tied, Tied, Cracked, Open, Through]);
        assert_eq!(along(COHESIVE, &pulled), [Intact, Tied, Tied, Cracked, Open, Through]);
        // pressed; slid; slid back to where it was; apart; pressed again
        let slid = [[-1e-6, 0.0], [-1e-6, 1e-5], [0.0, 1e-5], [1e-5, 1e-5], [-1e-6, 1e-5]];
        assert_eq!(along(COULOMB, &slid), [Intact, Slid, Slid, Open, Slid]);
        // across a gap: not yet met; pressed
        let law: Law = serde_json::from_str(COULOMB).unwrap();
        let start = law.initial_state(Local::zeros(), 1e-4).unwrap();
        let after = |n: f64| {
            let answer = law.respond(Local::new(n, 0.0, 0.0), &start, Integration::Tolerance(1e-6));
            law.condition(&answer.unwrap().state)
        };
        assert_eq!([-0.9e-4, -1.1e-4].map(after), [Open, Intact]);
        // sheared under pressure until all cohesion is spent
        let sheared = [[-5e-6, 0.0], [-5e-6, 1e-5], [-5e-6, 1e-2]];
        assert_eq!(along(CRACKING, &sheared), [Intact, Cracked, Through]);
    }
}

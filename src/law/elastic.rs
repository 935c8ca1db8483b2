//! Linear springs: t = D r + t₀, D = diag(K_N, K_T) (paper eq. 10). No state, no history.

use nalgebra::{Matrix2, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::admissible::{Inadmissible, not_negative};
use super::{Response, State};

/// Parameters of the elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elastic {
    /// Normal stiffness K_N [stress / length], zero or more.
    pub normal_stiffness: f64,
    /// Tangential stiffness K_T [stress / length], zero or more.
    pub tangential_stiffness: f64,
}

impl Elastic {
    /// The traction (n, t) at a jump (n, t), with the initial traction t₀.
    #[inline]
    pub fn traction(&self, jump: Vector2<f64>, initial: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(
            self.normal_stiffness * jump.x + initial.x,
            self.tangential_stiffness * jump.y + initial.y,
        )
    }

    /// Both stiffnesses must be finite and not negative; zero leaves that direction free.
    pub fn check(&self) -> Result<(), Inadmissible> {
        not_negative("normal_stiffness", self.normal_stiffness)?;
        not_negative("tangential_stiffness", self.tangential_stiffness)
    }

    /// The answer in the form all laws share: the old traction is carried, so t₀ needs no place of its own.
    #[inline]
    pub(super) fn respond(&self, jump: Vector2<f64>, old: &State) -> Response {
        let traction = self.traction(jump - old.jump, old.traction);
        Response {
            traction,
            stiffness: Matrix2::new(self.normal_stiffness, 0.0, 0.0, self.tangential_stiffness),
            state: State { jump, traction, ..*old },
            dissipation: 0.0,
            dissipation_gradient: Vector2::zeros(),
            released: 0.0,
        }
    }
}

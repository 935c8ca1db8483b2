//! Linear springs: t = D r + t₀, D = diag(K_N, K_T) (paper eq. 10). No state, no history.

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Inadmissible;

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
            self.normal_stiffness.mul_add(jump.x, initial.x),
            self.tangential_stiffness.mul_add(jump.y, initial.y),
        )
    }

    /// Both stiffnesses must be finite and not negative; zero leaves that direction free.
    pub fn check(&self) -> Result<(), Inadmissible> {
        for (key, value) in
            [("normal_stiffness", self.normal_stiffness), ("tangential_stiffness", self.tangential_stiffness)]
        {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(Inadmissible {
                    key,
                    what: format!("{key} = {value:e} is not a stiffness"),
                    cure: "it must be zero or more".into(),
                });
            }
        }
        Ok(())
    }
}

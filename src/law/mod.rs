//! Interface laws: each is a value that maps (jump, old state) to (traction, stiffness, new state, dissipation).
//!
//! A law stores nothing: to reject an increment drop the new states, to accept it copy them over the old ones.

mod elastic;

pub use elastic::Elastic;

use nalgebra::{Matrix2, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Index of the normal component of a jump or traction.
pub const N: usize = 0;
/// Index of the tangential component of a jump or traction.
pub const T: usize = 1;

/// The law of an interface, as written in the scene under `law`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum Law {
    /// Linear springs (paper eq. 10).
    Elastic(Elastic),
}

/// What a law point remembers from one increment to the next.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// Irreversible jump (n, t) [length].
    pub jump_plastic: Vector2<f64>,
    /// Work spent on fracture W [stress × length].
    pub fracture_work: f64,
    /// 0 elastic or stick, 1 T, 2 C or slip, 3 Z, 4 A or open.
    pub status: u8,
}

/// What a law answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Traction (n, t) [stress].
    pub traction: Vector2<f64>,
    /// ∂traction/∂jump, rows and columns (n, t) [stress / length]; unsymmetric in general.
    pub stiffness: Matrix2<f64>,
    /// State at the end of the increment.
    pub state: State,
    /// Energy dissipated in the increment per area [stress × length].
    pub dissipation: f64,
    /// ∂dissipation/∂jump (n, t) [stress].
    pub dissipation_gradient: Vector2<f64>,
}

/// Parameters that no law point can follow: the inequality that is broken, with its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Inadmissible {
    /// The key to blame.
    pub key: &'static str,
    /// The broken inequality with the numbers in it.
    pub what: String,
    /// What would have been right.
    pub cure: String,
}

impl Law {
    /// Checks the parameters; the scene's door asks once, nobody after it.
    pub fn check(&self) -> Result<(), Inadmissible> {
        match self {
            Law::Elastic(law) => law.check(),
        }
    }

    /// Normal and tangential elastic stiffness K_N, K_T [stress / length].
    pub fn elastic_stiffness(&self) -> [f64; 2] {
        match self {
            Law::Elastic(law) => [law.normal_stiffness, law.tangential_stiffness],
        }
    }
}

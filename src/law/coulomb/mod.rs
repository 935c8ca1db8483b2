//! Contact with Coulomb friction, constant cohesion and dilatancy, exact along a straight way of the jump.
//!
//! ```text
//! open    r_n > r_n^p:  t = 0,  r_t^p := r_t
//! closed  σ = K_N (r_n − r_n^p),  τ = K_T (r_t − r_t^p),  |τ| ≤ c − μ σ,  ṙ_n^p = tanψ |ṙ_t^p|
//! slip    |Δr_t^p| = (|τ_trial| + μ σ_trial − c) / (K_T + μ K_N tanψ),  from σ_a to σ_b it dissipates
//!         |Δr_t^p| (c − (μ − tanψ) (σ_a + σ_b)/2)
//! ```
//!
//! Between the events on the way (faces meet, slip starts, faces part) everything is linear, so answer and dissipation
//! do not depend on how a way is divided. Faces that part with cohesion drop τ, |τ| ≤ c, to 0 at once: τ²/(2 K_T) is
//! released, not dissipated; without cohesion slip has brought τ to 0 by then. At the apex of c = 0 faces that could
//! part or slide with dilatancy (0 < ṙ_n < tanψ |ṙ_t|) slide, as their neighbours on either side of the apex do.
//!
//! An initial gap g is r_n^p = −g at the start: the jump at which the faces meet. Not in the paper, which only names
//! friction laws (§3.2); classical otherwise.

mod jet;
mod way;

use nalgebra::{Matrix2, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::admissible::{Inadmissible, error_at, not_negative, positive};
use super::{Response, State};

/// Parameters of the Coulomb law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Coulomb {
    /// Normal (penalty) stiffness of the closed interface K_N [stress / length].
    pub normal_stiffness: f64,
    /// Tangential (penalty) stiffness of the sticking interface K_T [stress / length].
    pub tangential_stiffness: f64,
    /// Friction coefficient μ [-]; 0 is contact without friction.
    pub friction_coefficient: f64,
    /// Cohesion c [stress], constant, carried only while the interface is closed. Default 0.
    #[serde(default)]
    pub cohesion: f64,
    /// Dilatancy tan ψ [-]: opening per slip, at most the friction coefficient. Default 0.
    #[serde(default)]
    pub dilatancy: f64,
}

/// Status of a closed point that does not slide.
const STICK: u8 = 0;
/// Status of a closed point that slides.
const SLIP: u8 = 2;
/// Status of an open point.
pub(super) const OPEN: u8 = 4;

impl Coulomb {
    /// Stiffnesses above zero; friction, cohesion and dilatancy zero or more; dilatancy at most the friction.
    pub fn check(&self) -> Result<(), Inadmissible> {
        positive("normal_stiffness", self.normal_stiffness)?;
        positive("tangential_stiffness", self.tangential_stiffness)?;
        not_negative("friction_coefficient", self.friction_coefficient)?;
        not_negative("cohesion", self.cohesion)?;
        not_negative("dilatancy", self.dilatancy)?;
        if self.dilatancy > self.friction_coefficient {
            return error_at(
                "dilatancy",
                format!("dilatancy {} > friction_coefficient {}", self.dilatancy, self.friction_coefficient),
                "sliding would create energy; lower the dilatancy or raise the friction",
            );
        }
        Ok(())
    }

    /// Excess of a traction over the surface |τ| ≤ c − μ σ, σ ≤ 0 [stress].
    pub(super) fn excess(&self, traction: Vector2<f64>) -> f64 {
        let (sigma, tau) = (traction.x, traction.y);
        sigma.max(tau.abs() + self.friction_coefficient * sigma - self.cohesion)
    }

    /// Open, stick or slip at the end of the straight way from the old jump.
    pub(super) fn respond(&self, jump: Vector2<f64>, old: &State) -> Response {
        let end = way::follow(self, old.jump, old.jump_plastic, jump);
        let [sigma, tau] = end.traction;
        let traction = Vector2::new(sigma.value, tau.value);
        Response {
            traction,
            stiffness: Matrix2::from_rows(&[sigma.gradient.transpose(), tau.gradient.transpose()]),
            state: State { jump, traction, jump_plastic: end.jump_plastic, status: end.status, ..*old },
            dissipation: end.dissipation.value,
            dissipation_gradient: end.dissipation.gradient,
            released: end.released,
        }
    }

    /// Elastic energy of shear, τ²/(2 K_T) [stress × length].
    fn shear_energy(&self, tau: f64) -> f64 {
        0.5 * tau * tau / self.tangential_stiffness
    }
}

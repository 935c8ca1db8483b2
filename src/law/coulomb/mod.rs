//! Contact with Coulomb friction, constant cohesion and dilatancy.
//!
//! ```text
//! open    r_n > r_n^p:  t = 0,  r_t^p := r_t
//! closed  σ = K_N (r_n − r_n^p),  τ = K_T (r_t − r_t^p),  |τ| ≤ c − μ σ,  Δr_n^p = tanψ |Δr_t^p|
//! ```
//!
//! The limit is linear, so the return is closed:
//! |Δr_t^p| = (|τ_trial| + μ σ_trial − c) / (K_T + μ K_N tanψ). An initial gap g is r_n^p = −g at the start: the jump
//! at which the faces meet. Not in the paper, which only names friction laws (§3.2); classical otherwise.

use nalgebra::{Matrix2, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::admissible::{Inadmissible, not_negative, positive, refuse};
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
const OPEN: u8 = 4;

impl Coulomb {
    /// Stiffnesses above zero; friction, cohesion and dilatancy zero or more; dilatancy at most the friction.
    pub fn check(&self) -> Result<(), Inadmissible> {
        positive("normal_stiffness", self.normal_stiffness)?;
        positive("tangential_stiffness", self.tangential_stiffness)?;
        not_negative("friction_coefficient", self.friction_coefficient)?;
        not_negative("cohesion", self.cohesion)?;
        not_negative("dilatancy", self.dilatancy)?;
        if self.dilatancy > self.friction_coefficient {
            return refuse(
                "dilatancy",
                format!("dilatancy {} > friction_coefficient {}", self.dilatancy, self.friction_coefficient),
                "sliding would create energy; lower the dilatancy or raise the friction",
            );
        }
        Ok(())
    }

    /// How far a traction lies outside the surface |τ| ≤ c − μ σ, σ ≤ 0 [stress].
    pub(super) fn excess(&self, traction: Vector2<f64>) -> f64 {
        let (sigma, tau) = (traction.x, traction.y);
        sigma.max(tau.abs() + self.friction_coefficient * sigma - self.cohesion)
    }

    /// Open, stick or slip, from the jump and the old irreversible jump alone.
    pub(super) fn respond(&self, jump: Vector2<f64>, old: &State) -> Response {
        let (kn, kt, mu) = (self.normal_stiffness, self.tangential_stiffness, self.friction_coefficient);
        let tan_psi = self.dilatancy;
        if jump.x > old.jump_plastic.x {
            return Response {
                traction: Vector2::zeros(),
                stiffness: Matrix2::zeros(),
                state: State {
                    jump,
                    traction: Vector2::zeros(),
                    jump_plastic: Vector2::new(old.jump_plastic.x, jump.y),
                    status: OPEN,
                    ..*old
                },
                dissipation: 0.0,
                dissipation_gradient: Vector2::zeros(),
                released: 0.0,
            };
        }

        let elastic = jump - old.jump_plastic;
        let trial = Vector2::new(kn * elastic.x, kt * elastic.y);
        let excess = trial.y.abs() + mu * trial.x - self.cohesion;
        if excess <= 0.0 {
            return Response {
                traction: trial,
                stiffness: Matrix2::new(kn, 0.0, 0.0, kt),
                state: State { jump, traction: trial, status: STICK, ..*old },
                dissipation: 0.0,
                dissipation_gradient: Vector2::zeros(),
                released: 0.0,
            };
        }

        let sign = trial.y.signum();
        let slip = excess / (kt + mu * kn * tan_psi);
        let sigma = trial.x - kn * tan_psi * slip;
        let limit = self.cohesion - mu * sigma;
        let traction = Vector2::new(sigma, sign * limit);
        let slip_gradient = Vector2::new(mu * kn, sign * kt) / (kt + mu * kn * tan_psi);
        let sigma_gradient = Vector2::new(kn, 0.0) - kn * tan_psi * slip_gradient;
        let tau_gradient = -sign * mu * sigma_gradient;
        let per_slip = limit + sigma * tan_psi; // c + |σ| (μ − tanψ): never negative
        Response {
            traction,
            stiffness: Matrix2::new(sigma_gradient.x, sigma_gradient.y, tau_gradient.x, tau_gradient.y),
            state: State {
                jump,
                traction,
                jump_plastic: old.jump_plastic + slip * Vector2::new(tan_psi, sign),
                status: SLIP,
                ..*old
            },
            dissipation: slip * per_slip,
            dissipation_gradient: per_slip * slip_gradient + slip * (tan_psi - mu) * sigma_gradient,
            released: 0.0,
        }
    }
}

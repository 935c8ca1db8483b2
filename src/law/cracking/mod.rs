//! Normal/shear cracking of an interface (paper §3.2, figure 3): elasticity with a cracking surface that shrinks.
//!
//! ```text
//! t = K (r − r^p),  K = diag(K_N, K_T, K_T)                                elastic, never degrades
//! F = √(τ² + b²) − (c − σ tanφ) ≤ 0,  b = c − χ tanφ                       hyperbola, vertex (χ, 0)
//! χ = χ₀ (1 − S(W/G_I)),  c = c₀ (1 − S(W/G_II)),  tanφ = t₀ − (t₀ − t_r) S(W/G_II)
//! ṙ^p = λ̇ (f tanφ, τ/s),  s = √(τ² + b²)                                  f: dilatancy
//! Ẇ = σ ṙ_n^p + τ ṙ_t^p  (σ ≥ 0),  (|τ| + σ tanφ) |ṙ_t^p|  (σ < 0)        work without friction
//! ```
//!
//! f = 1 in tension, f_σ(σ) f_c(c) in compression and any value between at σ = 0, where a point that opens and slides
//! stays for a while. The paper gives the surface, its three parameters, the one history variable and the two limit
//! modes; the shapes S, the factors of f and the work follow the literature it cites.

mod check;
mod control;
mod facet;
mod flow;
mod march;
mod nested;
mod newton;
mod substep;
mod surface;
mod tangent;
mod variables;

pub use surface::Strength;
pub(super) use variables::VARIABLES;
pub use variables::WORK;

use facet::on_facet;
use march::step_nested;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::local::{Local, N, narrow, shear};
use super::{Integration, Response, State, Unresolved};
use substep::{Lengths, march, march_euler, onset_of};
use surface::Surface;

/// Parameters of the cracking law. Shape exponents α: 0 is linear in the work spent, more delays, less hastens.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cracking {
    /// Normal elastic (penalty) stiffness K_N [stress / length], above χ₀² e^|α| / G_I.
    pub normal_stiffness: f64,
    /// Tangential elastic (penalty) stiffness K_T [stress / length].
    pub tangential_stiffness: f64,
    /// Tensile strength of the intact interface χ₀ [stress].
    pub tensile_strength: f64,
    /// Apparent cohesion of the intact interface c₀ [stress], at least χ₀ tanφ₀.
    pub cohesion: f64,
    /// Tangent of the friction angle of the intact interface tanφ₀ [-].
    pub tan_friction: f64,
    /// Tangent of the residual friction angle tanφ_r [-]. Default: no loss.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tan_friction_residual: Option<f64>,
    /// Fracture energy in mode I, G_I [stress × length].
    pub fracture_energy_i: f64,
    /// Fracture energy in mode IIa (shear under very high compression), G_II [stress × length].
    pub fracture_energy_iia: f64,
    /// Compression σ_dil at which dilatancy vanishes [stress]; 0 is no dilatancy under any compression.
    pub dilatancy_stress: f64,
    /// Shape exponent of the loss of tensile strength [-]. Default 0.
    #[serde(default)]
    pub alpha_tensile_strength: f64,
    /// Shape exponent of the loss of cohesion [-]. Default 0.
    #[serde(default)]
    pub alpha_cohesion: f64,
    /// Shape exponent of the loss of friction [-]. Default 0.
    #[serde(default)]
    pub alpha_tan_friction: f64,
    /// Shape exponent of the loss of dilatancy with compression [-]. Default 0.
    #[serde(default)]
    pub alpha_dilatancy_stress: f64,
    /// Shape exponent of the loss of dilatancy with cohesion [-]. Default 0.
    #[serde(default)]
    pub alpha_dilatancy_cohesion: f64,
}

impl Cracking {
    /// Strength (χ, c, tanφ) once the work W has been spent.
    pub fn strength(&self, fracture_work: f64) -> Strength {
        let now = Surface::new(self).at(fracture_work);
        Strength { tensile_strength: now.chi, cohesion: now.c, tan_friction: now.t }
    }

    /// The hyperbola F of the intact interface at a traction [stress]; positive is outside.
    pub fn excess(&self, traction: Local) -> f64 {
        self.excess_at(traction, 0.0)
    }

    /// The hyperbola F at a traction once the work W has been spent [stress].
    pub fn excess_at(&self, traction: Local, fracture_work: f64) -> f64 {
        Surface::new(self).at(fracture_work).hyperbola(traction[N], shear(&traction))
    }

    /// The answer at a jump, reached in a straight line from the old state.
    pub(super) fn respond(
        &self,
        jump: Local,
        old: &State,
        integration: Integration,
    ) -> Result<Response, Unresolved> {
        let surface = Surface::new(self);
        match integration {
            Integration::Tolerance(tolerance) => {
                self.in_sub_steps(jump, old, Lengths::Controlled(tolerance, None))
            }
            Integration::BackwardEuler(steps) if old.is_plane(&jump) => {
                Ok(march_euler::<2>(&surface, narrow(&jump), old, steps))
            }
            Integration::BackwardEuler(steps) => Ok(march_euler::<3>(&surface, jump, old, steps)),
        }
    }

    /// The two-stage scheme in the plane or in space.
    fn in_sub_steps(&self, jump: Local, old: &State, lengths: Lengths) -> Result<Response, Unresolved> {
        let surface = Surface::new(self);
        match old.is_plane(&jump) {
            true => march::<2>(&surface, narrow(&jump), old, lengths),
            false => march::<3>(&surface, jump, old, lengths),
        }
    }

    /// The answer of a viscous step from a state under compression, with friction lagged and dilatancy kept.
    pub(super) fn respond_on_facet(&self, jump: Local, old: &State) -> Response {
        match old.is_plane(&jump) {
            true => on_facet::<2>(&Surface::new(self), jump, old),
            false => on_facet::<3>(&Surface::new(self), jump, old),
        }
    }

    /// Fraction of a straight way to a jump at which the surface is reached; none if it is not.
    pub(super) fn onset(&self, jump: Local, old: &State) -> Option<f64> {
        match old.is_plane(&jump) {
            true => onset_of::<2>(&Surface::new(self), narrow(&jump), old),
            false => onset_of::<3>(&Surface::new(self), jump, old),
        }
    }

    /// One backward Euler step by the safe nested solver alone: traction, W. What Newton is checked against.
    pub fn respond_nested(&self, jump: Local, old: &State) -> (Local, f64) {
        step_nested(&Surface::new(self), jump, old)
    }

    /// The answer under error control, with the lengths of its sub-steps appended to `lengths`.
    pub fn respond_recording(
        &self,
        jump: Local,
        old: &State,
        tolerance: f64,
        lengths: &mut Vec<f64>,
    ) -> Result<Response, Unresolved> {
        self.in_sub_steps(jump, old, Lengths::Controlled(tolerance, Some(lengths)))
    }

    /// The answer in sub-steps of given lengths, the last one up to the jump: the map whose exact derivative is the
    /// stiffness. Error control chooses these lengths anew for every jump, which the stiffness leaves out.
    pub fn respond_replaying(
        &self,
        jump: Local,
        old: &State,
        lengths: &[f64],
    ) -> Result<Response, Unresolved> {
        self.in_sub_steps(jump, old, Lengths::Given(lengths))
    }

    /// Distance of two states, as an error of the traction [stress]: in traction, strength and jump.
    pub(super) fn misfit(&self, a: &State, b: &State) -> f64 {
        let surface = Surface::new(self);
        let loss = surface.loss();
        (a.traction - b.traction)
            .amax()
            .max((a.own[WORK] - b.own[WORK]).abs() * loss)
            .max((a.jump - b.jump).amax() * loss * surface.scale())
    }

    /// The bound of the local error of a second-order step under this tolerance [stress].
    pub(super) fn local_bound(&self, tolerance: f64) -> f64 {
        control::local_bound(&Surface::new(self), tolerance)
    }
}

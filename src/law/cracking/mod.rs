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

mod answer;
mod check;
mod control;
mod crack;
mod elastic;
mod facet;
mod flow;
mod initial;
mod lagged;
mod march;
mod mode;
mod nested;
mod newton;
mod parameters;
mod prediction;
mod stage;
mod stage_slopes;
mod sub_steps;
mod surface;
mod tangent;
mod ties;
mod variables;
mod way;

pub use parameters::{Cracking, Unloading};
use variables::VARIABLES;
pub use variables::WORK;

use crack::Crack;
use elastic::stiff;
use facet::on_facet;
use march::step_nested;

use super::local::{Local, N, narrow, shear};
use super::variable::{LawVariable, OWN};
use super::{Inadmissible, Integration, PointLaw, Response, State, Strength, Unresolved};
use crate::error::Warning;
use answer::{held, march, march_euler, onset_of};
use control::Lengths;
use surface::Surface;

impl Cracking {
    /// Strength (χ, c, tanφ) once the work W has been spent.
    pub fn strength_after(&self, fracture_work: f64) -> Strength {
        let now = Surface::new(self).at(fracture_work);
        Strength { tensile_strength: now.chi, cohesion: now.c, tan_friction: now.t }
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

    /// An answer of a spent point with what a crack that closes knows of its gap.
    pub(super) fn with_gap(&self, mut answer: Response) -> Response {
        let surface = Surface::new(self);
        if surface.closes {
            Crack::spent(&surface, &answer.state).store(&surface, &mut answer.state);
        }
        answer
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
}

impl PointLaw for Cracking {
    fn all_variables() -> &'static [LawVariable] {
        &VARIABLES
    }

    /// Variables of the law; the published one has W alone.
    fn variables(&self) -> &'static [LawVariable] {
        match self.unloading {
            Unloading::Closing => &VARIABLES,
            Unloading::Plastic => &VARIABLES[..=WORK],
        }
    }

    fn check(&self) -> Result<(), Inadmissible> {
        self.admit()
    }

    fn warnings(&self) -> Vec<Warning> {
        self.doubts()
    }

    fn elastic_stiffness(&self) -> [f64; 3] {
        [self.normal_stiffness, self.tangential_stiffness, self.tangential_stiffness]
    }

    fn respond(&self, jump: Local, old: &State, integration: Integration) -> Result<Response, Unresolved> {
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

    fn respond_lagged(
        &self,
        jump: Local,
        old: &State,
        integration: Integration,
        all: bool,
    ) -> Result<Response, Unresolved> {
        lagged::answer(self, jump, old, integration, all)
    }

    fn held(&self, jump: Local, old: &State) -> (Local, [f64; 3]) {
        let (traction, [normal, tangential]) = held::<3>(&Surface::new(self), jump, old);
        (traction, [normal, tangential, tangential])
    }

    /// Stored energy [stress × length]: that of the elastic law, ties across a crack included.
    fn stored(&self, state: &State) -> f64 {
        let surface = Surface::new(self);
        let tau = shear(&state.traction);
        Crack::of(&surface, state).energy(&surface, state.traction[N]) + 0.5 * tau * tau / surface.kt
    }

    fn damage(&self, state: &State) -> Option<f64> {
        Some(Surface::new(self).damage(state.own[WORK]))
    }

    fn intact(&self) -> [f64; OWN] {
        let (surface, mut state) = (Surface::new(self), State::default());
        Crack::closed(&surface).store(&surface, &mut state);
        state.own
    }

    fn takes_damage(&self) -> bool {
        true
    }

    /// Opened under tension until that share is spent, and closed again.
    fn lost(&self, share: f64) -> Option<[f64; OWN]> {
        initial::opened_and_closed(self, share)
    }

    /// The irreversible jump is d of a crack that closes.
    fn at_rest(&self, jump: Local, jump_plastic: Local, own: &[f64; OWN]) -> Local {
        let surface = Surface::new(self);
        let elastic = jump - jump_plastic;
        let mut traction = stiff(&surface, elastic);
        if surface.closes {
            // intact up to the place where the faces touch
            let state = State { jump: jump_plastic, jump_plastic, own: *own, ..State::default() };
            let crack = Crack::of(&surface, &state);
            traction[N] = match surface.is_spent(own[WORK]) && elastic[N] > 0.0 {
                true => 0.0,
                false => crack.predict(&surface, traction[N], true).sigma,
            };
        }
        traction
    }

    /// The hyperbola F once the work W has been spent.
    fn excess(&self, traction: &Local, own: &[f64; OWN]) -> f64 {
        Surface::new(self).at(own[WORK]).hyperbola(traction[N], shear(traction))
    }

    fn strength(&self, state: &State) -> Option<Strength> {
        Some(self.strength_after(state.own[WORK]))
    }

    fn steepest_softening(&self) -> f64 {
        self.softens()
    }

    fn onset_or_on(&self, jump: Local, old: &State) -> Option<f64> {
        match old.is_plane(&jump) {
            true => onset_of::<2>(&Surface::new(self), narrow(&jump), old),
            false => onset_of::<3>(&Surface::new(self), jump, old),
        }
    }

    fn is_integrated(&self) -> bool {
        true
    }

    fn dilates(&self) -> bool {
        self.dilatancy_stress > 0.0
    }

    fn closes(&self) -> bool {
        self.unloading == Unloading::Closing
    }

    /// Distance of two states, as an error of the traction [stress]: in traction, strength and jump.
    fn misfit(&self, a: &State, b: &State) -> f64 {
        let surface = Surface::new(self);
        let loss = surface.loss();
        (a.traction - b.traction)
            .amax()
            .max((a.own[WORK] - b.own[WORK]).abs() * loss)
            .max((a.jump - b.jump).amax() * loss * surface.scale())
    }

    fn local_bound(&self, tolerance: f64) -> Option<f64> {
        Some(control::local_bound(&Surface::new(self), tolerance))
    }
}

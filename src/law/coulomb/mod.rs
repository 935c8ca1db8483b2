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
//! In space slip goes along the shear that would be there had nothing slipped: a way is followed in the plane of the normal
//! and that direction. This is exact where the shear keeps its direction, and of first order in its turn where it does not.
//!
//! With a closure σ is a hyperbola of r_n − r_n^p (`law::closure`), and slip may stop within a way (`slide`).
//!
//! An initial gap g is r_n^p = −g at the start: the jump at which the faces meet. Not in the paper, which only names
//! friction laws (§3.2); classical otherwise.

mod faces;
mod jet;
mod lagged;
mod normal;
mod parameters;
mod slide;
mod turned;
mod way;

pub use parameters::{Coulomb, LossOfCohesion};

use nalgebra::Vector2;

use super::admissible::{Inadmissible, error_at, not_negative, positive};
use super::closure::Springs;
use super::elastic::springs_under;
use super::local::{Local, N, shear};
use super::{Integration, LawVariable, OWN, PointLaw, Response, State, Strength, Unresolved};

use faces::Faces;
use parameters::{LOST, SLIP_TOTAL, VARIABLES};
use turned::Turned;

/// Status of a closed point that does not slide.
const STICK: u8 = 0;
/// Status of a closed point that slides.
const SLIP: u8 = 2;
/// Status of an open point.
const OPEN: u8 = 4;

impl PointLaw for Coulomb {
    fn all_variables() -> &'static [LawVariable] {
        &VARIABLES
    }

    /// Those that its keys ask for.
    fn variables(&self) -> &'static [LawVariable] {
        match (self.dilatancy_end.is_some(), self.cohesion_lost) {
            (true, LossOfCohesion::AtSlip) => &VARIABLES,
            (true, LossOfCohesion::Never) => &VARIABLES[..LOST],
            (false, LossOfCohesion::AtSlip) => &VARIABLES[LOST..],
            (false, LossOfCohesion::Never) => &[],
        }
    }

    /// Stiffnesses above zero; friction, cohesion and dilatancy zero or more; dilatancy at most the friction.
    fn check(&self) -> Result<(), Inadmissible> {
        Springs::check(self.normal_stiffness, self.closure, positive)?;
        positive("tangential_stiffness", self.tangential_stiffness)?;
        not_negative("friction_coefficient", self.friction_coefficient)?;
        not_negative("cohesion", self.cohesion)?;
        not_negative("dilatancy", self.dilatancy)?;
        if let Some(end) = self.dilatancy_end {
            positive("dilatancy_end", end)?;
        }
        if self.dilatancy > self.friction_coefficient {
            return error_at(
                "dilatancy",
                format!("dilatancy {} > friction_coefficient {}", self.dilatancy, self.friction_coefficient),
                "sliding would create energy; lower the dilatancy or raise the friction",
            );
        }
        Ok(())
    }

    fn elastic_stiffness(&self) -> [f64; 3] {
        [self.normal().initial(), self.tangential_stiffness, self.tangential_stiffness]
    }

    fn narrowest(&self) -> f64 {
        self.normal().narrowest()
    }

    fn jump_under(&self, traction: &Local) -> Local {
        springs_under(&self.normal(), self.tangential_stiffness, traction)
    }

    fn held(&self, jump: Local, old: &State) -> (Local, [f64; 3]) {
        let kt = self.tangential_stiffness;
        let (sigma, slope) = match self.closure {
            Some(_) => self.normal().answer(jump[N] - old.jump_plastic[N]),
            None => {
                let kn = self.normal().initial();
                (old.traction[N] + kn * (jump[N] - old.jump[N]), kn)
            }
        };
        let sheared = old.traction + (jump - old.jump) * kt;
        (Local::new(sigma, sheared.y, sheared.z), [slope, kt, kt])
    }

    fn stored(&self, state: &State) -> f64 {
        self.normal().stored(state.traction[N]) + self.shear_energy(shear(&state.traction))
    }

    fn takes_gap(&self) -> bool {
        true
    }

    fn strength(&self, state: &State) -> Option<Strength> {
        let (cohesion, tan_friction) = (Faces::of(self, &state.own).law.cohesion, self.friction_coefficient);
        Some(Strength { tensile_strength: 0.0, cohesion, tan_friction })
    }

    /// Excess over the surface |τ| ≤ c − μ σ, σ ≤ 0.
    fn excess(&self, traction: &Local, own: &[f64; OWN]) -> f64 {
        let sigma = traction[N];
        let cohesion = Faces::of(self, own).law.cohesion;
        sigma.max(shear(traction) + self.friction_coefficient * sigma - cohesion)
    }

    /// Open faces carry nothing.
    fn at_rest(&self, jump: Local, jump_plastic: Local, _: &[f64; OWN]) -> Local {
        let elastic = jump - jump_plastic;
        match elastic[N] > 0.0 {
            true => Local::zeros(),
            false => {
                let sheared = elastic * self.tangential_stiffness;
                Local::new(self.normal().answer(elastic[N]).0, sheared.y, sheared.z)
            }
        }
    }

    /// Open, stick or slip at the end of the straight way from the old jump.
    fn respond(&self, jump: Local, old: &State, _: Integration) -> Result<Response, Unresolved> {
        let turned = Turned::new(jump, old);
        let faces = Faces::of(self, &old.own);
        let end =
            way::follow(&faces, turned.plane(old.jump), turned.plane(old.jump_plastic), turned.plane(jump))
                .ok_or(Unresolved::Closed { jump, narrowest: self.narrowest() })?;
        let mut own = old.own;
        if self.dilatancy_end.is_some() {
            own[SLIP_TOTAL] += end.slip;
        }
        if self.cohesion_lost == LossOfCohesion::AtSlip && end.loosened {
            own[LOST] = 1.0;
        }
        let [sigma, tau] = end.traction;
        let traction = turned.space(Vector2::new(sigma.value, tau.value));
        let jump_plastic = turned.irreversible(end.jump_plastic, jump);
        Ok(Response {
            traction,
            stiffness: turned.stiffness(&end.traction),
            state: State { jump, traction, jump_plastic, own, status: end.status },
            dissipation: end.dissipation.value,
            dissipation_gradient: turned.space(end.dissipation.gradient),
            damage_gradient: Local::zeros(),
            released: end.released,
        })
    }

    fn respond_lagged(
        &self,
        jump: Local,
        old: &State,
        integration: Integration,
        _: bool,
    ) -> Result<Response, Unresolved> {
        match self.dilatancy == 0.0 && self.cohesion_lost == LossOfCohesion::Never {
            true if self.normal().reach(jump[N] - old.jump_plastic[N]) => Ok(lagged::answer(self, jump, old)),
            _ => self.respond(jump, old, integration),
        }
    }
}

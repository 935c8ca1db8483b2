//! The answer of a viscous step: friction lags by one step where it has no bounded slope.
//!
//! ```text
//! σ = min(K_N (r_n − r_n^p), 0)        τ = the law's own at (old r_n, r_t) if σ_old < 0, else 0
//! ```
//!
//! At a point without tensile strength the hyperbola has its vertex at the origin, τ_y ~ √(2 c tanφ |σ|): its slope has no
//! bound, and between stick and open there is no equilibrium with a positive Jacobian. With the shear limit of the step before,
//! a step is contact and a given limit, which is monotone. Steps get small, so what the lag changes goes away with them, and
//! what is stored is an equilibrium of the law itself. Frictional contact (`coulomb`) lags alike.

use nalgebra::{Matrix2, Vector2};

use super::coulomb::OPEN;
use super::{Coulomb, Cracking, Integration, Law, Response, State, Unresolved};

/// Part of G_I that counts as all of it.
const SPENT: f64 = 1.0 - 1e-9;
/// Statuses of what slides, and of what is free of stress.
const SLIPS: u8 = 2;
const FREE: u8 = 4;

impl Law {
    /// The answer at a jump with friction lagged where its slope has no bound, or with `all` where it is steep; the law's own
    /// elsewhere. Dilatancy lags alike.
    pub fn respond_lagged(
        &self,
        jump: Vector2<f64>,
        old: &State,
        integration: Integration,
        all: bool,
    ) -> Result<Response, Unresolved> {
        match self {
            Law::Cracking(law) if all && (old.traction.x < 0.0 || !law.is_spent(old, SPENT)) => {
                let answer = law.respond_on_facet(jump, old);
                Ok(match answer.traction.x >= 0.0 && law.is_spent(old, SPENT) {
                    true => parted(law.tangential_stiffness, answer),
                    false => answer,
                })
            }
            Law::Cracking(law) if law.is_spent(old, SPENT) && (all || law.dilatancy_stress == 0.0) => {
                let own = law.respond(Vector2::new(old.jump.x, jump.y), old, integration)?;
                let parted = old.jump_plastic.x.max(jump.x);
                Ok(lagged(self.elastic_stiffness(), jump, old, &own, old.traction.x < 0.0, parted))
            }
            Law::Coulomb(law) if law.dilatancy == 0.0 => {
                let own = law.at_limit(jump, old);
                let parted = old.jump_plastic.x;
                Ok(lagged(self.elastic_stiffness(), jump, old, &own, old.status != OPEN, parted))
            }
            _ => self.respond(jump, old, integration),
        }
    }
}

/// An answer at no normal traction: what is left of the shear pushes in this step and is lost with it.
fn parted(kt: f64, mut answer: Response) -> Response {
    let tau = answer.traction.y;
    answer.released = 0.5 * tau * tau / kt;
    answer.state.traction.y = 0.0;
    answer.state.jump_plastic.y += tau / kt;
    answer.state.status = FREE;
    answer
}

impl Cracking {
    /// This part of the tensile strength's energy is spent, or there is none.
    fn is_spent(&self, old: &State, part: f64) -> bool {
        self.tensile_strength == 0.0 || old.fracture_work >= part * self.fracture_energy_i
    }
}

impl Coulomb {
    /// The shear that the normal traction of the old state allows.
    fn at_limit(&self, jump: Vector2<f64>, old: &State) -> Response {
        let kt = self.tangential_stiffness;
        let trial = kt * (jump.y - old.jump_plastic.y);
        let limit = self.cohesion - self.friction_coefficient * old.traction.x;
        let slides = trial.abs() > limit;
        let tau = trial.clamp(-limit, limit);
        let d = Matrix2::new(0.0, 0.0, 0.0, if slides { 0.0 } else { kt });
        let spent = limit * (trial - tau).abs() / kt;
        let gradient = Vector2::new(0.0, if slides { tau } else { 0.0 });
        Response {
            traction: Vector2::new(0.0, tau),
            stiffness: d,
            state: *old,
            dissipation: spent,
            dissipation_gradient: gradient,
            released: 0.0,
        }
    }
}

/// The lagged answer from the shear part of another; `parted`: irreversible opening of a point that is open.
fn lagged(
    [kn, kt]: [f64; 2],
    jump: Vector2<f64>,
    old: &State,
    own: &Response,
    was_closed: bool,
    parted: f64,
) -> Response {
    let sigma = (kn * (jump.x - old.jump_plastic.x)).min(0.0);
    let closed = sigma < 0.0;
    let tau = if was_closed { own.traction.y } else { 0.0 };
    let keep = |value: f64| if was_closed { value } else { 0.0 };
    let (kept_tau, released) = if closed { (tau, 0.0) } else { (0.0, 0.5 * tau * tau / kt) };
    let dilated = keep((own.state.jump_plastic.x - old.jump_plastic.x).max(0.0));
    let opened = if closed { old.jump_plastic.x + dilated } else { parted };
    let kept_sigma = if closed { (kn * (jump.x - opened)).min(0.0) } else { 0.0 };
    Response {
        traction: Vector2::new(sigma, tau),
        stiffness: Matrix2::new(if closed { kn } else { 0.0 }, 0.0, 0.0, keep(own.stiffness.m22)),
        state: State {
            jump,
            traction: Vector2::new(kept_sigma, kept_tau),
            jump_plastic: Vector2::new(opened, jump.y - kept_tau / kt),
            fracture_work: if was_closed { own.state.fracture_work } else { old.fracture_work },
            status: if closed { SLIPS } else { FREE },
        },
        dissipation: keep(own.dissipation),
        dissipation_gradient: Vector2::new(0.0, keep(own.dissipation_gradient.y)),
        released,
    }
}

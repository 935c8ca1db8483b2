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

use super::closure::Springs;
use super::local::{Local, LocalMatrix, N, S, T};
use super::{Response, State};

/// Statuses of what slides, and of what is free of stress.
const SLIPS: u8 = 2;
const FREE: u8 = 4;

/// An answer at no normal traction: what is left of the shear pushes in this step and is lost with it.
pub(super) fn parted(kt: f64, mut answer: Response) -> Response {
    let tau = tangential(answer.traction);
    answer.released = 0.5 * tau.norm_squared() / kt;
    answer.state.traction -= tau;
    answer.state.jump_plastic += tau / kt;
    answer.state.status = FREE;
    answer
}

/// (n, t, s) with t and s of a vector.
fn with_normal(n: f64, v: Local) -> Local {
    Local::new(n, v[T], v[S])
}

/// (0, t, s) of a vector.
pub(super) fn tangential(v: Local) -> Local {
    with_normal(0.0, v)
}

/// The lagged answer from the shear part of another, with the springs of closed faces; `parted`: irreversible opening of a point that is open.
pub(super) fn lagged(
    (springs, kt): (Springs, f64),
    jump: Local,
    old: &State,
    own: &Response,
    was_closed: bool,
    parted: f64,
) -> Response {
    let pressed = |opened: f64| springs.answer((jump[N] - opened).min(0.0));
    let (sigma, kn) = pressed(old.jump_plastic[N]);
    let closed = sigma < 0.0;
    let keep = |value: f64| if was_closed { value } else { 0.0 };
    let tau = if was_closed { tangential(own.traction) } else { Local::zeros() };
    let (kept_tau, released) =
        if closed { (tau, 0.0) } else { (Local::zeros(), 0.5 * tau.norm_squared() / kt) };
    let dilated = keep((own.state.jump_plastic[N] - old.jump_plastic[N]).max(0.0));
    let opened = if closed { old.jump_plastic[N] + dilated } else { parted };
    let kept_sigma = if closed { pressed(opened).0 } else { 0.0 };
    let mut stiffness = if was_closed { own.stiffness } else { LocalMatrix::zeros() };
    stiffness.row_mut(N).fill(0.0);
    stiffness.column_mut(N).fill(0.0);
    stiffness[(N, N)] = if closed { kn } else { 0.0 };
    Response {
        traction: with_normal(sigma, tau),
        stiffness,
        state: State {
            jump,
            traction: with_normal(kept_sigma, kept_tau),
            jump_plastic: with_normal(opened, jump - kept_tau / kt),
            own: if was_closed { own.state.own } else { old.own },
            status: if closed { SLIPS } else { FREE },
        },
        dissipation: keep(own.dissipation),
        dissipation_gradient: tangential(own.dissipation_gradient) * keep(1.0),
        damage_gradient: tangential(own.damage_gradient) * keep(1.0),
        released,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spring of 10 that carries a shear of 3 and 4 has stored ½ 5²/10; the state lets go of it and moves to where it is at rest.
    #[test]
    fn a_point_that_parts_loses_what_its_springs_have_stored() {
        let traction = Local::new(0.0, 3.0, 4.0);
        let state = State { traction, jump_plastic: Local::new(0.1, 0.2, 0.3), ..State::default() };
        let answer = Response {
            traction,
            stiffness: LocalMatrix::zeros(),
            state,
            dissipation: 0.0,
            dissipation_gradient: Local::zeros(),
            damage_gradient: Local::zeros(),
            released: 0.0,
        };
        let Response { state, released, .. } = parted(10.0, answer);
        assert!((released - 1.25).abs() < 1e-15, "{released}");
        assert!((state.jump_plastic - Local::new(0.1, 0.5, 0.7)).norm() < 1e-15);
        assert_eq!((state.traction, state.status), (Local::zeros(), FREE));
    }
}

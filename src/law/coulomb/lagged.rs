//! The answer of a viscous step without dilatancy (`law::lagged`).

use super::super::lagged::{lagged, tangential};
use super::super::local::{Local, N, across, diagonal, direction, shear};
use super::super::{Response, State};
use super::{Coulomb, OPEN};

/// Friction lags by a step.
pub(super) fn answer(law: &Coulomb, jump: Local, old: &State) -> Response {
    let own = at_limit(law, jump, old);
    lagged((law.normal(), law.tangential_stiffness), jump, old, &own, old.status != OPEN, old.jump_plastic.x)
}

/// The shear that the normal traction of the old state allows.
fn at_limit(law: &Coulomb, jump: Local, old: &State) -> Response {
    let kt = law.tangential_stiffness;
    let trial = tangential(jump - old.jump_plastic) * kt;
    let limit = law.cohesion - law.friction_coefficient * old.traction[N];
    let (size, e) = (shear(&trial), direction(&trial));
    let slides = size > limit;
    let tau = if slides { e * limit } else { trial };
    let d = if slides { across(&e) * (limit / size * kt) } else { diagonal(0.0, kt) };
    let spent = limit * (size - shear(&tau)).abs() / kt;
    Response {
        traction: tau,
        stiffness: d,
        state: *old,
        dissipation: spent,
        dissipation_gradient: if slides { tau } else { Local::zeros() },
        damage_gradient: Local::zeros(),
        released: 0.0,
    }
}

//! The answer of a viscous step (`law::lagged`).

use super::super::closure::Springs;
use super::super::lagged::{lagged, parted};
use super::super::local::{Local, N, S, T};
use super::super::{Integration, PointLaw, Response, State, Unresolved};
use super::parameters::{Cracking, Unloading};
use super::variables::WORK;

/// Part of G_I that counts as all of it.
const SPENT: f64 = 1.0 - 1e-9;

/// Friction lags where nothing ties the faces and, with `all`, dilatancy too wherever the point is pressed or not spent.
pub(super) fn answer(
    law: &Cracking,
    jump: Local,
    old: &State,
    integration: Integration,
    all: bool,
) -> Result<Response, Unresolved> {
    let is_spent = law.tensile_strength == 0.0 || old.own[WORK] >= SPENT * law.fracture_energy_i;
    if all && (old.traction.x < 0.0 || !is_spent) {
        let answer = law.respond_on_facet(jump, old);
        return Ok(match answer.traction[N] >= 0.0 && is_spent {
            true => law.with_gap(parted(law.tangential_stiffness, answer)),
            false => answer,
        });
    }
    if is_spent && (all || law.dilatancy_stress == 0.0) {
        let own = law.respond(Local::new(old.jump[N], jump[T], jump[S]), old, integration)?;
        let parted = match law.unloading {
            Unloading::Closing => old.jump_plastic.x, // the gap is remembered
            Unloading::Plastic => old.jump_plastic.x.max(jump.x),
        };
        let springs = (Springs::Linear(law.normal_stiffness), law.tangential_stiffness);
        let answer = lagged(springs, jump, old, &own, old.traction.x < 0.0, parted);
        return Ok(law.with_gap(answer));
    }
    law.respond(jump, old, integration)
}

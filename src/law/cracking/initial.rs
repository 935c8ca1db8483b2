//! Cracks that are there at the start.

use super::super::local::Local;
use super::super::variable::OWN;
use super::super::{Integration, PointLaw, State};
use super::parameters::{Cracking, Unloading};
use super::variables::WORK;

/// Tolerance of the way there.
const TOLERANCE: Integration = Integration::Tolerance(1e-8);
/// Halvings of a bracket; doublings before it.
const HALVINGS: usize = 60;
const DOUBLINGS: usize = 60;

/// Variables of a point that was opened under tension until a share of G_I, of G_II where there is no tensile strength, was
/// spent, and was closed again.
pub(super) fn opened_and_closed(law: &Cracking, share: f64) -> Option<[f64; OWN]> {
    let own = law.intact();
    if law.tensile_strength == 0.0 || law.unloading == Unloading::Plastic {
        let energy = if law.tensile_strength > 0.0 { law.fracture_energy_i } else { law.fracture_energy_iia };
        let mut own = own;
        own[WORK] = share * energy;
        return Some(own);
    }
    let start = State { own, ..State::default() };
    let open = |jump: f64| {
        law.respond(Local::new(jump, 0.0, 0.0), &start, TOLERANCE).ok().map(|answer| answer.state)
    };
    let wanted = share * law.fracture_energy_i;
    let (mut low, mut high) = (0.0, law.fracture_energy_i / law.tensile_strength);
    for _ in 0..DOUBLINGS {
        if open(high)?.own[WORK] >= wanted {
            break;
        }
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if open(middle)?.own[WORK] < wanted { low = middle } else { high = middle }
    }
    let closed = law.respond(Local::zeros(), &open(high)?, TOLERANCE).ok()?;
    Some(closed.state.own)
}

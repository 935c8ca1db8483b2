//! Interfaces that nothing holds: what keeps the Jacobian regular, and keeps their sides from touching by rounding.

use super::evaluation::Evaluation;
use super::{Form, Respond};

/// A point that resists less than this part of its intact stiffness counts as if it did in the Jacobian: what nothing holds
/// and nothing pushes then stays where it is.
pub(super) const FREE: f64 = 1e-12;
/// The same part where no point of an interface resists an opening; its sides are moved apart at first by the second one of the
/// largest jump: rounding must not make them touch.
pub(super) const LOOSE: f64 = 1e-10;
const APART: f64 = 1e-7;

/// Stiffnesses of the law points of an interface before anything has cracked or slipped, by rows.
pub(super) fn intact<L: Respond>(form: &impl Form, laws: &L, k: usize) -> Vec<f64> {
    let coupling = &form.interfaces()[k].coupling;
    let c = coupling.components;
    let mut intact = vec![0.0; c * c * coupling.points.len()];
    intact.chunks_exact_mut(c * c).enumerate().for_each(|(p, d)| laws.initial_stiffness(k, p, d));
    intact
}

/// True if no point of an interface of c components resists an opening.
pub(super) fn opens_freely(stiffness: &[f64], intact: &[f64], c: usize) -> bool {
    stiffness.iter().zip(intact).step_by(c * c).all(|(d, intact)| d.abs() < FREE * intact)
}

/// The forces of the interfaces, with a push on those that do not resist it; none if all do.
pub(super) fn moved_apart<L: Respond>(
    form: &impl Form,
    laws: &L,
    now: &Evaluation<L::Memory>,
) -> Option<Vec<Vec<f64>>> {
    let (mut forces, mut any) = (now.forces.clone(), false);
    for (a, &k) in form.active().iter().enumerate() {
        let interface = &form.interfaces()[k];
        let c = interface.coupling.components;
        let intact = intact(form, laws, k);
        if !opens_freely(&now.stiffness[a], &intact, c) {
            continue;
        }
        any = true;
        let largest = now.jumps[a].iter().fold(0.0_f64, |most, jump| most.max(jump.abs()));
        let mut push = vec![0.0; now.jumps[a].len()];
        let normal = intact.iter().step_by(c * c);
        push.iter_mut().step_by(c).zip(normal).for_each(|(push, k)| *push = -LOOSE * k * APART * largest);
        forces[a].iter_mut().zip(interface.gather(&push)).for_each(|(force, push)| *force += push);
    }
    any.then_some(forces)
}

//! Equilibria that are none: a body that nothing holds goes anywhere, and forces that cancel there hide what is left.

use super::analysis::Analysis;
use super::converged::Converged;
use super::loading::StepLoad;
use crate::law::{Local, State};

/// True if what has converged is none: a point has slid or opened by more than its interface is long, though nothing that is prescribed
/// has moved so far. Springs may be as soft as they like.
pub(super) fn is_nowhere(
    found: &Converged,
    [now, then]: [&StepLoad; 2],
    Analysis { problem, state, .. }: &Analysis,
) -> bool {
    let (before, step) = (&state.snapshot, then.at().0);
    let beyond = |prescribed: f64| {
        found.interfaces.iter().any(|of| {
            let k = of.interface;
            let length = problem.model.interfaces[k].coupling.midplane.length;
            let loose = |p: usize, state: &State| {
                state.jump - problem.interfaces[k].laws.at(p).jump_under(&state.traction)
            };
            let ways = before.states[k].iter().zip(&of.memory).enumerate();
            ways.map(|(p, (old, new))| (loose(p, &new.state) - loose(p, old)).norm())
                .any(|way| way > length + prescribed)
        })
    };
    // forces are made where they are needed
    beyond(0.0) && {
        let ways = now.forces().prescribed.iter().zip(&then.forces().prescribed).zip(&step.constrained);
        let most = ways.filter(|(_, held)| **held).map(|((a, b), _)| (b - a).abs()).fold(0.0, f64::max);
        beyond(2.0 * most)
    }
}

/// The longest way of any point from the jumps before to those now [length].
pub(super) fn farthest(before: &[Local], now: &[Local]) -> f64 {
    before.iter().zip(now).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max)
}

//! Equilibria that are none: a body that nothing holds goes anywhere, and forces that cancel there hide what is left.

use super::analysis::Analysis;
use super::converged::Converged;
use super::loading::StepLoad;
use crate::law::Local;

/// True if what has converged is none: a point has moved by more than its interface is long, though nothing that is prescribed has.
pub(super) fn is_nowhere(
    found: &Converged,
    [now, then]: [&StepLoad; 2],
    Analysis { problem, state, .. }: &Analysis,
) -> bool {
    let (before, step) = (&state.snapshot, then.at().0);
    let beyond = |prescribed: f64| {
        found.interfaces.iter().any(|of| {
            let length = problem.model.interfaces[of.interface].coupling.midplane.length;
            farthest(&before.jumps[of.interface], &of.jumps) > length + prescribed
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

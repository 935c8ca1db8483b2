//! Viscous tractions and their work.

use super::laws::Laws;
use crate::history::converged::PointResponse;
use crate::law::N;
use crate::solver::Iterate;

/// Viscous tractions of what was found, and the work that they do on the way there from those before: that of all tractions
/// along a straight way, less that of the laws' own by Simpson's rule. And the bend of the tractions of interfaces that
/// dilate or whose cracks close, √(Σ w |Δt|²).
pub(super) fn account(
    laws: &Laws,
    active: &[usize],
    before: &[Vec<f64>],
    iterate: &Iterate<PointResponse>,
) -> (Vec<Vec<f64>>, [f64; 2]) {
    let mut viscous = Vec::new();
    if laws.viscosity.is_none() && before.is_empty() {
        return (viscous, [0.0; 2]);
    }
    let problem = laws.problem;
    let components = problem.model.components;
    let (mut released, mut bent) = (0.0, 0.0);
    for (a, &k) in active.iter().enumerate() {
        let points = &problem.model.interfaces[k].coupling.points;
        let is_watched = problem.interfaces[k].laws.all().iter().any(|law| law.dilates() || law.closes());
        let mut now = Vec::with_capacity(components * points.len());
        for (p, (old, answer)) in laws.old.states[k].iter().zip(&iterate.memory[a]).enumerate() {
            // a traction that drops at the end of a step pushes on in the next
            let traction = |i: usize| {
                let pressure = if i == N { answer.pressure } else { 0.0 };
                iterate.tractions[a][components * p + i] + pressure
            };
            (0..components).for_each(|i| now.push(traction(i) - answer.state.traction[i]));
            let jump = answer.state.jump;
            let moved = jump - old.jump;
            let middle = 0.5 * (jump + old.jump);
            // a law that lags may drop at once
            let Ok(start) = laws.own(k, p, old.jump) else { continue };
            let Ok(middle) = laws.own(k, p, middle) else { continue };
            for i in 0..components {
                let before = before.get(a).map_or(0.0, |viscous| viscous[components * p + i]);
                let own = traction(i) - answer.viscous[i];
                // ½ (t₀ + t₁) − (t₀' + 4 t_m + t₁) / 6
                let bend = 0.5 * (old.traction[i] + own)
                    - (start.traction[i] + 4.0 * middle.traction[i] + own) / 6.0;
                bent += if is_watched { points[p].weight * bend * bend } else { 0.0 };
                released += points[p].weight * (0.5 * (before + answer.viscous[i]) + bend) * moved[i];
            }
        }
        if laws.viscosity.is_some() {
            viscous.push(now);
        }
    }
    (viscous, [problem.model.thickness * released, bent.sqrt()])
}

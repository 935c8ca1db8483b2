//! Water in the interfaces after an increment: pressures and rates, and the work that pressures do.
//!
//! ```text
//! work.water = Σ h w ½ (p₀ + p₁) Δr_n      over the accepted parts of all increments
//! ```

use crate::assembly::InterfaceOperator;
use crate::coupling::LawPoint;
use crate::law::{Local, N};
use crate::output::Snapshot;
use crate::problem::{Problem, StepWater, WaterFields, WaterPoint};

/// Water at a load factor of a step for the jumps and states of a snapshot.
pub(super) fn pressures_of(
    problem: &Problem,
    snapshot: &Snapshot,
    water: &StepWater,
    load_factor: f64,
) -> Result<WaterFields, String> {
    let point = |k: usize, p: usize| -> WaterPoint {
        let state = snapshot.states[k].get(p);
        let damage = state.and_then(|state| problem.interfaces[k].laws.at(p).damage(state));
        WaterPoint {
            jump: snapshot.jumps[k][p],
            damage: damage.unwrap_or(0.0),
            damage_gradient: Local::zeros(),
        }
    };
    Ok(water.answer(&problem.model, load_factor, &point, false)?.fields)
}

/// The water of a snapshot in a step at a load factor; none without any.
pub(super) fn water_at(problem: &Problem, snapshot: &Snapshot, at: (usize, f64)) -> WaterFields {
    let water = problem.steps.get(at.0).and_then(|step| step.water.as_deref());
    // what has no value was refused before it was accepted
    water.and_then(|water| pressures_of(problem, snapshot, water, at.1).ok()).unwrap_or_default()
}

/// Work of the pressures in a part: that of all, and that of those which depend on the jumps and are no loads.
pub(super) fn water_work(
    problem: &Problem,
    before: (&WaterFields, &[Vec<Local>]),
    now: (&WaterFields, &[Vec<Local>]),
) -> [f64; 2] {
    let mut work = [0.0; 2];
    let interfaces = problem.model.interfaces.iter().zip(&problem.interfaces).enumerate();
    for (k, (operator, bound)) in interfaces {
        let none = Vec::new();
        let [p, q] = [before.0, now.0].map(|water| water.pressures.get(k).unwrap_or(&none));
        if p.is_empty() && q.is_empty() {
            continue;
        }
        let own = mean_work(operator, [p, q], [&before.1[k], &now.1[k]]);
        work[0] += problem.model.thickness * own;
        work[1] += if bound.coupled_pressure { problem.model.thickness * own } else { 0.0 };
    }
    work
}

fn mean_work(operator: &InterfaceOperator, pressures: [&Vec<f64>; 2], jumps: [&Vec<Local>; 2]) -> f64 {
    let value = |of: &Vec<f64>, p: usize| of.get(p).copied().unwrap_or(0.0);
    let at = |(p, point): (usize, &LawPoint)| {
        let mean = 0.5 * (value(pressures[0], p) + value(pressures[1], p));
        point.weight * mean * (jumps[1][p][N] - jumps[0][p][N])
    };
    operator.coupling.points.iter().enumerate().map(at).sum()
}

//! Energies of an increment, dissipation and external work, and what the interfaces carry.

use super::converged::{Converged, InterfaceResponse};
use super::loading::{LoadForces, StepLoad};
use crate::assembly::{InterfaceOperator, Model};
use crate::coupling::LawPoint;
use crate::law::{self, Local};
use crate::output::Snapshot;
use crate::problem::Problem;
use crate::solver::NodalSolution;

/// Energy that an increment dissipates [force × length].
pub(super) fn dissipation(problem: &Problem, found: &Converged) -> f64 {
    let of = |answer: &InterfaceResponse| {
        let points = problem.model.interfaces[answer.interface].coupling.points.iter().zip(&answer.memory);
        points.map(|(point, memory)| point.weight * memory.dissipation).sum::<f64>()
    };
    problem.model.thickness * found.interfaces.iter().map(of).sum::<f64>()
}

/// Mean square of their tractions times length [stress² × length].
pub(super) fn carried(problem: &Problem, snapshot: &Snapshot) -> f64 {
    let interfaces = problem.model.interfaces.iter().zip(&snapshot.states);
    let of = |(interface, states): (&InterfaceOperator, &Vec<law::State>)| {
        let points = interface.coupling.points.iter().zip(states);
        points.map(|(point, state)| point.weight * state.traction.norm_squared()).sum::<f64>()
    };
    interfaces.map(of).sum()
}

/// Mean square of the tractions found, times length [stress² × length].
pub(super) fn carried_after(problem: &Problem, found: &Converged) -> f64 {
    let of = |answer: &InterfaceResponse| {
        let points = problem.model.interfaces[answer.interface].coupling.points.iter().zip(&answer.memory);
        points.map(|(point, memory)| point.weight * memory.state.traction.norm_squared()).sum::<f64>()
    };
    found.interfaces.iter().map(of).sum()
}

/// Change of the tractions that an increment brings, measured alike.
pub(super) fn change(problem: &Problem, snapshot: &Snapshot, found: &Converged) -> f64 {
    let of = |answer: &InterfaceResponse| {
        let points = problem.model.interfaces[answer.interface].coupling.points.iter();
        let states = snapshot.states[answer.interface].iter().zip(&answer.memory);
        let change = |old: &law::State, new: &law::State| (new.traction - old.traction).norm_squared();
        points.zip(states).map(|(p, (old, new))| p.weight * change(old, &new.state)).sum::<f64>()
    };
    found.interfaces.iter().map(of).sum()
}

/// √(Σ w |Δr|²) of what was found, and that of open points that close.
pub(super) fn moved(problem: &Problem, snapshot: &Snapshot, found: &Converged) -> [f64; 2] {
    let mut squares = [0.0; 2];
    for answer in &found.interfaces {
        let points = problem.model.interfaces[answer.interface].coupling.points.iter();
        let states = snapshot.states[answer.interface].iter().zip(&answer.memory);
        for (point, (old, new)) in points.zip(states) {
            let moved = new.state.jump - old.jump;
            squares[0] += point.weight * moved.norm_squared();
            if old.traction.x == 0.0 && moved.x < 0.0 {
                squares[1] += point.weight * moved.x * moved.x;
            }
        }
    }
    squares.map(f64::sqrt)
}

/// ½ (f₀ + f₁) · Δu of loads and reactions.
pub(super) fn work_to(
    snapshot: &Snapshot,
    [before, reactions]: [&[f64]; 2],
    solution: &NodalSolution,
    load: &StepLoad,
) -> f64 {
    let LoadForces { force, released, .. } = load.forces();
    let at = |i: usize| {
        let before = before[i] + reactions[i];
        let now = force[i] + released[i] + solution.reactions[i];
        0.5 * (before + now) * (solution.u[i] - snapshot.u[i])
    };
    (0..solution.u.len()).map(at).sum()
}

/// Σ q · a of the interfaces that are not elastic.
pub(super) fn across(model: &Model, snapshot: &Snapshot) -> f64 {
    let interfaces = model.interfaces.iter().zip(&snapshot.jumps).zip(&snapshot.states);
    let points = interfaces
        .flat_map(|((interface, jumps), states)| interface.coupling.points.iter().zip(jumps).zip(states));
    let at = |((point, r), state): ((&LawPoint, &Local), &law::State)| {
        model.thickness * point.weight * state.traction.dot(r)
    };
    points.map(at).sum()
}

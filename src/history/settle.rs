//! Initial tractions before the first increment: forces of elastic interfaces, and the relaxation of what nothing holds.

use super::analysis::Analysis;
use super::equilibrium::{Ahead, Failure};
use super::failure::{no_equilibrium, unusable};
use super::loading::{LoadForces, Start};
use super::totals::Relaxed;
use crate::assembly::Model;
use crate::error::Result;
use crate::law::Local;
use crate::problem::{BoundInterface, BoundStep, Problem};

/// Initial tractions whose forces are out of balance by less than this part are so by rounding.
const ROUNDED: f64 = 1e-10;

/// Lets initial tractions, and those of overlaps, that supports and loads do not hold relax, before the first increment.
pub(super) fn settle(analysis: &mut Analysis, step: &BoundStep, start: &Start) -> Result<()> {
    let problem = analysis.problem;
    let mut tractions = vec![0.0; problem.model.dofs()];
    let mut sum = 0.0;
    let mut given = false;
    for (interface, BoundInterface { initial, states, .. }) in
        problem.model.interfaces.iter().zip(&problem.interfaces)
    {
        // faces that overlap press on each other without a traction of the scene
        let at = |p: usize| states.get(p).map_or(initial.at(p), |state| state.traction);
        let points = 0..interface.coupling.points.len();
        given |= points.clone().any(|p| initial.at(p) != Local::zeros());
        let at: Vec<f64> = leading(&problem.model, points.map(at));
        if at.iter().any(|t| *t != 0.0) {
            interface.add_force(&at, &mut tractions);
        }
    }
    sum += tractions.iter().map(|f| f.abs()).sum::<f64>();
    if sum == 0.0 {
        return Ok(());
    }
    let load = start.at(0.0)?;
    let LoadForces { force, released, .. } = load.forces();
    if let Some(prestress) = step.prestress_forces(&problem.model, 0.0) {
        tractions.iter_mut().zip(prestress).for_each(|(all, p)| *all += p);
    }
    // forces of what is not in equilibrium at the start, on free dofs
    let left: Vec<f64> = (0..tractions.len())
        .map(|i| if step.constrained[i] { 0.0 } else { force[i] + released[i] - tractions[i] })
        .collect();
    let rest = left.iter().map(|f| f.abs()).sum::<f64>() / sum;
    if rest <= ROUNDED {
        return Ok(());
    }
    analysis.clock.begin("solve");
    analysis.engine.prepare(None, &[]);
    analysis.state.open(None);
    let released = analysis.engine.solve(&analysis.state, &load, Ahead::default(), true);
    let found = released.map_err(|failure| match failure {
        Failure::Unconverged(why) => no_equilibrium(problem, step, 1, 0, 0.0, &why),
        Failure::Unusable(error) => unusable(step, 1, 0, error),
    })?;
    analysis.totals.iterations += found.iterations;
    let work = |u: &[f64]| 0.5 * left.iter().zip(u).map(|(f, u)| f * u).sum::<f64>();
    let released = found.solution.as_ref().map_or(0.0, |solution| work(&solution.u));
    analysis.engine.accept();
    analysis.state.accept(problem, found, load);
    analysis.state.released += released;
    analysis.state.recover(problem);
    analysis.totals.initial = if given { Relaxed { rest, released } } else { Relaxed::default() };
    Ok(())
}

/// Gᵀ Σ w Nᵀ Rᵀ t₀ of the initial tractions of elastic interfaces (paper eq. 12); other laws know theirs.
pub(super) fn initial_force(problem: &Problem) -> Vec<f64> {
    let mut force = vec![0.0; problem.model.dofs()];
    for (interface, BoundInterface { initial, states, .. }) in
        problem.model.interfaces.iter().zip(&problem.interfaces)
    {
        if states.is_empty() {
            let points = 0..interface.coupling.points.len();
            interface.add_force(&leading(&problem.model, points.map(|p| initial.at(p))), &mut force);
        }
    }
    force
}

/// Local vectors one after the other, with as many components as the model has.
fn leading(model: &Model, vectors: impl Iterator<Item = Local>) -> Vec<f64> {
    vectors.flat_map(|v| <[f64; 3]>::from(v).into_iter().take(model.components)).collect()
}

//! Checks of an increment that converged, and its place in the counts.

use super::analysis::Analysis;
use super::failure::unusable;
use super::increment::Increment;
use super::totals::NO_BALANCE;
use super::{Resultant, beyond, resultant};
use crate::error::{Error, Result};
use crate::problem::{BoundStep, is_constrained};

/// Rounding of forces, of those that the displacements would make.
const ROUNDING: f64 = 1e-11;

/// Recovers the fields of an increment that converged, checks and counts it.
pub(super) fn account(analysis: &mut Analysis, place: &mut Increment) -> Result<()> {
    analysis.clock.begin("recover");
    analysis.totals.iterations += place.iterations;
    analysis.state.recover(analysis.problem);
    if !(analysis.state.stored.is_finite() && analysis.state.work.is_finite()) {
        // every stress counts in these
        return Err(unusable(place.step, place.number, analysis.totals.increments, f64::INFINITY));
    }
    let imbalance = imbalance(analysis);
    if imbalance > NO_BALANCE {
        let reason = format!("loads and reactions are out of balance by {imbalance:.1e} of their sum");
        let (step, kept) = (place.step.name.clone(), analysis.totals.increments);
        return Err(Error::NoEquilibrium { step, increment: place.number, reason, kept });
    }
    analysis.totals.increments += 1;
    if imbalance > analysis.totals.imbalance {
        (analysis.totals.imbalance, analysis.totals.imbalance_at) = (imbalance, analysis.totals.increments);
    }
    note_unheld(analysis, place.step);
    beyond::note(analysis.problem, &analysis.state, analysis.totals.increments, &mut analysis.totals.beyond);
    if analysis.state.energy_balance().abs() > analysis.totals.energy_balance {
        analysis.totals.balance_at = analysis.totals.increments;
    }
    analysis.totals.released = analysis.state.released;
    analysis.totals.viscous = analysis.state.viscous_work(analysis.problem);
    analysis.totals.residual = analysis.totals.residual.max(analysis.state.residual);
    analysis.totals.energy_balance =
        analysis.totals.energy_balance.max(analysis.state.energy_balance().abs());
    place.increment = analysis.totals.increments;
    Ok(())
}

/// Out-of-balance of loads and reactions over the largest sum of their magnitudes so far; 0 where nothing but rounding acts,
/// and where displacements were not recovered.
fn imbalance(analysis: &mut Analysis) -> f64 {
    if analysis.state.force.is_empty() {
        return 0.0;
    }
    let model = &analysis.problem.model;
    let Resultant { rest, scale } = resultant(model, &analysis.state.force, &analysis.state.reactions);
    let young = model.subdomains.iter().map(|subdomain| subdomain.elasticity.young).fold(0.0, f64::max);
    let moved = analysis.state.snapshot.u.iter().map(|u| u.abs()).fold(0.0, f64::max);
    analysis.totals.forces = analysis.totals.forces.max(scale);
    let rounding = ROUNDING * young * moved * model.thickness;
    if rest > rounding { rest / analysis.totals.forces } else { 0.0 }
}

/// Notes the subdomains whose interfaces are all open and that the supports leave free.
fn note_unheld(analysis: &mut Analysis, step: &BoundStep) {
    let model = &analysis.problem.model;
    let states = &analysis.state.snapshot.states;
    let open = |k: usize| {
        !states[k].is_empty()
            && states[k].iter().all(|state| state.traction.x == 0.0 && state.traction.y == 0.0)
    };
    for (b, subdomain) in model.subdomains.iter().enumerate() {
        let mut of =
            (0..model.interfaces.len()).filter(|&k| model.interfaces[k].subdomains.contains(&b)).peekable();
        if of.peek().is_some()
            && of.all(open)
            && !analysis.totals.unheld.iter().any(|(name, _)| *name == subdomain.name)
            && !is_constrained(model, b, &step.constrained)
        {
            analysis.totals.unheld.push((subdomain.name.clone(), analysis.totals.increments));
        }
    }
}

//! Stresses beyond those of the strains in a state: loads that hold them, their work, what is written.

use crate::continuum::{Stresses, recover};
use crate::law::Local;
use crate::problem::Problem;

/// Step and load factor.
pub(super) type StepPlace = (usize, f64);

/// Loads and reactions that hold initial stresses; none where there are none.
pub(super) fn holding(problem: &Problem) -> Option<[Vec<f64>; 2]> {
    let step = problem.steps.first()?;
    let mut inside = step.prestress_forces(&problem.model, 0.0)?;
    let force = step.force(&problem.model, 0.0).ok()?;
    for (interface, bound) in problem.model.interfaces.iter().zip(&problem.interfaces) {
        let at = |p: usize| bound.states.get(p).map_or(bound.initial.at(p), |state| state.traction);
        let leading = |v: Local| <[f64; 3]>::from(v).into_iter().take(problem.model.components);
        let tractions: Vec<f64> = (0..interface.coupling.points.len()).flat_map(|p| leading(at(p))).collect();
        interface.add_force(&tractions, &mut inside);
    }
    let held = inside.iter().zip(&force).zip(&step.constrained);
    let reactions = held.map(|((p, f), constrained)| if *constrained { p - f } else { 0.0 }).collect();
    Some([force, reactions])
}

/// Work of what strains bodies by themselves between two states: −∫ σ : dε*, as ½ (u₀ + u₁) · Δp + Δ ½ ∫ ε*ᵀ C ε*.
pub(super) fn warmed(problem: &Problem, [from, to]: [StepPlace; 2], [before, now]: [&[f64]; 2]) -> f64 {
    if !problem.steps[to.0].warms() {
        return 0.0;
    }
    let nothing = || vec![0.0; now.len()];
    let [(forces_before, energy_before), (forces, energy)] = [from, to].map(|(step, load_factor)| {
        let step = &problem.steps[step];
        let forces = step.prestress_forces(&problem.model, load_factor).unwrap_or_else(nothing);
        (forces, step.own_strain_energy(load_factor))
    });
    let moved = before.iter().zip(now).zip(forces.iter().zip(&forces_before));
    moved.map(|((a, b), (p, before))| 0.5 * (a + b) * (p - before)).sum::<f64>() + energy - energy_before
}

/// Stresses of a subdomain, and what it has of its own.
pub(super) fn stresses(
    problem: &Problem,
    (step, load_factor): StepPlace,
    subdomain: usize,
    u: &[f64],
) -> Stresses {
    let (model, of) = (&problem.model, &problem.model.subdomains[subdomain]);
    let own = problem.steps.get(step).and_then(|step| step.prestress.get(subdomain)?.as_ref());
    let beyond = own.map(|own| own.at(load_factor));
    let u = &u[model.dofs_of(subdomain)];
    let stresses = recover(&of.mesh, u, &of.elasticity, model.thickness, beyond.as_deref());
    Stresses {
        temperatures: own.and_then(|own| own.temperatures(load_factor)),
        strains: own.and_then(|own| own.strains(load_factor)),
        ..stresses
    }
}

//! Linear functionals of displacements and reactions, prepared once per step: an increment whose fields are not stored then
//! costs nothing on the dofs of the bodies.
//!
//! ```text
//! c · u = c · u₀(λ) − (G K₀⁻¹ c) · e        r = K u + Gᵀ q − f:   c · r = (K₀ c) · u − c · f + (G c) · e
//! e = q − T₀ a        u₀(λ) = K₀⁻¹ f(λ), affine
//! ```

use super::refine::Factored;
use super::{Base, NodalSolution};

/// Loads and prescribed displacements that are affine in the load factor: their values at levels 0 and 1.
#[derive(Debug, Clone)]
pub struct Ramp {
    /// External forces [force].
    pub force: [Vec<f64>; 2],
    /// Displacements, read where held [length].
    pub prescribed: [Vec<f64>; 2],
}

impl Ramp {
    /// Forces and displacements at a load factor.
    pub fn at(&self, load_factor: f64) -> [Vec<f64>; 2] {
        [&self.force, &self.prescribed].map(|[start, end]| {
            start.iter().zip(end).map(|(start, end)| start + load_factor * (end - start)).collect()
        })
    }
}

/// A weighted sum over dofs.
#[derive(Debug, Clone)]
pub enum LinearMeasure {
    /// A measure of displacements.
    Displacement(Vec<(usize, f64)>),
    /// A measure of the reactions at held dofs; other dofs count nothing.
    Reaction(Vec<(usize, f64)>),
}

impl LinearMeasure {
    /// Its value for displacements and reactions.
    pub fn of(&self, solution: &NodalSolution) -> f64 {
        let (terms, values) = match self {
            LinearMeasure::Displacement(terms) => (terms, &solution.u),
            LinearMeasure::Reaction(terms) => (terms, &solution.reactions),
        };
        terms.iter().map(|&(dof, weight)| weight * values[dof]).sum()
    }
}

/// A measure on a condensed solution: value = ends, interpolated, + weights · e.
#[derive(Debug)]
pub(super) struct Functional {
    ends: [f64; 2],
    weights: Vec<f64>,
}

impl Functional {
    /// Prepares measures for base solutions at levels 0 and 1: one sweep through the factors for all of them.
    pub(super) fn all(
        base: &Base,
        active: &[usize],
        ramp: &Ramp,
        ends: &[NodalSolution],
        measures: &[LinearMeasure],
    ) -> Vec<Functional> {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let coefficients =
            |v: &[f64]| active.iter().flat_map(|&k| base.interfaces[k].coefficients(v)).collect();
        let nothing = vec![0.0; base.constrained().len()];
        let mut functionals = Vec::with_capacity(measures.len());
        let mut columns = Vec::new();
        for measure in measures {
            let mut c = nothing.clone();
            let mut functional = Functional { ends: [0.0; 2], weights: Vec::new() };
            match measure {
                LinearMeasure::Displacement(terms) => terms.iter().for_each(|&(dof, value)| c[dof] += value),
                LinearMeasure::Reaction(terms) => {
                    let constrained = terms.iter().filter(|(dof, _)| base.constrained()[*dof]);
                    constrained.for_each(|&(dof, value)| c[dof] += value);
                    functional.ends = [0, 1].map(|end| -dot(&c, &ramp.force[end]));
                    functional.weights = coefficients(&c);
                    c = base.residual(&nothing, &c).into_iter().map(|r| -r).collect();
                }
            }
            functional.ends.iter_mut().zip(ends).for_each(|(end, solution)| *end += dot(&c, &solution.u));
            functionals.push(functional);
            columns.push(c);
        }
        for (functional, moved) in functionals.iter_mut().zip(base.on_interfaces(active, columns)) {
            functional.weights.resize(moved.len(), 0.0);
            functional.weights.iter_mut().zip(moved).for_each(|(weight, moved)| *weight -= moved);
        }
        functionals
    }

    /// Its value at a load factor for what the interfaces carry beyond their base stiffness.
    pub(super) fn value(&self, load_factor: f64, excess: &[f64]) -> f64 {
        let [start, end] = self.ends;
        let interfaces = self.weights.iter().zip(excess).map(|(weight, e)| weight * e).sum::<f64>();
        start + load_factor * (end - start) + interfaces
    }
}

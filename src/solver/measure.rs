//! Linear functionals of displacements and reactions, prepared once per step: an increment whose fields are not stored then
//! costs nothing on the dofs of the bodies.
//!
//! ```text
//! c · u = c · u₀(λ) − (G K₀⁻¹ c) · e        r = K u + Gᵀ q − f:   c · r = (K₀ c) · u − c · f + (G c) · e
//! e = q − T₀ a        u₀(λ) = K₀⁻¹ f(λ), affine
//! ```

use super::refine::Factored;
use super::{Base, Solution};

/// Loads and prescribed displacements that are affine in the load level: their values at levels 0 and 1.
#[derive(Debug, Clone)]
pub struct Ramp {
    /// External forces [force].
    pub force: [Vec<f64>; 2],
    /// Displacements, read where held [length].
    pub prescribed: [Vec<f64>; 2],
}

/// A weighted sum over dofs.
#[derive(Debug, Clone)]
pub enum Measure {
    /// Of displacements.
    Displacement(Vec<(usize, f64)>),
    /// Of the reactions at held dofs; other dofs count nothing.
    Reaction(Vec<(usize, f64)>),
}

/// A measure on a condensed solution: value = ends, interpolated, + weights · e.
#[derive(Debug)]
pub(super) struct Functional {
    ends: [f64; 2],
    weights: Vec<f64>,
}

impl Functional {
    /// Prepares a measure for base solutions at levels 0 and 1.
    pub(super) fn new(
        base: &Base,
        active: &[usize],
        ramp: &Ramp,
        ends: &[Solution; 2],
        measure: &Measure,
    ) -> Functional {
        let held = base.held();
        let mut c = vec![0.0; held.len()];
        match measure {
            Measure::Displacement(terms) => terms.iter().for_each(|&(dof, value)| c[dof] += value),
            Measure::Reaction(terms) => {
                terms.iter().filter(|(dof, _)| held[*dof]).for_each(|&(dof, value)| c[dof] += value);
            }
        }
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let on_joints =
            |v: &[f64]| -> Vec<f64> { active.iter().flat_map(|&k| base.joints[k].coefficients(v)).collect() };
        let nothing = vec![0.0; c.len()];
        if c == nothing {
            return Functional { ends: [0.0; 2], weights: on_joints(&nothing) };
        }
        let (mut ends_of, mut weights) = ([0.0; 2], Vec::new());
        if let Measure::Reaction(_) = measure {
            for (end, force) in ends_of.iter_mut().zip(&ramp.force) {
                *end = -dot(&c, force);
            }
            weights = on_joints(&c);
            c = base.residual(&nothing, &c).into_iter().map(|r| -r).collect();
        }
        for (end, solution) in ends_of.iter_mut().zip(ends) {
            *end += dot(&c, &solution.u);
        }
        let moved = on_joints(&base.solve(&c, &nothing).u);
        weights.resize(moved.len(), 0.0);
        weights.iter_mut().zip(moved).for_each(|(weight, moved)| *weight -= moved);
        Functional { ends: ends_of, weights }
    }

    /// Its value at a level for what the joints carry beyond their springs.
    pub(super) fn value(&self, level: f64, excess: &[f64]) -> f64 {
        let [start, end] = self.ends;
        let joints = self.weights.iter().zip(excess).map(|(weight, e)| weight * e).sum::<f64>();
        start + level * (end - start) + joints
    }
}

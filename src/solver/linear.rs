//! A linear system: one factorisation per set of supports, no iteration but the refinement of round-off.
//!
//! ```text
//! (K + Σ GᵀTG) u = f      u = ū where held      reaction = K u + Gᵀ q − f where held
//! ```

use super::refine::Factored;
use super::{Factor, FactorPlan, NodalSolution, NotPositiveDefinite};
use crate::assembly::{InterfaceOperator, Pattern, Symmetric, add_stiffness};

/// The matrix of a linear scene: continuum and interfaces of constant stiffness.
#[derive(Debug, Clone, Copy)]
pub struct System<'a> {
    /// The interfaces.
    pub interfaces: &'a [InterfaceOperator],
    /// Stiffness D of every interface's law points, components² values each.
    pub stiffness: &'a [Vec<f64>],
    /// Pattern of the whole.
    pub pattern: &'a Pattern,
    /// K of the continuum.
    pub continuum: &'a Symmetric,
}

/// A factored system with its supports.
#[derive(Debug)]
pub struct Linear<'a> {
    system: System<'a>,
    constrained: Vec<bool>,
    total: Symmetric,
    factor: Factor<'a>,
}

impl<'a> Linear<'a> {
    /// Factors the system with the dofs in `held` prescribed.
    pub fn new(
        system: System<'a>,
        plan: &'a FactorPlan,
        constrained: &[bool],
    ) -> Result<Linear<'a>, NotPositiveDefinite> {
        let mut total = system.continuum.clone();
        for (interface, stiffness) in system.interfaces.iter().zip(system.stiffness) {
            add_stiffness(interface, system.pattern, stiffness, &mut total);
        }
        let taken = total.hold(system.pattern, constrained);
        let factor = plan.factor(system.pattern, &total)?;
        total.release(&taken);
        Ok(Linear { system, constrained: constrained.to_vec(), total, factor })
    }

    /// Solves for external forces `f` and prescribed displacements (read where held).
    pub fn solve(&self, f: &[f64], prescribed: &[f64]) -> NodalSolution {
        self.refined(f, prescribed)
    }
}

impl Factored for Linear<'_> {
    fn constrained(&self) -> &[bool] {
        &self.constrained
    }

    /// f − K u − Σ Gᵀ q, the interfaces by their jumps, so that what cancels does so before it is multiplied by K_N.
    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let mut force = vec![0.0; f.len()];
        self.system.continuum.add_product_by_differences(self.system.pattern, u, &mut force);
        for (interface, stiffness) in self.system.interfaces.iter().zip(self.system.stiffness) {
            interface.add_force(&tractions(interface, stiffness, u), &mut force);
        }
        f.iter().zip(force).map(|(f, force)| f - force).collect()
    }

    fn add_moved(&self, u: &[f64], scale: &mut [f64]) {
        self.system.continuum.add_absolute_product_by_differences(self.system.pattern, u, scale);
        let mut force = vec![0.0; u.len()];
        for (interface, stiffness) in self.system.interfaces.iter().zip(self.system.stiffness) {
            interface.add_force_sizes(&tractions(interface, stiffness, u), &mut force, scale);
        }
    }

    fn scales(&self, u: &[f64], f: Vec<f64>) -> [Vec<f64>; 2] {
        let mut scales = [f.clone(), f];
        self.total.add_absolute_product(self.system.pattern, u, &mut scales[0]);
        self.add_moved(u, &mut scales[1]);
        scales
    }

    fn apply(&self, b: &mut [Vec<f64>]) {
        self.factor.solve(b);
    }
}

/// Tractions D r (n, t, …) at the law points of an interface of constant stiffness.
pub(crate) fn tractions(interface: &InterfaceOperator, stiffness: &[f64], u: &[f64]) -> Vec<f64> {
    let c = interface.coupling.components;
    let jumps = interface.jumps(u);
    let mut tractions = vec![0.0; jumps.len()];
    for ((traction, jump), d) in
        tractions.chunks_exact_mut(c).zip(jumps.chunks_exact(c)).zip(stiffness.chunks_exact(c * c))
    {
        for (t, d) in traction.iter_mut().zip(d.chunks_exact(c)) {
            *t = d.iter().zip(jump).map(|(d, r)| d * r).sum();
        }
    }
    tractions
}

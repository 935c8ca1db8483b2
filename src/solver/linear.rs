//! A linear system: one factorisation per set of supports, no iteration but the refinement of round-off.
//!
//! ```text
//! (K + Σ GᵀTG) u = f      u = ū where held      reaction = K u + Gᵀ q − f where held
//! ```

use super::{Factor, NotPositiveDefinite, Plan};
use crate::assembly::{Joint, Pattern, Symmetric};

/// Refinement ends at this backward error, or where it no longer halves.
const BACKWARD_ERROR: f64 = 4.0 * f64::EPSILON;
/// Most refinements.
const REFINEMENTS: usize = 5;

/// The matrix of a linear scene: continuum and joints of constant stiffness.
#[derive(Debug)]
pub struct System<'a> {
    /// The joints.
    pub joints: &'a [Joint],
    /// Stiffness D of every joint's law points, components² values each.
    pub stiffness: &'a [Vec<f64>],
    /// Pattern of the whole.
    pub pattern: &'a Pattern,
    /// K of the continuum.
    pub continuum: &'a Symmetric,
}

/// A factored system with its supports.
#[derive(Debug)]
pub struct Linear<'a> {
    system: &'a System<'a>,
    held: Vec<bool>,
    total: Symmetric,
    factor: Factor<'a>,
}

/// An answer of the linear system.
#[derive(Debug, Clone)]
pub struct Solution {
    /// Displacement of every dof [length].
    pub u: Vec<f64>,
    /// Force of the supports at held dofs, zero elsewhere [force].
    pub reactions: Vec<f64>,
    /// max_i |r_i| / (|A| |u| + |f|)_i over the free dofs (Oettli and Prager); infinite if numbers overflowed.
    pub backward_error: f64,
}

impl<'a> Linear<'a> {
    /// Factors the system with the dofs in `held` prescribed.
    pub fn new(
        system: &'a System<'a>,
        plan: &'a Plan,
        held: &[bool],
    ) -> Result<Linear<'a>, NotPositiveDefinite> {
        let mut total = system.continuum.clone();
        for (joint, stiffness) in system.joints.iter().zip(system.stiffness) {
            joint.add_stiffness(system.pattern, stiffness, &mut total);
        }
        let taken = total.hold(system.pattern, held);
        let factor = plan.factor(system.pattern, &total)?;
        total.release(&taken);
        Ok(Linear { system, held: held.to_vec(), total, factor })
    }

    /// Solves for external forces `f` and prescribed displacements (read where held).
    pub fn solve(&self, f: &[f64], prescribed: &[f64]) -> Solution {
        let free = |i: usize| !self.held[i];
        let mut u: Vec<f64> = (0..f.len()).map(|i| if free(i) { 0.0 } else { prescribed[i] }).collect();
        let mut residual = self.residual(f, &u);
        let mut best: Option<(f64, Vec<f64>, Vec<f64>)> = None;
        for pass in 0..=REFINEMENTS {
            let mut correction: Vec<f64> =
                (0..f.len()).map(|i| if free(i) { residual[i] } else { 0.0 }).collect();
            if correction.iter().all(|&r| r == 0.0) && pass == 0 {
                return Solution { reactions: self.reactions(&residual), u, backward_error: 0.0 };
            }
            self.factor.solve(&mut correction);
            for i in (0..f.len()).filter(|&i| free(i)) {
                u[i] += correction[i];
            }
            residual = self.residual(f, &u);
            let error = self.backward_error(f, &u, &residual);
            let previous = best.as_ref().map_or(f64::INFINITY, |(error, ..)| *error);
            if error < previous {
                best = Some((error, u.clone(), residual.clone()));
            }
            if error <= BACKWARD_ERROR || error > 0.5 * previous {
                break;
            }
        }
        let (backward_error, u, residual) = best.unwrap_or((f64::INFINITY, u, residual));
        Solution { reactions: self.reactions(&residual), u, backward_error }
    }

    /// f − K u − Σ Gᵀ q, the joints by their jumps, so that what cancels does so before it is multiplied by K_N.
    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let mut force = vec![0.0; f.len()];
        self.system.continuum.add_product(self.system.pattern, u, &mut force);
        for (joint, stiffness) in self.system.joints.iter().zip(self.system.stiffness) {
            joint.add_force(&tractions(joint, stiffness, u), &mut force);
        }
        f.iter().zip(force).map(|(f, force)| f - force).collect()
    }

    fn reactions(&self, residual: &[f64]) -> Vec<f64> {
        residual.iter().zip(&self.held).map(|(r, &held)| if held { -r } else { 0.0 }).collect()
    }

    fn backward_error(&self, f: &[f64], u: &[f64], residual: &[f64]) -> f64 {
        let mut scale: Vec<f64> = f.iter().map(|f| f.abs()).collect();
        self.total.add_absolute_product(self.system.pattern, u, &mut scale);
        if !scale.iter().all(|scale| scale.is_finite()) {
            return f64::INFINITY; // overflow: a maximum would pass over what is not a number
        }
        let free = (0..f.len()).filter(|&i| !self.held[i] && scale[i] > 0.0);
        free.map(|i| residual[i].abs() / scale[i]).fold(0.0, f64::max)
    }
}

/// Tractions D r (n, t, …) at the law points of a joint of constant stiffness.
pub(crate) fn tractions(joint: &Joint, stiffness: &[f64], u: &[f64]) -> Vec<f64> {
    let c = joint.coupling.components;
    let jumps = joint.jumps(u);
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

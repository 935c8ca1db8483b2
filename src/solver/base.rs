//! The base system K₀ = K + Gᵀ T₀ G of one set of supports: a soft base stiffness in place of the laws.
//!
//! T₀ has the size E/h, never K_N, so that K₀ is positive definite also for floating bodies and well conditioned; what the
//! laws answer differently is the business of the interface problem (`dual`).

use std::sync::Arc;

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, Mat, MatMut};

use super::dense::{cholesky, cholesky_solve, detach, parallelism};
use super::linear::tractions;
use super::refine::Factored;
use super::{Condensation, Continuum, NodalSolution, NotPositiveDefinite};
use crate::assembly::{InterfaceOperator, InterfaceTangent};

/// A factored base system.
#[derive(Debug)]
pub struct Base<'a> {
    continuum: &'a Continuum,
    condensation: Arc<Condensation>,
    pub(super) interfaces: &'a [InterfaceOperator],
    /// Base stiffness of every interface, components² values per law point.
    stiffness: &'a [Vec<f64>],
    constrained: Vec<bool>,
    /// L of S + Gᵀ T₀ G with the supports on interfaces.
    separator: Mat<f64>,
}

impl<'a> Base<'a> {
    /// Adds base stiffness and supports on the interfaces to a condensation that serves these supports.
    pub fn new(
        continuum: &'a Continuum,
        condensation: Arc<Condensation>,
        interfaces: &'a [InterfaceOperator],
        stiffness: &'a [Vec<f64>],
        constrained: &[bool],
    ) -> Result<Base<'a>, NotPositiveDefinite> {
        let mut separator = continuum.schur(&condensation);
        let place = |dof: usize| continuum.places[dof].map(|place| place as usize);
        for (interface, stiffness) in interfaces.iter().zip(stiffness) {
            let mut tangent = InterfaceTangent::new(interface);
            tangent.fill(interface, stiffness);
            interface.visit_stiffness(&tangent.matrix, |row, column, value| {
                if let (Some(i), Some(j)) = (place(row), place(column))
                    && i >= j
                {
                    separator[(i, j)] += value;
                }
            });
        }
        for (dof, _) in constrained.iter().enumerate().filter(|(_, constrained)| **constrained) {
            if let Some(k) = place(dof) {
                detach(&mut separator, k);
            }
        }
        cholesky(&mut separator, parallelism(continuum.separator()))?;
        Ok(Base {
            continuum,
            condensation,
            interfaces,
            stiffness,
            constrained: constrained.to_vec(),
            separator,
        })
    }

    /// Solves with the separator in place; held dofs stay where they are.
    fn solve_separator(&self, x: MatMut<f64>) {
        self.continuum.solve_separator(&self.constrained, x, |x| cholesky_solve(&self.separator, x));
    }

    /// Solves for external forces `f` and prescribed displacements (read where held).
    pub fn solve(&self, f: &[f64], prescribed: &[f64]) -> NodalSolution {
        self.refined(f, prescribed)
    }

    /// G K₀⁻¹ b on the jump coefficients of some interfaces for several right-hand sides, without refinement; what `b` has at
    /// held dofs is ignored.
    pub(super) fn on_interfaces(&self, active: &[usize], mut b: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let constrained = |dof: usize| self.constrained[dof];
        b.iter_mut().for_each(|b| (0..b.len()).filter(|&dof| constrained(dof)).for_each(|dof| b[dof] = 0.0));
        let mut x = self.continuum.on_separator(&self.condensation, &b);
        self.solve_separator(x.as_mut());
        let at =
            |dof: usize, k: usize| self.continuum.places[dof].map_or(0.0, |place| x[(place as usize, k)]);
        let of = |k: usize| {
            let rows = active
                .iter()
                .flat_map(|&interface| (0..self.interfaces[interface].size()).map(move |i| (interface, i)));
            let sum = |(interface, i): (usize, usize)| {
                let (dofs, values) = self.interfaces[interface].row(i);
                dofs.iter().zip(values).map(|(&dof, value)| value * at(dof, k)).sum()
            };
            rows.map(sum).collect()
        };
        (0..b.len()).map(of).collect()
    }

    /// F₀ = G K₀⁻¹ Gᵀ on the jump coefficients of some interfaces, zero where nodes are held.
    pub(super) fn flexibility(&self, active: &[usize]) -> Mat<f64> {
        let m: usize = active.iter().map(|&k| self.interfaces[k].size()).sum();
        let mut x = Mat::zeros(self.separator.nrows(), m);
        let mut column = 0;
        for &k in active {
            let interface = &self.interfaces[k];
            for i in 0..interface.size() {
                let (dofs, values) = interface.row(i);
                for (&dof, &value) in dofs.iter().zip(values).filter(|(dof, _)| !self.constrained[**dof]) {
                    if let Some(place) = self.continuum.places[dof] {
                        x[(place as usize, column)] = value;
                    }
                }
                column += 1;
            }
        }
        let par = parallelism(m);
        solve_lower_triangular_in_place(self.separator.as_ref(), x.as_mut(), par);
        let mut flexibility = Mat::zeros(m, m);
        matmul(flexibility.as_mut(), Accum::Replace, x.transpose(), x.as_ref(), 1.0, par);
        flexibility
    }
}

impl Factored for Base<'_> {
    fn constrained(&self) -> &[bool] {
        &self.constrained
    }

    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let mut force = vec![0.0; f.len()];
        self.continuum.add_product(u, &mut force);
        for (interface, stiffness) in self.interfaces.iter().zip(self.stiffness) {
            interface.add_force(&tractions(interface, stiffness, u), &mut force);
        }
        f.iter().zip(force).map(|(f, force)| f - force).collect()
    }

    fn add_moved(&self, u: &[f64], scale: &mut [f64]) {
        self.continuum.add_absolute_product(u, scale);
        let mut force = vec![0.0; u.len()];
        for (interface, stiffness) in self.interfaces.iter().zip(self.stiffness) {
            interface.add_force_sizes(&tractions(interface, stiffness, u), &mut force, scale);
        }
    }

    fn apply(&self, b: &mut [Vec<f64>]) {
        self.continuum.solve(&self.condensation, b, |x| self.solve_separator(x));
    }
}

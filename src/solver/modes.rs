//! Bodies without interfaces: every one condensed on its separator, its free rigid motions set apart.
//!
//! ```text
//! F̂ = (S + c N Nᵀ)⁻¹      S N = 0, Nᵀ N = 1: F̂ is a generalised inverse of S for loads that balance, Nᵀ f = 0
//! ```

use std::sync::Arc;

use faer::{Mat, MatMut, Par};
use rayon::prelude::*;

use super::dense::{cholesky, cholesky_solve, detach};
use super::refine::Factored;
use super::rigid_modes::free_rigid_modes;
use super::{Condensation, Continuum, NotPositiveDefinite};

/// Bodies under one set of supports.
#[derive(Debug)]
pub(super) struct FloatingModes<'a> {
    pub(super) continuum: &'a Continuum,
    condensation: Arc<Condensation>,
    pub(super) constrained: Vec<bool>,
    /// L of S + c N Nᵀ, body by body.
    pub(super) factors: Vec<Mat<f64>>,
    /// N on all dofs of a body.
    pub(super) rigid_modes: Vec<Vec<Vec<f64>>>,
}

impl<'a> FloatingModes<'a> {
    /// Factors the separators of all bodies, side by side.
    pub(super) fn new(
        continuum: &'a Continuum,
        condensation: Arc<Condensation>,
        constrained: &[bool],
    ) -> Result<FloatingModes<'a>, NotPositiveDefinite> {
        let make = |b: usize| {
            let (dofs, places) = (continuum.dofs_of(b), continuum.places_of(b));
            let constrained = &constrained[dofs.clone()];
            let (pieces, x) = (continuum.pieces_of(b), continuum.coordinates_of(b));
            let rigid_modes = free_rigid_modes(continuum.components(), pieces, x, constrained, &places);
            let mut s = continuum.schur_of(&condensation, b).clone();
            let inside = places.iter().enumerate().filter_map(|(dof, place)| Some((dof, (*place)? as usize)));
            for (dof, k) in inside.clone() {
                if constrained[dof] {
                    detach(&mut s, k);
                }
            }
            let mean = (0..s.nrows()).map(|k| s[(k, k)]).sum::<f64>() / s.nrows().max(1) as f64;
            for motion in &rigid_modes {
                for (row, i) in inside.clone() {
                    for (column, j) in inside.clone().filter(|(_, j)| i >= *j) {
                        s[(i, j)] += mean * motion[row] * motion[column];
                    }
                }
            }
            cholesky(&mut s, Par::Seq)?;
            Ok((s, rigid_modes))
        };
        let made: Vec<_> = (0..continuum.subdomains()).into_par_iter().map(make).collect();
        let made = made.into_iter().collect::<Result<Vec<_>, NotPositiveDefinite>>()?;
        let (factors, rigid_modes) = made.into_iter().unzip();
        Ok(FloatingModes { continuum, condensation, constrained: constrained.to_vec(), factors, rigid_modes })
    }

    /// F̂ on the separator in place; held dofs stay where they are.
    fn solve_separator(&self, x: MatMut<f64>) {
        self.continuum.solve_separator(&self.constrained, x, |mut x| {
            for (b, factor) in self.factors.iter().enumerate() {
                let separator = self.continuum.separator_of(b);
                cholesky_solve(factor, x.as_mut().subrows_mut(separator.start, separator.len()));
            }
        });
    }

    /// Nᵀ f̂ of every body for loads that are zero at held dofs.
    pub(super) fn modal_forces(&self, load: &[f64]) -> Vec<Vec<f64>> {
        // a motion that nothing holds does the same work on a load as on its condensation
        let of = |(b, rigid_modes): (usize, &Vec<Vec<f64>>)| {
            let load = &load[self.continuum.dofs_of(b)];
            rigid_modes.iter().map(|motion| motion.iter().zip(load).map(|(n, f)| n * f).sum()).collect()
        };
        self.rigid_modes.iter().enumerate().map(of).collect()
    }
}

impl Factored for FloatingModes<'_> {
    fn constrained(&self) -> &[bool] {
        &self.constrained
    }

    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        self.continuum.residual(f, u)
    }

    fn add_moved(&self, u: &[f64], scale: &mut [f64]) {
        self.continuum.add_absolute_product(u, scale);
    }

    fn apply(&self, b: &mut [Vec<f64>]) {
        self.continuum.solve(&self.condensation, b, |x| self.solve_separator(x));
    }
}

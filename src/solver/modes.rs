//! Bodies without joints: every one condensed on its border, its free rigid motions set apart.
//!
//! ```text
//! F̂ = (S + c N Nᵀ)⁻¹      S N = 0, Nᵀ N = 1: F̂ is a generalised inverse of S for loads that balance, Nᵀ f = 0
//! ```

use std::sync::Arc;

use faer::{Mat, MatMut, Par};
use rayon::prelude::*;

use super::dense::{cholesky, cholesky_solve, detach};
use super::motions::free_motions;
use super::refine::Factored;
use super::{Condensation, Continuum, NotPositiveDefinite};

/// Bodies under one set of supports.
#[derive(Debug)]
pub(super) struct FloatingModes<'a> {
    pub(super) continuum: &'a Continuum,
    condensation: Arc<Condensation>,
    pub(super) held: Vec<bool>,
    /// L of S + c N Nᵀ, body by body.
    pub(super) factors: Vec<Mat<f64>>,
    /// N on all dofs of a body.
    pub(super) motions: Vec<Vec<Vec<f64>>>,
}

impl<'a> FloatingModes<'a> {
    /// Factors the borders of all bodies, side by side.
    pub(super) fn new(
        continuum: &'a Continuum,
        condensation: Arc<Condensation>,
        held: &[bool],
    ) -> Result<FloatingModes<'a>, NotPositiveDefinite> {
        let make = |b: usize| {
            let (dofs, places) = (continuum.dofs_of(b), continuum.places_of(b));
            let held = &held[dofs.clone()];
            let (pieces, x) = (continuum.pieces_of(b), continuum.coordinates_of(b));
            let motions = free_motions(continuum.components(), pieces, x, held, &places);
            let mut s = continuum.schur_of(&condensation, b).clone();
            let inside = places.iter().enumerate().filter_map(|(dof, place)| Some((dof, (*place)? as usize)));
            for (dof, k) in inside.clone() {
                if held[dof] {
                    detach(&mut s, k);
                }
            }
            let mean = (0..s.nrows()).map(|k| s[(k, k)]).sum::<f64>() / s.nrows().max(1) as f64;
            for motion in &motions {
                for (row, i) in inside.clone() {
                    for (column, j) in inside.clone().filter(|(_, j)| i >= *j) {
                        s[(i, j)] += mean * motion[row] * motion[column];
                    }
                }
            }
            cholesky(&mut s, Par::Seq)?;
            Ok((s, motions))
        };
        let made: Vec<_> = (0..continuum.bodies()).into_par_iter().map(make).collect();
        let made = made.into_iter().collect::<Result<Vec<_>, NotPositiveDefinite>>()?;
        let (factors, motions) = made.into_iter().unzip();
        Ok(FloatingModes { continuum, condensation, held: held.to_vec(), factors, motions })
    }

    /// F̂ on the border in place; held dofs stay where they are.
    fn solve_border(&self, x: MatMut<f64>) {
        self.continuum.solve_border(&self.held, x, |mut x| {
            for (b, factor) in self.factors.iter().enumerate() {
                let border = self.continuum.border_of(b);
                cholesky_solve(factor, x.as_mut().subrows_mut(border.start, border.len()));
            }
        });
    }

    /// Nᵀ f̂ of every body for loads that are zero at held dofs.
    pub(super) fn pushed(&self, load: &[f64]) -> Vec<Vec<f64>> {
        // a motion that nothing holds does the same work on a load as on its condensation
        let of = |(b, motions): (usize, &Vec<Vec<f64>>)| {
            let load = &load[self.continuum.dofs_of(b)];
            motions.iter().map(|motion| motion.iter().zip(load).map(|(n, f)| n * f).sum()).collect()
        };
        self.motions.iter().enumerate().map(of).collect()
    }
}

impl Factored for FloatingModes<'_> {
    fn held(&self) -> &[bool] {
        &self.held
    }

    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let mut force = vec![0.0; f.len()];
        self.continuum.add_product(u, &mut force);
        f.iter().zip(force).map(|(f, force)| f - force).collect()
    }

    fn add_scale(&self, u: &[f64], scale: &mut [f64]) {
        self.add_moved(u, scale);
    }

    fn add_moved(&self, u: &[f64], scale: &mut [f64]) {
        self.continuum.add_absolute_product(u, scale);
    }

    fn apply(&self, b: &mut [Vec<f64>]) {
        self.continuum.solve(&self.condensation, b, |x| self.solve_border(x));
    }
}

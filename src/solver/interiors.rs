//! The interiors of bodies whose nodes on interfaces are held: what loads inside leave on these, and what moves inside with them.

use std::sync::Arc;

use super::refine::Factored;
use super::{Condensation, Continuum};

/// Interiors under one set of supports.
#[derive(Debug)]
pub(super) struct Interiors<'a> {
    pub(super) continuum: &'a Continuum,
    pub(super) condensation: Arc<Condensation>,
    /// Supports of the interiors.
    inside: Vec<bool>,
    /// These, and all dofs on interfaces.
    constrained: Vec<bool>,
}

impl<'a> Interiors<'a> {
    /// For a condensation that serves these supports.
    pub(super) fn new(
        continuum: &'a Continuum,
        condensation: Arc<Condensation>,
        constrained: &[bool],
    ) -> Interiors<'a> {
        let both = || constrained.iter().zip(&continuum.places);
        let inside = both().map(|(constrained, place)| *constrained && place.is_none()).collect();
        let constrained = both().map(|(constrained, place)| *constrained || place.is_some()).collect();
        Interiors { continuum, condensation, inside, constrained }
    }

    /// f̂: what forces and displacements that are prescribed inside leave on the separator.
    pub(super) fn condensed(&self, force: &[f64], prescribed: &[f64]) -> Vec<f64> {
        let moved: Vec<f64> =
            prescribed.iter().zip(&self.inside).map(|(u, held)| if *held { *u } else { 0.0 }).collect();
        let mut load =
            if moved.iter().any(|u| *u != 0.0) { self.residual(force, &moved) } else { force.to_vec() };
        load.iter_mut().zip(&self.inside).filter(|(_, held)| **held).for_each(|(load, _)| *load = 0.0);
        let condensed = self.continuum.on_separator(&self.condensation, &[load]);
        condensed.col_as_slice(0).to_vec()
    }
}

impl Factored for Interiors<'_> {
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
        self.continuum.solve(&self.condensation, b, |mut x| x.fill(0.0));
    }
}

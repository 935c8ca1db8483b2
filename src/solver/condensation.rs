//! The continuum condensed on its joints: every body's interior eliminated once, the joints' dofs left in a dense S.
//!
//! ```text
//!   S = diag(S₁, S₂, …)      S of every body as in `substructure`: no node belongs to two bodies
//! ```
//!
//! Springs and supports on the joints act on S alone, so that they never touch the sparse factors.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use faer::{Mat, MatMut};
use rayon::prelude::*;

use super::{CondensedSubdomain, NotPositiveDefinite, SubdomainCache, Substructure, TooLarge};
use crate::assembly::Model;

/// The bodies, each planned alone, and how their dofs are numbered together.
#[derive(Debug)]
pub struct Continuum {
    bodies: Vec<Arc<Substructure>>,
    /// Dofs of every body in the model.
    dofs: Vec<Range<usize>>,
    /// Places of every body's border in the whole border.
    borders: Vec<Range<usize>>,
    /// Place of every dof in the border.
    pub(super) places: Vec<Option<u32>>,
    /// Of all nodes, one after the other.
    coordinates: Vec<f64>,
    /// Nodes of the pieces of every body that falls into several.
    pieces: Vec<Vec<Vec<usize>>>,
    shelf: Option<Arc<SubdomainCache>>,
    found: Mutex<CacheHits>,
}

/// What was on the shelf, by number of the body.
#[derive(Debug, Clone, Default)]
pub struct CacheHits {
    /// Bodies with their stiffness.
    pub bodies: Vec<usize>,
    /// Their factors.
    pub factors: Vec<usize>,
}

/// The interiors' factors under one set of supports.
#[derive(Debug)]
pub struct Condensation {
    held: Vec<bool>,
    bodies: Vec<Arc<CondensedSubdomain>>,
}

/// A body, its condensation, and what it keeps of right-hand sides.
type InteriorRhs<'a> = ((&'a Arc<Substructure>, &'a Arc<CondensedSubdomain>), Vec<Mat<f64>>);

impl Continuum {
    /// Assembles the bodies of a model and plans their condensation; what is on the shelf is taken from there.
    pub fn new(model: &Model, shelf: Option<Arc<SubdomainCache>>) -> Result<Continuum, TooLarge> {
        let c = model.components;
        let joined = model.joined();
        let make = |b: usize| {
            let (body, dofs) = (&model.bodies[b], model.dofs_of(b));
            let joined = &joined[dofs.start / c..dofs.end / c];
            match &shelf {
                Some(shelf) => shelf.body(c, body, model.thickness, joined),
                None => Substructure::new(c, body, model.thickness, joined).map(|new| (Arc::new(new), false)),
            }
        };
        let made: Vec<_> = (0..model.bodies.len()).into_par_iter().map(make).collect();
        let (mut bodies, mut found) = (Vec::new(), CacheHits::default());
        for (b, made) in made.into_iter().enumerate() {
            let (body, there) = made?;
            found.bodies.extend(there.then_some(b));
            bodies.push(body);
        }
        let dofs: Vec<Range<usize>> = (0..bodies.len()).map(|b| model.dofs_of(b)).collect();
        let (mut borders, mut places, mut end) = (Vec::new(), Vec::with_capacity(model.dofs()), 0);
        for (body, dofs) in bodies.iter().zip(&dofs) {
            let start = end;
            end += body.parts.border();
            borders.push(start..end);
            let inside = body.parts.places(dofs.len()).into_iter();
            places.extend(inside.map(|place| place.map(|place| start as u32 + place)));
        }
        let (coordinates, found) = (model.coordinates(), Mutex::new(found));
        let pieces = model.bodies.iter().map(|body| body.pieces.clone()).collect();
        Ok(Continuum { bodies, dofs, borders, places, coordinates, pieces, shelf, found })
    }

    /// What was on the shelf so far.
    pub fn found(&self) -> CacheHits {
        self.found.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Number of dofs in the border.
    pub fn border(&self) -> usize {
        self.borders.last().map_or(0, |last| last.end)
    }

    /// Number of bodies.
    pub fn bodies(&self) -> usize {
        self.bodies.len()
    }

    /// Dofs of a body.
    pub(super) fn dofs_of(&self, body: usize) -> Range<usize> {
        self.dofs[body].clone()
    }

    /// Places of a body's border in the whole border.
    pub fn border_of(&self, body: usize) -> Range<usize> {
        self.borders[body].clone()
    }

    /// Place of every dof of a body in its own border.
    pub(super) fn places_of(&self, body: usize) -> Vec<Option<u32>> {
        let start = self.borders[body].start as u32;
        self.places[self.dofs_of(body)].iter().map(|place| place.map(|place| place - start)).collect()
    }

    /// Displacement components per node.
    pub(super) fn components(&self) -> usize {
        self.bodies.first().map_or(0, |body| body.pattern.components())
    }

    /// Nodes of the pieces of a body that falls into several.
    pub(super) fn pieces_of(&self, body: usize) -> &[Vec<usize>] {
        &self.pieces[body]
    }

    /// Coordinates of a body's nodes, one after the other.
    pub(super) fn coordinates_of(&self, body: usize) -> &[f64] {
        &self.coordinates[self.dofs_of(body)]
    }

    /// S of a body, its lower triangle.
    pub(super) fn schur_of<'a>(&self, condensation: &'a Condensation, body: usize) -> &'a Mat<f64> {
        &condensation.bodies[body].schur
    }

    /// Number of entries of all factors.
    pub fn entries(&self) -> usize {
        self.bodies.iter().map(|body| body.parts.entries()).sum()
    }

    /// Multiplications and additions to eliminate the interiors.
    pub fn operations(&self) -> f64 {
        self.bodies.iter().map(|body| body.parts.operations()).sum()
    }

    /// Memory of the matrices, the factors and the work on them [bytes].
    pub fn bytes(&self) -> usize {
        let matrix = |body: &Substructure| size_of::<f64>() * body.stiffness.values.len();
        self.bodies.iter().map(|body| body.parts.bytes() + matrix(body)).sum()
    }

    /// True if two sets of supports differ on joints only, so that one condensation serves both.
    pub fn serves(&self, condensation: &Condensation, held: &[bool]) -> bool {
        let inside = self.places.iter().zip(condensation.held.iter().zip(held));
        inside.filter(|(place, _)| place.is_none()).all(|(_, (a, b))| a == b)
    }

    /// Eliminates the interiors under the supports that are not on joints.
    pub fn condense(&self, held: &[bool]) -> Result<Condensation, NotPositiveDefinite> {
        let held: Vec<bool> =
            held.iter().zip(&self.places).map(|(&held, place)| held && place.is_none()).collect();
        let condense = |(body, dofs): (&Arc<Substructure>, &Range<usize>)| {
            let held = held[dofs.clone()].to_vec();
            match &self.shelf {
                Some(shelf) => shelf.condensed(body, held),
                None => body.condense(held).map(|new| (Arc::new(new), false)),
            }
        };
        let made: Vec<_> = self.bodies.par_iter().zip(&self.dofs).map(condense).collect();
        let mut bodies = Vec::new();
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        for (b, made) in made.into_iter().enumerate() {
            let (condensed, there) = made?;
            found.factors.extend(there.then_some(b));
            bodies.push(condensed);
        }
        Ok(Condensation { held, bodies })
    }

    /// S, its lower triangle.
    pub(super) fn schur(&self, condensation: &Condensation) -> Mat<f64> {
        let mut whole = Mat::zeros(self.border(), self.border());
        for (border, CondensedSubdomain { schur, .. }) in
            self.borders.iter().zip(condensation.bodies.iter().map(|c| &**c))
        {
            whole.submatrix_mut(border.start, border.start, border.len(), border.len()).copy_from(schur);
        }
        whole
    }

    /// Solves on the border in place with what solves on all of it; held dofs stay where they are.
    pub(super) fn solve_border(&self, held: &[bool], mut x: MatMut<f64>, solve: impl FnOnce(MatMut<f64>)) {
        let held = held.iter().zip(&self.places).filter(|(held, _)| **held);
        let places: Vec<usize> = held.filter_map(|(_, place)| place.map(|place| place as usize)).collect();
        let clear =
            |x: &mut MatMut<f64>| (0..x.ncols()).for_each(|k| places.iter().for_each(|&i| x[(i, k)] = 0.0));
        clear(&mut x);
        solve(x.as_mut());
        clear(&mut x);
    }

    /// What the border needs of several right-hand sides.
    pub(super) fn on_border(&self, condensation: &Condensation, b: &[Vec<f64>]) -> Mat<f64> {
        self.forward(condensation, b).1
    }

    /// Solves with a condensation in place; `border` solves on the joints' dofs.
    pub(super) fn solve(
        &self,
        condensation: &Condensation,
        b: &mut [Vec<f64>],
        border: impl FnOnce(MatMut<f64>),
    ) {
        let (inner, mut x) = self.forward(condensation, b);
        border(x.as_mut());
        let numbered = self.dofs.par_iter().zip(&self.borders);
        let pieces = self.bodies.par_iter().zip(&condensation.bodies).zip(inner).zip(numbered);
        let expand =
            |(((body, condensed), inner), (dofs, border)): (InteriorRhs, (&Range<usize>, &Range<usize>))| {
                let mut own = vec![vec![0.0; dofs.len()]; x.ncols()];
                let x = x.subrows(border.start, border.len());
                body.parts.expand(&condensed.values, inner, x, &mut own);
                own
            };
        let solved: Vec<Vec<Vec<f64>>> = pieces.map(expand).collect();
        for (own, dofs) in solved.into_iter().zip(&self.dofs) {
            b.iter_mut().zip(own).for_each(|(b, own)| b[dofs.clone()].copy_from_slice(&own));
        }
    }

    /// The way down of both substitutions: what every body keeps, and what the border then has.
    fn forward(&self, condensation: &Condensation, b: &[Vec<f64>]) -> (Vec<Vec<Mat<f64>>>, Mat<f64>) {
        let reduce =
            |((body, condensed), dofs): ((&Arc<Substructure>, &Arc<CondensedSubdomain>), &Range<usize>)| {
                let b: Vec<&[f64]> = b.iter().map(|b| &b[dofs.clone()]).collect();
                body.parts.reduce(&condensed.values, &b)
            };
        let pieces = self.bodies.par_iter().zip(&condensation.bodies).zip(&self.dofs);
        let reduced: Vec<(Vec<Mat<f64>>, Mat<f64>)> = pieces.map(reduce).collect();
        let (mut inner, mut whole) = (Vec::new(), Mat::zeros(self.border(), b.len()));
        for ((of, on_border), border) in reduced.into_iter().zip(&self.borders) {
            inner.push(of);
            whole.subrows_mut(border.start, border.len()).copy_from(&on_border);
        }
        (inner, whole)
    }

    /// f += K u, from differences.
    pub(super) fn add_product(&self, u: &[f64], f: &mut [f64]) {
        for (body, dofs) in self.bodies.iter().zip(&self.dofs) {
            let (u, f) = (&u[dofs.clone()], &mut f[dofs.clone()]);
            body.stiffness.add_product_by_differences(&body.pattern, u, f);
        }
    }

    /// f += |K| |u|, from differences.
    pub(super) fn add_absolute_product(&self, u: &[f64], f: &mut [f64]) {
        for (body, dofs) in self.bodies.iter().zip(&self.dofs) {
            let (u, f) = (&u[dofs.clone()], &mut f[dofs.clone()]);
            body.stiffness.add_absolute_product_by_differences(&body.pattern, u, f);
        }
    }
}

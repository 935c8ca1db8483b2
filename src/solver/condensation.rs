//! The continuum condensed on its interfaces: every body's interior eliminated once, the interfaces' dofs left in a dense S.
//!
//! ```text
//!   S = diag(S₁, S₂, …)      S of every body as in `substructure`: no node belongs to two bodies
//! ```
//!
//! Base stiffness and supports on the interfaces act on S alone, so that they never touch the sparse factors.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use faer::{Mat, MatMut};
use rayon::prelude::*;

use super::{CondensedSubdomain, NotPositiveDefinite, SubdomainCache, Substructure, TooLarge};
use crate::assembly::Model;

/// The bodies, each planned alone, and how their dofs are numbered together.
#[derive(Debug)]
pub struct Continuum {
    subdomains: Vec<Arc<Substructure>>,
    /// Dofs of every body in the model.
    dofs: Vec<Range<usize>>,
    /// Places of every body's separator in the whole separator.
    separators: Vec<Range<usize>>,
    /// Place of every dof in the separator.
    pub(super) places: Vec<Option<u32>>,
    /// Components of all nodes, one after the other.
    coordinates: Vec<f64>,
    /// Nodes of the pieces of every body that falls into several.
    pieces: Vec<Vec<Vec<usize>>>,
    cache: Option<Arc<SubdomainCache>>,
    found: Mutex<CacheHits>,
}

/// Hits of the cache, by number of the body.
#[derive(Debug, Clone, Default)]
pub struct CacheHits {
    /// Bodies with their stiffness.
    pub subdomains: Vec<usize>,
    /// Their factors.
    pub factors: Vec<usize>,
}

/// The interiors' factors under one set of supports.
#[derive(Debug)]
pub struct Condensation {
    constrained: Vec<bool>,
    subdomains: Vec<Arc<CondensedSubdomain>>,
}

/// A body, its condensation, and what it keeps of right-hand sides.
type InteriorRhs<'a> = ((&'a Arc<Substructure>, &'a Arc<CondensedSubdomain>), Vec<Mat<f64>>);

impl Continuum {
    /// Assembles the bodies of a model and plans their condensation; what is on the cache is taken from there.
    pub fn new(model: &Model, cache: Option<Arc<SubdomainCache>>) -> Result<Continuum, TooLarge> {
        let c = model.components;
        let joined = model.joined();
        let make = |b: usize| {
            let (subdomain, dofs) = (&model.subdomains[b], model.dofs_of(b));
            let joined = &joined[dofs.start / c..dofs.end / c];
            match &cache {
                Some(cache) => cache.subdomain(c, subdomain, model.thickness, joined),
                None => {
                    Substructure::new(c, subdomain, model.thickness, joined).map(|new| (Arc::new(new), false))
                }
            }
        };
        let made: Vec<_> = (0..model.subdomains.len()).into_par_iter().map(make).collect();
        let (mut subdomains, mut found) = (Vec::new(), CacheHits::default());
        for (b, made) in made.into_iter().enumerate() {
            let (subdomain, there) = made?;
            found.subdomains.extend(there.then_some(b));
            subdomains.push(subdomain);
        }
        let dofs: Vec<Range<usize>> = (0..subdomains.len()).map(|b| model.dofs_of(b)).collect();
        let (mut separators, mut places, mut end) = (Vec::new(), Vec::with_capacity(model.dofs()), 0);
        for (subdomain, dofs) in subdomains.iter().zip(&dofs) {
            let start = end;
            end += subdomain.parts.separator();
            separators.push(start..end);
            let inside = subdomain.parts.places(dofs.len()).into_iter();
            places.extend(inside.map(|place| place.map(|place| start as u32 + place)));
        }
        let (coordinates, found) = (model.coordinates(), Mutex::new(found));
        let pieces = model.subdomains.iter().map(|subdomain| subdomain.pieces.clone()).collect();
        Ok(Continuum { subdomains, dofs, separators, places, coordinates, pieces, cache, found })
    }

    /// Hits of the cache so far.
    pub fn found(&self) -> CacheHits {
        self.found.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Number of dofs in the separator.
    pub fn separator(&self) -> usize {
        self.separators.last().map_or(0, |last| last.end)
    }

    /// Number of bodies.
    pub fn subdomains(&self) -> usize {
        self.subdomains.len()
    }

    /// Dofs of a body.
    pub(super) fn dofs_of(&self, subdomain: usize) -> Range<usize> {
        self.dofs[subdomain].clone()
    }

    /// Places of a body's separator in the whole separator.
    pub fn separator_of(&self, subdomain: usize) -> Range<usize> {
        self.separators[subdomain].clone()
    }

    /// Place of every dof of a body in its own separator.
    pub(super) fn places_of(&self, subdomain: usize) -> Vec<Option<u32>> {
        let start = self.separators[subdomain].start as u32;
        self.places[self.dofs_of(subdomain)].iter().map(|place| place.map(|place| place - start)).collect()
    }

    /// Displacement components per node.
    pub(super) fn components(&self) -> usize {
        self.subdomains.first().map_or(0, |subdomain| subdomain.pattern.components())
    }

    /// Nodes of the pieces of a body that falls into several.
    pub(super) fn pieces_of(&self, subdomain: usize) -> &[Vec<usize>] {
        &self.pieces[subdomain]
    }

    /// Coordinates of a body's nodes, one after the other.
    pub(super) fn coordinates_of(&self, subdomain: usize) -> &[f64] {
        &self.coordinates[self.dofs_of(subdomain)]
    }

    /// S of a body, its lower triangle.
    pub(super) fn schur_of<'a>(&self, condensation: &'a Condensation, subdomain: usize) -> &'a Mat<f64> {
        &condensation.subdomains[subdomain].schur
    }

    /// Number of entries of all factors.
    pub fn entries(&self) -> usize {
        self.subdomains.iter().map(|subdomain| subdomain.parts.entries()).sum()
    }

    /// Multiplications and additions to eliminate the interiors.
    pub fn operations(&self) -> f64 {
        self.subdomains.iter().map(|subdomain| subdomain.parts.operations()).sum()
    }

    /// Memory of the matrices, the factors and the work on them [bytes].
    pub fn bytes(&self) -> usize {
        let matrix = |subdomain: &Substructure| size_of::<f64>() * subdomain.stiffness.values.len();
        self.subdomains.iter().map(|subdomain| subdomain.parts.bytes() + matrix(subdomain)).sum()
    }

    /// True if two sets of supports differ on interfaces only, so that one condensation serves both.
    pub fn serves(&self, condensation: &Condensation, constrained: &[bool]) -> bool {
        let inside = self.places.iter().zip(condensation.constrained.iter().zip(constrained));
        inside.filter(|(place, _)| place.is_none()).all(|(_, (a, b))| a == b)
    }

    /// Eliminates the interiors under the supports that are not on interfaces.
    pub fn condense(&self, constrained: &[bool]) -> Result<Condensation, NotPositiveDefinite> {
        let constrained: Vec<bool> = constrained
            .iter()
            .zip(&self.places)
            .map(|(&constrained, place)| constrained && place.is_none())
            .collect();
        let condense = |(subdomain, dofs): (&Arc<Substructure>, &Range<usize>)| {
            let constrained = constrained[dofs.clone()].to_vec();
            match &self.cache {
                Some(cache) => cache.condensed(subdomain, constrained),
                None => subdomain.condense(constrained).map(|new| (Arc::new(new), false)),
            }
        };
        let made: Vec<_> = self.subdomains.par_iter().zip(&self.dofs).map(condense).collect();
        let mut subdomains = Vec::new();
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        for (b, made) in made.into_iter().enumerate() {
            let (condensed, there) = made?;
            found.factors.extend(there.then_some(b));
            subdomains.push(condensed);
        }
        Ok(Condensation { constrained, subdomains })
    }

    /// S, its lower triangle.
    pub(super) fn schur(&self, condensation: &Condensation) -> Mat<f64> {
        let mut whole = Mat::zeros(self.separator(), self.separator());
        for (separator, CondensedSubdomain { schur, .. }) in
            self.separators.iter().zip(condensation.subdomains.iter().map(|c| &**c))
        {
            whole
                .submatrix_mut(separator.start, separator.start, separator.len(), separator.len())
                .copy_from(schur);
        }
        whole
    }

    /// Solves on the separator in place with what solves on all of it; held dofs stay where they are.
    pub(super) fn solve_separator(
        &self,
        constrained: &[bool],
        mut x: MatMut<f64>,
        solve: impl FnOnce(MatMut<f64>),
    ) {
        let constrained = constrained.iter().zip(&self.places).filter(|(constrained, _)| **constrained);
        let places: Vec<usize> =
            constrained.filter_map(|(_, place)| place.map(|place| place as usize)).collect();
        let clear =
            |x: &mut MatMut<f64>| (0..x.ncols()).for_each(|k| places.iter().for_each(|&i| x[(i, k)] = 0.0));
        clear(&mut x);
        solve(x.as_mut());
        clear(&mut x);
    }

    /// Condensed right-hand sides.
    pub(super) fn on_separator(&self, condensation: &Condensation, b: &[Vec<f64>]) -> Mat<f64> {
        self.forward(condensation, b).1
    }

    /// Solves with a condensation in place; `separator` solves on the interfaces' dofs.
    pub(super) fn solve(
        &self,
        condensation: &Condensation,
        b: &mut [Vec<f64>],
        separator: impl FnOnce(MatMut<f64>),
    ) {
        let (inner, mut x) = self.forward(condensation, b);
        separator(x.as_mut());
        let numbered = self.dofs.par_iter().zip(&self.separators);
        let pieces = self.subdomains.par_iter().zip(&condensation.subdomains).zip(inner).zip(numbered);
        let expand = |(((subdomain, condensed), inner), (dofs, separator)): (
            InteriorRhs,
            (&Range<usize>, &Range<usize>),
        )| {
            let mut own = vec![vec![0.0; dofs.len()]; x.ncols()];
            let x = x.subrows(separator.start, separator.len());
            subdomain.parts.expand(&condensed.values, inner, x, &mut own);
            own
        };
        let solved: Vec<Vec<Vec<f64>>> = pieces.map(expand).collect();
        for (own, dofs) in solved.into_iter().zip(&self.dofs) {
            b.iter_mut().zip(own).for_each(|(b, own)| b[dofs.clone()].copy_from_slice(&own));
        }
    }

    /// The way down of both substitutions: what every body keeps, and what the separator then has.
    fn forward(&self, condensation: &Condensation, b: &[Vec<f64>]) -> (Vec<Vec<Mat<f64>>>, Mat<f64>) {
        let reduce = |((subdomain, condensed), dofs): (
            (&Arc<Substructure>, &Arc<CondensedSubdomain>),
            &Range<usize>,
        )| {
            let b: Vec<&[f64]> = b.iter().map(|b| &b[dofs.clone()]).collect();
            subdomain.parts.reduce(&condensed.values, &b)
        };
        let pieces = self.subdomains.par_iter().zip(&condensation.subdomains).zip(&self.dofs);
        let reduced: Vec<(Vec<Mat<f64>>, Mat<f64>)> = pieces.map(reduce).collect();
        let (mut inner, mut whole) = (Vec::new(), Mat::zeros(self.separator(), b.len()));
        for ((of, on_separator), separator) in reduced.into_iter().zip(&self.separators) {
            inner.push(of);
            whole.subrows_mut(separator.start, separator.len()).copy_from(&on_separator);
        }
        (inner, whole)
    }

    /// f += K u, from differences.
    pub(super) fn add_product(&self, u: &[f64], f: &mut [f64]) {
        for (subdomain, dofs) in self.subdomains.iter().zip(&self.dofs) {
            let (u, f) = (&u[dofs.clone()], &mut f[dofs.clone()]);
            subdomain.stiffness.add_product_by_differences(&subdomain.pattern, u, f);
        }
    }

    /// f += |K| |u|, from differences.
    pub(super) fn add_absolute_product(&self, u: &[f64], f: &mut [f64]) {
        for (subdomain, dofs) in self.subdomains.iter().zip(&self.dofs) {
            let (u, f) = (&u[dofs.clone()], &mut f[dofs.clone()]);
            subdomain.stiffness.add_absolute_product_by_differences(&subdomain.pattern, u, f);
        }
    }
}

//! The continuum condensed on its interfaces: every body's interior eliminated once, the interfaces' dofs left in a dense S.
//!
//! ```text
//!   S = diag(S₁, S₂, …)      S of every body as in `substructure`: no node belongs to two bodies
//! ```
//!
//! Base stiffness and supports on the interfaces act on S alone, so that they never touch the sparse factors. Bodies that are equal
//! up to a motion (`equal`) have one stiffness and one condensation: in their own axes S is R S Rᵀ.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use faer::{Mat, MatMut};
use rayon::prelude::*;

use super::condensation::Condensation;
use super::equal::{Like, Rotation, first_of_its_kind};
use super::{SubdomainCache, Substructure, TooLarge};
use crate::assembly::Model;

/// The bodies, each planned alone, and how their dofs are numbered together.
#[derive(Debug)]
pub struct Continuum {
    pub(super) subdomains: Vec<Arc<Substructure>>,
    /// Which body every body is like, and its rotation against that one.
    pub(super) likes: Vec<Like>,
    /// Dofs of every body in the model.
    pub(super) dofs: Vec<Range<usize>>,
    /// Places of every body's separator in the whole separator.
    separators: Vec<Range<usize>>,
    /// Place of every dof in the separator.
    pub(super) places: Vec<Option<u32>>,
    /// Components of all nodes, one after the other.
    coordinates: Vec<f64>,
    /// Nodes of the pieces of every body that falls into several.
    pieces: Vec<Vec<Vec<usize>>>,
    pub(super) cache: Option<Arc<SubdomainCache>>,
    pub(super) found: Mutex<CacheHits>,
}

/// Hits of the cache, by number of the body.
#[derive(Debug, Clone, Default)]
pub struct CacheHits {
    /// Bodies with their stiffness.
    pub subdomains: Vec<usize>,
    /// Their factors.
    pub factors: Vec<usize>,
}

impl Continuum {
    /// Assembles the bodies of a model and plans their condensation; what is on the cache is taken from there. Bodies with dofs that
    /// are `held` at any time, all dofs of the model, are not taken for turned ones.
    pub fn new(
        model: &Model,
        held: &[bool],
        cache: Option<Arc<SubdomainCache>>,
    ) -> Result<Continuum, TooLarge> {
        let c = model.components;
        let joined = model.joined();
        let joined_of = |b: usize| &joined[model.dofs_of(b).start / c..model.dofs_of(b).end / c];
        let likes = first_of_its_kind(model, &joined, held);
        let make = |b: usize| {
            let (subdomain, joined) = (&model.subdomains[b], joined_of(b));
            match &cache {
                Some(cache) => cache.subdomain(c, subdomain, model.thickness, joined),
                None => {
                    Substructure::new(c, subdomain, model.thickness, joined).map(|new| (Arc::new(new), false))
                }
            }
        };
        let firsts: Vec<usize> = (0..likes.len()).filter(|&b| likes[b].first == b).collect();
        let made: Vec<_> = firsts.par_iter().map(|&b| make(b)).collect();
        let mut of_firsts = HashMap::new();
        for (b, made) in firsts.into_iter().zip(made) {
            of_firsts.insert(b, made?);
        }
        let (mut subdomains, mut found) = (Vec::new(), CacheHits::default());
        for (b, like) in likes.iter().enumerate() {
            let (subdomain, there) = &of_firsts[&like.first];
            found.subdomains.extend(there.then_some(b));
            subdomains.push(subdomain.clone());
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
        Ok(Continuum { subdomains, likes, dofs, separators, places, coordinates, pieces, cache, found })
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

    /// Coordinates of all nodes, one after the other.
    pub(super) fn coordinates(&self) -> &[f64] {
        &self.coordinates
    }

    /// Coordinates of a body's nodes, one after the other.
    pub(super) fn coordinates_of(&self, subdomain: usize) -> &[f64] {
        &self.coordinates[self.dofs_of(subdomain)]
    }

    /// S of a body, its lower triangle.
    pub(super) fn schur_of<'a>(&self, condensation: &'a Condensation, subdomain: usize) -> &'a Mat<f64> {
        &condensation.schurs[subdomain]
    }

    /// The bodies that are not like an earlier one.
    fn firsts(&self) -> impl Iterator<Item = &Substructure> {
        let firsts = self.likes.iter().enumerate().filter(|(b, like)| like.first == *b);
        firsts.map(|(b, _)| &*self.subdomains[b])
    }

    /// Number of bodies that are not like an earlier one, and of their dofs.
    pub fn distinct(&self) -> (usize, usize) {
        let firsts = self.likes.iter().enumerate().filter(|(b, like)| like.first == *b);
        firsts.fold((0, 0), |(count, dofs), (b, _)| (count + 1, dofs + self.dofs[b].len()))
    }

    /// Number of entries of all factors.
    pub fn entries(&self) -> usize {
        self.firsts().map(|subdomain| subdomain.parts.entries()).sum()
    }

    /// Multiplications and additions to eliminate the interiors.
    pub fn operations(&self) -> f64 {
        self.firsts().map(|subdomain| subdomain.parts.operations()).sum()
    }

    /// Memory of the matrices, the factors and the work on them [bytes].
    pub fn bytes(&self) -> usize {
        let matrix = |subdomain: &Substructure| size_of::<f64>() * subdomain.stiffness.values.len();
        self.firsts().map(|subdomain| subdomain.parts.bytes() + matrix(subdomain)).sum()
    }

    /// S, its lower triangle.
    pub(super) fn schur(&self, condensation: &Condensation) -> Mat<f64> {
        let mut whole = Mat::zeros(self.separator(), self.separator());
        for (separator, schur) in self.separators.iter().zip(&condensation.schurs) {
            whole
                .submatrix_mut(separator.start, separator.start, separator.len(), separator.len())
                .copy_from(&**schur);
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
        let expand = |(k, inner): (usize, Vec<Mat<f64>>)| {
            let separator = &self.separators[k];
            let mut own = vec![vec![0.0; self.dofs[k].len()]; x.ncols()];
            let x = x.subrows(separator.start, separator.len());
            let parts = &self.subdomains[k].parts;
            let values = &condensation.subdomains[k].values;
            match &self.likes[k].rotation {
                Some(rotation) => {
                    let mut x = x.to_owned();
                    (0..x.ncols()).for_each(|j| rotation.back(x.col_as_slice_mut(j)));
                    parts.expand(values, inner, x.as_ref(), &mut own);
                    own.iter_mut().for_each(|own| rotation.turn(own));
                }
                None => parts.expand(values, inner, x, &mut own),
            }
            own
        };
        let solved: Vec<Vec<Vec<f64>>> = inner.into_par_iter().enumerate().map(expand).collect();
        for (own, dofs) in solved.into_iter().zip(&self.dofs) {
            b.iter_mut().zip(own).for_each(|(b, own)| b[dofs.clone()].copy_from_slice(&own));
        }
    }

    /// The way down of both substitutions: what every body keeps, and what the separator then has.
    fn forward(&self, condensation: &Condensation, b: &[Vec<f64>]) -> (Vec<Vec<Mat<f64>>>, Mat<f64>) {
        let reduce = |k: usize| {
            let own: Vec<&[f64]> = b.iter().map(|b| &b[self.dofs[k].clone()]).collect();
            let parts = &self.subdomains[k].parts;
            let values = &condensation.subdomains[k].values;
            let Some(rotation) = &self.likes[k].rotation else { return parts.reduce(values, &own) };
            let turned: Vec<Vec<f64>> = own.iter().map(|own| rotation.turned_back(own)).collect();
            let (inner, mut on_separator) =
                parts.reduce(values, &turned.iter().map(|b| &b[..]).collect::<Vec<_>>());
            (0..on_separator.ncols()).for_each(|j| rotation.turn(on_separator.col_as_slice_mut(j)));
            (inner, on_separator)
        };
        let reduced: Vec<(Vec<Mat<f64>>, Mat<f64>)> =
            (0..self.subdomains()).into_par_iter().map(reduce).collect();
        let (mut inner, mut whole) = (Vec::new(), Mat::zeros(self.separator(), b.len()));
        for ((of, on_separator), separator) in reduced.into_iter().zip(&self.separators) {
            inner.push(of);
            whole.subrows_mut(separator.start, separator.len()).copy_from(&on_separator);
        }
        (inner, whole)
    }

    /// f += K u, from differences.
    pub(super) fn add_product(&self, u: &[f64], f: &mut [f64]) {
        self.add(u, f, Rotation::turn, |subdomain, u, f| {
            subdomain.stiffness.add_product_by_differences(&subdomain.pattern, u, f);
        });
    }

    /// f − K u of bodies alone, from differences.
    pub(super) fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64> {
        let mut force = vec![0.0; f.len()];
        self.add_product(u, &mut force);
        f.iter().zip(force).map(|(f, force)| f - force).collect()
    }

    /// f += |K| |u|, from differences; of a turned body |R| times the sizes in the axes of the one it is like.
    pub(super) fn add_absolute_product(&self, u: &[f64], f: &mut [f64]) {
        self.add(u, f, Rotation::turn_sizes, |subdomain, u, f| {
            subdomain.stiffness.add_absolute_product_by_differences(&subdomain.pattern, u, f);
        });
    }

    /// Adds what every body makes of its displacements, side by side.
    fn add(
        &self,
        u: &[f64],
        f: &mut [f64],
        turn: impl Fn(&Rotation, &mut [f64]) + Sync,
        of: impl Fn(&Substructure, &[f64], &mut [f64]) + Sync,
    ) {
        let mut rest = f;
        let mut own = Vec::with_capacity(self.dofs.len());
        for dofs in &self.dofs {
            let (first, others) = rest.split_at_mut(dofs.len());
            own.push(first);
            rest = others;
        }
        own.into_par_iter().enumerate().for_each(|(b, f)| {
            let (subdomain, u) = (&self.subdomains[b], &u[self.dofs[b].clone()]);
            let Some(rotation) = &self.likes[b].rotation else { return of(subdomain, u, f) };
            let mut turned = vec![0.0; f.len()];
            of(subdomain, &rotation.turned_back(u), &mut turned);
            turn(rotation, &mut turned);
            f.iter_mut().zip(turned).for_each(|(f, turned)| *f += turned);
        });
    }
}

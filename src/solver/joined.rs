//! The equilibrium of many bodies on the displacements of the nodes that interfaces touch: every body condensed on them, the
//! system of all sparse by bodies and interfaces.
//!
//! ```text
//! R(x) = S x + Gᵀ q(G x) − f̂   where free,   k (x − x̄)   where held      J = S + Gᵀ T G,   k 1
//! ```
//!
//! S = diag(S₁, S₂, …) and f̂ are what the interiors leave on these nodes. A brick has fewer nodes on one of its sides than
//! interfaces around it have jumps: a factor of this system takes half the operations of one on jumps (`floating`). It ends where
//! `primal` ends, at ε K_N h/E; stiff interfaces need their jumps as unknowns.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use faer::Mat;
use rayon::prelude::*;

use super::fronts::{FrontWork, Fronts, Layout};
use super::interiors::Interiors;
use super::lower::{symmetric_product, whole};
use super::lu::SparseLu;
use super::refine::Factored;
use super::springs::SpringElements;
use super::{Condensation, Continuum, ForceScale, Form, NodalSolution};
use crate::assembly::{InterfaceOperator, InterfaceTangent};
use crate::sparse::Csr;

/// Rounding of one term of the residual, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Unknowns that are worth a thread.
const SIDE_BY_SIDE: usize = 2048;

/// The form of condensed bodies under one set of supports; all interfaces respond.
#[derive(Debug)]
pub struct JoinedSubdomains<'a> {
    interiors: Interiors<'a>,
    interfaces: &'a [InterfaceOperator],
    active: Vec<usize>,
    /// G of every interface on the separator, and Gᵀ of all.
    jumps: Vec<Csr>,
    transposed: Csr,
    springs: SpringElements,
    /// Supports on the separator.
    held: Vec<bool>,
    /// Bodies that nothing holds inside: S of these knows no difference between x and x + a translation.
    floats: Vec<bool>,
    /// Size of the continuum's stiffness: scales the equations of held dofs.
    scale: f64,
    lu: SparseLu,
    force_scale: ForceScale,
}

impl<'a> JoinedSubdomains<'a> {
    /// For a condensation that serves these supports.
    pub fn new(
        continuum: &'a Continuum,
        condensation: Arc<Condensation>,
        interfaces: &'a [InterfaceOperator],
        constrained: &[bool],
    ) -> JoinedSubdomains<'a> {
        let size = continuum.separator();
        let jumps = jumps(continuum, interfaces);
        let springs = SpringElements::new(jumps.par_iter());
        let transposed = Csr::stacked(&jumps).transposed();
        let mut held = vec![false; size];
        for (place, constrained) in continuum.places.iter().zip(constrained) {
            if let Some(place) = place {
                held[*place as usize] = *constrained;
            }
        }
        let inside = |b: usize| {
            let mut dofs = continuum.dofs_of(b);
            !dofs.any(|dof| constrained[dof] && continuum.places[dof].is_none())
        };
        let floats = (0..continuum.subdomains()).map(inside).collect();
        let largest = |b: usize| {
            let s = continuum.schur_of(&condensation, b);
            (0..s.nrows()).map(|k| s[(k, k)]).fold(0.0, f64::max)
        };
        let scale = (0..continuum.subdomains()).map(largest).fold(0.0, f64::max);
        JoinedSubdomains {
            interiors: Interiors::new(continuum, condensation, constrained),
            interfaces,
            active: (0..interfaces.len()).collect(),
            jumps,
            transposed,
            springs,
            held,
            floats,
            scale,
            lu: SparseLu::default(),
            force_scale: ForceScale::default(),
        }
    }

    /// Number of unknowns for a continuum.
    pub fn unknowns(continuum: &Continuum) -> usize {
        continuum.separator()
    }

    /// Work of a factorisation.
    pub fn work(continuum: &Continuum, interfaces: &[InterfaceOperator]) -> FrontWork {
        let springs = SpringElements::new(jumps(continuum, interfaces).par_iter());
        Fronts::new(&layout(continuum, springs.unknowns())).work()
    }

    /// f += S x, by the displacements against those of the body's first node.
    fn add_bodies(&self, x: &[f64], f: &mut [f64]) {
        self.add(f, |b, schur, place| {
            let of = &x[place];
            let c = self.interiors.continuum.components();
            let against = |k: usize| if self.floats[b] { of[k % c] } else { 0.0 };
            let moved: Vec<f64> = of.iter().enumerate().map(|(k, x)| x - against(k)).collect();
            symmetric_product(schur, &moved, |value| value)
        });
    }

    /// sizes += |S| |x|: displacements have the digits of the whole motion, whatever part of it is none of the body.
    fn add_body_sizes(&self, x: &[f64], sizes: &mut [f64]) {
        self.add(sizes, |_, schur, place| {
            let of: Vec<f64> = x[place].iter().map(|x| x.abs()).collect();
            symmetric_product(schur, &of, f64::abs)
        });
    }

    fn add(&self, f: &mut [f64], product: impl Fn(usize, &Mat<f64>, Range<usize>) -> Vec<f64> + Sync) {
        let Interiors { continuum, condensation, .. } = &self.interiors;
        let of = |b: usize| product(b, continuum.schur_of(condensation, b), continuum.separator_of(b));
        let products: Vec<Vec<f64>> = (0..continuum.subdomains()).into_par_iter().map(of).collect();
        f.iter_mut().zip(products.iter().flatten()).for_each(|(f, product)| *f += product);
    }

    /// Gᵀ q of all interfaces.
    fn nodal(&self, q: &[f64]) -> Vec<f64> {
        let at = |i: usize| {
            let (columns, values) = self.transposed.row(i);
            columns.iter().zip(values).map(|(&j, value)| value * q[j]).sum()
        };
        (0..self.held.len()).into_par_iter().with_min_len(SIDE_BY_SIDE).map(at).collect()
    }

    /// S x + Gᵀ q, and Gᵀ q.
    fn internal(&self, x: &[f64], forces: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
        let interfaces = self.nodal(&forces.concat());
        let mut internal = interfaces.clone();
        self.add_bodies(x, &mut internal);
        (internal, interfaces)
    }

    fn held_places(&self) -> impl Iterator<Item = usize> {
        self.held.iter().enumerate().filter(|(_, held)| **held).map(|(k, _)| k)
    }

    /// S of every body, bodies that are equal and not held sharing one.
    fn bodies(&self) -> Vec<Option<Arc<Mat<f64>>>> {
        let Interiors { continuum, condensation, .. } = &self.interiors;
        let mut shared: HashMap<*const Mat<f64>, Arc<Mat<f64>>> = HashMap::new();
        let body = |b: usize| {
            let schur = continuum.schur_of(condensation, b);
            let held = &self.held[continuum.separator_of(b)];
            if !held.contains(&true) {
                return Some(
                    shared
                        .entry(std::ptr::from_ref(schur))
                        .or_insert_with(|| Arc::new(whole(schur, held)))
                        .clone(),
                );
            }
            Some(Arc::new(whole(schur, held)))
        };
        (0..continuum.subdomains()).map(body).collect()
    }
}

/// G of every interface on the separator.
fn jumps(continuum: &Continuum, interfaces: &[InterfaceOperator]) -> Vec<Csr> {
    let place = |dof: usize| continuum.places[dof].map_or(0, |place| place as usize);
    interfaces.par_iter().map(|interface| interface.numbered(place, continuum.separator())).collect()
}

/// Places of the Jacobian's entries: an element of every body and of every interface.
fn layout(continuum: &Continuum, springs: Vec<Vec<u32>>) -> Layout {
    let (c, size) = (continuum.components(), continuum.separator());
    let mut coordinates = vec![0.0; size];
    for (place, x) in continuum.places.iter().zip(continuum.coordinates()) {
        if let Some(place) = place {
            coordinates[*place as usize] = *x;
        }
    }
    let of = |b: usize| {
        let of = continuum.separator_of(b);
        (of.start as u32..of.end as u32).collect()
    };
    Layout {
        node_of: (0..size).map(|k| (k / c) as u32).collect(),
        coordinates,
        nodes: size / c,
        elements: (0..continuum.subdomains()).map(of).chain(springs).collect(),
        entries: Vec::new(),
    }
}

fn squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

impl Form for JoinedSubdomains<'_> {
    fn interfaces(&self) -> &[InterfaceOperator] {
        self.interfaces
    }

    fn active(&self) -> &[usize] {
        &self.active
    }

    fn target(&self, force: &[f64], prescribed: &[f64]) -> Vec<f64> {
        let Interiors { continuum, .. } = &self.interiors;
        let mut target = self.interiors.condensed(force, prescribed);
        for (place, prescribed) in continuum.places.iter().zip(prescribed) {
            if let Some(place) = place.map(|place| place as usize).filter(|&place| self.held[place]) {
                target[place] = self.scale * prescribed;
            }
        }
        target
    }

    fn coefficients(&self, x: &[f64]) -> Vec<Vec<f64>> {
        self.jumps.par_iter().map(|jump| jump.multiply(x)).collect()
    }

    fn residual(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
        let (internal, _) = self.internal(x, forces);
        let value = |i: usize| if self.held[i] { self.scale * x[i] } else { internal[i] };
        (0..x.len()).map(|i| value(i) - target[i]).collect()
    }

    fn compare_with(&mut self, scale: ForceScale) {
        self.force_scale = scale;
    }

    /// Over what the bodies, the interfaces and the loads carry; prescribed displacements are no forces.
    fn error(&self, residual: &[f64], x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> f64 {
        let (internal, interfaces) = self.internal(x, forces);
        let loads = target.iter().zip(&self.held).filter(|(_, held)| !**held);
        let scale =
            squares(&internal) + squares(&interfaces) + loads.map(|(load, _)| load * load).sum::<f64>();
        self.force_scale.error(squares(residual), scale)
    }

    /// Jumps are differences of displacements: their rounding is that of the displacements, times the stiffness.
    fn rounding(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64], tangents: &[InterfaceTangent]) -> f64 {
        let mut sizes: Vec<f64> = target.iter().map(|b| b.abs()).collect();
        self.add_body_sizes(x, &mut sizes);
        let all = squares(&sizes) + self.springs.squares(&self.active, tangents, x);
        let one = vec![1.0; x.len()];
        let per_force = self.error(&one, x, forces, target) / (x.len() as f64).sqrt();
        ROUNDING * all.sqrt() * per_force
    }

    fn factor(&mut self, tangents: &[InterfaceTangent]) -> bool {
        let mut elements = vec![None; self.interiors.continuum.subdomains()];
        if !self.lu.is_planned() {
            let mut layout = layout(self.interiors.continuum, self.springs.unknowns());
            layout.entries = self.held_places().map(|k| (k as u32, k as u32)).collect();
            let diagonal = vec![self.scale; layout.entries.len()];
            self.lu.plan(layout, diagonal);
            elements = self.bodies();
        }
        elements.extend(self.springs.renewed(&self.active, tangents, &self.held));
        self.lu.factor(elements)
    }

    fn solve(&self, b: &mut [f64]) {
        self.lu.solve(b);
    }

    fn defect(&self, _: &[f64], _: &[f64]) -> Vec<f64> {
        Vec::new()
    }

    fn weights(&self, of_coefficients: &[Vec<f64>]) -> Vec<f64> {
        self.nodal(&of_coefficients.concat())
    }

    fn recover(&self, x: &[f64], forces: &[Vec<f64>], force: &[f64], prescribed: &[f64]) -> NodalSolution {
        let mut load = force.to_vec();
        for (interface, q) in self.interfaces.iter().zip(forces) {
            let against: Vec<f64> = q.iter().map(|q| -q).collect();
            interface.add_nodal(&against, &mut load);
        }
        let Interiors { continuum, .. } = &self.interiors;
        let on_separator = |(place, prescribed): (&Option<u32>, &f64)| match place.map(|place| place as usize)
        {
            Some(place) if !self.held[place] => x[place],
            _ => *prescribed,
        };
        let known: Vec<f64> = continuum.places.iter().zip(prescribed).map(on_separator).collect();
        let mut solution = self.interiors.refined(&load, &known);
        let free = |place: &Option<u32>| place.is_some_and(|place| !self.held[place as usize]);
        let left = solution.reactions.iter_mut().zip(&continuum.places);
        left.filter(|(_, place)| free(place)).for_each(|(left, _)| *left = 0.0);
        let target = self.target(force, prescribed);
        let error = self.error(&self.residual(x, forces, &target), x, forces, &target);
        solution.backward_error = solution.backward_error.max(error);
        solution
    }
}

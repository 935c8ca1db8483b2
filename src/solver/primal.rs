//! The equilibrium on the displacements: the plain sparse Newton, factored anew in every iteration.
//!
//! ```text
//! R(u) = K u + Gᵀ q(G u) − f   where free,   k (u − ū)   where held      J = K + Gᵀ T G,   k 1
//! ```
//!
//! The independent check of the condensed form, and the way for interfaces whose dense flexibility would not fit. Its accuracy
//! ends at ε K_N h/E, because u_B − u_A is taken before it is multiplied by K_N.

use rayon::prelude::*;

use super::fronts::{FrontWork, Fronts, Layout};
use super::linear::tractions;
use super::lu::SparseLu;
use super::springs::SpringElements;
use super::{ForceScale, Form, NodalSolution};
use crate::assembly::{InterfaceOperator, InterfaceTangent, Pattern, Symmetric};

/// Rounding of one term of the residual, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The plain form under one set of supports.
#[derive(Debug)]
pub struct Primal<'a> {
    interfaces: &'a [InterfaceOperator],
    active: Vec<usize>,
    /// True for these.
    responds: Vec<bool>,
    /// Law stiffness of the other interfaces.
    stiffness: &'a [Vec<f64>],
    pattern: &'a Pattern,
    continuum: &'a Symmetric,
    /// Coordinates of all nodes, one after the other.
    coordinates: Vec<f64>,
    constrained: Vec<bool>,
    /// Size of the continuum's stiffness: scales the equations of held dofs.
    scale: f64,
    force_scale: ForceScale,
    springs: SpringElements,
    lu: SparseLu,
}

impl<'a> Primal<'a> {
    /// The form of the continuum on its pattern, with the interfaces in `active` and, as constant springs, all others.
    pub fn new(
        interfaces: &'a [InterfaceOperator],
        active: &[usize],
        stiffness: &'a [Vec<f64>],
        (pattern, coordinates): (&'a Pattern, Vec<f64>),
        continuum: &'a Symmetric,
        constrained: &[bool],
    ) -> Primal<'a> {
        let diagonal = |j: usize| continuum.values[pattern.column(j).start];
        let scale = (0..pattern.size()).map(diagonal).fold(0.0, f64::max);
        let (active, constrained) = (active.to_vec(), constrained.to_vec());
        let mut responds = vec![false; interfaces.len()];
        active.iter().for_each(|&k| responds[k] = true);
        let springs = SpringElements::new(interfaces.par_iter().map(InterfaceOperator::jump));
        Primal {
            interfaces,
            active,
            responds,
            stiffness,
            pattern,
            continuum,
            coordinates,
            constrained,
            scale,
            springs,
            lu: SparseLu::default(),
            force_scale: ForceScale::default(),
        }
    }

    /// Work of a factorisation.
    pub fn work(pattern: &Pattern, coordinates: Vec<f64>, interfaces: &[InterfaceOperator]) -> FrontWork {
        let springs = SpringElements::new(interfaces.par_iter().map(InterfaceOperator::jump));
        let pairs = |j: usize| pattern.rows[pattern.column(j)].iter().map(move |&i| (i, j as u32));
        let entries = (0..pattern.size()).flat_map(pairs).collect();
        Fronts::new(&layout(pattern, coordinates, (springs.unknowns(), entries))).work()
    }

    fn passive(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.interfaces.len()).filter(|&k| !self.responds[k])
    }

    /// Places and values of the bodies' entries, and of the equations of held dofs.
    fn entries(&self) -> (Vec<(u32, u32)>, Vec<f64>) {
        let n = self.pattern.size();
        let (mut entries, mut values) = (Vec::new(), Vec::new());
        let mut entry = |i: usize, j: usize, value: f64| {
            if !self.constrained[i] {
                entries.push((i as u32, j as u32));
                values.push(value);
            }
        };
        for j in 0..n {
            let range = self.pattern.column(j);
            for (&i, &value) in self.pattern.rows[range.clone()].iter().zip(&self.continuum.values[range]) {
                entry(i as usize, j, value);
                if i as usize != j {
                    entry(j, i as usize, value);
                }
            }
        }
        for i in (0..n).filter(|&i| self.constrained[i]) {
            entries.push((i as u32, i as u32));
            values.push(self.scale);
        }
        (entries, values)
    }

    /// K u + Gᵀ q of all interfaces.
    fn internal(&self, u: &[f64], forces: &[Vec<f64>]) -> Vec<f64> {
        let mut internal = vec![0.0; u.len()];
        self.continuum.add_product_by_differences(self.pattern, u, &mut internal);
        self.active.iter().zip(forces).for_each(|(&k, q)| self.interfaces[k].add_nodal(q, &mut internal));
        for k in self.passive() {
            self.interfaces[k]
                .add_force(&tractions(&self.interfaces[k], &self.stiffness[k], u), &mut internal);
        }
        internal
    }
}

/// Places of the Jacobian's entries: an element of every interface, and the bodies' as they are.
fn layout(
    pattern: &Pattern,
    coordinates: Vec<f64>,
    (elements, entries): (Vec<Vec<u32>>, Vec<(u32, u32)>),
) -> Layout {
    let (n, c) = (pattern.size(), pattern.components());
    let node_of = (0..n).map(|dof| (dof / c) as u32).collect();
    Layout { node_of, coordinates, nodes: n / c, elements, entries }
}

impl Form for Primal<'_> {
    fn interfaces(&self) -> &[InterfaceOperator] {
        self.interfaces
    }

    fn active(&self) -> &[usize] {
        &self.active
    }

    fn target(&self, force: &[f64], prescribed: &[f64]) -> Vec<f64> {
        let value = |i: usize| if self.constrained[i] { self.scale * prescribed[i] } else { force[i] };
        (0..force.len()).map(value).collect()
    }

    fn coefficients(&self, x: &[f64]) -> Vec<Vec<f64>> {
        self.active.iter().map(|&k| self.interfaces[k].coefficients(x)).collect()
    }

    fn residual(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
        let internal = self.internal(x, forces);
        let value = |i: usize| if self.constrained[i] { self.scale * x[i] } else { internal[i] };
        (0..x.len()).map(|i| value(i) - target[i]).collect()
    }

    fn compare_with(&mut self, scale: ForceScale) {
        self.force_scale = scale;
    }

    /// Over what the bodies, the interfaces and the loads carry; prescribed displacements are no forces.
    fn error(&self, residual: &[f64], x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> f64 {
        let squares = |v: &mut dyn Iterator<Item = f64>| v.map(|v| v * v).sum::<f64>();
        let misfit = squares(&mut residual.iter().copied());
        let internal = self.internal(x, forces);
        let mut interfaces = vec![0.0; x.len()];
        self.active.iter().zip(forces).for_each(|(&k, q)| self.interfaces[k].add_nodal(q, &mut interfaces));
        let scale = squares(&mut internal.into_iter())
            + squares(&mut interfaces.into_iter())
            + squares(
                &mut target
                    .iter()
                    .zip(&self.constrained)
                    .filter(|(_, constrained)| !**constrained)
                    .map(|(f, _)| *f),
            );
        self.force_scale.error(misfit, scale)
    }

    /// Jumps are differences of displacements: their rounding is that of the displacements, times the stiffness.
    fn rounding(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64], tangents: &[InterfaceTangent]) -> f64 {
        let mut sizes: Vec<f64> = target.iter().map(|b| b.abs()).collect();
        self.continuum.add_absolute_product(self.pattern, x, &mut sizes);
        let squares = sizes.iter().map(|size| size * size).sum::<f64>()
            + self.springs.squares(&self.active, tangents, x);
        let one = vec![1.0; x.len()];
        let per_force = self.error(&one, x, forces, target) / (x.len() as f64).sqrt();
        ROUNDING * squares.sqrt() * per_force
    }

    fn factor(&mut self, tangents: &[InterfaceTangent]) -> bool {
        let mut elements = self.springs.renewed(&self.active, tangents, &self.constrained);
        if !self.lu.is_planned() {
            let passive: Vec<usize> = self.passive().collect();
            let constant = |&k: &usize| {
                let mut tangent = InterfaceTangent::new(&self.interfaces[k]);
                tangent.fill(&self.interfaces[k], &self.stiffness[k]);
                tangent
            };
            let constant: Vec<InterfaceTangent> = passive.iter().map(constant).collect();
            let mut springs = self.springs.renewed(&passive, &constant, &self.constrained);
            passive.iter().for_each(|&k| elements[k] = springs[k].take());
            let (entries, values) = self.entries();
            let unknowns = (self.springs.unknowns(), entries);
            self.lu.plan(layout(self.pattern, self.coordinates.clone(), unknowns), values);
        }
        self.lu.factor(elements)
    }

    fn solve(&self, b: &mut [f64]) {
        self.lu.solve(b);
    }

    fn defect(&self, _: &[f64], _: &[f64]) -> Vec<f64> {
        Vec::new()
    }

    fn weights(&self, of_coefficients: &[Vec<f64>]) -> Vec<f64> {
        let mut weights = vec![0.0; self.constrained.len()];
        self.active
            .iter()
            .zip(of_coefficients)
            .for_each(|(&k, c)| self.interfaces[k].add_nodal(c, &mut weights));
        weights
    }

    fn recover(&self, x: &[f64], forces: &[Vec<f64>], force: &[f64], prescribed: &[f64]) -> NodalSolution {
        let internal = self.internal(x, forces);
        let residual: Vec<f64> = internal.iter().zip(force).map(|(internal, f)| internal - f).collect();
        let reactions = residual
            .iter()
            .zip(&self.constrained)
            .map(|(r, &constrained)| if constrained { *r } else { 0.0 })
            .collect();
        let u = (0..x.len()).map(|i| if self.constrained[i] { prescribed[i] } else { x[i] }).collect();
        let target = self.target(force, prescribed);
        let backward_error = self.error(&self.residual(x, forces, &target), x, forces, &target);
        NodalSolution { u, reactions, backward_error }
    }
}

//! The equilibrium of many bodies on the jump coefficients: every body keeps its own flexibility, and where it floats its
//! rigid motions are unknowns. The system is sparse by blocks, where the dense one of `dual` would be full.
//!
//! ```text
//! R_a = a + Σ G F̂ Gᵀ q(a) − Σ G N α − Σ G F̂ f̂        F̂ = (S + c N Nᵀ)⁻¹      u = F̂ (f̂ − Gᵀ q) + N α
//! R_α = Nᵀ Gᵀ q(a) − Nᵀ f̂                             sums over the bodies, S their condensations, f̂ their loads
//!
//! J = ⎡ I + Σ G F̂ Gᵀ T   −G N ⎤
//!     ⎣     (G N)ᵀ T       0  ⎦
//! ```
//!
//! N: the rigid motions that the supports of a body leave free, orthonormal on its separator, so that S N = 0. The second equation
//! says that its loads balance, and F̂ is then as good as a generalised inverse of S. Motions that are held keep their place
//! among the unknowns with the equation α = 0, so that the unknowns are the same under all supports.

use std::sync::Arc;

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use rayon::prelude::*;

use super::block::SubdomainBlock;
use super::dense::column_mut;
use super::fronts::{FrontWork, Fronts};
use super::lu::SparseLu;
use super::modes::FloatingModes;
use super::numbering::{Numbering, layout};
use super::refine::Factored;
use super::{Condensation, Continuum, ForceScale, Form, NodalSolution, NotPositiveDefinite};
use crate::assembly::{InterfaceOperator, InterfaceTangent};
use crate::sparse::Csr;

/// Rounding of one term of the residual, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Forces below this part of what the base stiffness would carry are no measure of their own.
const SLIGHT: f64 = 1e-3;

/// The form of many bodies under one set of supports; all interfaces respond.
#[derive(Debug)]
pub struct FloatingSubdomains<'a> {
    subdomains: FloatingModes<'a>,
    interfaces: &'a [InterfaceOperator],
    active: Vec<usize>,
    /// Base stiffness of the size of E/h: it measures jumps as forces.
    base_stiffness: Vec<Csr>,
    /// First unknown of every interface; the rigid motions follow the last.
    first: Vec<usize>,
    blocks: Vec<SubdomainBlock>,
    unknowns: usize,
    lu: SparseLu,
    /// Values of the tangents that are factored.
    factored: Vec<Vec<f64>>,
    force_scale: ForceScale,
}

impl<'a> FloatingSubdomains<'a> {
    /// Condenses every body on the interfaces for itself. `stiffness`: base stiffness of the size of E/h at every law point.
    pub fn new(
        continuum: &'a Continuum,
        condensation: Arc<Condensation>,
        interfaces: &'a [InterfaceOperator],
        stiffness: &[Vec<f64>],
        constrained: &[bool],
    ) -> Result<FloatingSubdomains<'a>, NotPositiveDefinite> {
        let subdomains = FloatingModes::new(continuum, condensation, constrained)?;
        let Numbering { first, of, starts, unknowns } = Numbering::new(continuum, interfaces);
        let block = |b: usize| SubdomainBlock::new(&subdomains, interfaces, (&first, &of[b]), b, starts[b]);
        let blocks = (0..continuum.subdomains()).into_par_iter().map(block).collect();
        let base_spring = |(interface, stiffness): (&InterfaceOperator, &Vec<f64>)| {
            let mut tangent = InterfaceTangent::new(interface);
            tangent.fill(interface, stiffness);
            tangent.matrix
        };
        let base_stiffness = interfaces.iter().zip(stiffness).map(base_spring).collect();
        let active = (0..interfaces.len()).collect();
        Ok(FloatingSubdomains {
            subdomains,
            interfaces,
            active,
            base_stiffness,
            first,
            blocks,
            unknowns,
            lu: SparseLu::default(),
            factored: Vec::new(),
            force_scale: ForceScale::default(),
        })
    }

    /// Number of unknowns for a continuum: jump coefficients and rigid motions.
    pub fn unknowns(continuum: &Continuum, interfaces: &[InterfaceOperator]) -> usize {
        Numbering::new(continuum, interfaces).unknowns
    }

    /// Work of a factorisation.
    pub fn work(continuum: &Continuum, interfaces: &[InterfaceOperator]) -> FrontWork {
        Fronts::new(&layout(continuum, interfaces)).work()
    }

    fn part<'b>(&self, k: usize, x: &'b [f64]) -> &'b [f64] {
        &x[self.first[k]..self.first[k + 1]]
    }

    fn coefficients_of(&self, u: &[f64]) -> Vec<f64> {
        self.interfaces.iter().flat_map(|interface| interface.coefficients(u)).collect()
    }

    /// The part of a body in the Jacobian.
    fn element(&self, block: &SubdomainBlock, columns: &[Csr]) -> Mat<f64> {
        let (m, rigid_modes) = (block.touched.len(), block.moved.ncols());
        let mut element = Mat::zeros(m + block.most, m + block.most);
        for (at, &j) in block.touched.iter().enumerate() {
            let k = self.first.partition_point(|&first| first <= j) - 1;
            let column = element.col_as_slice_mut(at);
            // all unknowns of an interface that a body touches stand one after the other
            let (rows, stiffness) = columns[k].row(j - self.first[k]);
            for (&row, &value) in rows.iter().zip(stiffness).filter(|(_, value)| **value != 0.0) {
                let from = at + row + self.first[k] - j;
                let flexibility = block.flexibility.col_as_slice(from);
                column.iter_mut().zip(flexibility).for_each(|(entry, f)| *entry += value * f);
                (0..rigid_modes).for_each(|i| column[m + i] += value * block.moved[(from, i)]);
            }
            (0..rigid_modes).for_each(|i| element[(at, m + i)] = -block.moved[(at, i)]);
        }
        (rigid_modes..block.most).for_each(|i| element[(m + i, m + i)] = 1.0);
        element
    }
}

impl Form for FloatingSubdomains<'_> {
    fn interfaces(&self) -> &[InterfaceOperator] {
        self.interfaces
    }

    fn active(&self) -> &[usize] {
        &self.active
    }

    fn target(&self, force: &[f64], prescribed: &[f64]) -> Vec<f64> {
        let constrained = &self.subdomains.constrained;
        let start: Vec<f64> = prescribed
            .iter()
            .zip(constrained)
            .map(|(u, constrained)| if *constrained { *u } else { 0.0 })
            .collect();
        let mut load = self.subdomains.residual(force, &start);
        load.iter_mut()
            .zip(constrained)
            .filter(|(_, constrained)| **constrained)
            .for_each(|(load, _)| *load = 0.0);
        let modal_forces = self.subdomains.modal_forces(&load);
        let mut solved = [load];
        self.subdomains.apply(&mut solved);
        let [mut u] = solved;
        u.iter_mut().zip(&start).for_each(|(u, start)| *u += start);
        let mut target = self.coefficients_of(&u);
        target.resize(self.unknowns, 0.0);
        for (block, modal_forces) in self.blocks.iter().zip(modal_forces) {
            target[block.first..block.first + modal_forces.len()].copy_from_slice(&modal_forces);
        }
        target
    }

    fn coefficients(&self, x: &[f64]) -> Vec<Vec<f64>> {
        self.active.iter().map(|&k| self.part(k, x).to_vec()).collect()
    }

    fn residual(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
        let q = forces.concat();
        let mut residual: Vec<f64> = x.iter().zip(target).map(|(x, target)| x - target).collect();
        for block in &self.blocks {
            let (m, rigid_modes) = (block.touched.len(), block.moved.ncols());
            let mut local: Vec<f64> = block.touched.iter().map(|&j| q[j]).collect();
            let mut jumps = vec![0.0; m];
            let flexibility = block.flexibility.as_ref();
            matmul(column_mut(&mut jumps), Accum::Add, flexibility, column_mut(&mut local), 1.0, Par::Seq);
            for k in 0..rigid_modes {
                let alpha = x[block.first + k];
                (0..m).for_each(|i| jumps[i] -= block.moved[(i, k)] * alpha);
                let push: f64 = (0..m).map(|i| block.moved[(i, k)] * local[i]).sum();
                residual[block.first + k] = push - target[block.first + k];
            }
            block.touched.iter().zip(&jumps).for_each(|(&j, jump)| residual[j] += jump);
        }
        residual
    }

    fn compare_with(&mut self, scale: ForceScale) {
        self.force_scale = scale;
    }

    /// Forces of the base stiffness for the misfit of jumps, and the misfit of the bodies' balance, over what interfaces and loads carry.
    /// A rigid motion of all makes no difference: jumps without interface forces count with the rigid motions found.
    fn error(&self, residual: &[f64], x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> f64 {
        let squares = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
        let end = self.first[self.interfaces.len()];
        let (mut misfit, mut scale) = (squares(&residual[end..]), squares(&target[end..]));
        let mut free = target[..end].to_vec();
        for block in &self.blocks {
            for (i, &j) in block.touched.iter().enumerate() {
                free[j] +=
                    (0..block.moved.ncols()).map(|k| block.moved[(i, k)] * x[block.first + k]).sum::<f64>();
            }
        }
        for k in 0..self.interfaces.len() {
            misfit += squares(&self.base_stiffness[k].multiply(self.part(k, residual)));
            let unlimited = squares(&self.base_stiffness[k].multiply(self.part(k, &free)));
            scale += squares(&forces[k]) + SLIGHT * SLIGHT * unlimited;
        }
        self.force_scale.error(misfit, scale)
    }

    /// Every term of the residual to the precision of numbers.
    fn rounding(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64], _: &[InterfaceTangent]) -> f64 {
        let q = forces.concat();
        let mut sizes: Vec<f64> = x.iter().zip(target).map(|(x, b)| x.abs() + b.abs()).collect();
        for block in &self.blocks {
            for (i, &row) in block.touched.iter().enumerate() {
                let base_stiffness = block.touched.iter().enumerate();
                sizes[row] +=
                    base_stiffness.map(|(j, &of)| (block.flexibility[(i, j)] * q[of]).abs()).sum::<f64>();
                for k in 0..block.moved.ncols() {
                    sizes[row] += (block.moved[(i, k)] * x[block.first + k]).abs();
                    sizes[block.first + k] += (block.moved[(i, k)] * q[row]).abs();
                }
            }
        }
        sizes.iter_mut().for_each(|size| *size *= ROUNDING);
        self.error(&sizes, x, forces, target)
    }

    fn factor(&mut self, tangents: &[InterfaceTangent]) -> bool {
        if !self.lu.is_planned() {
            let layout = layout(self.subdomains.continuum, self.interfaces);
            let jumps = layout.entries.len();
            self.lu.plan(layout, vec![1.0; jumps]);
        }
        let values: Vec<Vec<f64>> = tangents.iter().map(|tangent| tangent.matrix.values.clone()).collect();
        let changed: Vec<bool> =
            (0..values.len()).map(|k| self.factored.get(k) != Some(&values[k])).collect();
        let columns: Vec<Csr> = tangents.par_iter().map(|tangent| tangent.matrix.transposed()).collect();
        let first = self.factored.is_empty();
        let renew = |block: &SubdomainBlock| {
            let renewed = first || block.interfaces.iter().any(|&k| changed[k]);
            renewed.then(|| Arc::new(self.element(block, &columns)))
        };
        let elements = self.blocks.par_iter().map(renew).collect();
        self.factored = values;
        self.lu.factor(elements)
    }

    fn solve(&self, b: &mut [f64]) {
        self.lu.solve(b);
    }

    fn defect(&self, x: &[f64], u: &[f64]) -> Vec<f64> {
        let mut defect: Vec<f64> =
            x.iter().zip(self.coefficients_of(u)).map(|(a, moved)| a - moved).collect();
        defect.resize(self.unknowns, 0.0);
        defect
    }

    fn weights(&self, of_coefficients: &[Vec<f64>]) -> Vec<f64> {
        let mut weights = of_coefficients.concat();
        weights.resize(self.unknowns, 0.0);
        weights
    }

    fn recover(&self, x: &[f64], forces: &[Vec<f64>], force: &[f64], prescribed: &[f64]) -> NodalSolution {
        let mut load = force.to_vec();
        for (interface, q) in self.interfaces.iter().zip(forces) {
            let against: Vec<f64> = q.iter().map(|q| -q).collect();
            interface.add_nodal(&against, &mut load);
        }
        let mut solution = self.subdomains.refined(&load, prescribed);
        for (b, (block, rigid_modes)) in self.blocks.iter().zip(&self.subdomains.rigid_modes).enumerate() {
            let u = &mut solution.u[self.subdomains.continuum.dofs_of(b)];
            for (k, motion) in rigid_modes.iter().enumerate() {
                u.iter_mut().zip(motion).for_each(|(u, n)| *u += x[block.first + k] * n);
            }
        }
        solution
    }
}

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
//! N: the rigid motions that the supports of a body leave free, orthonormal on its border, so that S N = 0. The second equation
//! says that its loads balance, and F̂ is then as good as a generalised inverse of S. Motions that are held keep their place
//! among the unknowns with the equation α = 0, so that the unknowns are the same under all supports.

use std::sync::Arc;

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};
use faer::{Accum, Par};
use rayon::prelude::*;

use super::block::SubdomainBlock;
use super::dense::column_mut;
use super::modes::FloatingModes;
use super::motions::most;
use super::refine::Factored;
use super::{Condensation, Continuum, Form, NodalSolution, NotPositiveDefinite};
use crate::assembly::{InterfaceTangent, Joint};
use crate::sparse::Csr;

/// Rounding of one term of the residual, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Forces below this part of what springs in place of the joints would carry are no measure of their own.
const SLIGHT: f64 = 1e-3;

/// The form of many bodies under one set of supports; all joints are asked.
#[derive(Debug)]
pub struct FloatingSubdomains<'a> {
    bodies: FloatingModes<'a>,
    joints: &'a [Joint],
    active: Vec<usize>,
    /// Springs of the size of E/h: they measure jumps as forces.
    springs: Vec<Csr>,
    /// First unknown of every joint; the rigid motions follow the last.
    first: Vec<usize>,
    blocks: Vec<SubdomainBlock>,
    unknowns: usize,
    plan: Option<(SymbolicSparseColMat<usize>, Argsort<usize>, SymbolicLu<usize>)>,
    factor: Option<Lu<usize, f64>>,
}

impl<'a> FloatingSubdomains<'a> {
    /// Condenses every body on the joints for itself. `stiffness`: springs of the size of E/h at every law point.
    pub fn new(
        continuum: &'a Continuum,
        condensation: Arc<Condensation>,
        joints: &'a [Joint],
        stiffness: &[Vec<f64>],
        held: &[bool],
    ) -> Result<FloatingSubdomains<'a>, NotPositiveDefinite> {
        let bodies = FloatingModes::new(continuum, condensation, held)?;
        let mut first = vec![0];
        joints.iter().for_each(|joint| first.push(first[first.len() - 1] + joint.size()));
        let mut unknowns = first[joints.len()];
        let mut starts = Vec::new();
        for b in 0..continuum.bodies() {
            starts.push((unknowns, most(continuum.components(), continuum.pieces_of(b))));
            unknowns += starts[b].1;
        }
        let block = |b: usize| SubdomainBlock::new(&bodies, joints, &first, b, starts[b]);
        let blocks = (0..continuum.bodies()).into_par_iter().map(block).collect();
        let spring = |(joint, stiffness): (&Joint, &Vec<f64>)| {
            let mut tangent = InterfaceTangent::new(joint);
            tangent.fill(joint, stiffness);
            tangent.matrix
        };
        let springs = joints.iter().zip(stiffness).map(spring).collect();
        let active = (0..joints.len()).collect();
        Ok(FloatingSubdomains {
            bodies,
            joints,
            active,
            springs,
            first,
            blocks,
            unknowns,
            plan: None,
            factor: None,
        })
    }

    /// Number of unknowns for a continuum: jump coefficients and rigid motions.
    pub fn unknowns(continuum: &Continuum, joints: &[Joint]) -> usize {
        let motions: usize =
            (0..continuum.bodies()).map(|b| most(continuum.components(), continuum.pieces_of(b))).sum();
        joints.iter().map(Joint::size).sum::<usize>() + motions
    }

    fn part<'b>(&self, k: usize, x: &'b [f64]) -> &'b [f64] {
        &x[self.first[k]..self.first[k + 1]]
    }

    fn coefficients_of(&self, u: &[f64]) -> Vec<f64> {
        self.joints.iter().flat_map(|joint| joint.coefficients(u)).collect()
    }

    /// Places of the Jacobian's entries, in the order of `entries`.
    fn places(&self) -> Vec<Pair<usize, usize>> {
        let mut places = Vec::new();
        for block in &self.blocks {
            let motions = block.moved.ncols();
            for &j in &block.touched {
                places.extend(block.touched.iter().map(|&row| Pair { row, col: j }));
                places.extend((0..motions).map(|k| Pair { row: block.first + k, col: j }));
                places.extend((0..motions).map(|k| Pair { row: j, col: block.first + k }));
            }
            places.extend((motions..block.most).map(|k| Pair { row: block.first + k, col: block.first + k }));
        }
        places.extend((0..self.first[self.joints.len()]).map(|k| Pair { row: k, col: k }));
        places
    }

    fn entries(&self, tangents: &[InterfaceTangent]) -> Vec<f64> {
        let columns: Vec<Csr> = tangents.iter().map(|tangent| tangent.matrix.transposed()).collect();
        let of_block = |block: &SubdomainBlock| {
            let (m, motions) = (block.touched.len(), block.moved.ncols());
            let mut values = Vec::with_capacity(m * (m + 2 * motions) + block.most);
            let mut column = vec![0.0; m + motions];
            for (at, &j) in block.touched.iter().enumerate() {
                column.fill(0.0);
                let k = self.first.partition_point(|&first| first <= j) - 1;
                // all unknowns of a joint that a body touches stand one after the other
                let (rows, stiffness) = columns[k].row(j - self.first[k]);
                for (&row, &value) in rows.iter().zip(stiffness).filter(|(_, value)| **value != 0.0) {
                    let from = at + row + self.first[k] - j;
                    (0..m).for_each(|i| column[i] += value * block.flexibility[(i, from)]);
                    (0..motions).for_each(|i| column[m + i] += value * block.moved[(from, i)]);
                }
                values.extend_from_slice(&column);
                values.extend((0..motions).map(|i| -block.moved[(at, i)]));
            }
            values.extend((motions..block.most).map(|_| 1.0));
            values
        };
        let mut values: Vec<f64> = self.blocks.par_iter().flat_map_iter(of_block).collect();
        values.extend((0..self.first[self.joints.len()]).map(|_| 1.0));
        values
    }
}

impl Form for FloatingSubdomains<'_> {
    fn joints(&self) -> &[Joint] {
        self.joints
    }

    fn active(&self) -> &[usize] {
        &self.active
    }

    fn target(&self, force: &[f64], prescribed: &[f64]) -> Vec<f64> {
        let held = &self.bodies.held;
        let start: Vec<f64> =
            prescribed.iter().zip(held).map(|(u, held)| if *held { *u } else { 0.0 }).collect();
        let mut load = self.bodies.residual(force, &start);
        load.iter_mut().zip(held).filter(|(_, held)| **held).for_each(|(load, _)| *load = 0.0);
        let pushed = self.bodies.pushed(&load);
        let mut solved = [load];
        self.bodies.apply(&mut solved);
        let [mut u] = solved;
        u.iter_mut().zip(&start).for_each(|(u, start)| *u += start);
        let mut target = self.coefficients_of(&u);
        target.resize(self.unknowns, 0.0);
        for (block, pushed) in self.blocks.iter().zip(pushed) {
            target[block.first..block.first + pushed.len()].copy_from_slice(&pushed);
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
            let (m, motions) = (block.touched.len(), block.moved.ncols());
            let mut local: Vec<f64> = block.touched.iter().map(|&j| q[j]).collect();
            let mut jumps = vec![0.0; m];
            let flexibility = block.flexibility.as_ref();
            matmul(column_mut(&mut jumps), Accum::Add, flexibility, column_mut(&mut local), 1.0, Par::Seq);
            for k in 0..motions {
                let alpha = x[block.first + k];
                (0..m).for_each(|i| jumps[i] -= block.moved[(i, k)] * alpha);
                let push: f64 = (0..m).map(|i| block.moved[(i, k)] * local[i]).sum();
                residual[block.first + k] = push - target[block.first + k];
            }
            block.touched.iter().zip(&jumps).for_each(|(&j, jump)| residual[j] += jump);
        }
        residual
    }

    /// What springs would make of the misfit of jumps, and the misfit of the bodies' balance, over what interfaces and loads carry.
    /// A rigid motion of all makes no difference: jumps without interface forces count with the rigid motions found.
    fn error(&self, residual: &[f64], x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> f64 {
        let squares = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
        let end = self.first[self.joints.len()];
        let (mut misfit, mut scale) = (squares(&residual[end..]), squares(&target[end..]));
        let mut free = target[..end].to_vec();
        for block in &self.blocks {
            for (i, &j) in block.touched.iter().enumerate() {
                free[j] +=
                    (0..block.moved.ncols()).map(|k| block.moved[(i, k)] * x[block.first + k]).sum::<f64>();
            }
        }
        for k in 0..self.joints.len() {
            misfit += squares(&self.springs[k].multiply(self.part(k, residual)));
            let unlimited = squares(&self.springs[k].multiply(self.part(k, &free)));
            scale += squares(&forces[k]) + SLIGHT * SLIGHT * unlimited;
        }
        if misfit == 0.0 { 0.0 } else { (misfit / scale).sqrt() }
    }

    /// Every term of the residual to the precision of numbers.
    fn rounding(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64], _: &[InterfaceTangent]) -> f64 {
        let q = forces.concat();
        let mut sizes: Vec<f64> = x.iter().zip(target).map(|(x, b)| x.abs() + b.abs()).collect();
        for block in &self.blocks {
            for (i, &row) in block.touched.iter().enumerate() {
                let springs = block.touched.iter().enumerate();
                sizes[row] += springs.map(|(j, &of)| (block.flexibility[(i, j)] * q[of]).abs()).sum::<f64>();
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
        let values = self.entries(tangents);
        if self.plan.is_none() {
            let made =
                SymbolicSparseColMat::try_new_from_indices(self.unknowns, self.unknowns, &self.places());
            self.plan = made.ok().and_then(|(pattern, order)| {
                let symbolic = SymbolicLu::try_new(pattern.as_ref()).ok()?;
                Some((pattern, order, symbolic))
            });
        }
        let Some((pattern, order, symbolic)) = &self.plan else { return false };
        let matrix = SparseColMat::new_from_argsort(pattern.clone(), order, &values);
        self.factor =
            matrix.ok().and_then(|matrix| Lu::try_new_with_symbolic(symbolic.clone(), matrix.as_ref()).ok());
        self.factor.is_some()
    }

    fn solve(&self, b: &mut [f64]) {
        if let Some(factor) = &self.factor {
            factor.solve_in_place(column_mut(b));
        }
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
        for (joint, q) in self.joints.iter().zip(forces) {
            let against: Vec<f64> = q.iter().map(|q| -q).collect();
            joint.add_nodal(&against, &mut load);
        }
        let mut solution = self.bodies.refined(&load, prescribed);
        for (b, (block, motions)) in self.blocks.iter().zip(&self.bodies.motions).enumerate() {
            let u = &mut solution.u[self.bodies.continuum.dofs_of(b)];
            for (k, motion) in motions.iter().enumerate() {
                u.iter_mut().zip(motion).for_each(|(u, n)| *u += x[block.first + k] * n);
            }
        }
        solution
    }
}

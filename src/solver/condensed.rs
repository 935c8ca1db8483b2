//! The equilibrium on the jump coefficients: the continuum is linear, so an iteration does not touch it.
//!
//! ```text
//! R(a) = a + F₀ (q(a) − T₀ a) − a₀     F₀ = G K₀⁻¹ Gᵀ     a₀ = G K₀⁻¹ f
//! J    = I + F₀ (T + P − T₀)           u  = K₀⁻¹ (f − Gᵀ (q − T₀ a))        P: pressures of flow
//! ```
//!
//! Neither F₀ nor T is inverted: F₀ is singular where interface nodes are held, T where an interface slides or is open. The
//! system is well conditioned at every K_N. Elastic interfaces are part of K₀, only the others respond (`active`).

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

use super::dense::column_mut;
use super::jacobian::Jacobian;
use super::measure::Functional;
use super::refine::Factored;
use super::{Base, ForceScale, Form, LinearMeasure, NodalSolution, Ramp};
use crate::assembly::{InterfaceOperator, InterfaceTangent};
use crate::sparse::Csr;

/// Rounding of one term of the residual, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Forces of the interfaces below this part of what the base stiffness would carry are no measure of their own.
const SLIGHT: f64 = 1e-3;
/// Jumps this many times those of the base system have no hold.
const RUN_AWAY: f64 = 100.0;

/// The condensed form under one set of supports.
#[derive(Debug)]
pub struct Condensed<'a> {
    base: Base<'a>,
    active: Vec<usize>,
    /// T₀ of every active interface.
    base_stiffness: Vec<Csr>,
    /// First unknown of every active interface, and the end.
    first: Vec<usize>,
    flexibility: Mat<f64>,
    /// Targets at both ends of a prepared step, and its measures.
    targets: [Vec<f64>; 2],
    functionals: Vec<Functional>,
    jacobian: Jacobian,
    force_scale: ForceScale,
    /// Derivative of the forces beyond the tangents.
    beyond: Option<Mat<f64>>,
}

impl<'a> Condensed<'a> {
    /// Condenses a base system on the interfaces in `active`, whose base stiffness is `stiffness` at every law point and whose laws
    /// have the stiffness `intact` there before anything has cracked or slipped.
    pub fn new(
        base: Base<'a>,
        active: &[usize],
        stiffness: &[Vec<f64>],
        intact: &[Vec<f64>],
    ) -> Condensed<'a> {
        let matrices = |stiffness: &[Vec<f64>]| -> Vec<Csr> {
            let matrix = |&k: &usize| {
                let mut tangent = InterfaceTangent::new(&base.interfaces[k]);
                tangent.fill(&base.interfaces[k], &stiffness[k]);
                tangent.matrix
            };
            active.iter().map(matrix).collect()
        };
        let base_stiffness = matrices(stiffness);
        let jacobian = Jacobian::new(&base_stiffness, &matrices(intact));
        let mut first = vec![0];
        base_stiffness
            .iter()
            .for_each(|base_stiffness| first.push(first[first.len() - 1] + base_stiffness.rows()));
        let flexibility = base.flexibility(active);
        let active = active.to_vec();
        let (targets, functionals) = ([Vec::new(), Vec::new()], Vec::new());
        Condensed {
            base,
            active,
            base_stiffness,
            first,
            flexibility,
            targets,
            functionals,
            jacobian,
            force_scale: ForceScale::default(),
            beyond: None,
        }
    }

    fn part<'b>(&self, k: usize, x: &'b [f64]) -> &'b [f64] {
        &x[self.first[k]..self.first[k + 1]]
    }

    /// q − T₀ a.
    fn excess(&self, a: &[f64], forces: &[Vec<f64>]) -> Vec<f64> {
        let of = |k: usize| self.base_stiffness[k].multiply(self.part(k, a)).into_iter().zip(&forces[k]);
        (0..self.active.len())
            .flat_map(|k| of(k).map(|(base_spring, q)| q - base_spring).collect::<Vec<_>>())
            .collect()
    }
}

impl Form for Condensed<'_> {
    fn interfaces(&self) -> &[InterfaceOperator] {
        self.base.interfaces
    }

    fn active(&self) -> &[usize] {
        &self.active
    }

    fn target(&self, force: &[f64], prescribed: &[f64]) -> Vec<f64> {
        let u = self.base.solve(force, prescribed).u;
        self.active.iter().flat_map(|&k| self.base.interfaces[k].coefficients(&u)).collect()
    }

    fn prepare(&mut self, ramp: Option<&Ramp>, measures: &[LinearMeasure]) -> bool {
        self.functionals.clear();
        let Some(ramp) = ramp else { return false };
        let loads = [0, 1].map(|end| (&ramp.force[end][..], &ramp.prescribed[end][..]));
        let ends = self.base.refined_all(&loads);
        let on_interfaces = |solution: &NodalSolution| -> Vec<f64> {
            self.active.iter().flat_map(|&k| self.base.interfaces[k].coefficients(&solution.u)).collect()
        };
        self.targets = [on_interfaces(&ends[0]), on_interfaces(&ends[1])];
        self.functionals = Functional::all(&self.base, &self.active, ramp, &ends, measures);
        true
    }

    fn prepared(&self, load_factor: f64) -> Vec<f64> {
        let [start, end] = &self.targets;
        let between = |(a, b): (&f64, &f64)| if load_factor == 1.0 { *b } else { a + load_factor * (b - a) };
        start.iter().zip(end).map(between).collect()
    }

    fn measured(&self, load_factor: f64, x: &[f64], forces: &[Vec<f64>]) -> Vec<f64> {
        let excess = self.excess(x, forces);
        self.functionals.iter().map(|functional| functional.value(load_factor, &excess)).collect()
    }

    fn coefficients(&self, x: &[f64]) -> Vec<Vec<f64>> {
        (0..self.active.len()).map(|k| self.part(k, x).to_vec()).collect()
    }

    fn residual(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
        let m = x.len();
        let mut residual: Vec<f64> = x.iter().zip(target).map(|(a, a0)| a - a0).collect();
        let excess = self.excess(x, forces);
        let excess = MatRef::from_column_major_slice(&excess, m, 1);
        matmul(column_mut(&mut residual), Accum::Add, self.flexibility.as_ref(), excess, 1.0, Par::Seq);
        residual
    }

    fn compare_with(&mut self, scale: ForceScale) {
        self.force_scale = scale;
    }

    /// Forces of the base stiffness for the misfit, over what the interfaces carry. If they carry nothing a small part of
    /// what the base stiffness alone would carry stands for it.
    fn error(&self, residual: &[f64], _: &[f64], forces: &[Vec<f64>], target: &[f64]) -> f64 {
        let squares = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
        let (mut misfit, mut scale) = (0.0, 0.0);
        for k in 0..self.active.len() {
            misfit += squares(&self.base_stiffness[k].multiply(self.part(k, residual)));
            let unlimited = squares(&self.base_stiffness[k].multiply(self.part(k, target)));
            scale += squares(&forces[k]) + SLIGHT * SLIGHT * unlimited;
        }
        self.force_scale.error(misfit, scale)
    }

    /// Every term of the residual to the precision of numbers. Where nothing holds the interface, jumps run away: those are no
    /// reason to be content with less.
    fn rounding(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64], _: &[InterfaceTangent]) -> f64 {
        let far = RUN_AWAY * target.iter().map(|a| a.abs()).fold(0.0, f64::max);
        let absolute = |v: &[f64]| v.iter().map(|v| v.abs().min(far)).collect::<Vec<f64>>();
        let sizes: Vec<Vec<f64>> = (0..self.active.len())
            .map(|k| {
                let base_spring = self.base_stiffness[k].multiply(&absolute(self.part(k, x)));
                base_spring
                    .iter()
                    .zip(&forces[k])
                    .map(|(base_spring, q)| base_spring.abs() + q.abs())
                    .collect()
            })
            .collect();
        let sizes = sizes.concat();
        let misfit: Vec<f64> = (0..x.len())
            .map(|i| {
                let moved = (0..x.len()).map(|j| self.flexibility[(i, j)].abs() * sizes[j]).sum::<f64>();
                ROUNDING * (moved + x[i].abs().min(far) + target[i].abs())
            })
            .collect();
        self.error(&misfit, x, forces, target)
    }

    fn couple(&mut self, beyond: Option<Mat<f64>>) {
        self.beyond = beyond;
    }

    fn factor(&mut self, tangents: &[InterfaceTangent]) -> bool {
        self.jacobian.factor(self.flexibility.as_ref(), tangents, self.beyond.as_ref());
        true
    }

    fn solve(&self, b: &mut [f64]) {
        self.jacobian.solve(b);
    }

    /// a − G u: F₀ carries the rounding of the condensation, which stiff bodies on soft interfaces magnify; u does not.
    fn defect(&self, x: &[f64], u: &[f64]) -> Vec<f64> {
        let moved = self.active.iter().flat_map(|&k| self.base.interfaces[k].coefficients(u));
        x.iter().zip(moved).map(|(a, moved)| a - moved).collect()
    }

    fn weights(&self, of_coefficients: &[Vec<f64>]) -> Vec<f64> {
        of_coefficients.concat()
    }

    fn recover(&self, x: &[f64], forces: &[Vec<f64>], force: &[f64], prescribed: &[f64]) -> NodalSolution {
        let mut load = force.to_vec();
        let excess: Vec<f64> = self.excess(x, forces).iter().map(|q| -q).collect();
        for (k, &interface) in self.active.iter().enumerate() {
            self.base.interfaces[interface].add_nodal(self.part(k, &excess), &mut load);
        }
        self.base.solve(&load, prescribed)
    }
}

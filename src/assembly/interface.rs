//! An interface on global dofs: a = G u, F = h Gᵀ Σ_p w_p N_pᵀ R_pᵀ t_p, K = h Gᵀ [Σ_p w_p N_pᵀ R_pᵀ D_p R_p N_p] G.

use crate::coupling::{Coupling, LawPoint};
use crate::sparse::Csr;

/// Directions that differ by no more than this are one.
const STRAIGHT: f64 = 8.0 * f64::EPSILON;
const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A coupling whose columns are dofs of the model.
#[derive(Debug, Clone)]
pub struct InterfaceOperator {
    /// Name of the interface.
    pub name: String,
    /// The coupling with its geometry; its own `jump` is in side columns.
    pub coupling: Coupling,
    /// Bodies of side A and side B.
    pub subdomains: [usize; 2],
    /// G on global dofs, in the axes of `turned`.
    pub(super) jump: Csr,
    /// The common n and t of a straight interface, in which its jump coefficients are then given; else they are in x, y.
    turned: Option<[[f64; 3]; 3]>,
    thickness: f64,
}

impl InterfaceOperator {
    /// Puts a coupling on the dofs of a model whose bodies start at the nodes `first`.
    pub fn new(
        name: &str,
        coupling: Coupling,
        subdomains: [usize; 2],
        first: [usize; 2],
        dofs: usize,
        thickness: f64,
    ) -> InterfaceOperator {
        let c = coupling.components;
        let nodes_a = coupling.sides[0].nodes.iter().map(|&node| first[0] + node);
        let nodes_b = coupling.sides[1].nodes.iter().map(|&node| first[1] + node);
        let nodes: Vec<usize> = nodes_a.chain(nodes_b).collect();
        let turned = common_axes(&coupling);
        let axes = turned.unwrap_or(IDENTITY);
        let mut entries = Vec::with_capacity(coupling.jump.values.len());
        for i in 0..coupling.jump.rows() {
            let (columns, values) = coupling.jump.row(i);
            for (a, axis) in axes.iter().take(c).enumerate().filter(|(_, axis)| axis[i % c] != 0.0) {
                let dof = |j: usize| c * nodes[j / c] + j % c;
                let turn = |(&j, &value): (&usize, &f64)| (i - i % c + a, dof(j), axis[i % c] * value);
                entries.extend(columns.iter().zip(values).map(turn));
            }
        }
        let jump = Csr::from_triplets(coupling.jump.rows(), dofs, &entries); // columns ascend again
        InterfaceOperator { name: name.into(), coupling, subdomains, jump, turned, thickness }
    }

    /// R of a law point on the jump coefficients as they are given.
    pub(super) fn rotation(&self, point: &LawPoint) -> [[f64; 3]; 3] {
        if self.turned.is_some() { IDENTITY } else { point.rotation }
    }

    /// Jump coefficients a = G u of displacements.
    pub fn coefficients(&self, u: &[f64]) -> Vec<f64> {
        self.jump.multiply(u)
    }

    /// Jumps (n, t, …) at the law points for displacements u.
    pub fn jumps(&self, u: &[f64]) -> Vec<f64> {
        self.jumps_of(&self.coefficients(u))
    }

    /// Jumps r_p = R_p N_p a (n, t, …) at the law points.
    pub fn jumps_of(&self, coefficients: &[f64]) -> Vec<f64> {
        let c = self.coupling.components;
        let mut jumps = vec![0.0; c * self.coupling.points.len()];
        for (point, jump) in self.coupling.points.iter().zip(jumps.chunks_exact_mut(c)) {
            for (row, jump) in self.rotation(point).iter().zip(jump) {
                for &(i, n) in &point.interpolation {
                    let a = &coefficients[c * i..c * (i + 1)];
                    *jump += n * row.iter().zip(a).map(|(r, a)| r * a).sum::<f64>();
                }
            }
        }
        jumps
    }

    /// The normal jump at a law point as weights on the jump coefficients.
    pub fn normal_jump(&self, point: usize) -> Vec<(usize, f64)> {
        let (c, point) = (self.coupling.components, &self.coupling.points[point]);
        let normal = self.rotation(point)[0];
        let of = |&(i, n): &(usize, f64)| (0..c).map(move |d| (c * i + d, n * normal[d]));
        point.interpolation.iter().flat_map(of).filter(|(_, weight)| *weight != 0.0).collect()
    }

    /// Forces on the jump coefficients, q = h Σ w Nᵀ Rᵀ t, of tractions (n, t, …) at the law points.
    pub fn gather(&self, tractions: &[f64]) -> Vec<f64> {
        let c = self.coupling.components;
        let mut q = vec![0.0; self.jump.rows()];
        for (point, traction) in self.coupling.points.iter().zip(tractions.chunks_exact(c)) {
            for &(i, n) in &point.interpolation {
                for (row, t) in self.rotation(point).iter().zip(traction) {
                    for (q, r) in q[c * i..c * (i + 1)].iter_mut().zip(row) {
                        *q += self.thickness * point.weight * n * r * t;
                    }
                }
            }
        }
        q
    }

    /// f += Gᵀ q for forces on the jump coefficients.
    pub fn add_nodal(&self, q: &[f64], f: &mut [f64]) {
        self.jump.add_transposed(q, f);
    }

    /// f += Gᵀ Σ w Nᵀ Rᵀ t for tractions (n, t, …) at the law points.
    pub fn add_force(&self, tractions: &[f64], f: &mut [f64]) {
        self.add_nodal(&self.gather(tractions), f);
    }

    /// sizes += |Gᵀ Σ w Nᵀ Rᵀ t|; `force` is zero everywhere, before and after.
    pub fn add_force_sizes(&self, tractions: &[f64], force: &mut [f64], sizes: &mut [f64]) {
        self.add_force(tractions, force);
        for &dof in &self.jump.columns {
            sizes[dof] += std::mem::take(&mut force[dof]).abs();
        }
    }

    /// Thickness out of the plane [length].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Number of jump coefficients with all their components.
    pub fn size(&self) -> usize {
        self.jump.rows()
    }

    /// Gᵀ T G, entry by entry (row, column, value) with repetitions.
    pub fn visit_stiffness(&self, tangent: &Csr, mut entry: impl FnMut(usize, usize, f64)) {
        let product = tangent.product(&self.jump);
        for i in 0..self.jump.rows() {
            let (left, left_values) = self.jump.row(i);
            let (right, right_values) = product.row(i);
            for (&row, left) in left.iter().zip(left_values) {
                for (&column, right) in right.iter().zip(right_values) {
                    entry(row, column, left * right);
                }
            }
        }
    }

    /// G.
    pub fn jump(&self) -> &Csr {
        &self.jump
    }

    /// G with its dofs numbered anew: `places` in a list of so many.
    pub fn numbered(&self, places: impl Fn(usize) -> usize, size: usize) -> Csr {
        let columns = self.jump.columns.iter().map(|&dof| places(dof)).collect();
        Csr { columns, width: size, ..self.jump.clone() }
    }

    /// Row i of G: dofs and values.
    pub fn row(&self, i: usize) -> (&[usize], &[f64]) {
        self.jump.row(i)
    }
}

/// n and t of the law points if they have them in common: stiff springs along one of them do not then reach into the other.
fn common_axes(coupling: &Coupling) -> Option<[[f64; 3]; 3]> {
    let first = coupling.points.first()?.rotation;
    let same = |point: &LawPoint| {
        let pairs = point.rotation.as_flattened().iter().zip(first.as_flattened());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) <= STRAIGHT
    };
    coupling.points.iter().all(same).then_some(first)
}
